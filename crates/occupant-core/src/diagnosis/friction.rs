//! Stability of friction in a step of the classical Runge–Kutta method, the one with fixed steps: step·f·wF/(v_s·m_eff)
//! must stay below 2.785.
//!
//! Friction is −f·wF·v_t/√(v_t² + v_s²); at low slip it is a damper f·wF/v_s against the effective mass along the
//! surface. The masses are those of the posture at the start. In the shipped cases the energy balance jumps where the
//! number exceeds the limit: 2.4e-6 at 2.72 and 3.3e-4 at 3.48 (`cart-unbelted`), 1.7e-6 at 2.79 and 6.7e-5 at 3.14
//! (`rear-seat`).

use serde::Serialize;

use super::mobility_of;
use super::rates::FrictionMasses;
use crate::model::Model;
use crate::results::recorder::{Flow, Recorder, RecorderError};
use crate::results::sample::Sample;
use placed_text::Problems;

/// Stability number above which a warning is due: where 1 + z + z²/2 + z³/6 + z⁴/24 = 1 on the negative real axis.
pub(super) const LIMIT: f64 = 2.785;

/// Friction of a sphere on a material that was unstable at the step size.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UnstableFriction {
    /// Name of the sphere.
    pub sphere: String,
    /// Name of the surface.
    pub surface: String,
    /// Name of its material.
    pub material: String,
    /// Time of the largest stability number, s.
    pub time_s: f64,
    /// Normal force at that time.
    pub normal_force_n: f64,
    /// The stability number.
    pub number: f64,
    /// The step.
    pub step_s: f64,
}

/// Monitors the normal forces of a run at its outputs; keeps the worst of each sphere and material.
#[derive(Clone, Debug, Default)]
pub struct FrictionWatch {
    masses: Option<FrictionMasses>,
    /// 0 under error control, which finds a stable step.
    step_s: f64,
    /// By sphere and material.
    worst: Vec<Worst>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Worst {
    number: f64,
    time_s: f64,
    normal_force_n: f64,
    surface: usize,
}

impl FrictionWatch {
    /// Empty.
    pub fn new() -> Self {
        FrictionWatch::default()
    }

    /// Unstable friction in the run of `model`, once per sphere and material, in the body's order.
    pub fn unstable(&self, model: &Model) -> Vec<UnstableFriction> {
        let setup = model.setup();
        let materials = setup.materials.len().max(1);
        let unstable = self.worst.iter().enumerate().filter(|(_, worst)| worst.number > LIMIT);
        unstable
            .map(|(i, worst)| UnstableFriction {
                sphere: setup.body.spheres[i / materials].name.clone(),
                surface: setup.surface_name(worst.surface).unwrap_or_default().to_owned(),
                material: setup.materials[i % materials].name.clone(),
                time_s: worst.time_s,
                normal_force_n: worst.normal_force_n,
                number: worst.number,
                step_s: self.step_s,
            })
            .collect()
    }

    /// The same as warnings, one per material: numbers of the worst sphere, names of the others.
    pub fn warnings(&self, model: &Model) -> Problems {
        let mut problems = Problems::new();
        let unstable = self.unstable(model);
        for material in &model.setup().materials {
            let own = || unstable.iter().filter(|f| f.material == material.name);
            if let Some(worst) = own().max_by(|a, b| a.number.total_cmp(&b.number)) {
                let others: Vec<&str> = own().filter(|f| f.sphere != worst.sphere).map(|f| f.sphere.as_str()).collect();
                warn(&mut problems, worst, &others);
            }
        }
        problems
    }

    fn see(&mut self, model: &Model, sphere: usize, surface: usize, force_n: f64, time_s: f64) {
        let Some(masses) = &self.masses else {
            return;
        };
        let number = force_n * masses.per_newton(model, sphere, surface, self.step_s);
        let setup = model.setup();
        let material = setup.surface_material(surface);
        let worst = &mut self.worst[sphere * setup.materials.len() + material];
        if number > worst.number {
            *worst = Worst { number, time_s, normal_force_n: force_n, surface };
        }
    }
}

/// Warning text for the worst sphere on a material.
fn warn(problems: &mut Problems, worst: &UnstableFriction, others: &[&str]) {
    let step_ms = worst.step_s * 1e3;
    let also = match others {
        [] => String::new(),
        names => format!(" (so may {})", names.join(", ")),
    };
    problems.warning(
        format!("materials.{}.friction", worst.material),
        format!(
            "friction is too stiff for the step of {step_ms:.4} ms: {:.0} N of {} on {} at t = {:.1} ms give a stability number of {:.1}, so the sphere may chatter{also}",
            worst.normal_force_n,
            worst.sphere,
            worst.surface,
            worst.time_s * 1e3,
            worst.number,
        ),
        format!(
            "at most {LIMIT}: a step of {:.4} ms or less, or a `friction_speed` {:.1} times as large",
            step_ms * LIMIT / worst.number,
            worst.number / LIMIT
        ),
    );
}

impl Recorder for FrictionWatch {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        let setup = model.setup();
        let step_s = setup.fixed_step_s().unwrap_or(0.0);
        *self = FrictionWatch {
            masses: Some(FrictionMasses::new(model, &mobility_of(model))),
            step_s,
            worst: vec![Worst::default(); setup.materials.len() * setup.body.spheres.len()],
        };
        Ok(())
    }

    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        if self.step_s == 0.0 {
            return Ok(Flow::Continue);
        }
        for contact in sample.contacts() {
            self.see(sample.model, contact.sphere, contact.surface, contact.normal_force_n, sample.time_s);
        }
        Ok(Flow::Continue)
    }
}

//! `[materials]`: the keys of a material, and the [`Material`] they come to.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::quantity::{FRACTION, NOT_NEGATIVE, POSITIVE, si_or};
use super::{Length, Ratio, Scenario, Speed, Stiffness};
use crate::forces::contact::material::{Material, Memory};
use crate::forces::spring::BilinearSpring;

/// A contact material: a bilinear spring that gives back part of its energy, and friction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-together" = [["k2", "delta_b"]]))]
pub(crate) struct MaterialSection {
    /// K₁, stiffness up to `delta_b`.
    pub(crate) k1: Stiffness<POSITIVE>,
    /// Δ_b, deformation at which the stiffness changes. Without it the spring is linear.
    pub(crate) delta_b: Option<Length<NOT_NEGATIVE>>,
    /// K₂, stiffness beyond `delta_b`.
    pub(crate) k2: Option<Stiffness<NOT_NEGATIVE>>,
    /// μ₁, fraction of the energy stored up to `delta_b` that unloading returns.
    pub(crate) mu1: Ratio<FRACTION>,
    /// μ₂, the same beyond `delta_b`; equal to `mu1` if absent.
    pub(crate) mu2: Option<Ratio<FRACTION>>,
    /// Coefficient of friction.
    pub(crate) friction: Ratio<NOT_NEGATIVE>,
    /// v_s, sliding speed at which friction reaches 71 % of its full value; 5 in/s if absent.
    pub(crate) friction_speed: Option<Speed<POSITIVE>>,
    /// Whether crush is remembered after contact has ended; "reset" if absent.
    pub(crate) memory: Option<Memory>,
}

/// All materials, in the order written.
pub(super) fn materials(scenario: &Scenario) -> Vec<Material> {
    scenario.materials.iter().map(|(name, section)| material(name, section)).collect()
}

fn material(name: &str, s: &MaterialSection) -> Material {
    let spring = spring(&s.k1, &s.k2, &s.delta_b, s.mu1.si(), &s.mu2);
    let plain = Material::new(name, spring, s.friction.si());
    Material {
        friction_speed_m_s: si_or(&s.friction_speed, plain.friction_speed_m_s),
        memory: s.memory.unwrap_or(plain.memory),
        ..plain
    }
}

/// A bilinear spring; linear where no break is given.
pub(super) fn spring(
    k1: &Stiffness<POSITIVE>,
    k2: &Option<Stiffness<NOT_NEGATIVE>>,
    delta_b: &Option<Length<NOT_NEGATIVE>>,
    returned_1: f64,
    mu2: &Option<Ratio<FRACTION>>,
) -> BilinearSpring {
    let line = BilinearSpring::linear(k1.si(), returned_1);
    BilinearSpring {
        k2_n_per_m: si_or(k2, line.k2_n_per_m),
        break_m: si_or(delta_b, line.break_m),
        returned_2: si_or(mu2, line.returned_2),
        ..line
    }
}

//! The fastest rates of the equations of motion at the start: springs of contacts and belts, dampers of joints.
//!
//! A spring K against an effective mass m oscillates with ω = √(K/m); a damper J against an effective inertia I decays
//! with J/I. The classical Runge–Kutta method is stable while step·rate stays below about 2.8 on either axis. These are
//! estimates: the posture is that of the start, the slope the steepest of the material, the mass the smallest of any
//! direction, and each force acts alone.

use nalgebra::{Matrix3, Vector3};
use serde::Serialize;

use super::mobility::{Mobility, across, greatest};
use crate::body::joint::{BallJoint, Joint};
use crate::forces::contact::flat_face::FlatFace;
use crate::forces::contact::surface::Frame;
use crate::forces::material::{BilinearSpring, Material};
use crate::forces::spring::Spring;
use crate::model::Model;
use crate::model::setup::Setup;
use crate::motion::frame::Moving;
use crate::motion::layout::{BALL_JOINTS, BALLS, HINGE_JOINTS};
use crate::results::sample::Sample;
use crate::vehicle::{FrameMotion, PathCursor};

/// step·rate at which the classical Runge–Kutta method becomes unstable, on the imaginary axis; 2.785 on the real one.
pub const RK4_STABILITY_LIMIT: f64 = 2.8;

/// A rate of the equations of motion.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Rate {
    /// Name of the sphere, belt or joint.
    pub of: String,
    /// What makes it: the material, the belt's sphere, or the joint's damper or spring.
    pub by: String,
    /// Effective mass in kg, or effective inertia in kg·m².
    pub effective: f64,
    /// Stiffness in N/m or N·m/rad, or damping in N·m·s/rad.
    pub coefficient: f64,
    /// 1/rate, s.
    pub time_scale_s: f64,
}

/// What a sphere meets: its stiffest contact and the friction that the step can bear.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SphereRate {
    /// The spring rate; `by` is the material.
    #[serde(flatten)]
    pub rate: Rate,
    /// Normal force up to which friction is stable at the step; absent without friction or with a step under error control.
    pub friction_limit_n: Option<f64>,
    /// The surface of that limit.
    pub friction_surface: Option<String>,
}

/// Effective mass of a sphere for friction, by surface.
#[derive(Clone, Debug)]
pub struct FrictionMasses {
    surfaces: usize,
    /// By sphere and surface, kg; 0 for pairs that cannot touch.
    tangential_kg: Vec<f64>,
}

impl FrictionMasses {
    /// For every sphere and every surface that it can touch.
    pub fn new(model: &Model, mobility: &Mobility<'_>) -> Self {
        let surfaces = model.faces().len();
        let mut tangential_kg = vec![0.0; surfaces * model.body().spheres.len()];
        for (sphere, surface) in pairs(model) {
            tangential_kg[sphere * surfaces + surface] = tangential(model, mobility, sphere, surface);
        }
        FrictionMasses { surfaces, tangential_kg }
    }

    /// step·f·wF/(v_s·m_eff), the friction's rate times the step; unstable above 2.
    pub fn number(&self, model: &Model, sphere: usize, surface: usize, normal_force_n: f64, step_s: f64) -> f64 {
        let per_newton = self.per_newton(model, sphere, surface, step_s);
        normal_force_n * per_newton
    }

    fn per_newton(&self, model: &Model, sphere: usize, surface: usize, step_s: f64) -> f64 {
        let mass_kg = self.tangential_kg[sphere * self.surfaces + surface];
        let setup = model.setup();
        let material = material_of(setup, surface);
        if mass_kg > 0.0 { step_s * material.friction / (material.friction_speed_m_s * mass_kg) } else { 0.0 }
    }
}

/// Pairs of sphere and surface that can touch.
fn pairs(model: &Model) -> impl Iterator<Item = (usize, usize)> + '_ {
    let contacts = &model.system().forces.contacts;
    contacts.groups().iter().flat_map(move |group| {
        let parts = contacts.pairs()[group.pairs.clone()].iter().flat_map(|p| &p.parts);
        parts.map(move |part| (group.sphere, part.surface))
    })
}

/// Smallest effective mass along the surface at the point of contact A = centre − r N̂, kg.
fn tangential(model: &Model, mobility: &Mobility<'_>, sphere: usize, surface: usize) -> f64 {
    let system = model.system();
    let site = &system.spheres[sphere];
    let normal = normal_in_space(model, &model.faces()[surface]);
    let (_, centre, _) = system.sphere(mobility.kinematics(), sphere);
    let point = centre - crate::motion::vector::V3::of(&normal) * site.radius;
    1.0 / greatest(across(&mobility.of_point(site.segment, point), &normal))
}

fn normal_in_space(model: &Model, face: &FlatFace) -> Vector3<f64> {
    match face.frame {
        Frame::Space => face.normal,
        Frame::Vehicle => vehicle_at_start(model).vector_to_space(face.normal),
    }
}

/// Motion of the vehicle at the start.
pub(super) fn vehicle_at_start(model: &Model) -> FrameMotion {
    let start_s = model.setup().time.start_s;
    let path = &model.setup().path;
    path.motion(start_s, start_s, &mut PathCursor::default())
}

/// The stiffest contact of each sphere that can touch anything.
pub(super) fn of_spheres(
    model: &Model,
    mobility: &Mobility<'_>,
    masses: &FrictionMasses,
    step_s: Option<f64>,
) -> Vec<SphereRate> {
    let setup = model.setup();
    let one = |sphere: usize| {
        let own = || pairs(model).filter(move |&(s, _)| s == sphere).map(|(_, f)| f);
        let slope = |&surface: &usize| steepest(&material_of(setup, surface).spring);
        let stiffest = own().max_by(|a, b| slope(a).total_cmp(&slope(b)))?;
        let site = &model.system().spheres[sphere];
        let (_, centre, _) = model.system().sphere(mobility.kinematics(), sphere);
        let mass_kg = 1.0 / greatest(mobility.of_point(site.segment, centre));
        let friction = step_s.and_then(|step_s| {
            let worst = |surface: usize| (masses.per_newton(model, sphere, surface, step_s), surface);
            let (per_newton, surface) = own().map(worst).max_by(|a, b| a.0.total_cmp(&b.0))?;
            (per_newton > 0.0).then_some((super::friction::LIMIT / per_newton, surface))
        });
        let name = |surface: usize| setup.surfaces[surface].name.clone();
        let rate = spring_rate(
            setup.body.spheres[sphere].name.clone(),
            material_of(setup, stiffest).name.clone(),
            mass_kg,
            slope(&stiffest),
        );
        Some(SphereRate {
            rate,
            friction_limit_n: friction.map(|f| f.0),
            friction_surface: friction.map(|f| name(f.1)),
        })
    };
    (0..setup.body.spheres.len()).filter_map(one).collect()
}

/// Belts: loop stiffness against the mass that the sum of the two free lengths' directions moves.
pub(super) fn of_belts(sample: &Sample<'_>, mobility: &Mobility<'_>) -> Vec<Rate> {
    let model = sample.model;
    let setup = model.setup();
    let vehicle: Moving<f64> = Moving::of(sample.vehicle);
    let one = |(belt, action): (&crate::forces::belt::Belt, &crate::forces::belt::law::BeltAction<f64>)| {
        // −gradient of the length with respect to the centre
        let gradient = vehicle.axes.out(action.free[0] + action.free[1]).to_vector();
        let site = &model.system().spheres[belt.sphere];
        let (_, centre, _) = model.system().sphere(mobility.kinematics(), belt.sphere);
        let give = gradient.dot(&(mobility.of_point(site.segment, centre) * gradient));
        let sphere = &setup.body.spheres[belt.sphere].name;
        spring_rate(belt.name.clone(), format!("on {sphere}"), 1.0 / give, steepest(&belt.webbing))
    };
    setup.belts.iter().zip(&sample.actions.belts).map(one).collect()
}

/// Joints: the damper at its strongest, and the spring.
pub(super) fn of_joints(model: &Model, mobility: &Mobility<'_>) -> Vec<Rate> {
    let j = &model.setup().joints;
    let name = |joint: Joint| j.tree()[joint].name;
    let mut rates = Vec::new();
    for (joint, &(inner, outer)) in BALL_JOINTS.iter().zip(BALLS) {
        let Some(law) = j[*joint].ball() else { continue };
        let relative = mobility.of_joint(inner, outer);
        rates.extend(ball_rates(name(*joint), law, &relative, mobility, inner, outer, j.epsilon));
    }
    for (limb, joint) in HINGE_JOINTS.iter().enumerate() {
        let Some(law) = j[*joint].hinge() else { continue };
        let stops = [law.lower_stop, law.upper_stop];
        let strongest = stops.iter().flatten().fold(law.damping_n_m_s, |most, stop| most.max(stop.damping_n_m_s));
        rates.extend(damper_rate(name(*joint), 1.0 / mobility.of_hinge(limb), strongest));
    }
    rates
}

fn ball_rates(
    name: &str,
    joint: &BallJoint,
    relative: &Matrix3<f64>,
    mobility: &Mobility<'_>,
    inner: usize,
    outer: usize,
    epsilon: f64,
) -> Vec<Rate> {
    let axes = &mobility.kinematics().axes;
    let (z_k, z_l) = (axes[inner].z.to_vector(), axes[outer].z.to_vector());
    let n = z_k.cross(&z_l);
    let sine_squared = (n.norm_squared() + epsilon * epsilon).max(1e-30);
    // T = −J·C·ω with C = [n nᵀ + ε²(1 − Z_k Z_kᵀ)]/(s² + ε²)
    let plane = Matrix3::identity() - z_k * z_k.transpose();
    let shape = (n * n.transpose() + plane * (epsilon * epsilon)) / sine_squared;
    let damping = joint.stop.map_or(joint.damping_n_m_s, |s| s.damping_n_m_s.max(joint.damping_n_m_s));
    // the eigenvalues of C·W are those of LᵀCL, W = L·Lᵀ
    let give = relative.cholesky().map_or(0.0, |c| greatest(c.l().transpose() * shape * c.l()));
    let mut rates = Vec::new();
    if give > 0.0 {
        rates.extend(damper_rate(name, 1.0 / give, damping));
    }
    let twist = z_l.dot(&(relative * z_l));
    rates.extend(damper_rate(&format!("{name}, twist"), 1.0 / twist, joint.twist_damping_n_m_s));
    let bend = n.dot(&(relative * n)) / sine_squared;
    if let Some(spring) = joint.spring.filter(|s| s.stiffness_n_m > 0.0 && bend > 0.0) {
        rates.push(spring_rate(name.to_owned(), "spring".to_owned(), 1.0 / bend, spring.stiffness_n_m));
    }
    rates
}

fn spring_rate(of: String, by: String, effective: f64, stiffness: f64) -> Rate {
    Rate { of, by, effective, coefficient: stiffness, time_scale_s: (effective / stiffness).sqrt() }
}

fn damper_rate(of: &str, inertia_kg_m2: f64, damping_n_m_s: f64) -> Option<Rate> {
    (damping_n_m_s > 0.0).then(|| Rate {
        of: of.to_owned(),
        by: "damper".to_owned(),
        effective: inertia_kg_m2,
        coefficient: damping_n_m_s,
        time_scale_s: inertia_kg_m2 / damping_n_m_s,
    })
}

/// Material of a surface.
fn material_of(setup: &Setup, surface: usize) -> &Material {
    &setup.materials[setup.surfaces[surface].material]
}

fn steepest(spring: &BilinearSpring) -> f64 {
    Spring::<f64>::new(spring).steepest()
}

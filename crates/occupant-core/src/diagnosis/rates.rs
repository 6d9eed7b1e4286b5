//! The fastest rates of contacts at the start, and the largest friction for which a step is stable.
//!
//! The classical Runge–Kutta method is stable while step·rate stays below about 2.8 on either axis. These are
//! estimates: the posture is that of the start, the slope the steepest of the material, the mass the smallest of any
//! direction, and each force acts alone.

use nalgebra::Vector3;
use serde::Serialize;

use crate::forces::contact::OPEN;
use crate::forces::contact::material::{Force, Material};
use crate::forces::contact::surface::Frame;
use crate::forces::rate::Rate;
use crate::model::Model;
use crate::model::setup::Setup;
use crate::motion::kinematics::Kinematics;
use crate::motion::mobility::{Mobility, across, greatest};
use crate::motion::vector::V3;
use crate::vehicle::{FrameMotion, PathCursor};

/// Stability limit step·rate of the classical Runge–Kutta method on the imaginary axis; 2.785 on the real one.
pub const RK4_STABILITY_LIMIT: f64 = 2.8;

/// Stiffest contact of a sphere, and the largest friction that is stable at the step.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SphereRate {
    /// The spring rate; `by` is the material.
    #[serde(flatten)]
    pub rate: Rate,
    /// Normal force up to which friction is stable at the step; absent without friction or under error control.
    pub friction_limit_n: Option<f64>,
    /// The surface of that limit.
    pub friction_surface: Option<String>,
}

/// Effective mass of a sphere for friction, by surface.
#[derive(Clone, Debug)]
pub(super) struct FrictionMasses {
    surfaces: usize,
    /// By sphere and surface, kg; 0 for pairs that cannot touch.
    tangential_kg: Vec<f64>,
}

impl FrictionMasses {
    /// Masses for all spheres and the surfaces that they can touch.
    pub(super) fn new(model: &Model, mobility: &Mobility<'_>) -> Self {
        let surfaces = model.setup().surface_names().count();
        let mut tangential_kg = vec![0.0; surfaces * model.body().spheres.len()];
        for (sphere, surface) in pairs(model) {
            tangential_kg[sphere * surfaces + surface] = tangential(model, mobility, sphere, surface);
        }
        FrictionMasses { surfaces, tangential_kg }
    }

    /// step·f/(v_s·m_eff): times the normal force it is step × friction rate, unstable above 2.
    pub(super) fn per_newton(&self, model: &Model, sphere: usize, surface: usize, step_s: f64) -> f64 {
        let mass_kg = self.tangential_kg[sphere * self.surfaces + surface];
        let material = material_of(model.setup(), surface);
        if mass_kg > 0.0 { step_s * material.friction / (material.friction_speed_m_s * mass_kg) } else { 0.0 }
    }
}

/// Pairs of sphere and surface that can touch; spheres of the body count as surfaces for others.
fn pairs(model: &Model) -> impl Iterator<Item = (usize, usize)> + '_ {
    let contacts = &model.system().forces.contacts;
    let faces = contacts.groups.iter().flat_map(move |group| {
        let parts = group.pairs.clone().flat_map(|i| &contacts.pairs[i].parts);
        parts.map(move |part| (group.sphere, part.surface))
    });
    let solids = contacts.solids.met().map(|(group, member)| (group.sphere, member.surface));
    let own = contacts.own.pairs.iter().flat_map(|pair| {
        let [a, b] = pair.spheres;
        [(a, contacts.own.surface + b), (b, contacts.own.surface + a)]
    });
    faces.chain(solids).chain(own)
}

/// Smallest effective mass along the surface at the point of contact A = centre − r N̂, kg.
fn tangential(model: &Model, mobility: &Mobility<'_>, sphere: usize, surface: usize) -> f64 {
    let system = model.system();
    let site = &system.spheres[sphere];
    let (_, centre, _) = system.sphere(&mobility.kinematics, sphere);
    if let Some(other) = surface.checked_sub(system.forces.contacts.own.surface) {
        // of the body: whatever the direction
        let (_, other_centre, _) = system.sphere(&mobility.kinematics, other);
        let give = |segment, centre| greatest(mobility.of_point(segment, centre));
        return 1.0 / (give(site.segment, centre) + give(system.spheres[other].segment, other_centre));
    }
    let normal = normal_in_space(model, centre, surface);
    let point = centre - V3::of(&normal) * site.radius;
    1.0 / greatest(across(&mobility.of_point(site.segment, point), &normal))
}

/// N̂ of a surface, or of a solid at `centre`, space axes.
fn normal_in_space(model: &Model, centre: V3<f64>, surface: usize) -> Vector3<f64> {
    let (frame, normal) = match model.faces().get(surface) {
        Some(face) => (face.frame, face.normal),
        None => {
            let solid = surface - model.faces().len();
            let frame = model.setup().solids[solid].frame;
            let place = V3::of(&frame_at_start(model, frame).point_to_frame(centre.to_vector()));
            let shape = &model.system().forces.contacts.solids.shapes[solid];
            (frame, shape.distance(place, OPEN).normal.to_vector())
        }
    };
    frame_at_start(model, frame).vector_to_space(normal)
}

/// Motion of a frame at the start.
pub(super) fn frame_at_start(model: &Model, frame: Frame) -> FrameMotion {
    frame_at(model, frame, model.setup().time.start_s)
}

/// Motion of a frame at a time, s; for one carried by a body, at the start.
pub(super) fn frame_at(model: &Model, frame: Frame, time_s: f64) -> FrameMotion {
    let vehicle = model.setup().path.motion(time_s, time_s, &mut PathCursor::default());
    let all = model.frames_with(time_s, time_s, &vehicle);
    match frame {
        Frame::Vehicle => vehicle,
        Frame::Space => FrameMotion::space(),
        Frame::Other(_) => all[frame.index(&[])].motion(),
        Frame::Segment(n) => Kinematics::new(&model.system().skeleton, &model.start().state).moving(n).motion(),
    }
}

/// The stiffest contact of each sphere.
pub(super) fn of_spheres(
    model: &Model,
    mobility: &Mobility<'_>,
    masses: &FrictionMasses,
    step_s: Option<f64>,
) -> Vec<SphereRate> {
    let setup = model.setup();
    let one = |sphere: usize| {
        let own = || pairs(model).filter(move |&(s, _)| s == sphere).map(|(_, f)| f);
        let share = setup.body.spheres[sphere].share;
        let slope = |&surface: &usize| share * material_of(setup, surface).force.steepest_n_per_m();
        let stiffest = own().max_by(|a, b| slope(a).total_cmp(&slope(b)))?;
        let site = &model.system().spheres[sphere];
        let (_, centre, _) = model.system().sphere(&mobility.kinematics, sphere);
        let mass_kg = 1.0 / greatest(mobility.of_point(site.segment, centre));
        let friction = step_s.and_then(|step_s| {
            let worst = |surface: usize| (masses.per_newton(model, sphere, surface, step_s), surface);
            let (per_newton, surface) = own().map(worst).max_by(|a, b| a.0.total_cmp(&b.0))?;
            (per_newton > 0.0).then_some((super::friction::LIMIT / per_newton, surface))
        });
        let name = |surface: usize| setup.surface_name(surface).unwrap_or_default().to_owned();
        let rate = Rate::of_spring(
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

/// The strongest damping of each sphere, from rate factors and dampers of its contacts.
pub(super) fn of_dampers(model: &Model, mobility: &Mobility<'_>) -> Vec<Rate> {
    let (setup, system) = (model.setup(), model.system());
    let damping = |(sphere, surface): (usize, usize)| {
        let Force::Deflection(law) = &material_of(setup, surface).force else { return 0.0 };
        setup.body.spheres[sphere].share * law.damping()
    };
    let one = |sphere: usize| {
        let own = pairs(model).filter(|(s, _)| *s == sphere);
        let (_, surface) = own.max_by(|a, b| damping(*a).total_cmp(&damping(*b)))?;
        let (_, centre, _) = system.sphere(&mobility.kinematics, sphere);
        let mass_kg = 1.0 / greatest(mobility.of_point(system.spheres[sphere].segment, centre));
        let name = format!("{}, {}", setup.body.spheres[sphere].name, material_of(setup, surface).name);
        Rate::of_damper(&name, mass_kg, damping((sphere, surface)))
    };
    (0..setup.body.spheres.len()).filter_map(one).collect()
}

/// Material of a surface.
fn material_of(setup: &Setup, surface: usize) -> &Material {
    &setup.materials[setup.surface_material(surface)]
}

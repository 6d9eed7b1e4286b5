//! The initial state: seat, contacts, other force elements.

use crate::forces::table::InOrder;
use serde::Serialize;

use super::rates::frame_at_start;
use super::shoulder::{self, ShoulderBelt};
use crate::forces::Instant;
use crate::forces::contact::PASSED;
use crate::forces::contact::flat_face::FlatFace;
use crate::forces::contact::material::Material;
use crate::forces::contact::surface::Outline;
use crate::forces::rate::Rate;
use crate::forces::table::Tables;
use crate::model::Model;
use crate::model::seating::InitialPosture;
use crate::model::settle::Settled;
use crate::motion::mobility::Mobility;
use crate::motion::vector::V3;
use crate::results::recorder::Watch;
use crate::results::sample::{Contact, Sample};
use crate::run::Course;

/// Key numbers of the seating, vehicle axes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SeatStart {
    /// Name of the cushion.
    pub cushion: String,
    /// Name of the back.
    pub back: String,
    /// Penetration of the pelvis into the cushion.
    pub sink_m: f64,
    /// Centre of the pelvis sphere.
    pub pelvis_m: [f64; 3],
    /// Left knee.
    pub left_knee_m: [f64; 3],
    /// Lean of the thighs; 90° is level, forward.
    pub thighs_deg: f64,
    /// Lean of the lower legs.
    pub lower_legs_deg: f64,
    /// Result of settling, if requested.
    pub settled: Option<Settled>,
    /// Imbalance without settling.
    pub unsettled: Option<Settled>,
}

/// A pair with a force at the start.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ContactStart {
    /// Name of the sphere.
    pub sphere: String,
    /// Name of the surface.
    pub surface: String,
    /// Δ.
    pub depth_m: f64,
    /// Normal force.
    pub normal_force_n: f64,
    /// Friction force at the initial sliding speed.
    pub friction_n: f64,
    /// Friction force at full sliding.
    pub full_friction_n: f64,
}

/// Friction of a material below its full value.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FrictionFigures {
    /// Name of the material.
    pub material: String,
    /// f.
    pub coefficient: f64,
    /// v_s, sliding speed at which friction is 71 % of its full value.
    pub speed_m_s: f64,
    /// Creep speed of a body on a slope of 10°; none if it slides.
    pub creeps_m_s: Option<f64>,
}

/// Friction of the materials in use.
pub(super) fn friction(model: &Model) -> Vec<FrictionFigures> {
    let setup = model.setup();
    let used = |i: &usize| (0..setup.surface_names().count()).any(|surface| setup.surface_material(surface) == *i);
    let rubs = (0..setup.materials.len()).filter(used).map(|i| &setup.materials[i]).filter(|m| m.friction > 0.0);
    let figures = |m: &Material| {
        // v_s tan θ/√(f² − tan² θ)
        let rest = m.friction * m.friction - TAN_10 * TAN_10;
        FrictionFigures {
            material: m.name.clone(),
            coefficient: m.friction,
            speed_m_s: m.friction_speed_m_s,
            creeps_m_s: (rest > 0.0).then(|| m.friction_speed_m_s * TAN_10 / rest.sqrt()),
        }
    };
    rubs.map(figures).collect()
}

/// tan 10°.
const TAN_10: f64 = 0.176_326_980_708_464_98;

/// A sphere whose centre starts behind a surface, where a user would expect it in front.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SphereBehind {
    /// Name of the sphere.
    pub sphere: String,
    /// Name of the surface.
    pub surface: String,
    /// Distance of the centre behind the plane.
    pub behind_m: f64,
}

/// Data from the first sample of a run.
#[derive(Default)]
pub(super) struct Look {
    pub contacts: Vec<ContactStart>,
    pub elements: Tables,
    pub shoulders: Vec<ShoulderBelt>,
    /// Of force elements.
    pub rates: Vec<Rate>,
}

/// Takes the first sample of a run, without a step.
pub(super) fn look(model: &Model, mobility: &Mobility<'_>) -> Look {
    let mut look = Look::default();
    let mut first = Watch(|sample: &Sample<'_>| {
        let (k, spheres) = (&sample.evaluation.kinematics, &model.system().spheres);
        let carried: Vec<_> = model.system().carriers.iter().map(|n| k.moving(*n)).collect();
        let at = Instant { k, state: sample.state, frames: sample.frames, carried: &carried, spheres, accepted: true };
        let data = model.setup().forces(model.faces());
        look = Look {
            contacts: sample.contacts().map(|c| contact(sample, &c)).collect(),
            elements: sample.start_tables(),
            shoulders: shoulder::all(sample),
            rates: data.rates(model.body(), &at, sample.actions, mobility),
        };
    });
    // a closure that watches never fails, so neither does the record
    let _recorded = Course::new(model).record(model, &mut first);
    look
}

fn contact(sample: &Sample<'_>, contact: &Contact) -> ContactStart {
    let setup = sample.model.setup();
    ContactStart {
        sphere: setup.body.spheres[contact.sphere].name.clone(),
        surface: setup.surface_name(contact.surface).unwrap_or_default().to_owned(),
        depth_m: contact.depth_m,
        normal_force_n: contact.normal_force_n,
        friction_n: contact.friction_n.norm(),
        full_friction_n: setup.materials[setup.surface_material(contact.surface)].friction * contact.normal_force_n,
    }
}

/// The seating's figures, if the body was seated.
pub(super) fn seat(model: &Model) -> Option<SeatStart> {
    let (setup, start) = (model.setup(), model.start());
    let (InitialPosture::Seated(seating), Some(seated)) = (&setup.posture, &start.seated) else {
        return None;
    };
    let name = |surface: usize| setup.surface_name(surface).unwrap_or_default().to_owned();
    Some(SeatStart {
        cushion: name(seating.cushion),
        back: name(seating.back),
        sink_m: seated.sink_m,
        pelvis_m: seated.pelvis_m.into(),
        left_knee_m: seated.knee_m.into(),
        thighs_deg: seated.legs_rad[0].to_degrees(),
        lower_legs_deg: seated.legs_rad[1].to_degrees(),
        settled: start.settled,
        unsettled: start.unsettled,
    })
}

/// Passed pairs whose sphere overlaps the face itself, not only its plane.
pub(super) fn behind(model: &Model, mobility: &Mobility<'_>) -> Vec<SphereBehind> {
    let (setup, contacts) = (model.setup(), &model.system().forces.contacts);
    let mut behind = Vec::new();
    for group in &contacts.groups {
        let (_, centre, _) = model.system().sphere(&mobility.kinematics, group.sphere);
        let radius_m = setup.body.spheres[group.sphere].radius_m;
        let passed = group.pairs.clone().filter(|&i| model.start().history.memory.contacts[i].phase == PASSED);
        let pairs = passed.map(|i| &contacts.pairs[i]);
        for (pair, part) in pairs.flat_map(|pair| pair.parts.iter().map(move |part| (pair, part))) {
            let plane = &model.faces()[part.surface];
            let place = frame_at_start(model, plane.frame).point_to_frame(centre.to_vector());
            let behind_m = plane.offset_m - plane.normal.dot(&place);
            let overlaps = behind_m > 0.0 && behind_m < radius_m;
            if overlaps && pair.beside(part, V3::of(&place)) < radius_m {
                behind.push(SphereBehind {
                    sphere: setup.body.spheres[group.sphere].name.clone(),
                    surface: setup.surfaces[part.surface].name.clone(),
                    behind_m,
                });
            }
        }
    }
    behind
}

/// Convex corners of two surfaces within reach of the body.
pub(super) fn corners(model: &Model) -> Vec<[String; 2]> {
    let (setup, faces) = (model.setup(), model.faces());
    let t1_m = model.start().state.t1().to_vector();
    let spheres = setup.body.spheres.iter().zip(setup.body.standing_m());
    let reach_m = spheres.map(|(sphere, place)| place.coords.norm() + sphere.radius_m).fold(0.0, f64::max);
    let is_near = |face: &FlatFace| {
        let from = frame_at_start(model, face.frame).point_to_frame(t1_m);
        matches!(&face.outline, Outline::Polygon(corners) if corners.iter().any(|p| (p.coords - from).norm() < reach_m))
    };
    let near: Vec<usize> = (0..faces.len()).filter(|i| is_near(&faces[*i])).collect();
    let corners = FlatFace::corners_among(faces, &near).into_iter();
    corners.map(|pair| pair.map(|i| setup.surfaces[i].name.clone())).collect()
}

/// Contacts possible within the body.
pub(super) fn self_contact(model: &Model) -> InOrder<String, Vec<String>> {
    let part = |sphere: usize| model.body().spheres[sphere].part.clone();
    let mut list: InOrder<String, Vec<String>> = InOrder::new();
    for pair in model.setup().self_contact.iter().flat_map(|own| &own.pairs) {
        let [one, other] = pair.map(part);
        let others = list.or_default(one);
        if !others.contains(&other) {
            others.push(other);
        }
    }
    list
}

//! Model and suitability of the step: the output of `occupant check`.
//!
//! All figures are those of the start of the run. Ours; the report prints the seating only.

mod ahead;
mod clearance;
mod friction;
mod lap;
mod rates;
mod shoulder;
mod start;

use crate::forces::table::InOrder;
use nalgebra::Vector3;
use serde::Serialize;

pub use crate::forces::chain::OnShoulder;
pub use crate::forces::rate::Rate;
use crate::forces::table::Tables;
pub use ahead::OpenAhead;
pub use clearance::{Clearance, Way, clearances};
pub use friction::{FrictionWatch, UnstableFriction};
pub use lap::LapBelt;
pub use rates::{RK4_STABILITY_LIMIT, SphereRate};
pub use shoulder::ShoulderBelt;
pub use start::{ContactStart, FrictionFigures, SeatStart, SphereBehind};

use crate::body::Segment;
use crate::model::Model;
use crate::motion::mobility::Mobility;
use crate::vehicle::{PathCursor, VehiclePath};
use rates::FrictionMasses;

/// Description of a simulation before it is run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Diagnosis {
    /// The scenario's title.
    pub title: String,
    /// The occupant.
    pub body: BodyFigures,
    /// Times and integrator.
    pub run: RunFigures,
    /// Motion of the vehicle.
    pub vehicle: VehicleFigures,
    /// Number of surfaces and solids.
    pub surfaces: usize,
    /// Seating, if the body was seated.
    pub seat: Option<SeatStart>,
    /// Sphere-surface pairs with a force at the start.
    pub contacts: Vec<ContactStart>,
    /// Materials with friction.
    pub friction: Vec<FrictionFigures>,
    /// Spheres that start behind a surface and have no contact until they have come out.
    pub behind: Vec<SphereBehind>,
    /// Unbelted occupants with neither panel nor windscreen in front.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub open_ahead: Vec<OpenAhead>,
    /// Lap belts that would slide up on the iliac wings from the start.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub lap_belts: Vec<LapBelt>,
    /// Clearances in front of head, chest and knees, and above the head.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub clearances: Vec<Clearance>,
    /// Position of belts on the shoulders under load.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub shoulder_belts: Vec<ShoulderBelt>,
    /// Corners between two surfaces within reach, around which a sphere may move without contact.
    pub corners: Vec<[String; 2]>,
    /// Parts of the body, and those that they can touch.
    pub self_contact: InOrder<String, Vec<String>>,
    /// Tables of force elements.
    #[serde(flatten)]
    pub elements: Tables,
    /// Time scales of contact springs, by sphere.
    pub sphere_rates: Vec<SphereRate>,
    /// Time scales of all other force elements: springs and dampers.
    pub other_rates: Vec<Rate>,
    /// The shortest time scale.
    pub fastest: Option<Rate>,
    /// Step over the shortest time scale; absent under error control.
    pub step_by_time_scale: Option<f64>,
}

/// Key numbers of the occupant.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BodyFigures {
    /// Name of the body.
    pub name: String,
    /// Total mass.
    pub mass_kg: f64,
    /// Mass of each segment.
    pub segments: Vec<SegmentFigures>,
    /// Degrees of freedom.
    pub degrees_of_freedom: usize,
    /// Contact spheres.
    pub spheres: usize,
    /// Known weakness of its numbers.
    pub weak: Option<&'static str>,
}

/// Key numbers of a segment.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SegmentFigures {
    /// Name.
    pub segment: &'static str,
    /// Mass.
    pub mass_kg: f64,
    /// Length.
    pub length_m: f64,
    /// Range of lengths of 90 % of the people with the body's sex, stature and mass, if it is a person's.
    pub length_band_m: Option<[f64; 2]>,
}

/// Key numbers of the run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RunFigures {
    /// Start.
    pub start_s: f64,
    /// End.
    pub end_s: f64,
    /// Output interval.
    pub output_s: f64,
    /// Outputs.
    pub outputs: usize,
    /// The integrator.
    pub integrator: &'static str,
    /// Fixed step; absent under error control.
    pub step_s: Option<f64>,
    /// Gravity.
    pub gravity_m_s2: f64,
}

/// Key numbers of the vehicle's motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct VehicleFigures {
    /// Kind of path.
    pub path: &'static str,
    /// Speed at the start.
    pub start_speed_m_s: f64,
    /// Speed at the end.
    pub end_speed_m_s: f64,
    /// Magnitude of the velocity change between them.
    pub velocity_change_m_s: f64,
    /// Peak deceleration, m/s², and duration, s, of its pulse, if the path is one.
    pub pulse: Option<[f64; 2]>,
}

impl Diagnosis {
    /// False if the fixed step is too long for the shortest time scale; true if not known to be.
    pub fn step_is_stable(&self) -> bool {
        self.step_by_time_scale.is_none_or(|number| number < RK4_STABILITY_LIMIT)
    }

    /// Time scales for which the fixed step is too long.
    pub fn too_fast(&self) -> Vec<&Rate> {
        let all = self.sphere_rates.iter().map(|s| &s.rate).chain(&self.other_rates);
        let limit_s = self.run.step_s.map_or(0.0, |step_s| step_s / RK4_STABILITY_LIMIT);
        all.filter(|rate| rate.time_scale_s <= limit_s).collect()
    }
}

/// Examines the start of a run.
pub fn diagnose(model: &Model) -> Diagnosis {
    let setup = model.setup();
    let step_s = setup.fixed_step_s();
    let mobility = mobility_of(model);
    let masses = FrictionMasses::new(model, &mobility);
    let sphere_rates = rates::of_spheres(model, &mobility, &masses, step_s);
    let start = start::look(model, &mobility);
    let other_rates: Vec<Rate> = start.rates.into_iter().chain(rates::of_dampers(model, &mobility)).collect();
    let all = sphere_rates.iter().map(|s| &s.rate).chain(&other_rates);
    let fastest = all.min_by(|a, b| a.time_scale_s.total_cmp(&b.time_scale_s)).cloned();
    let step_by_time_scale = step_s.zip(fastest.as_ref()).map(|(h, r)| h / r.time_scale_s);
    Diagnosis {
        title: setup.title.clone(),
        body: body(model),
        run: RunFigures {
            start_s: setup.time.start_s,
            end_s: setup.time.end_s,
            output_s: setup.time.output_s,
            outputs: model.output_count(),
            integrator: setup.integrator.name(),
            step_s,
            gravity_m_s2: setup.gravity_m_s2,
        },
        vehicle: vehicle(model),
        surfaces: setup.surfaces.len() + setup.solids.len(),
        seat: start::seat(model),
        contacts: start.contacts,
        friction: start::friction(model),
        behind: start::behind(model, &mobility),
        open_ahead: ahead::open_ahead(model),
        lap_belts: lap::sliding(model),
        clearances: clearances(model),
        shoulder_belts: start.shoulders,
        corners: start::corners(model),
        self_contact: start::self_contact(model),
        elements: start.elements,
        sphere_rates,
        other_rates,
        fastest,
        step_by_time_scale,
    }
}

/// Mobility of the body of `model` at the start.
fn mobility_of(model: &Model) -> Mobility<'_> {
    Mobility::new(&model.system().skeleton, &model.start().state)
}

fn body(model: &Model) -> BodyFigures {
    let body = model.body();
    let segment = |s: Segment| SegmentFigures {
        segment: body.tree[s].name,
        mass_kg: body.segment(s).mass_kg,
        length_m: body.segment(s).length_m,
        length_band_m: None,
    };
    BodyFigures {
        name: body.name.clone(),
        mass_kg: body.mass_kg(),
        segments: body.tree.segments().map(segment).collect(),
        degrees_of_freedom: body.tree.degrees_of_freedom() - if model.setup().mounting().is_some() { 6 } else { 0 },
        spheres: body.spheres.len(),
        weak: None,
    }
}

fn vehicle(model: &Model) -> VehicleFigures {
    let setup = model.setup();
    let mut cursor = PathCursor::default();
    let mut velocity = |t: f64| -> Vector3<f64> { setup.path.motion(t, t, &mut cursor).velocity_m_s };
    let (first, last) = (velocity(setup.time.start_s), velocity(setup.time.end_s));
    VehicleFigures {
        path: match setup.path {
            VehiclePath::Table(_) => "table",
            VehiclePath::Pulse(_) => "pulse",
            VehiclePath::Sensors(_) => "sensors",
            VehiclePath::Fixed(_) => "fixed",
            VehiclePath::Driven(_) => "drive",
            VehiclePath::Live(_) => "live",
            VehiclePath::Own(_) => "own",
        },
        start_speed_m_s: first.norm(),
        end_speed_m_s: last.norm(),
        velocity_change_m_s: (last - first).norm(),
        pulse: match &setup.path {
            VehiclePath::Pulse(path) => {
                let (from_s, to_s) = path.pulse_span_s();
                Some([path.peak_deceleration_m_s2(), to_s - from_s])
            }
            _ => None,
        },
    }
}

#[cfg(test)]
pub(crate) mod tests;

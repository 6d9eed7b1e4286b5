//! The model: a checked [`Setup`] with all that can be computed before the first step. Immutable, shared by all threads.

pub mod seat;
pub mod seating;
pub mod settle;
pub mod setup;
mod validate;

use nalgebra::Vector3;

use crate::body::Body;
use crate::forces::History;
use crate::forces::belt::law::BeltLaw;
use crate::forces::contact::flat_face::FlatFace;
use crate::forces::contact::{ContactSystem, PairHistory};
use crate::forces::joint::JointSystem;
use crate::kernel::System;
use crate::model::seat::{Seat, Seated, seat};
use crate::model::seating::{InitialPosture, InitialVelocity, Seating};
use crate::model::settle::{Settled, settle};
use crate::model::setup::Setup;
use crate::motion::frame::Frames;
use crate::motion::frame::{Moving, VEHICLE};
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::{BALLS, FREE};
use crate::motion::skeleton::Skeleton;
use crate::motion::state::State;
use crate::motion::vector::V3;
use crate::problem::Problems;
use crate::vehicle::{FrameMotion, PathCursor};

/// A scenario ready to run.
#[derive(Clone, Debug)]
pub struct Model {
    setup: Setup,
    faces: Vec<FlatFace>,
    system: System<f64>,
    start: Start,
    warnings: Problems,
}

/// The occupant at the start.
#[derive(Clone, Debug)]
pub struct Start {
    /// State.
    pub state: State<f64>,
    /// Pair states and belt histories.
    pub history: History<f64>,
    /// Figures of the seating, if the body was seated.
    pub seated: Option<Seated>,
    /// Outcome of settling, if it was asked for.
    pub settled: Option<Settled>,
}

impl Model {
    /// Checks `setup` and computes the start of the run.
    ///
    /// # Errors
    /// Every problem of the setup at once; warnings alone do not fail and are kept in [`Model::warnings`].
    pub fn new(setup: Setup) -> Result<Model, Problems> {
        let mut problems = Problems::new();
        validate::check(&setup, &mut problems);
        let faces: Vec<Option<FlatFace>> =
            setup.surfaces.iter().map(|s| FlatFace::new(s, &format!("surfaces.{}", s.name), &mut problems)).collect();
        if let Err(problem) = setup.path.check_span(setup.time.start_s, setup.time.end_s) {
            problems.error("path", problem.to_string(), "a path for the whole run");
        }
        if problems.has_errors() {
            return Err(problems);
        }
        let faces: Vec<FlatFace> = faces.into_iter().flatten().collect();
        match begin(&setup, &faces, &mut problems) {
            Some((system, start)) if !problems.has_errors() => {
                Ok(Model { setup, faces, system, start, warnings: problems })
            }
            _ => Err(problems),
        }
    }

    /// What the model was made from.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// The occupant's body.
    pub fn body(&self) -> &Body {
        &self.setup.body
    }

    /// Planes and outlines of the surfaces, in the setup's order.
    pub fn faces(&self) -> &[FlatFace] {
        &self.faces
    }

    /// The derivative kernel's constants.
    pub fn system(&self) -> &System<f64> {
        &self.system
    }

    /// The occupant at the start.
    pub fn start(&self) -> &Start {
        &self.start
    }

    /// Things that a user should know but that do not stop a run.
    pub fn warnings(&self) -> &Problems {
        &self.warnings
    }

    /// Time of output `index`, s; the last is the end of the run.
    pub fn output_time_s(&self, index: usize) -> Option<f64> {
        let time = &self.setup.time;
        let (number, whole) = (index as f64, time.whole_intervals());
        if number <= whole {
            Some(time.start_s + number * time.output_s)
        } else {
            (number <= whole + 1.0).then_some(time.end_s)
        }
    }

    /// Number of outputs of a whole run.
    pub fn output_count(&self) -> usize {
        self.setup.time.whole_intervals() as usize + 2
    }

    /// Frames at `t_s` within a step whose middle is `step_middle_s`.
    pub fn frames(&self, t_s: f64, step_middle_s: f64, cursor: &mut PathCursor) -> Frames<f64> {
        frames(&self.setup.path.motion(t_s, step_middle_s, cursor))
    }
}

/// Frames for a motion of the vehicle.
pub fn frames(vehicle: &FrameMotion) -> Frames<f64> {
    [Moving::space(), Moving::of(vehicle)]
}

/// Places the body, then everything that depends on where it is: β₀, L₀, pair states, velocities.
fn begin(setup: &Setup, faces: &[FlatFace], problems: &mut Problems) -> Option<(System<f64>, Start)> {
    let start_s = setup.time.start_s;
    let vehicle = setup.path.motion(start_s, start_s, &mut PathCursor::default());
    let skeleton = Skeleton::new(&setup.body, setup.gravity_m_s2);
    let contacts = ContactSystem::new(
        &setup.body,
        &setup.surfaces,
        faces,
        &setup.materials,
        setup.edge_force,
        setup.integrator.longest_step_s(),
    );
    let mut system =
        System { skeleton, joints: JointSystem::new(&setup.joints, &[0.0; BALLS.len()]), contacts, belts: Vec::new() };
    let (mut state, seated, settled) = match &setup.posture {
        InitialPosture::Coordinates(q) | InitialPosture::Continued { coordinates: q, .. } => (q.to_state(), None, None),
        InitialPosture::Seated(seating) => {
            let place = seat_of(setup, faces, seating, problems)?;
            let (state, seated) = seat(&setup.body, seating, &place, &vehicle, setup.gravity_m_s2, problems)?;
            if seating.settle {
                let (state, settled) = settle(setup, &system, &vehicle, state);
                settled.warn(problems);
                (state, Some(seated), Some(settled))
            } else {
                (state, Some(seated), None)
            }
        }
    };
    if !state.is_finite() {
        problems.error("posture", "coordinates that are not finite numbers", "numbers");
        return None;
    }
    if seated.is_some() {
        set_velocity(&mut state, &setup.velocity, &vehicle);
    }
    let k = Kinematics::new(&system.skeleton, &state);
    let rest: [f64; BALLS.len()] = std::array::from_fn(|i| system.joints.beta(i, &k));
    system.joints = JointSystem::new(&setup.joints, &rest);
    system.belts = belts(setup, &system, &k, &vehicle, problems);
    let mut history = initial_history(&system, &k, &frames(&vehicle));
    if let InitialPosture::Continued { passed, .. } = &setup.posture {
        let pairs = |at: usize| continued_history(&system, &k, &frames(&vehicle), passed, at);
        history.pairs = (0..system.contacts.groups().len()).flat_map(pairs).collect();
    }
    Some((system, Start { state, history, seated, settled }))
}

fn seat_of<'a>(
    setup: &'a Setup,
    faces: &'a [FlatFace],
    seating: &Seating,
    problems: &mut Problems,
) -> Option<Seat<'a>> {
    let mut face = |index: usize, key: &str| {
        let found = faces.get(index);
        if found.is_none() {
            problems.error(format!("seat.{key}"), "no such surface", "a surface of the scenario");
        }
        found
    };
    let (cushion, back) = (face(seating.cushion, "cushion"), face(seating.back, "back"));
    let material = setup.surfaces.get(seating.cushion)?.material;
    Some(Seat { cushion: cushion?, back: back?, spring: &setup.materials.get(material)?.spring })
}

/// Gives every point of the body its velocity at the start.
fn set_velocity(state: &mut State<f64>, velocity: &InitialVelocity, vehicle: &FrameMotion) {
    match velocity {
        InitialVelocity::WithVehicle => {
            state.velocity = V3::of(&vehicle.velocity_at(state.t1.to_vector()));
            state.omega = [V3::of(&vehicle.angular_velocity_rad_s); FREE.len()];
        }
        InitialVelocity::VehicleOrigin => state.velocity = V3::of(&vehicle.velocity_m_s),
        InitialVelocity::Given(v) => {
            state.velocity = V3::of(&vehicle.vector_to_space(*v));
        }
    }
}

fn belts(
    setup: &Setup,
    system: &System<f64>,
    k: &Kinematics<f64>,
    vehicle: &FrameMotion,
    problems: &mut Problems,
) -> Vec<BeltLaw<f64>> {
    let law = |belt: &crate::forces::belt::Belt| {
        let path = format!("belts.{}", belt.name);
        let radius = setup.body.spheres[belt.sphere].radius_m;
        let centre = centre_in(system, k, belt.sphere, vehicle);
        for (i, anchor) in belt.anchors_m.iter().enumerate() {
            let distance = (anchor.coords - centre).norm();
            if distance <= radius {
                problems.error_with_hint(
                    format!("{path}.anchors"),
                    format!(
                        "anchor {} lies {:.4} m from the centre of the sphere {} of radius {radius:.4} m",
                        i + 1,
                        distance,
                        setup.body.spheres[belt.sphere].name
                    ),
                    "an anchor outside the sphere that the belt goes round",
                    "move the anchor, or check the seat's lateral place and the anchor's sign of y",
                );
            }
        }
        let law = BeltLaw::laid(belt, radius, V3::of(&centre));
        let rest_length_m = law.rest_length;
        if !(rest_length_m.is_finite() && rest_length_m > 0.0) {
            problems.error(path, format!("an unstretched length of {rest_length_m} m"), "a positive length");
        }
        law
    };
    setup.belts.iter().map(law).collect()
}

fn centre_in(system: &System<f64>, k: &Kinematics<f64>, sphere: usize, vehicle: &FrameMotion) -> Vector3<f64> {
    vehicle.point_to_frame(system.sphere(k, sphere).1.to_vector())
}

/// Pair states of group `at` where an earlier run ended: the listed pairs have passed, all others that overlap touch.
fn continued_history(
    system: &System<f64>,
    k: &Kinematics<f64>,
    frames: &Frames<f64>,
    passed: &[(usize, usize)],
    at: usize,
) -> Vec<PairHistory<f64>> {
    let group = &system.contacts.groups()[at];
    let frame = &frames[group.frame];
    let centre = frame.axes.into_frame(system.sphere(k, group.sphere).1 - frame.origin);
    let history = |i: usize| {
        let parts = &system.contacts.pairs()[i].parts;
        let is_passed = parts.iter().any(|part| passed.contains(&(group.sphere, part.surface)));
        system.contacts.continued_history(i, centre, is_passed)
    };
    group.pairs.clone().map(history).collect()
}

/// Pair states and belt histories of a body that stands where it is.
pub(crate) fn initial_history(system: &System<f64>, k: &Kinematics<f64>, frames: &Frames<f64>) -> History<f64> {
    let in_frame = |sphere: usize, frame: usize| {
        let f: &Moving<f64> = &frames[frame];
        f.axes.into_frame(system.sphere(k, sphere).1 - f.origin)
    };
    let mut pairs = Vec::with_capacity(system.contacts.pairs().len());
    for group in system.contacts.groups() {
        let radius = system.contacts.sites[group.sphere].radius;
        let centre = in_frame(group.sphere, group.frame);
        let history = |i| system.contacts.initial_history(i, radius, centre);
        pairs.extend(group.pairs.clone().map(history));
    }
    let belts = system.belts.iter().map(|b| b.initial_history(in_frame(b.sphere, VEHICLE))).collect();
    History::new(&system.contacts, pairs, belts)
}

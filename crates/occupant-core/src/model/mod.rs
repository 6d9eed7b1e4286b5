//! The model: a checked [`Setup`] with all that can be computed before the first step. Immutable, shared by all threads.

mod limp;
mod pose;
pub mod seat;
pub mod seating;
pub mod settle;
pub mod setup;
mod validate;

use crate::body::Body;
use crate::forces::bag::Bag;
use crate::forces::chain::Chain;
use crate::forces::contact::OPEN;
use crate::forces::contact::flat_face::FlatFace;
use crate::forces::contact::solid::Solids;
use crate::forces::sphere::Site;
use crate::forces::{Data, Forces, History, Instant};
use crate::kernel::System;
use crate::model::limp::{Rest, sink};
use crate::model::pose::hang;
use crate::model::seat::{Seat, SeatPlane, Seated, seat};
use crate::model::seating::{InitialPosture, InitialVelocity, Seating, Settling};
use crate::model::settle::{Settled, carry, kept, lack, settle};
use crate::model::setup::Setup;
use crate::motion::frame::{Frames, Moving};
use crate::motion::kinematics::Kinematics;
use crate::motion::skeleton::Skeleton;
use crate::motion::state::{MOST_OWN, State};
use crate::motion::vector::V3;
use crate::vehicle::{FrameMotion, PathCursor, VehiclePath};
use nalgebra::Vector3;
use placed_text::Problems;

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
    /// History of the force elements.
    pub history: History<f64>,
    /// Figures of the seating, if the body was seated.
    pub seated: Option<Seated>,
    /// Outcome of settling, if it was asked for.
    pub settled: Option<Settled>,
    /// What is left over of a seated body that was not to settle.
    pub unsettled: Option<Settled>,
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
        validate::check_path(&setup, &mut problems);
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

    /// The same, its body swept as any tree is.
    #[cfg(test)]
    pub(crate) fn without_closed_forms(mut self) -> Self {
        self.system.skeleton = self.system.skeleton.without_closed_forms();
        self
    }

    /// Things that a user should know but that do not stop a run.
    pub fn warnings(&self) -> &Problems {
        &self.warnings
    }

    /// Time of output `index`, s; the last is the end of the run.
    pub(crate) fn output_time_s(&self, index: usize) -> Option<f64> {
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

    /// Times at which the vehicle's motion jumps, a muscle begins or ends to act, or a device of a belt or bag does, s, in increasing order: no step goes
    /// across one where the error control chooses it.
    pub(crate) fn breaks_s(&self) -> Vec<f64> {
        let mut breaks_s = self.setup.path.breaks_s();
        breaks_s.extend(self.setup.joints.muscles.iter().flat_map(|muscle| muscle.times_s));
        breaks_s.extend(self.setup.chains.iter().flat_map(Chain::breaks_s));
        breaks_s.extend(self.setup.bags.iter().flat_map(Bag::breaks_s));
        breaks_s.sort_by(f64::total_cmp);
        breaks_s.dedup();
        breaks_s
    }

    /// Frames at `t_s` within a step whose middle is `step_middle_s`.
    pub fn frames(&self, t_s: f64, step_middle_s: f64, cursor: &mut PathCursor) -> Frames<f64> {
        frames(t_s, &self.vehicle(t_s, step_middle_s, cursor))
    }

    /// Motion of the vehicle at `t_s` within a step whose middle is `step_middle_s`.
    pub(crate) fn vehicle(&self, t_s: f64, step_middle_s: f64, cursor: &mut PathCursor) -> FrameMotion {
        let path = &self.setup.path;
        // only a mount feels accelerations
        let motion = if self.setup.mounting().is_some() { VehiclePath::motion_within } else { VehiclePath::motion };
        motion(path, t_s, step_middle_s, cursor)
    }
}

/// Frames for a motion of the vehicle at a time.
pub fn frames(time_s: f64, vehicle: &FrameMotion) -> Frames<f64> {
    Frames { time: time_s, moving: [Moving::space(), Moving::of(vehicle)] }
}

/// Places the body, then everything that depends on where it is: velocities, constants and history of force elements.
fn begin(setup: &Setup, faces: &[FlatFace], problems: &mut Problems) -> Option<(System<f64>, Start)> {
    let start_s = setup.time.start_s;
    let vehicle = setup.path.motion(start_s, start_s, &mut PathCursor::default());
    let mut skeleton = Skeleton::new(&setup.body, setup.gravity_m_s2);
    if let Some(mounting) = setup.mounting() {
        skeleton = skeleton.mounted(mounting.mount(setup.body.joint_m(setup.body.tree.segment(0))));
    }
    let data = setup.forces(faces);
    let forces = Forces::new(&data, &setup.body);
    let mut system = System { skeleton, spheres: Site::all(&setup.body), forces };
    let Placed { mut state, seated, mut settled, unsettled, rest } =
        place(setup, faces, &data, &system, &vehicle, problems)?;
    if !state.is_finite() {
        problems.error("posture", "coordinates that are not finite numbers", "numbers");
        return None;
    }
    if seated.is_some() {
        set_velocity(&mut state, &setup.velocity, &vehicle);
    }
    let k = Kinematics::new(&system.skeleton, &state);
    let at =
        Instant { k: &k, state: &state, frames: &frames(start_s, &vehicle), spheres: &system.spheres, accepted: false };
    let forces = &mut system.forces;
    forces.lay(&data, &setup.body, &at);
    forces.begin(&data, &setup.body, &at, problems);
    rest.iter().for_each(|rest| rest.keep(forces));
    let own = forces.own();
    if own.len() > MOST_OWN {
        let found = format!("bags with {} numbers of gas", own.len());
        problems.error("bags", found, format!("at most {MOST_OWN}: five for each bag and one more for each inflator"));
        return None;
    }
    let mut history = forces.start(&at);
    rest.iter().for_each(|rest| rest.hold(&mut history));
    if let InitialPosture::Continued { passed, .. } = &setup.posture {
        history.memory.contacts = forces.contacts.continued(&at, passed);
        warn_apart(setup, forces, &history, passed, problems);
    }
    if let Some(settled) = &mut settled {
        let (still, standing) = (state.still(), frames(start_s, &vehicle.held()));
        carry(&mut system, &still, &standing, &history);
        settled.lack = lack(&system, &setup.body, &still, &standing, &history);
    }
    let state = state.with_own(&own);
    Some((system, Start { state, history, seated, settled, unsettled }))
}

/// Where a body begins.
struct Placed {
    state: State<f64>,
    seated: Option<Seated>,
    settled: Option<Settled>,
    unsettled: Option<Settled>,
    rest: Option<Rest>,
}

impl Placed {
    fn at(state: State<f64>) -> Self {
        Placed { state, seated: None, settled: None, unsettled: None, rest: None }
    }
}

/// Places the body by what the setup says of its posture.
fn place(
    setup: &Setup,
    faces: &[FlatFace],
    data: &Data<'_>,
    system: &System<f64>,
    vehicle: &FrameMotion,
    problems: &mut Problems,
) -> Option<Placed> {
    let seating = match &setup.posture {
        InitialPosture::Seated(seating) => seating,
        InitialPosture::Coordinates(q) | InitialPosture::Continued { coordinates: q, .. } => {
            return Some(Placed::at(q.to_state()));
        }
        InitialPosture::Mounted(mounting) => {
            let carrier = mounting.carrier(vehicle);
            let mut state = hang(&setup.body, mounting, &carrier);
            set_velocity(&mut state, &InitialVelocity::WithVehicle, &carrier);
            return Some(Placed::at(state));
        }
    };
    let on = seat_of(setup, faces, &system.forces.contacts.solids, seating, vehicle, problems)?;
    let (state, seated) = seat(&setup.body, seating, &on, vehicle, setup.gravity_m_s2, problems)?;
    let mut placed = Placed { seated: Some(seated), ..Placed::at(state) };
    match seating.settle {
        Settling::Not => placed.unsettled = Some(kept(setup, data, system, vehicle, &state)),
        Settling::Locked => {
            let (state, settled) = settle(setup, data, system, vehicle, state);
            (placed.state, placed.settled) = (state, Some(settled));
        }
        Settling::Limp => {
            let (seated, _) = settle(setup, data, system, vehicle, state);
            let (state, settled, rest) = sink(setup, data, system, vehicle, seated);
            (placed.state, placed.settled, placed.rest) = (state, Some(settled), Some(rest));
        }
    }
    placed.settled.inspect(|settled| settled.warn(problems));
    Some(placed)
}

/// Names the pairs that are said to have passed each other and do not overlap: they are open, as if they were not listed.
fn warn_apart(
    setup: &Setup,
    forces: &Forces<f64>,
    history: &History<f64>,
    passed: &[(usize, usize)],
    problems: &mut Problems,
) {
    let (contacts, pairs) = (&forces.contacts, &history.memory.contacts);
    let is_apart = |&&(sphere, surface): &&(usize, usize)| {
        let groups = contacts.groups.iter().filter(|group| group.sphere == sphere);
        let open = |i: usize| pairs[i].phase == OPEN && contacts.pairs[i].parts.iter().any(|p| p.surface == surface);
        groups.flat_map(|group| group.pairs.clone()).any(open)
    };
    let names = |&(sphere, surface): &(usize, usize)| {
        Some(format!("{} and {}", setup.body.spheres.get(sphere)?.name, setup.surface_name(surface)?))
    };
    let apart: Vec<String> = passed.iter().filter(is_apart).filter_map(names).collect();
    if !apart.is_empty() {
        let found = format!("pairs that do not overlap at the start, and so have no effect: {}", apart.join(", "));
        problems.warning("initial_state.passed", found, "pairs that overlap where the earlier run ended");
    }
}

/// The planes of a seat: of solids, the face of the cushion that looks most upwards and that of the back that looks most
/// towards the heels.
fn seat_of<'a>(
    setup: &'a Setup,
    faces: &[FlatFace],
    solids: &Solids<f64>,
    seating: &Seating,
    vehicle: &FrameMotion,
    problems: &mut Problems,
) -> Option<Seat<'a>> {
    let mut plane = |index: usize, key: &str, looks: &dyn Fn(Vector3<f64>) -> Vector3<f64>| {
        let face = faces.get(index).map(|face| SeatPlane { normal: face.normal, offset_m: face.offset_m });
        let solid = || solids.shapes.get(index.checked_sub(faces.len())?)?.plane_towards(looks);
        let found = face.or_else(|| solid().map(|(normal, offset_m)| SeatPlane { normal, offset_m }));
        if found.is_none() {
            problems.error(format!("seat.{key}"), "no such surface", "a surface, or a solid with flat faces");
        }
        found
    };
    let up = vehicle.rotation.tr_mul(&Vector3::z());
    let cushion = plane(seating.cushion, "cushion", &|_| up);
    let back = plane(seating.back, "back", &|middle| Vector3::x() * (seating.heels_m[0] - middle.x).signum());
    let (cushion, back) = (cushion?, back?);
    let material = setup.materials.get(setup.surface_material(seating.cushion))?;
    Some(Seat { cushion, back, force: &material.force })
}

/// Gives every point of the body its velocity at the start.
fn set_velocity(state: &mut State<f64>, velocity: &InitialVelocity, vehicle: &FrameMotion) {
    match velocity {
        InitialVelocity::WithVehicle => {
            state.set_velocity(V3::of(&vehicle.velocity_at(state.t1().to_vector())));
            state.turns().for_each(|slot| state.set_omega(slot, V3::of(&vehicle.angular_velocity_rad_s)));
        }
        InitialVelocity::VehicleOrigin => state.set_velocity(V3::of(&vehicle.velocity_m_s)),
        InitialVelocity::Given(v) => {
            state.set_velocity(V3::of(&vehicle.vector_to_space(*v)));
        }
    }
}

//! The model: a checked [`Setup`] with all that can be computed before the first step. Immutable, shared by all threads.

pub mod accuracy;
mod begin;
pub(crate) mod behind;
mod descent;
mod limp;
mod pose;
pub mod seat;
pub mod seating;
pub mod settle;
pub mod setup;
mod together;
mod validate;

use std::hash::{DefaultHasher, Hash, Hasher};

use crate::body::Body;
use crate::forces::History;
use crate::forces::bag::Bag;
use crate::forces::chain::Chain;
use crate::forces::contact::flat_face::FlatFace;
use crate::forces::contact::surface::Frame;
use crate::kernel::System;
use crate::model::begin::begin;
use crate::model::seat::Seated;
use crate::model::settle::Settled;
use crate::model::setup::{Integrator, Member, Setup};
use crate::motion::frame::{Frames, Moving, VEHICLE};
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::{MOST_BODIES, Trunk};
use crate::motion::state::State;
use crate::vehicle::{FrameMotion, PathCursor, VehiclePath};
use nalgebra::Vector3;
use placed_text::Problems;

/// Times closer than this are one time, s.
pub const ROUNDING_S: f64 = 1e-12;

/// A scenario ready to run.
#[derive(Clone, Debug)]
pub struct Model {
    setup: Setup,
    faces: Vec<FlatFace>,
    system: System<f64>,
    start: Start,
    alone: Vec<Model>,
    warnings: Problems,
    names_hash: u64,
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
    /// Remaining load on a seated body without settling.
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
            Some((system, start, alone)) if !problems.has_errors() => {
                let names_hash = names_hash(&setup);
                Ok(Model { setup, faces, system, start, alone, warnings: problems, names_hash })
            }
            _ => Err(problems),
        }
    }

    /// A number that is equal for models whose parts have the same names in the same order, and so the same results.
    pub(crate) fn names_hash(&self) -> u64 {
        self.names_hash
    }

    /// The setup.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// The occupant's body.
    pub fn body(&self) -> &Body {
        &self.setup.body
    }

    /// Mass of each body, kg.
    pub(crate) fn masses_kg(&self) -> Vec<f64> {
        let skeleton = &self.system.skeleton;
        let mass_kg = |trunk: &Trunk| trunk.segments().map(|n| skeleton.links[n].mass).sum();
        skeleton.layout.trunks().iter().map(mass_kg).collect()
    }

    /// Mass of all bodies and their centre of gravity at the start, space axes, kg and m.
    pub fn centre_at_start(&self) -> (f64, Vector3<f64>) {
        let (skeleton, k) = (&self.system.skeleton, Kinematics::new(&self.system.skeleton, &self.start.state));
        let (mut mass_kg, mut moment) = (0.0, Vector3::zeros());
        for n in 0..skeleton.layout.len() {
            mass_kg += skeleton.links[n].mass;
            moment += skeleton.links[n].mass * k.cg(skeleton, n).to_vector();
        }
        (mass_kg, moment / mass_kg)
    }

    /// Centres of the contact spheres at the start in the body's order, space axes, m.
    pub fn spheres_at_start(&self) -> impl Iterator<Item = Vector3<f64>> {
        let k = Kinematics::new(&self.system.skeleton, &self.start.state);
        (0..self.setup.body.spheres.len()).map(move |i| self.system.sphere(&k, i).1.to_vector())
    }

    /// Planes and outlines of the surfaces, in the setup's order.
    pub fn faces(&self) -> &[FlatFace] {
        &self.faces
    }

    /// Constants of the derivative kernel.
    pub fn system(&self) -> &System<f64> {
        &self.system
    }

    /// Initial state of the occupant.
    pub fn start(&self) -> &Start {
        &self.start
    }

    /// The single bodies, if there are several.
    pub fn alone(&self) -> &[Model] {
        &self.alone
    }

    /// The same model without closed forms: its body is swept as a general tree.
    #[cfg(test)]
    pub(crate) fn without_closed_forms(mut self) -> Self {
        self.system.skeleton = self.system.skeleton.without_closed_forms();
        self
    }

    /// Warnings that do not prevent a run.
    pub fn warnings(&self) -> &Problems {
        &self.warnings
    }

    /// Time of the output with this index, s; the last is the end of the run.
    pub(crate) fn output_time_s(&self, index: usize) -> Option<f64> {
        let time = &self.setup.time;
        let (number, whole) = (index as f64, time.whole_intervals());
        if number <= whole {
            Some(time.start_s + number * time.output_s)
        } else {
            (number <= whole + 1.0).then_some(time.end_s)
        }
    }

    /// The same model with another integrator.
    ///
    /// # Errors
    /// Steps and tolerances that cannot be.
    pub fn with_integrator(mut self, integrator: Integrator) -> Result<Self, Problems> {
        self.setup.integrator = integrator;
        self.timed()
    }

    /// The same model with other output times.
    ///
    /// # Errors
    /// An interval that cannot be, or longer than the run.
    pub fn with_outputs_every(mut self, interval_s: f64) -> Result<Self, Problems> {
        self.setup.time.output_s = interval_s;
        self.timed()
    }

    /// The model, if its times and its integrator are possible.
    fn timed(self) -> Result<Self, Problems> {
        let mut problems = Problems::new();
        validate::check_time(&self.setup.time, &self.setup.integrator, &mut problems);
        if problems.has_errors() { Err(problems) } else { Ok(self) }
    }

    /// Number of outputs of a whole run.
    pub fn output_count(&self) -> usize {
        self.setup.time.whole_intervals() as usize + 2
    }

    /// Times of discontinuities in the motion of the vehicle or of another frame, s, in the order of the setup.
    fn corners_s(&self) -> Vec<f64> {
        let frames = self.setup.frames.iter().flat_map(|frame| frame.path.breaks_s());
        self.setup.path.breaks_s().into_iter().chain(frames).collect()
    }

    /// Times at which a muscle, or a device of a belt or bag, begins or ends to act, s, in the order of the setup.
    fn dues_s(&self) -> Vec<f64> {
        let mut dues_s: Vec<f64> = self.setup.joints.muscles.iter().flat_map(|muscle| muscle.times_s).collect();
        dues_s.extend(self.setup.chains.iter().flat_map(Chain::breaks_s));
        dues_s.extend(self.setup.bags.iter().flat_map(Bag::breaks_s));
        dues_s
    }

    /// Times of all discontinuities, in an order that models of one structure share.
    pub fn each_break_s(&self) -> Vec<f64> {
        [self.corners_s(), self.dues_s()].concat()
    }

    /// Times of discontinuities in the motion of the vehicle, or at which a muscle or a device of a belt or bag begins
    /// or ends to act, s, in increasing order: error-controlled steps do not cross them.
    pub(crate) fn breaks_s(&self) -> Vec<f64> {
        in_order(self.each_break_s())
    }

    /// Frames at `t_s` within a step with the middle `step_middle_s`.
    pub fn frames(&self, t_s: f64, step_middle_s: f64, cursor: &mut PathCursor) -> Frames<f64> {
        let mut frames = Frames::still(t_s);
        self.move_frames(&mut frames, t_s, step_middle_s, cursor);
        frames
    }

    /// Sets `frames` to those of a time: [`Model::frames`].
    #[inline]
    pub(crate) fn move_frames(&self, frames: &mut Frames<f64>, t_s: f64, step_middle_s: f64, cursor: &mut PathCursor) {
        frames.time = t_s;
        frames[VEHICLE] = Moving::of(&self.vehicle(t_s, step_middle_s, cursor));
        if !self.setup.frames.is_empty() {
            self.setup.place_frames(frames, step_middle_s);
        }
    }

    /// [`Model::frames`] with the known motion of the vehicle.
    pub(crate) fn frames_with(&self, t_s: f64, step_middle_s: f64, vehicle: &FrameMotion) -> Frames<f64> {
        let mut frames = frames(t_s, vehicle);
        self.setup.place_frames(&mut frames, step_middle_s);
        frames
    }

    /// Motion of the vehicle at `t_s` within a step with the middle `step_middle_s`.
    pub(crate) fn vehicle(&self, t_s: f64, step_middle_s: f64, cursor: &mut PathCursor) -> FrameMotion {
        let path = &self.setup.path;
        // only mounts, columns and hinges feel accelerations
        let is_mounted = self.system.skeleton.roots.iter().any(|root| root.mount.is_some());
        let is_felt = is_mounted || self.system.forces.gives();
        let motion = if is_felt { VehiclePath::motion_within } else { VehiclePath::motion };
        motion(path, t_s, step_middle_s, cursor)
    }
}

impl Model {
    /// Motions of the home frames of the bodies for output, by `frames` with the motion of the vehicle.
    pub(crate) fn homes(&self, frames: &Frames<f64>, vehicle: &FrameMotion) -> [FrameMotion; MOST_BODIES] {
        let mut homes = [*vehicle; MOST_BODIES];
        for (motion, Member { home, .. }) in homes.iter_mut().zip(&self.setup.members) {
            match home {
                Frame::Vehicle => {}
                // vehicles hang on nothing
                Frame::Other(i) => {
                    *motion = self.setup.frames[*i].path.shown_motion(frames.time, &mut PathCursor::default())
                }
                _ => *motion = frames[home.index(&[])].motion(),
            }
        }
        homes
    }
}

/// A number that differs between models with differently named parts.
fn names_hash(setup: &Setup) -> u64 {
    let Setup { body, belts, chains, bags, columns, frames, members, joints, output, .. } = setup;
    let mut hasher = DefaultHasher::new();
    for row in body.tree.segment_rows() {
        row.name.hash(&mut hasher);
    }
    body.tree.joint_rows().iter().for_each(|row| row.name.hash(&mut hasher));
    let spheres = body.spheres.iter().map(|one| &one.name);
    let things = setup.surfaces.iter().map(|one| &one.name).chain(setup.solids.iter().map(|one| &one.name));
    let straps = chains.iter().flat_map(|chain| [&chain.belt].into_iter().chain(&chain.straps));
    let elements = belts.iter().map(|one| &one.name).chain(straps).chain(bags.iter().map(|one| &one.name));
    let more = setup
        .own_forces
        .iter()
        .map(|one| &one.name)
        .chain(columns.iter().map(|one| &one.name))
        .chain(frames.iter().map(|one| &one.name));
    let told = members.iter().map(|one| &one.name).chain(output.markers.iter().map(|one| &one.name));
    spheres.chain(things).chain(elements).chain(more).chain(told).for_each(|name| name.hash(&mut hasher));
    let counts = [setup.surfaces.len(), joints.limits.len(), joints.muscles.len()];
    (counts, setup.self_contact.is_some(), output.report_coordinates).hash(&mut hasher);
    hasher.finish()
}

/// Frames for a motion of the vehicle at a time; other frames are at rest in space.
pub fn frames(time_s: f64, vehicle: &FrameMotion) -> Frames<f64> {
    let mut frames = Frames::still(time_s);
    frames[VEHICLE] = Moving::of(vehicle);
    frames
}

/// Sorted times without duplicates: of times that differ by rounding only, the last, at which all are due.
fn in_order(mut times_s: Vec<f64>) -> Vec<f64> {
    times_s.sort_by(f64::total_cmp);
    times_s.dedup_by(|later_s, kept_s| {
        let is_same = *later_s - *kept_s <= ROUNDING_S;
        *kept_s = if is_same { *later_s } else { *kept_s };
        is_same
    });
    times_s
}

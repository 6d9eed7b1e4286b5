//! A run that a program steps itself.

use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

use super::{Course, RunError, Step};
use crate::forces::History;
use crate::model::Model;
use crate::motion::state::State;
use crate::results::checkpoint::Checkpoint;
use crate::results::outcome::{Outcome, RecordingFailed, SimulationError, Status};
use crate::results::recorder::{Flow, Recorder, Watch};
use crate::results::sample::Sample;
use crate::run::simulate::go_on;
use crate::vehicle::live::{LiveFrame, LiveFrames};
use crate::vehicle::{FrameMotion, VehicleInput, VehiclePose};

/// A run that a program steps itself: to a time, from frame to frame, with looks, kicks and pauses in between.
///
/// It begins at the model's start. Looking at it never changes it; a clone is independent; every process gives the same
/// bits.
///
/// ```
/// # use occupant_core::{body::Body, forces::joint::Joints, model::{Model, seating::InitialPosture, setup::SetupBuilder}};
/// # use occupant_core::motion::report_coordinates::{DOF, ReportCoordinates};
/// use occupant_core::run::Run;
/// use occupant_core::vehicle::{VehicleInput, VehiclePath, VehicleState};
///
/// # let mut q = [0.0; DOF];
/// # q[2] = 100.0;
/// # let posture = InitialPosture::Coordinates(Box::new(ReportCoordinates { q, rates: [0.0; DOF] }));
/// # let case = SetupBuilder::new("Fall", Body::male50(), Joints::male50());
/// let model = Model::new(case.build(VehiclePath::live(VehicleState::default()), posture, 1.0))?;
/// let mut run = Run::new(&model);
/// for frame in 1..=10 {
///     run.push(1e-3 * f64::from(frame), &VehicleInput::acceleration([-3.0, 0.0, 0.0]))?; // m/s²
///     run.advance_to(run.known_until_s())?;
/// }
/// let sunk_m = run.look(|sample| sample.cg_m(model.body().tree.segment(0)).z)?; // vehicle axes: Z down
/// # assert!(sunk_m < 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct Run<'m> {
    pub(super) model: Held<'m>,
    pub(super) course: Course,
    /// Whether a recorder has begun.
    pub(super) is_recorded: bool,
}

/// A borrowed or a shared model.
#[derive(Clone)]
pub(super) enum Held<'m> {
    Lent(&'m Model),
    Shared(Arc<Model>),
}

impl Deref for Held<'_> {
    type Target = Model;

    fn deref(&self) -> &Model {
        match self {
            Held::Lent(model) => model,
            Held::Shared(model) => model,
        }
    }
}

impl fmt::Debug for Run<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Run at t = {} s of {:?}", self.course.time_s, self.model.setup().title)
    }
}

impl<'m> Run<'m> {
    /// A run of `model` at its start.
    pub fn new(model: &'m Model) -> Self {
        Run { model: Held::Lent(model), course: Course::looked_at(model), is_recorded: false }
    }

    /// The same for a shared model, kept alive by the run: it has no borrowed lifetime.
    pub fn shared(model: Arc<Model>) -> Run<'static> {
        Run { course: Course::looked_at(&model), model: Held::Shared(model), is_recorded: false }
    }

    /// The run at a checkpoint of [`Run::checkpoint`] or of an output. It has no motion of a live vehicle yet;
    /// [`Run::load`] restores that too.
    ///
    /// # Errors
    /// A checkpoint that does not fit the model.
    pub fn from_checkpoint(model: &'m Model, checkpoint: &Checkpoint) -> Result<Self, RunError> {
        let course = Course::from_checkpoint(model, checkpoint, false)?;
        Ok(Run { model: Held::Lent(model), course, is_recorded: false })
    }

    /// The model.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Time reached, s.
    pub fn time_s(&self) -> f64 {
        self.course.time_s
    }

    /// End of the model's time, s.
    pub fn end_s(&self) -> f64 {
        self.model.setup().time.end_s
    }

    /// State at the time reached.
    pub fn state(&self) -> &State<f64> {
        &self.course.state
    }

    /// Memory of force elements.
    pub fn history(&self) -> &History<f64> {
        &self.course.history
    }

    /// Times of discontinuities in the motion of the vehicle or in an activation, s.
    pub fn breaks_s(&self) -> &[f64] {
        &self.course.breaks_s
    }

    /// The model's next output time, s; none at its end, and none once all bodies are at rest in a run that ends then.
    pub fn next_output_s(&self) -> Option<f64> {
        let (time, now_s) = (&self.model.setup().time, self.time_s());
        if self.course.rest.is_over(now_s) {
            return None;
        }
        let near = ((now_s - time.start_s) / time.output_s).floor().max(0.0) as usize;
        (near..near + 3).filter_map(|index| self.model.output_time_s(index)).find(|output_s| *output_s > now_s)
    }

    /// Steps to a time, s: at most the model's end, and at most the known motion of a live vehicle.
    ///
    /// # Errors
    /// A time before the present one or behind the end, or no number; a step that fails.
    pub fn advance_to(&mut self, target_s: f64) -> Result<(), RunError> {
        let (now_s, end_s) = (self.time_s(), self.end_s());
        // not a number is neither
        if !(target_s >= now_s && target_s <= end_s) {
            return Err(RunError::Time { now_s, end_s, target_s });
        }
        if target_s > now_s {
            self.course.advance_to(&self.model, target_s)?;
        }
        if !self.is_recorded {
            // nobody will ask for what was read since the last output
            self.course.forget_readings();
        }
        Ok(())
    }

    /// Steps by a duration, s; see [`Run::advance_to`].
    ///
    /// # Errors
    /// As of [`Run::advance_to`].
    pub fn advance_by(&mut self, by_s: f64) -> Result<(), RunError> {
        self.advance_to(self.time_s() + by_s)
    }

    /// Looks at the present state of the run.
    ///
    /// # Errors
    /// None of today's; forces that cannot be worked out may become one.
    pub fn look<T>(&mut self, look: impl FnOnce(&Sample<'_>) -> T) -> Result<T, RunError> {
        let (mut look, mut seen) = (Some(look), None);
        self.course.look(&self.model, &mut Watch(|sample: &Sample<'_>| seen = look.take().map(|look| look(sample))))?;
        seen.ok_or_else(|| RunError::input("a look that saw nothing", "a sample"))
    }

    /// Passes the present state of the run to a recorder as its next output. The first output begins the recorder. From
    /// then on the readings of instruments are kept until the next output, about half a megabyte per second. If a long
    /// run needs no more outputs, continue with a [`Run::load`] of it, or use looks.
    ///
    /// # Errors
    /// An error of the recorder.
    pub fn record(&mut self, recorder: &mut dyn Recorder) -> Result<Flow, RecordingFailed> {
        if !self.is_recorded {
            self.course.begin(&self.model, recorder)?;
            self.is_recorded = true;
        }
        self.course.record(&self.model, recorder)
    }

    /// Continues to the model's end and records every output on the way, the present one first.
    ///
    /// # Errors
    /// A step that fails, an error of the recorder.
    pub fn finish(mut self, recorder: &mut dyn Recorder) -> Result<Outcome, SimulationError> {
        if !self.is_recorded {
            self.course.begin(&self.model, recorder)?;
        }
        let status = go_on(&self.model, &mut self.course, recorder)?;
        self.course.end(status, recorder)?.succeeded()
    }

    /// Ends the run here and informs `recorder`.
    ///
    /// # Errors
    /// An error of the recorder.
    pub fn end(self, status: Status, recorder: &mut dyn Recorder) -> Result<Outcome, RecordingFailed> {
        self.course.end(status, recorder)
    }

    /// The complete memory of the run, as plain data; [`Run::save`] also contains the motion of a live vehicle.
    ///
    /// # Errors
    /// As of [`Run::look`].
    pub fn checkpoint(&mut self) -> Result<Checkpoint, RunError> {
        self.look(|sample| sample.checkpoint())
    }

    /// End of the known vehicle motion, s; unlimited unless the vehicle is live.
    pub fn known_until_s(&self) -> f64 {
        self.course.known_s(&self.model)
    }

    /// Gives the vehicle's motion from [`Run::known_until_s`] to `until_s`, the end of a frame. The model's path is
    /// [`VehiclePath::live`](crate::vehicle::VehiclePath::live). Positions and velocities continue without a jump.
    ///
    /// # Errors
    /// A model whose path is known beforehand; a frame that is not behind all others, or before the run has come to the end of
    /// the one before; an input that cannot be. Nothing is changed then.
    pub fn push(&mut self, until_s: f64, input: &VehicleInput) -> Result<(), RunError> {
        let from_s = self.known_until_s();
        if !self.model.setup().path.is_live() {
            return Err(RunError::input("a vehicle whose path is known beforehand", "`VehiclePath::live`"));
        }
        if !(until_s > from_s && until_s.is_finite()) {
            let found = format!("a frame from {from_s} s to {until_s} s");
            return Err(RunError::input(found, "an end behind its beginning"));
        }
        if self.time_s() < from_s {
            let found = format!("a frame from {from_s} s on in a run at {} s", self.time_s());
            return Err(RunError::input(found, "a run that has reached the end of the previous frame"));
        }
        let (start, pose) = self.vehicle_at(from_s);
        let frame = LiveFrame::new([from_s, until_s], start, pose.attitude, input);
        let frame = frame.map_err(|(found, expected)| RunError::input(found, expected))?;
        let before = self.course.cursor.live.as_deref().copied();
        let frames = LiveFrames::with(before.as_ref(), frame);
        match &mut self.course.cursor.live {
            Some(known) => **known = frames,
            none => *none = Some(Box::new(frames)),
        }
        self.course.mark_frame(from_s, until_s);
        Ok(())
    }

    /// Motion of the vehicle at a time, as far as it is known.
    fn vehicle_at(&mut self, t_s: f64) -> (FrameMotion, VehiclePose) {
        let (path, cursor) = (&self.model.setup().path, &mut self.course.cursor);
        (path.motion(t_s, t_s, cursor), path.attitude(t_s, cursor))
    }

    /// Present motion of the vehicle, space axes.
    pub fn vehicle(&mut self) -> FrameMotion {
        let now_s = self.time_s();
        self.model.setup().path.motion(now_s, now_s, &mut self.course.cursor)
    }

    /// Records the accepted steps from now on: [`Run::take_steps`].
    pub fn follow_steps(&mut self, room: usize) {
        self.course.taken = Some(Vec::with_capacity(room));
    }

    /// Accepted steps since they were last taken; empty unless recorded. `spent` is a list to be reused.
    pub fn take_steps(&mut self, mut spent: Vec<Step>) -> Vec<Step> {
        spent.clear();
        match &mut self.course.taken {
            Some(taken) => std::mem::replace(taken, spent),
            None => spent,
        }
    }
}

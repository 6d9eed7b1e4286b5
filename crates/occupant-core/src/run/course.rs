//! The memory of a run from step to step and from output to output, and its end.
//!
//! The model is separate and immutable: every call receives the model for which the course was made. [`super::Run`]
//! keeps both together; runs in lanes keep their own models.

use std::time::Instant;

use super::adaptive::{Control, Memory as Wanted};
use super::{Front, Rear, Step, Stretch, Switches};

use crate::forces::{Actions, History, Memory};
use crate::kernel::carried::Carried;
use crate::kernel::{Evaluation, Scratch, Situation};
use crate::model::Model;
use crate::model::setup::{Allowance, Integrator};
use crate::motion::frame::{Frames, Moving};
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::MOST_BODIES;
use crate::motion::state::State;
use crate::results::checkpoint::{Checkpoint, CheckpointError, Progress};
use crate::results::energy::{self, EnergyLedger, EnergyStart, Greatest, Rest};
use crate::results::outcome::{Outcome, RecordingFailed, Status, StepError};
use crate::results::peaks::Peaks;
use crate::results::recorder::{Flow, Recorder, RecorderError, Watch};
use crate::results::sample::{Effort, Sample};
use crate::run::corner::Touching;
use crate::run::observers::{Felt, Met, Seen, none_of};
use crate::vehicle::PathCursor;

/// A run in progress, besides its model.
#[derive(Clone)]
pub(crate) struct Course {
    /// Index of the next output.
    pub(super) index: usize,
    /// Time reached, s.
    pub time_s: f64,
    /// State there.
    pub state: State<f64>,
    /// History of the force elements there.
    pub history: History<f64>,
    pub(crate) cursor: PathCursor,
    pub(super) seen: Seen,
    /// Contacts and readings at the start of a step of fixed length or at an output.
    pub(super) met: Vec<Touching>,
    pub(super) felt: Felt,
    /// Values at the latest output.
    pub(super) now: Peaks,
    pub(crate) effort: Effort,
    allowance: Allowance,
    /// Wall time of its start, if that time is limited.
    started: Option<Instant>,
    /// Integration under error control; none with a fixed step.
    pub(super) front: Option<Box<Front>>,
    /// With a fixed step, the start of the latest, if any element of the model can switch.
    pub(super) rear: Option<Box<Rear>>,
    pub(super) control: Wanted,
    /// By body, from the first output on.
    pub(super) energy_starts: Vec<EnergyStart>,
    pub(super) start_gravity_j: f64,
    /// The same by body.
    pub(super) own_gravity_j: [f64; MOST_BODIES],
    pub(super) greatest: Greatest,
    pub(super) rest: Rest,
    /// By body.
    pub(super) masses_kg: Vec<f64>,
    pub(super) actions: Actions<f64>,
    /// Results of the evaluation of an output.
    scratch: Box<Scratch<f64>>,
    /// Times of discontinuities in the motion of the vehicle or in an activation, s.
    pub breaks_s: Vec<f64>,
    /// Accepted steps since it was last emptied, if requested.
    pub taken: Option<Vec<Step>>,
    pub(super) switches: Switches,
}

impl Course {
    /// A run of `model` at its start.
    pub fn new(model: &Model) -> Self {
        let start = model.start();
        let (integrator, time_s) = (&model.setup().integrator, model.setup().time.start_s);
        let (skeleton, allowance) = (&model.system().skeleton, model.setup().time.allowance);
        Course {
            index: 0,
            time_s,
            state: start.state,
            history: start.history.clone(),
            cursor: PathCursor::default(),
            effort: Effort::default(),
            allowance,
            started: allowance.wall_time_s.is_finite().then(Instant::now),
            front: match integrator {
                Integrator::Rk4 { .. } => None,
                Integrator::Adaptive { .. } => {
                    let front = Front::new(model, time_s, &start.state, &start.history);
                    Some(Box::new(front))
                }
            },
            rear: match integrator {
                Integrator::Rk4 { .. } if model.system().forces.can_switch() => {
                    Some(Box::new(Rear::new(&start.state, &start.history)))
                }
                _ => None,
            },
            control: Wanted::new(first_step(integrator)),
            energy_starts: Vec::with_capacity(MOST_BODIES),
            start_gravity_j: energy::gravity(skeleton, &Kinematics::new(skeleton, &start.state)),
            own_gravity_j: energy::gravity_by_body(skeleton, &Kinematics::new(skeleton, &start.state)),
            greatest: Greatest::default(),
            rest: Rest::default(),
            masses_kg: model.masses_kg(),
            actions: Actions::with_room(&model.system().forces),
            scratch: Box::new(Scratch::blank(model.system())),
            seen: Seen::new(model),
            met: Vec::with_capacity(start.history.memory.contacts.len()),
            felt: Felt::new(model),
            now: none_of(model),
            breaks_s: model.breaks_s(),
            taken: None,
            switches: Switches::new(),
        }
    }

    /// A run of `model` at one of its outputs.
    ///
    /// `at_output`: whether it must be at one of the model's outputs.
    pub(crate) fn from_checkpoint(model: &Model, from: &Checkpoint, at_output: bool) -> Result<Self, CheckpointError> {
        from.check_at(model, at_output)?;
        let state = |numbers: &[f64]| Checkpoint::state_of(model, numbers);
        let mut run = Course::new(model);
        let progress = from.progress;
        run.index = from.index;
        run.time_s = from.time_s;
        run.state = state(&from.state)?;
        run.history = History::new(&model.system().forces, from.memory.clone());
        run.effort = progress.effort;
        run.control = Wanted { wanted_s: progress.wanted_s, error: progress.step_error };
        if run.front.is_some() {
            let step = from.under_way.as_ref();
            run.front = Some(Box::new(match step {
                Some(start) => Front::within(model, start, &state(&start.state)?),
                None => Front::new(model, run.time_s, &run.state, &run.history),
            }));
        }
        run.energy_starts = match model.alone().len() {
            0 => vec![progress.energy_start],
            _ => starts_of(model),
        };
        run.greatest = progress.greatest;
        run.rest = progress.rest;
        if !run.seen.know(from) {
            return Err(CheckpointError::Readings);
        }
        run.switches.told.extend_from_slice(&from.events);
        Ok(run)
    }

    /// Informs `recorder` of the start of the run.
    pub(crate) fn begin(&self, model: &Model, recorder: &mut dyn Recorder) -> Result<(), RecordingFailed> {
        recorder.begin(model).map_err(|e| self.unrecorded(e))
    }

    /// Evaluates the present state completely and records it as the next output.
    pub fn record(&mut self, model: &Model, recorder: &mut dyn Recorder) -> Result<Flow, RecordingFailed> {
        let t = self.time_s;
        let path = &model.setup().path;
        let vehicle = path.motion(t, t, &mut self.cursor);
        let vehicle_pose = path.attitude(t, &mut self.cursor);
        let mut frames = model.frames_with(t, t, &vehicle);
        // no force depends on what is told of the accelerations
        let vehicle = path.shown_motion(t, &mut self.cursor);
        let homes = model.homes(&frames, &vehicle);
        let system = model.system();
        let evaluation = self.evaluate(model, &frames);
        system.carry(&self.state, &mut frames);
        self.actions.follow(&mut Met::anew(&mut self.met, &mut self.felt));
        let derived = Carried::of_evaluation(&system.skeleton, &evaluation);
        system.read_from(&derived, &frames, &mut |of, reading| self.felt.readings[of] = *reading);
        let past = &self.history.memory.contacts;
        if self.index == 0 {
            self.seen.see(model, t, &self.met, &self.felt, |pair| past[pair].phase);
        }
        self.seen.look_at(model, t, (&self.met, &self.felt), past, &mut self.now);
        if self.front.as_ref().is_none_or(|front| front.under_way(t).is_none()) {
            // the state is that of an accepted step
            self.seen.compare(model, t, &self.met, &self.felt);
        }
        let bodies = 0..system.skeleton.layout.trunks().len();
        let mut ledgers = [EnergyLedger::default(); MOST_BODIES];
        for body in bodies.clone() {
            let stored_j = self.actions.stored_of(&system.forces, &system.spheres, &system.skeleton.layout, body);
            let work = self.state.work(body);
            let home = Moving::of(&homes[body]);
            let of = (&system.skeleton, body);
            let ledger =
                |start: &EnergyStart| EnergyLedger::new(of, &evaluation.kinematics, &home, stored_j, &work, start);
            if self.energy_starts.len() == body {
                self.energy_starts.push(ledger(&EnergyStart::default()).as_start());
            }
            ledgers[body] = ledger(&self.energy_starts[body]);
        }
        let energy = EnergyLedger::sum(&ledgers[bodies.clone()]);
        let by_elements = |body: usize| self.state.work(body).sums.map(f64::abs).iter().sum::<f64>();
        let of_all = bodies.clone().map(by_elements).sum::<f64>();
        self.greatest.all.see(&energy, (energy.gravity_j - self.start_gravity_j).abs() + of_all);
        for body in bodies.clone().filter(|_| bodies.len() > 1) {
            let own = &ledgers[body];
            let work_j = (own.gravity_j - self.own_gravity_j[body]).abs() + by_elements(body);
            self.greatest.each[body].see(own, work_j);
        }
        if model.setup().time.stops_at_rest {
            let kinetic_j: Vec<f64> = ledgers[bodies.clone()].iter().map(|ledger| ledger.kinetic_j).collect();
            self.rest.see(t, &kinetic_j);
        }
        let index = self.index;
        self.index += 1;
        let told = &mut self.switches.told;
        told.append(self.seen.told());
        told.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
        let switches = std::mem::take(told);
        let recorded = recorder.record(&Sample {
            time_s: t,
            index,
            model,
            state: &self.state,
            history: &self.history,
            frames: &frames,
            vehicle: &vehicle,
            homes: &homes[bodies.clone()],
            ledgers: &ledgers[bodies],
            of: 0,
            watcher: None,
            vehicle_pose,
            evaluation: &evaluation,
            actions: &self.actions,
            energy,
            effort: self.effort,
            progress: Progress {
                effort: self.effort,
                wanted_s: self.control.wanted_s,
                step_error: self.control.error,
                energy_start: self.energy_starts[0],
                greatest: self.greatest,
                rest: self.rest,
            },
            first_touches: &self.seen.touches,
            switched: &switches,
            step_peaks: &self.seen.peaks,
            now: &self.now,
            fine: &self.seen.fine,
            readings: &self.felt.readings,
            under_way: self.front.as_ref().and_then(|front| front.under_way(t)),
        });
        self.switches.told = switches;
        self.switches.told.clear();
        self.seen.fine.clear();
        recorded.map_err(|e| self.unrecorded(e))
    }

    /// Shows the present state to `watch` without counting it as an output: nothing changes except the memory of force
    /// elements, which is updated.
    pub(super) fn look(&mut self, model: &Model, watch: &mut dyn Recorder) -> Result<(), RecordingFailed> {
        let (index, fine) = (self.index, self.seen.fine.clone());
        let (told, greatest, rest) = (self.switches.told.clone(), self.greatest, self.rest);
        let seen = self.record(model, watch);
        (self.index, self.seen.fine, self.switches.told) = (index, fine, told);
        (self.greatest, self.rest) = (greatest, rest);
        seen.map(|_| ())
    }

    /// Reference energies of a run at its start, used whenever it is looked at.
    pub(super) fn looked_at(model: &Model) -> Self {
        let mut course = Course::new(model);
        // what only watches never fails
        let _seen = course.look(model, &mut Watch(|_: &Sample<'_>| ()));
        course
    }

    /// Clears readings and switches since the latest output.
    pub(super) fn forget_readings(&mut self) {
        self.seen.fine.clear();
        self.switches.told.clear();
    }

    /// Makes steps end at the frames of a live vehicle.
    pub(super) fn mark_frame(&mut self, from_s: f64, until_s: f64) {
        self.breaks_s.retain(|break_s| *break_s >= self.time_s - 1.0);
        for time_s in [from_s, until_s] {
            let place = self.breaks_s.partition_point(|break_s| *break_s < time_s);
            if self.breaks_s.get(place) != Some(&time_s) {
                self.breaks_s.insert(place, time_s);
            }
        }
    }

    /// Complete evaluation of the present state, which updates the history.
    fn evaluate(&mut self, model: &Model, frames: &Frames<f64>) -> Evaluation<f64> {
        loop {
            if let Some(rear) = &mut self.rear {
                rear.keep(&self.history);
            }
            self.actions.clear();
            let situation = Situation::accepted(&self.state, frames);
            let (scratch, history) = (&mut self.scratch, &mut self.history);
            let evaluation = model.system().evaluate_with(scratch, situation, history, &mut self.actions);
            if !self.take_back_from_output(model) {
                if let Some(rear) = &mut self.rear {
                    let [before, now] = [rear.kept(), &self.history.memory];
                    self.switches.note(&model.system().forces, self.time_s, before, now);
                    rear.forget();
                }
                return evaluation;
            }
        }
    }

    /// Time of the next output, s; none after the last, and none once all bodies are at rest in a run that ends then.
    pub fn next_output_s(&self, model: &Model) -> Option<f64> {
        model.output_time_s(self.index).filter(|_| !self.rest.is_over(self.time_s))
    }

    /// End of the known vehicle motion, s.
    pub(super) fn known_s(&self, model: &Model) -> f64 {
        if !model.setup().path.is_live() {
            return f64::INFINITY;
        }
        self.cursor.live.as_ref().map_or(model.setup().time.start_s, |frames| frames.now().until_s)
    }

    /// Steps until `target_s`.
    pub fn advance_to(&mut self, model: &Model, target_s: f64) -> Result<(), StepError> {
        let known_s = self.known_s(model);
        if target_s > known_s {
            return Err(StepError::NotTold { known_s, target_s });
        }
        let integrator = &model.setup().integrator;
        match Control::of(integrator) {
            Some(control) => self.advance_adaptive(model, target_s, &control),
            None => {
                let stretch = Stretch::new(self.time_s, target_s, integrator.longest_step_s());
                self.advance_rk4(model, None, stretch)
            }
        }
    }

    /// Takes the state after a step, if it is finite.
    pub(crate) fn accept(&mut self, model: &Model, next: State<f64>, step: Step) -> Result<(), StepError> {
        self.refuse_beyond_allowance(step.start_s)?;
        if !next.is_finite() {
            return Err(broken(model, &self.history.memory, step, &next));
        }
        self.state = next;
        self.accept_time(step);
        Ok(())
    }

    /// Whether the work so far is permitted.
    #[inline]
    pub(super) fn is_within_allowance(&self) -> bool {
        self.effort.evaluations <= self.allowance.evaluations && !self.took_too_long()
    }

    fn took_too_long(&self) -> bool {
        self.started.is_some_and(|started| started.elapsed().as_secs_f64() > self.allowance.wall_time_s)
    }

    /// Refuses work beyond what is permitted, at `time_s`.
    pub(super) fn refuse_beyond_allowance(&self, time_s: f64) -> Result<(), StepError> {
        let (Effort { evaluations, .. }, Allowance { evaluations: most, wall_time_s: most_s }) =
            (self.effort, self.allowance);
        match () {
            () if self.is_within_allowance() => Ok(()),
            () if evaluations > most => Err(StepError::TooManyEvaluations { time_s, evaluations, most }),
            () => Err(StepError::TookTooLong { time_s, most_s }),
        }
    }

    /// Counts an accepted step whose state is stored elsewhere.
    pub(crate) fn accept_time(&mut self, step: Step) {
        self.time_s = step.end_s;
        self.count(step);
    }

    /// Counts an accepted step.
    pub(super) fn count(&mut self, step: Step) {
        if let Some(taken) = &mut self.taken {
            taken.push(step);
        }
        self.effort.steps += 1;
        self.effort.step_s = step.length_s();
    }

    /// Ends the run and informs `recorder`.
    pub fn end(self, status: Status, recorder: &mut dyn Recorder) -> Result<Outcome, RecordingFailed> {
        let time_s = self.time_s;
        let outcome = self.outcome(status);
        match recorder.end(&outcome) {
            Ok(()) => Ok(outcome),
            Err(source) => Err(RecordingFailed { time_s, source }),
        }
    }

    fn outcome(self, status: Status) -> Outcome {
        Outcome {
            status,
            time_s: self.time_s,
            effort: self.effort,
            first_touches: self.seen.touches,
            energy: self.greatest.check(&self.masses_kg),
        }
    }

    fn unrecorded(&self, source: RecorderError) -> RecordingFailed {
        let time_s = self.time_s;
        RecordingFailed { time_s, source }
    }
}

/// Reference energies of the balances of several bodies, at the start of a run.
fn starts_of(model: &Model) -> Vec<EnergyStart> {
    let mut run = Course::new(model);
    // what only watches never fails
    let _recorded = run.record(model, &mut Watch(|_: &Sample<'_>| ()));
    run.energy_starts
}

fn first_step(integrator: &Integrator) -> f64 {
    match *integrator {
        Integrator::Rk4 { step_s } => step_s,
        Integrator::Adaptive { min_step_s, max_step_s, .. } => (10.0 * min_step_s).min(max_step_s),
    }
}

/// Reason why a step did not give finite values.
pub(crate) fn broken(model: &Model, memory: &Memory<f64>, step: Step, next: &State<f64>) -> StepError {
    let (time_s, step_s) = (step.start_s, step.length_s());
    match memory.failure(&model.setup().forces(&[]), &model.system().forces) {
        Some(why) => StepError::Unsolved { time_s, step_s, why },
        None => StepError::NotFinite { time_s, step_s, component: broken_component(model, next) },
    }
}

/// Name of the first component that is not finite.
fn broken_component(model: &Model, state: &State<f64>) -> String {
    let (tree, layout) = (model.body().tree, &model.system().skeleton.layout);
    let name = |n: usize| tree[tree.segment(n)].name;
    let bad = |x: f64, y: f64, z: f64| !(x.is_finite() && y.is_finite() && z.is_finite());
    for (slot, &n) in layout.free().iter().enumerate() {
        let (q, w) = (state.orientation(slot), state.omega(slot));
        if bad(q.v.x, q.v.y, q.v.z) || bad(w.x, w.y, w.z) || !q.w.is_finite() {
            return format!("orientation or angular velocity of the {}", name(n));
        }
    }
    for (slot, &n) in layout.hinged().iter().enumerate() {
        if !(state.hinge()[slot].is_finite() && state.hinge_rate()[slot].is_finite()) {
            return format!("joint angle of the {}", name(n));
        }
    }
    "place or velocity of the reference point T1".to_owned()
}

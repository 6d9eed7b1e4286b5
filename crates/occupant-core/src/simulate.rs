//! A run from start to end: steps, exact output times, first touches.

use crate::body::Segment;
use crate::checkpoint::{Checkpoint, CheckpointError, Progress};
use crate::energy::{EnergyLedger, EnergyStart, Stored};
use crate::integrate::dormand_prince::{self, Tolerance};
use crate::integrate::rk4::{self, Stage};
use crate::kernel::History;
use crate::kernel::frame::VEHICLE;
use crate::kernel::state::{FREE, HINGED, State};
use crate::model::{Model, frames};
use crate::observers::{Seen, SeenAt, Touches};
pub use crate::outcome::{FirstTouch, Outcome, RecordingFailed, ResumeError, Status, StepError};
use crate::path::PathCursor;
use crate::recorder::{Flow, Recorder, RecorderError};
use crate::sample::{Effort, Sample};
use crate::setup::Integrator;
use crate::trig;

/// Runs `model` from its start to its end time.
///
/// A step that fails is an [`Outcome`] of [`Status::Failed`]: what was recorded before stands.
///
/// # Errors
/// What the recorder reports.
pub fn simulate(model: &Model, recorder: impl Recorder) -> Result<Outcome, RecordingFailed> {
    Run::new(model).go(0, recorder)
}

/// Runs `model` from one of its outputs to its end time. The first output recorded is that of the checkpoint; all outputs
/// and the outcome are, to the bit, those of a run from the start, whose end time may have been another.
///
/// # Errors
/// A checkpoint that does not fit the model; what the recorder reports.
pub fn resume(
    model: &Model,
    checkpoint: &Checkpoint,
    recorder: impl Recorder,
) -> Result<Outcome, ResumeError> {
    let run = Run::from_checkpoint(model, checkpoint).map_err(ResumeError::Refused)?;
    run.go(checkpoint.index, recorder)
        .map_err(ResumeError::Recording)
}

/// Records the output of a checkpoint once more, to the bit, without a step. The recorder neither begins nor ends here.
///
/// # Errors
/// A checkpoint that does not fit the model; what the recorder reports.
pub fn replay(
    model: &Model,
    checkpoint: &Checkpoint,
    recorder: &mut impl Recorder,
) -> Result<(), ResumeError> {
    let mut run = Run::from_checkpoint(model, checkpoint).map_err(ResumeError::Refused)?;
    let recorded = run.record(checkpoint.index, recorder).map_err(|source| {
        let time_s = run.time_s;
        ResumeError::Recording(RecordingFailed { time_s, source })
    });
    recorded.map(|_| ())
}

/// Time of output `index`, s; the last is the end of the run.
pub fn output_time(model: &Model, index: usize) -> Option<f64> {
    let time = &model.setup().time;
    let span = time.end_s - time.start_s;
    // an interval that misses the end by rounding alone is the last
    let whole = ((span / time.output_s) - 1e-9).floor().max(0.0);
    let number = index as f64;
    if number <= whole {
        Some(time.start_s + number * time.output_s)
    } else {
        (number <= whole + 1.0).then_some(time.end_s)
    }
}

/// Number of outputs of a whole run.
pub fn output_count(model: &Model) -> usize {
    let time = &model.setup().time;
    (((time.end_s - time.start_s) / time.output_s) - 1e-9)
        .floor()
        .max(0.0) as usize
        + 2
}

/// A run in progress.
struct Run<'a> {
    model: &'a Model,
    time_s: f64,
    state: State<f64>,
    history: History<f64>,
    cursor: PathCursor,
    effort: Effort,
    /// Step that the error control wants next, s.
    wanted_s: f64,
    energy_start: Option<EnergyStart>,
    greatest_kinetic_j: f64,
    greatest_imbalance_j: f64,
    touches: Touches,
    seen: Seen<'a>,
    breaks_s: Vec<f64>,
}

impl<'a> Run<'a> {
    fn new(model: &'a Model) -> Self {
        let start = model.start();
        let pairs = model.system().contacts.pairs();
        Run {
            model,
            time_s: model.setup().time.start_s,
            state: start.state,
            history: start.history.clone(),
            cursor: PathCursor::default(),
            effort: Effort::default(),
            wanted_s: first_step(&model.setup().integrator),
            energy_start: None,
            greatest_kinetic_j: 0.0,
            greatest_imbalance_j: 0.0,
            touches: Touches {
                pairs: Vec::with_capacity(pairs.len()),
                belts: Vec::with_capacity(model.system().belts.len()),
            },
            seen: Seen::new(model),
            breaks_s: model.setup().path.breaks_s(),
        }
    }

    fn from_checkpoint(model: &'a Model, from: &Checkpoint) -> Result<Self, CheckpointError> {
        from.check(model)?;
        let mut run = Run::new(model);
        let (pairs, belts) = (from.pairs.clone(), from.belts.clone());
        let progress = from.progress;
        run.time_s = from.time_s;
        run.state = from.state;
        run.history = History::new(&model.system().contacts, pairs, belts);
        run.effort = progress.effort;
        run.wanted_s = progress.wanted_s;
        run.energy_start = Some(progress.energy_start);
        run.greatest_kinetic_j = progress.greatest_kinetic_j;
        run.greatest_imbalance_j = progress.greatest_imbalance_j;
        run.seen.know(&from.first_touches);
        Ok(run)
    }

    /// From the present output, number `first`, to the end.
    fn go(mut self, first: usize, mut recorder: impl Recorder) -> Result<Outcome, RecordingFailed> {
        let failed = |time_s, source| RecordingFailed { time_s, source };
        recorder
            .begin(self.model)
            .map_err(|e| failed(self.time_s, e))?;
        let mut status = Status::Completed;
        for index in first.. {
            let flow = self
                .record(index, &mut recorder)
                .map_err(|e| failed(self.time_s, e))?;
            if flow == Flow::Stop {
                status = Status::Stopped;
                break;
            }
            let Some(target_s) = output_time(self.model, index + 1) else {
                break;
            };
            if let Err(error) = self.advance_to(target_s) {
                status = Status::Failed(error);
                break;
            }
        }
        let outcome = self.outcome(status);
        recorder
            .end(&outcome)
            .map_err(|e| failed(outcome.time_s, e))?;
        Ok(outcome)
    }

    /// Evaluates the present state with all details and hands it to the recorder.
    fn record(
        &mut self,
        index: usize,
        recorder: &mut impl Recorder,
    ) -> Result<Flow, RecorderError> {
        let t = self.time_s;
        let setup = self.model.setup();
        let vehicle = setup.path.motion(t, t, &mut self.cursor);
        let vehicle_pose = setup.path.attitude(t, &mut self.cursor);
        let frames = frames(&vehicle);
        let system = self.model.system();
        self.touches.clear();
        let evaluation =
            system.evaluate::<true>(&self.state, &frames, &mut self.history, &mut self.touches);
        for touch in &self.touches.pairs {
            self.seen.note(t, touch);
        }
        let stored = Stored {
            spine_j: system.joints.stored(&evaluation.kinematics),
            contacts_j: self.touches.pairs.iter().map(|t| t.stored).sum(),
            belts_j: self.touches.belts.iter().map(|b| b.stored).sum(),
        };
        let ledger = |start: &EnergyStart| {
            EnergyLedger::new(
                &system.skeleton,
                &evaluation.kinematics,
                &frames[VEHICLE],
                stored,
                &self.state.work,
                start,
            )
        };
        let energy_start = *self
            .energy_start
            .get_or_insert_with(|| ledger(&EnergyStart::default()).as_start());
        let energy = ledger(&energy_start);
        self.greatest_kinetic_j = self.greatest_kinetic_j.max(energy.kinetic_relative_j);
        self.greatest_imbalance_j = self.greatest_imbalance_j.max(energy.balance_j.abs());
        recorder.record(&Sample {
            time_s: t,
            index,
            model: self.model,
            state: &self.state,
            history: &self.history,
            frames: &frames,
            vehicle: &vehicle,
            vehicle_pose,
            evaluation: &evaluation,
            touches: &self.touches.pairs,
            belts: &self.touches.belts,
            energy,
            effort: self.effort,
            progress: Progress {
                effort: self.effort,
                wanted_s: self.wanted_s,
                energy_start,
                greatest_kinetic_j: self.greatest_kinetic_j,
                greatest_imbalance_j: self.greatest_imbalance_j,
            },
            first_touches: &self.seen.touches,
        })
    }

    fn advance_to(&mut self, target_s: f64) -> Result<(), StepError> {
        match self.model.setup().integrator {
            Integrator::Rk4 { step_s } => self.advance_rk4(target_s, step_s),
            Integrator::Adaptive {
                relative,
                absolute_m,
                absolute_m_s,
                min_step_s,
                max_step_s,
            } => {
                let tolerance = Tolerance {
                    relative,
                    absolute_m,
                    absolute_m_s,
                };
                self.advance_adaptive(target_s, &tolerance, min_step_s, max_step_s)
            }
        }
    }

    /// Whole steps from the last output, the last one shortened to end at the target.
    fn advance_rk4(&mut self, target_s: f64, step_s: f64) -> Result<(), StepError> {
        let from_s = self.time_s;
        let count = (((target_s - from_s) / step_s) - 1e-9).ceil().max(1.0);
        let (model, system) = (self.model, self.model.system());
        for i in 0..count as u64 {
            let t = from_s + i as f64 * step_s;
            let end = if i as f64 + 1.0 < count {
                from_s + (i + 1) as f64 * step_s
            } else {
                target_s
            };
            let (h, middle) = (end - t, 0.5 * (t + end));
            let at_start = model.frames(t, middle, &mut self.cursor);
            let at_middle = model.frames(middle, middle, &mut self.cursor);
            let at_end = model.frames(end, middle, &mut self.cursor);
            let (history, seen) = (&mut self.history, &mut self.seen);
            let next = rk4::step(&self.state, h, |stage, state| match stage {
                Stage::Start => {
                    let mut observer = SeenAt { seen, time_s: t };
                    system.rate_observed::<true>(state, &at_start, history, &mut observer)
                }
                Stage::Middle => system.rate::<false>(state, &at_middle, history),
                Stage::End => system.rate::<false>(state, &at_end, history),
            });
            self.effort.evaluations += 4;
            self.accept(next, t, end)?;
        }
        Ok(())
    }

    fn advance_adaptive(
        &mut self,
        target_s: f64,
        tolerance: &Tolerance,
        min_step_s: f64,
        max_step_s: f64,
    ) -> Result<(), StepError> {
        let (model, system) = (self.model, self.model.system());
        let mut first: Option<State<f64>> = None;
        while self.time_s < target_s {
            let t = self.time_s;
            let stop = self
                .breaks_s
                .iter()
                .copied()
                .find(|&b| b > t)
                .unwrap_or(f64::INFINITY);
            let limit = target_s.min(stop);
            let wanted = self.wanted_s.min(max_step_s);
            // a step that would leave a sliver takes it along
            let end = if t + wanted * 1.01 >= limit {
                limit
            } else {
                t + wanted
            };
            if end <= t {
                // the clock no longer tells the step's ends apart
                return Err(StepError::StepTooSmall {
                    time_s: t,
                    step_s: wanted,
                    min_step_s,
                    error: 0.0,
                });
            }
            let (h, middle) = (end - t, 0.5 * (t + end));
            let cursor = &mut self.cursor;
            let history = &mut self.history;
            let start_rate = first.unwrap_or_else(|| {
                self.effort.evaluations += 1;
                let frames = model.frames(t, middle, cursor);
                let mut observer = SeenAt {
                    seen: &mut self.seen,
                    time_s: t,
                };
                system.rate_observed::<true>(&self.state, &frames, history, &mut observer)
            });
            let trial =
                dormand_prince::attempt(&self.state, &start_rate, h, tolerance, |c, state| {
                    let frames = model.frames(t + c * h, middle, cursor);
                    system.rate::<false>(state, &frames, history)
                });
            self.effort.evaluations += 6;
            // fifth-order growth with a safety factor; a trial that is not a number asks for a tenth
            let growth = if trial.error.is_finite() {
                (0.9 * trig::pow(trial.error.max(1e-10), -0.2)).clamp(0.1, 5.0)
            } else {
                0.1
            };
            if trial.error <= 1.0 {
                let full = h >= wanted * 0.99;
                self.wanted_s = if full {
                    h * growth
                } else {
                    self.wanted_s.max(h * growth)
                };
                self.accept(trial.state, t, end)?;
                if end < target_s {
                    let frames = model.frames(end, middle, &mut self.cursor);
                    let mut observer = SeenAt {
                        seen: &mut self.seen,
                        time_s: end,
                    };
                    system.commit(&self.state, &frames, &mut self.history, &mut observer);
                }
                // the velocity of the vehicle may jump at a break
                first = (end < stop).then_some(trial.rate);
            } else {
                self.effort.rejected += 1;
                first = Some(start_rate);
                self.wanted_s = h * growth.min(0.9);
                if self.wanted_s < min_step_s {
                    return Err(StepError::StepTooSmall {
                        time_s: t,
                        step_s: self.wanted_s,
                        min_step_s,
                        error: trial.error,
                    });
                }
            }
        }
        Ok(())
    }

    fn accept(&mut self, next: State<f64>, start_s: f64, end_s: f64) -> Result<(), StepError> {
        let step_s = end_s - start_s;
        if !next.is_finite() {
            let component = broken_component(&next);
            return Err(StepError::NotFinite {
                time_s: start_s,
                step_s,
                component,
            });
        }
        self.state = next;
        self.time_s = end_s;
        self.effort.steps += 1;
        self.effort.step_s = step_s;
        Ok(())
    }

    fn outcome(self, status: Status) -> Outcome {
        let greatest = self.greatest_kinetic_j;
        Outcome {
            status,
            time_s: self.time_s,
            effort: self.effort,
            first_touches: self.seen.touches,
            greatest_kinetic_j: greatest,
            balance_error: if greatest > 0.0 {
                self.greatest_imbalance_j / greatest
            } else {
                0.0
            },
        }
    }
}

fn first_step(integrator: &Integrator) -> f64 {
    match *integrator {
        Integrator::Rk4 { step_s } => step_s,
        Integrator::Adaptive {
            min_step_s,
            max_step_s,
            ..
        } => (10.0 * min_step_s).min(max_step_s),
    }
}

/// Name of the first component that is not finite.
fn broken_component(state: &State<f64>) -> String {
    let bad = |x: f64, y: f64, z: f64| !(x.is_finite() && y.is_finite() && z.is_finite());
    for (slot, &n) in FREE.iter().enumerate() {
        let (q, w) = (&state.orientation[slot], &state.omega[slot]);
        if bad(q.v.x, q.v.y, q.v.z) || bad(w.x, w.y, w.z) || !q.w.is_finite() {
            return format!(
                "orientation or angular velocity of the {}",
                Segment::ALL[n].name()
            );
        }
    }
    for (slot, &n) in HINGED.iter().enumerate() {
        if !(state.hinge[slot].is_finite() && state.hinge_rate[slot].is_finite()) {
            return format!("joint angle of the {}", Segment::ALL[n].name());
        }
    }
    "place or velocity of the reference point T1".to_owned()
}

//! A run in its place beside others.

use super::{Ended, Job, Kernel};
use crate::forces::Observer;
use crate::forces::contact::Touch;
use crate::model::Model;
use crate::motion::lanes::Lanes;
use crate::results::outcome::{RecordingFailed, Status};
use crate::results::recorder::{Flow, Recorder};
use crate::run::observers::Meeting;
use crate::run::simulate::go_on;
use crate::run::{Run, Step, Stretch};

/// A run in its place.
pub(super) struct Place<T, R> {
    tag: T,
    pub model: Model,
    recorder: R,
    pub run: Run,
    /// Steps to the next output.
    pub stretch: Stretch,
    step_s: f64,
    /// The step under way.
    pub step: Step,
}

/// What becomes of a run after a step or an output.
pub(super) enum Next {
    GoesOn,
    Ends(Result<Status, RecordingFailed>),
}

impl Next {
    pub(super) fn ended(status: Status) -> Self {
        Next::Ends(Ok(status))
    }
}

impl<T, R: Recorder> Place<T, R> {
    /// The run of `job` at its start.
    pub(super) fn new(job: Job<T, R>, step_s: f64) -> Self {
        let run = Run::new(&job.model);
        Place {
            tag: job.tag,
            model: job.model,
            recorder: job.recorder,
            stretch: Stretch::new(run.time_s, run.time_s, step_s),
            run,
            step_s,
            step: Step::default(),
        }
    }

    /// The first output.
    pub(super) fn begin(&mut self) -> Next {
        match self.run.begin(&self.model, &mut self.recorder) {
            Ok(()) => self.output(),
            Err(error) => Next::Ends(Err(error)),
        }
    }

    /// Records an output and turns to the next.
    pub(super) fn output(&mut self) -> Next {
        match self.run.record(&self.model, &mut self.recorder) {
            Err(error) => return Next::Ends(Err(error)),
            Ok(Flow::Stop) => return Next::ended(Status::Stopped),
            Ok(Flow::Continue) => {}
        }
        let Some(target_s) = self.run.next_output_s(&self.model) else {
            return Next::ended(Status::Completed);
        };
        self.stretch = Stretch::new(self.run.time_s, target_s, self.step_s);
        Next::GoesOn
    }

    /// The rest of the run, alone.
    pub(super) fn finish(&mut self) -> Result<Status, RecordingFailed> {
        match self.run.advance_rk4(&self.model, self.stretch) {
            Err(error) => Ok(Status::Failed(error)),
            Ok(()) => go_on(&self.model, &mut self.run, &mut self.recorder),
        }
    }

    pub(super) fn end(mut self, kernel: Kernel, status: Result<Status, RecordingFailed>) -> Ended<T, R> {
        let outcome = status.and_then(|status| self.run.end(status, &mut self.recorder));
        Ended { tag: self.tag, model: self.model, recorder: self.recorder, outcome, kernel }
    }
}

/// Notes the first touches of every run.
pub(super) struct Witness<'a, T, R>(pub &'a mut [Option<Box<Place<T, R>>>]);

impl<L: Lanes, T, R> Observer<L> for Witness<'_, T, R> {
    fn contacts(&mut self, touch: &Touch<L>) {
        for (i, place) in self.0.iter_mut().enumerate() {
            let Some(place) = place else { continue };
            if touch.weight.lane(i) > 0.0 {
                let meeting = Meeting {
                    sphere: touch.sphere,
                    pair: touch.pair,
                    part: touch.part.lane(i) as usize,
                    closing_m_s: touch.closing.lane(i),
                };
                let time_s = place.step.start_s;
                place.run.seen.note(&place.model, time_s, meeting);
            }
        }
    }
}

//! A run from start to end: steps, exact output times, first contacts.

use crate::model::Model;
use crate::results::checkpoint::Checkpoint;
use crate::results::outcome::{Outcome, RecordingFailed, ResumeError, SimulationError, Status};
use crate::results::recorder::{Flow, Recorder};
use crate::run::Course;

/// Runs `model` from its start to its end time, or until the recorder stops it.
///
/// # Errors
/// A step that fails, with the outcome so far; recorded outputs stay valid. An error of the recorder.
pub fn simulate(model: &Model, recorder: impl Recorder) -> Result<Outcome, SimulationError> {
    attempt(model, recorder)?.succeeded()
}

/// Runs `model` as far as possible: a failed step is an [`Outcome`] of [`Status::Failed`].
///
/// # Errors
/// An error of the recorder.
pub fn attempt(model: &Model, mut recorder: impl Recorder) -> Result<Outcome, RecordingFailed> {
    go(model, Course::new(model), &mut recorder)
}

/// Runs `model` from one of its outputs to its end time. The first output recorded is that of the checkpoint; all outputs
/// and the outcome are, to the bit, those of a run from the start, whose end time may have been another. A step that fails is
/// an outcome, as of [`attempt`].
///
/// # Errors
/// A checkpoint that does not fit the model; an error of the recorder.
pub fn resume(model: &Model, checkpoint: &Checkpoint, mut recorder: impl Recorder) -> Result<Outcome, ResumeError> {
    let run = Course::from_checkpoint(model, checkpoint, true).map_err(ResumeError::Refused)?;
    go(model, run, &mut recorder).map_err(ResumeError::Recording)
}

/// Records the output of a checkpoint once more, to the bit, without a step. The recorder neither begins nor ends here.
///
/// # Errors
/// A checkpoint that does not fit the model; an error of the recorder.
pub fn replay(model: &Model, checkpoint: &Checkpoint, recorder: &mut impl Recorder) -> Result<(), ResumeError> {
    let mut run = Course::from_checkpoint(model, checkpoint, true).map_err(ResumeError::Refused)?;
    let recorded = run.record(model, recorder);
    recorded.map(|_| ()).map_err(ResumeError::Recording)
}

/// A whole run, from the present output of `run` on.
fn go(model: &Model, mut run: Course, recorder: &mut dyn Recorder) -> Result<Outcome, RecordingFailed> {
    run.begin(model, recorder)?;
    let status = go_on(model, &mut run, recorder)?;
    run.end(status, recorder)
}

/// From the present output of `run`, the next to be recorded, to the end.
pub(crate) fn go_on(model: &Model, run: &mut Course, recorder: &mut dyn Recorder) -> Result<Status, RecordingFailed> {
    loop {
        if run.record(model, recorder)? == Flow::Stop {
            return Ok(Status::Stopped);
        }
        let Some(target_s) = run.next_output_s(model) else {
            return Ok(Status::Completed);
        };
        if let Err(error) = run.advance_to(model, target_s) {
            return Ok(Status::Failed(error));
        }
    }
}

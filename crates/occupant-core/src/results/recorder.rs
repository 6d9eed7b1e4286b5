//! Receivers of the results of a run.

use crate::model::Model;
use crate::results::outcome::Outcome;
use crate::results::sample::Sample;

/// Error of a recorder, such as a full disk.
pub type RecorderError = Box<dyn std::error::Error + Send + Sync>;

/// Whether a run continues.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// Continue.
    Continue,
    /// End the run here; recorded outputs are kept.
    Stop,
}

/// Records parts of a run: a file of time histories, a summary, a single peak.
pub trait Recorder {
    /// Called before the start of the run.
    ///
    /// # Errors
    /// An error ends the run.
    fn begin(&mut self, _model: &Model) -> Result<(), RecorderError> {
        Ok(())
    }

    /// Called at every output.
    ///
    /// # Errors
    /// An error ends the run.
    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError>;

    /// Called at the end of the run, except after an error of this recorder.
    ///
    /// # Errors
    /// An error is that of the run.
    fn end(&mut self, _outcome: &Outcome) -> Result<(), RecorderError> {
        Ok(())
    }
}

/// Two recorders, one after the other.
impl<A: Recorder, B: Recorder> Recorder for (A, B) {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        self.0.begin(model)?;
        self.1.begin(model)
    }

    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        let (first, second) = (self.0.record(sample)?, self.1.record(sample)?);
        Ok(if first == Flow::Stop { first } else { second })
    }

    fn end(&mut self, outcome: &Outcome) -> Result<(), RecorderError> {
        self.0.end(outcome)?;
        self.1.end(outcome)
    }
}

impl<R: Recorder + ?Sized> Recorder for &mut R {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        (**self).begin(model)
    }

    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        (**self).record(sample)
    }

    fn end(&mut self, outcome: &Outcome) -> Result<(), RecorderError> {
        (**self).end(outcome)
    }
}

/// Records nothing.
impl Recorder for () {
    fn record(&mut self, _sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        Ok(Flow::Continue)
    }
}

/// A closure that receives every sample.
#[derive(Debug)]
pub struct Watch<F>(pub F);

impl<F: FnMut(&Sample<'_>)> Recorder for Watch<F> {
    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        (self.0)(sample);
        Ok(Flow::Continue)
    }
}

//! Errors of a run that a program steps itself.

use crate::results::checkpoint::CheckpointError;
use crate::results::outcome::{RecordingFailed, StepError};

/// Reason why a call of a [`Run`](crate::run::Run) was refused, or could not continue. A refused call changes nothing.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RunError {
    /// Unreachable time.
    #[error("the run is at t = {now_s} s and ends at {end_s} s: it cannot go to {target_s} s")]
    Time {
        /// Present time, s.
        now_s: f64,
        /// The end of its model, s.
        end_s: f64,
        /// Requested time, s.
        target_s: f64,
    },
    /// Invalid number, state or frame.
    #[error("{found}; expected {expected}")]
    Input {
        /// Value found.
        found: String,
        /// Value expected.
        expected: String,
    },
    /// The integration cannot continue; the run stays at its present state.
    #[error(transparent)]
    Step(#[from] StepError),
    /// The recorder failed.
    #[error(transparent)]
    Recording(#[from] RecordingFailed),
    /// Saved run of another model.
    #[error("{0}")]
    Saved(#[from] CheckpointError),
}

impl RunError {
    /// Value found and value expected.
    pub(crate) fn input(found: impl Into<String>, expected: impl Into<String>) -> Self {
        RunError::Input { found: found.into(), expected: expected.into() }
    }
}

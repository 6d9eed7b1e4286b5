//! Errors of a run that a program steps itself.

use crate::results::checkpoint::CheckpointError;
use crate::results::outcome::{RecordingFailed, StepError};

/// Why a call of a [`Run`](crate::run::Run) was refused, or could not go on. A refused call changes nothing.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RunError {
    /// A time that the run cannot go to.
    #[error("the run is at t = {now_s} s and ends at {end_s} s: it cannot go to {target_s} s")]
    Time {
        /// Its present time, s.
        now_s: f64,
        /// The end of its model, s.
        end_s: f64,
        /// Where it was to go, s.
        target_s: f64,
    },
    /// A number, a state or a frame that cannot be.
    #[error("{found}; expected {expected}")]
    Input {
        /// What was found.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// The integration cannot continue; the run stays at its present state.
    #[error(transparent)]
    Step(#[from] StepError),
    /// The recorder failed.
    #[error(transparent)]
    Recording(#[from] RecordingFailed),
    /// A saved run that is none of the model's.
    #[error("{0}")]
    Saved(#[from] CheckpointError),
}

impl RunError {
    /// What was found, and what was expected.
    pub(crate) fn input(found: impl Into<String>, expected: impl Into<String>) -> Self {
        RunError::Input { found: found.into(), expected: expected.into() }
    }
}

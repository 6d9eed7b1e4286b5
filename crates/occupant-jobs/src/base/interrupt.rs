//! Interruption: work stops at its next output.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;

use super::Failure;

/// A request to stop the work; as a recorder it stops the run.
#[derive(Clone, Debug, Default)]
pub struct Interrupt {
    /// Set by the caller.
    pub asked: Arc<AtomicBool>,
}

impl Interrupt {
    /// Whether stopping was requested.
    pub fn is_asked(&self) -> bool {
        self.asked.load(Ordering::Relaxed)
    }

    /// Aborts the work if stopping was requested.
    ///
    /// # Errors
    /// Interrupted, and what was done before.
    pub fn refuse(&self, done: &str) -> Result<(), Failure> {
        if self.is_asked() { Err(Interrupt::failure(done)) } else { Ok(()) }
    }

    /// Failure of an interrupted job, with a note on what was done before.
    pub fn failure(done: &str) -> Failure {
        Failure::BrokeOff("error: interrupted".to_owned()).with_done(done)
    }
}

impl Recorder for Interrupt {
    fn record(&mut self, _sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        Ok(if self.is_asked() { Flow::Stop } else { Flow::Continue })
    }
}

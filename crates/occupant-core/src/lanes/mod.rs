//! Many runs on one thread, several at once side by side: the work of a sweep.
//!
//! [`simulate_many`] pulls its runs one by one, whenever one has ended, so that it holds a handful of models however long
//! the list is. What every recorder sees, and every outcome, is to the bit what [`crate::simulate::simulate`] gives for
//! that model alone, whichever [`Kernel`] computed it and whatever ran beside it.

use std::fmt;
use std::ops::ControlFlow;

use crate::model::Model;
use crate::outcome::{Outcome, RecordingFailed};
use crate::recorder::Recorder;
use crate::simulate::simulate;

/// A run to be done.
#[derive(Clone, Debug)]
pub struct Job<T, R> {
    /// Whatever tells the caller which run this is.
    pub tag: T,
    /// What is run.
    pub model: Model,
    /// Where its results go.
    pub recorder: R,
}

/// A run that has ended, with all that its [`Job`] brought.
#[derive(Debug)]
pub struct Ended<T, R> {
    /// The tag of its job.
    pub tag: T,
    /// What was run.
    pub model: Model,
    /// Where its results went.
    pub recorder: R,
    /// How it ended, or why it could not be recorded.
    pub outcome: Result<Outcome, RecordingFailed>,
    /// What computed it.
    pub kernel: Kernel,
}

/// How many runs a processor core computes at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kernel {
    /// One run at a time.
    Scalar,
    /// Four runs side by side.
    Lanes4,
    /// Eight runs side by side.
    Lanes8,
}

impl Kernel {
    /// The fastest one that this processor has.
    pub fn best() -> Kernel {
        Kernel::Scalar
    }

    /// `scalar`, `lanes4` or `lanes8`.
    pub fn name(self) -> &'static str {
        match self {
            Kernel::Scalar => "scalar",
            Kernel::Lanes4 => "lanes4",
            Kernel::Lanes8 => "lanes8",
        }
    }
}

impl fmt::Display for Kernel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Runs all `jobs` on this thread with the fastest kernel; `on_end` gets each when it has ended, in no fixed order, and may
/// break off: then the runs still under way are dropped.
///
/// The next job is taken only when there is room for it; a job list that waits for others (a channel) holds up the runs
/// under way.
pub fn simulate_many<T, R: Recorder>(
    jobs: impl IntoIterator<Item = Job<T, R>>,
    on_end: impl FnMut(Ended<T, R>) -> ControlFlow<()>,
) {
    simulate_many_with(Kernel::best(), jobs, on_end);
}

/// [`simulate_many`] with a kernel of the caller's choice, or the next smaller one that this processor has.
pub fn simulate_many_with<T, R: Recorder>(
    _kernel: Kernel,
    jobs: impl IntoIterator<Item = Job<T, R>>,
    mut on_end: impl FnMut(Ended<T, R>) -> ControlFlow<()>,
) {
    for job in jobs {
        let Job {
            tag,
            model,
            mut recorder,
        } = job;
        let outcome = simulate(&model, &mut recorder);
        let ended = Ended {
            tag,
            model,
            recorder,
            outcome,
            kernel: Kernel::Scalar,
        };
        if on_end(ended).is_break() {
            return;
        }
    }
}

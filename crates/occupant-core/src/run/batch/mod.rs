//! Many runs on one thread, several at once side by side: the work of a sweep.
//!
//! [`simulate_many`] pulls its runs one by one, whenever one has ended, so that it holds a handful of models however long
//! the list is. What every recorder sees, and every outcome, is to the bit what [`crate::run::simulate::simulate`] gives for
//! that model alone, whichever [`Kernel`] computed it and whatever ran beside it.
//!
//! Side by side run models with the fixed-step integrator and the same structure: the same spheres on the same segments, the
//! same surfaces by kind and corners, in the same seams and for the same spheres, belts round the same spheres, springs in the
//! same joints ([`Unlike`] names what differs). All numbers may differ: masses, places, stiffnesses, paths, times,
//! steps, outputs. A model that has no place beside those under way is run alone at once; one with error control always
//! is.

#[cfg(any(target_arch = "x86_64", test))]
mod group;
#[cfg(any(target_arch = "x86_64", test))]
mod machine;
#[cfg(any(target_arch = "x86_64", test))]
mod place;

use std::fmt;
use std::ops::ControlFlow;

#[cfg(any(target_arch = "x86_64", test))]
use group::Group;

#[cfg(doc)]
use crate::forces::Unlike;
use crate::model::Model;
use crate::results::outcome::{Outcome, RecordingFailed};
use crate::results::recorder::Recorder;
use crate::run::simulate::simulate;

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
        let all = [Kernel::Lanes8, Kernel::Lanes4];
        let found = all.into_iter().find(|kernel| kernel.is_available());
        found.unwrap_or(Kernel::Scalar)
    }

    /// True if this processor has it.
    pub fn is_available(self) -> bool {
        match self {
            Kernel::Scalar => true,
            #[cfg(target_arch = "x86_64")]
            Kernel::Lanes4 => crate::motion::lanes::has_avx2(),
            #[cfg(target_arch = "x86_64")]
            Kernel::Lanes8 => crate::motion::lanes::has_avx512(),
            #[cfg(not(target_arch = "x86_64"))]
            Kernel::Lanes4 | Kernel::Lanes8 => false,
        }
    }

    /// The one of that name.
    pub fn named(name: &str) -> Option<Kernel> {
        let all = [Kernel::Scalar, Kernel::Lanes4, Kernel::Lanes8];
        all.into_iter().find(|kernel| kernel.name() == name)
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

/// [`simulate_many`] with a kernel of the caller's choice; with [`Kernel::Scalar`] if this processor has not got it.
pub fn simulate_many_with<T, R: Recorder>(
    kernel: Kernel,
    jobs: impl IntoIterator<Item = Job<T, R>>,
    mut on_end: impl FnMut(Ended<T, R>) -> ControlFlow<()>,
) {
    let mut jobs = jobs.into_iter();
    // whether all were run or the caller broke off, there is nothing left to do
    let _ = match kernel {
        #[cfg(target_arch = "x86_64")]
        Kernel::Lanes4 if kernel.is_available() => {
            Group::<crate::motion::lanes::Avx2, T, R>::new(kernel).run_all(jobs, &mut on_end)
        }
        #[cfg(target_arch = "x86_64")]
        Kernel::Lanes8 if kernel.is_available() => {
            Group::<crate::motion::lanes::Avx512, T, R>::new(kernel).run_all(jobs, &mut on_end)
        }
        _ => jobs.try_for_each(|job| on_end(run_alone(job))),
    };
}

/// A run with the scalar kernel.
fn run_alone<T, R: Recorder>(mut job: Job<T, R>) -> Ended<T, R> {
    let outcome = simulate(&job.model, &mut job.recorder);
    Ended { tag: job.tag, model: job.model, recorder: job.recorder, outcome, kernel: Kernel::Scalar }
}

#[cfg(test)]
mod tests;

//! Many runs on one thread, several at once in lanes: the work of a sweep.
//!
//! [`simulate_many`] requests its runs one by one, whenever one has ended, so it holds only a few models however long
//! the list is. Every sample and every outcome has the bits that [`attempt`] gives for that model alone, whichever
//! [`Kernel`] computed it and whatever ran beside it.
//!
//! Models run side by side if they have the same kind of integrator and the same structure: the same spheres on the
//! same segments, the same surfaces by kind and corners, in the same seams and for the same spheres, belts round the
//! same spheres, springs in the same joints ([`Unlike`] names what differs). All numbers may differ: masses, positions,
//! stiffnesses, paths, times, steps, tolerances, outputs. A model that does not fit beside those in progress is run
//! alone at once. So is every model with a program's own forces, with a live path, or with air bags under error
//! control.

#[cfg(any(target_arch = "x86_64", test))]
mod bench;
#[cfg(any(target_arch = "x86_64", test))]
mod group;
#[cfg(any(target_arch = "x86_64", test))]
mod machine;
#[cfg(any(target_arch = "x86_64", test))]
mod place;
#[cfg(any(target_arch = "x86_64", test))]
mod tries;

use std::fmt;
use std::ops::ControlFlow;

#[cfg(any(target_arch = "x86_64", test))]
use group::Group;

#[cfg(doc)]
use crate::forces::Unlike;
use crate::model::Model;
use crate::results::outcome::{Outcome, RecordingFailed};
use crate::results::recorder::Recorder;
use crate::run::simulate::attempt;

/// A run to be computed.
#[derive(Clone, Debug)]
pub struct Job<T, R> {
    /// The caller's tag of this run.
    pub tag: T,
    /// Model.
    pub model: Model,
    /// Recorder of its results.
    pub recorder: R,
}

/// A finished run, with everything of its [`Job`].
#[derive(Debug)]
pub struct Ended<T, R> {
    /// Tag of its job.
    pub tag: T,
    /// Model.
    pub model: Model,
    /// Recorder of its results.
    pub recorder: R,
    /// Outcome, or the error of the recorder.
    pub outcome: Result<Outcome, RecordingFailed>,
    /// Kernel that computed it.
    pub kernel: Kernel,
}

/// Number of runs that a processor core computes at once.
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
    /// Fastest kernel of this processor.
    pub fn best() -> Kernel {
        let all = [Kernel::Lanes8, Kernel::Lanes4];
        let found = all.into_iter().find(|kernel| kernel.is_available());
        found.unwrap_or(Kernel::Scalar)
    }

    /// Whether this processor supports it.
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

    /// Number of runs side by side.
    pub fn lanes(self) -> usize {
        match self {
            Kernel::Scalar => 1,
            Kernel::Lanes4 => 4,
            Kernel::Lanes8 => 8,
        }
    }

    /// Kernel with this name.
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

/// Runs all `jobs` on this thread, with [`Kernel::Scalar`] if this processor has not got `kernel`; `on_end` gets each when it has ended, in no fixed order, and may
/// break off: then the runs still under way are dropped.
///
/// The next job is taken only when there is room for it; a job list that waits for others (a channel) holds up the runs
/// under way.
pub fn simulate_many<T, R: Recorder>(
    kernel: Kernel,
    jobs: impl IntoIterator<Item = Job<T, R>>,
    mut on_end: impl FnMut(Ended<T, R>) -> ControlFlow<()>,
) {
    let under_way = (0..MOST_PLACES).map(|_| None).collect();
    run_all(kernel, &mut JobList { jobs: jobs.into_iter(), on_end: &mut on_end, under_way, nobody: () });
}

/// Compiled here, once for each kind of lanes, for all types of jobs.
fn run_all(kernel: Kernel, jobs: &mut dyn Jobs) {
    // whether all were run or the caller broke off, there is nothing left to do
    let _ = match kernel {
        #[cfg(target_arch = "x86_64")]
        Kernel::Lanes4 if kernel.is_available() => Group::<crate::motion::lanes::Avx2>::new(kernel).run_all(jobs),
        #[cfg(target_arch = "x86_64")]
        Kernel::Lanes8 if kernel.is_available() => Group::<crate::motion::lanes::Avx512>::new(kernel).run_all(jobs),
        _ => one_by_one(jobs),
    };
}

/// Source and destination of the models of a group, with the other data of their jobs.
trait Jobs {
    /// Model of the next job, which gets the index `place`.
    fn next(&mut self, place: usize) -> Option<Model>;
    /// Recorder of the run at `place`.
    fn recorder(&mut self, place: usize) -> &mut dyn Recorder;
    /// Takes the ended run of `place`.
    fn end(
        &mut self,
        place: usize,
        model: Model,
        outcome: Result<Outcome, RecordingFailed>,
        kernel: Kernel,
    ) -> ControlFlow<()>;
}

/// Largest number of lanes.
const MOST_PLACES: usize = 8;

/// List of jobs with the receiver of ended runs.
struct JobList<I, F, T, R> {
    jobs: I,
    on_end: F,
    /// Tags and recorders of the present runs, by index.
    under_way: Vec<Option<(T, R)>>,
    /// Recorder for data of no run.
    nobody: (),
}

impl<T, R, I, F> Jobs for JobList<I, F, T, R>
where
    R: Recorder,
    I: Iterator<Item = Job<T, R>>,
    F: FnMut(Ended<T, R>) -> ControlFlow<()>,
{
    fn next(&mut self, place: usize) -> Option<Model> {
        let Job { tag, model, recorder } = self.jobs.next()?;
        self.under_way[place] = Some((tag, recorder));
        Some(model)
    }

    fn recorder(&mut self, place: usize) -> &mut dyn Recorder {
        match &mut self.under_way[place] {
            Some((_, recorder)) => recorder,
            None => &mut self.nobody,
        }
    }

    fn end(
        &mut self,
        place: usize,
        model: Model,
        outcome: Result<Outcome, RecordingFailed>,
        kernel: Kernel,
    ) -> ControlFlow<()> {
        match self.under_way[place].take() {
            Some((tag, recorder)) => (self.on_end)(Ended { tag, model, recorder, outcome, kernel }),
            None => ControlFlow::Continue(()),
        }
    }
}

/// All jobs with the scalar kernel.
fn one_by_one(jobs: &mut dyn Jobs) -> ControlFlow<()> {
    while let Some(model) = jobs.next(0) {
        run_alone(0, model, jobs)?;
    }
    ControlFlow::Continue(())
}

/// Runs `model`, the job of `place`, with the scalar kernel.
fn run_alone(place: usize, model: Model, jobs: &mut dyn Jobs) -> ControlFlow<()> {
    let outcome = attempt(&model, jobs.recorder(place));
    jobs.end(place, model, outcome, Kernel::Scalar)
}

#[cfg(test)]
mod tests;

//! Many runs on all processor cores, in lanes on each, with the rows of finished runs passed to the caller.
//!
//! ```text
//! indices ─ Source::begin ─ lanes, on the threads of a pool ─ Source::end ─ channel ─ sink, on the calling thread
//! ```
//!
//! A thread takes the next index whenever one of its lanes is free, so lanes stay filled until the indices run out;
//! batches would leave them idle at each end. A row depends only on its index: rows have the same bits for any number
//! of threads, but not the same order. Memory holds the runs in progress and a few rows. Reads and writes no files.

use std::cell::RefCell;
use std::iter::from_fn;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::time::Instant;

use occupant_core::model::Model;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_core::run::batch::{self, Job, Kernel, simulate_many};
use occupant_scenario::Diagnostics;
use occupant_scenario::ending::Ending;
pub use occupant_scenario::ending::Unrecorded;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

/// Stack size of a thread, bytes: eight models of many bodies side by side are large to build.
const STACK: usize = 16 << 20;

/// Largest number of threads, or four per core if that is more; further threads would only wait.
pub const MOST_THREADS: usize = 64;

/// Source of runs and sink of their results, shared by all threads.
pub trait Source: Sync {
    /// Receives the results of one run.
    type Recorder: Recorder;
    /// Data kept of a run.
    type Row: Send;
    /// An error that ends all runs, such as a full disk.
    type Error: From<Unrecorded> + Send;

    /// The model of a run and its recorder.
    ///
    /// # Errors
    /// A refused or excluded scenario costs this run; anything else ends all.
    fn begin(&self, index: u64) -> Result<(Model, Self::Recorder), NotBegun<Self::Error>>;

    /// The row of a run that has ended.
    ///
    /// # Errors
    /// An error that ends all runs.
    fn end(&self, run: Finished<Self::Recorder>) -> Result<Self::Row, Self::Error>;

    /// Discards the recorder of an interrupted run, which has no row.
    ///
    /// # Errors
    /// An error that ends all runs.
    fn stopped(&self, _recorder: Self::Recorder) -> Result<(), Self::Error> {
        Ok(())
    }
}

/// Reason why a run did not start.
#[derive(Debug)]
pub enum NotBegun<E> {
    /// The scenario has errors.
    Refused(Diagnostics),
    /// The study leaves it out, for this reason.
    Excluded(String),
    /// An error that ends all runs.
    Error(E),
}

impl<E> From<Diagnostics> for NotBegun<E> {
    fn from(problems: Diagnostics) -> Self {
        NotBegun::Refused(problems)
    }
}

/// A run that has ended, completed or not.
#[derive(Debug)]
pub struct Finished<R> {
    /// Its index.
    pub index: u64,
    /// Outcome.
    pub ending: Ending,
    /// Wall time since its start, s.
    pub wall_time_s: f64,
    /// The model and its results; none if the scenario was refused or excluded, or the program broke off.
    pub ran: Option<Ran<R>>,
}

/// A run that was computed.
#[derive(Debug)]
pub struct Ran<R> {
    /// The model.
    pub model: Model,
    /// Its recorder.
    pub recorder: R,
    /// The kernel used.
    pub kernel: Kernel,
}

/// Threads that compute runs, and their kernel.
#[derive(Debug)]
pub struct Engine {
    pool: ThreadPool,
    kernel: Kernel,
}

impl Engine {
    /// An engine with this many threads: at most [`MOST_THREADS`], or four per core where that is more, and fewer if
    /// the system grants no more.
    ///
    /// # Errors
    /// The system gives not even one.
    pub fn new(threads: usize, kernel: Kernel) -> Result<Engine, ThreadPoolBuildError> {
        let pool =
            |n| ThreadPoolBuilder::new().num_threads(n).stack_size(STACK).thread_name(|i| format!("runs {i}")).build();
        let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let mut count = threads.clamp(1, MOST_THREADS.max(4 * cores));
        loop {
            match pool(count) {
                Err(_) if count > 1 => count /= 2,
                built => return built.map(|pool| Engine { pool, kernel }),
            }
        }
    }

    /// Number of threads.
    pub fn threads(&self) -> usize {
        self.pool.current_num_threads()
    }

    /// The kernel.
    pub fn kernel(&self) -> Kernel {
        self.kernel
    }

    /// Does other work on the threads of the engine, as parallel iterators share it.
    pub fn share<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        self.pool.install(work)
    }

    /// Runs all `indices` and hands each row to `sink` on the calling thread, in the order in which the runs end. Once
    /// `stop` is true nothing new is begun, and runs under way end at their next output without a row. Threads wait while
    /// the sink has no room. A run on which the program panics is a row; those under way with it are computed again.
    ///
    /// # Errors
    /// The first of `source` or `sink`, which ends all runs.
    pub fn run<S: Source>(
        &self,
        source: &S,
        indices: impl Iterator<Item = u64> + Send,
        stop: &AtomicBool,
        mut sink: impl FnMut(S::Row) -> Result<(), S::Error>,
    ) -> Result<(), S::Error> {
        let (rows, received) = sync_channel(self.threads());
        let (indices, halted) = (Mutex::new(indices), AtomicBool::new(false));
        let stop = Stop { asked: stop, halted: &halted };
        self.pool.in_place_scope(|scope| {
            for _ in 0..self.threads() {
                let (rows, under_way) = (rows.clone(), RefCell::default());
                let worker = Worker { source, indices: &indices, stop, kernel: self.kernel, rows, under_way };
                scope.spawn(move |_| worker.work());
            }
            drop(rows);
            let mut ended = Ok(());
            for row in received {
                // after an error the rest is thrown away, so that no thread waits for room
                if ended.is_ok() {
                    ended = row.and_then(&mut sink);
                    halted.fetch_or(ended.is_err(), Ordering::Relaxed);
                }
            }
            ended
        })
    }
}

/// Request to end runs early: from the caller, or by an error.
#[derive(Clone, Copy)]
struct Stop<'a> {
    asked: &'a AtomicBool,
    halted: &'a AtomicBool,
}

impl Stop<'_> {
    fn is_halted(self) -> bool {
        self.halted.load(Ordering::Relaxed)
    }

    fn is_asked(self) -> bool {
        self.asked.load(Ordering::Relaxed) || self.is_halted()
    }
}

impl Recorder for Stop<'_> {
    fn record(&mut self, _sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        Ok(if self.is_asked() { Flow::Stop } else { Flow::Continue })
    }
}

/// Index of a run, and when it started.
type Tag = (u64, Instant);
type Ended<'a, R> = batch::Ended<Tag, (Stop<'a>, R)>;

/// The work of one thread.
struct Worker<'a, S: Source, I> {
    source: &'a S,
    indices: &'a Mutex<I>,
    stop: Stop<'a>,
    kernel: Kernel,
    rows: SyncSender<Result<S::Row, S::Error>>,
    /// Indices of the runs in progress.
    under_way: RefCell<Vec<u64>>,
}

impl<'a, S: Source, I: Iterator<Item = u64>> Worker<'a, S, I> {
    fn work(&self) {
        // a defect of the program costs one run: each of those under way is computed alone, to find out which it was
        while catch_unwind(AssertUnwindSafe(|| self.side_by_side(self.kernel, || self.next()))).is_err() {
            self.under_way.take().into_iter().for_each(|index| self.alone(index));
        }
    }

    fn next(&self) -> Option<u64> {
        if self.stop.is_asked() {
            return None;
        }
        let mut indices = self.indices.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        indices.next()
    }

    fn alone(&self, index: u64) {
        let mut only = Some(index);
        let run = || self.side_by_side(Kernel::Scalar, || only.take());
        if let Err(panic) = catch_unwind(AssertUnwindSafe(run)) {
            self.finish((index, Instant::now()), Ending::broken(&*panic), None);
        }
    }

    /// Runs the indices given by `next`, as many side by side as the kernel can.
    fn side_by_side(&self, kernel: Kernel, mut next: impl FnMut() -> Option<u64>) {
        let jobs = from_fn(|| {
            loop {
                let index = next()?;
                self.under_way.borrow_mut().push(index);
                let tag = (index, Instant::now());
                match self.source.begin(index) {
                    Ok((model, recorder)) => return Some(Job { tag, model, recorder: (self.stop, recorder) }),
                    Err(NotBegun::Refused(problems)) => self.finish(tag, Ending::refused(&problems), None),
                    Err(NotBegun::Excluded(reason)) => self.finish(tag, Ending::Excluded(reason), None),
                    Err(NotBegun::Error(error)) => self.hand_on(index, Err(error)),
                }
            }
        });
        simulate_many(kernel, jobs, |ended| {
            self.end(ended);
            if self.stop.is_halted() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
    }

    fn end(&self, ended: Ended<'a, S::Recorder>) {
        let (index, _) = ended.tag;
        let (_, recorder) = ended.recorder;
        match ended.outcome.map(|outcome| Ending::of(&outcome)) {
            Ok(Some(ending)) => {
                self.finish(ended.tag, ending, Some(Ran { model: ended.model, recorder, kernel: ended.kernel }));
            }
            Ok(None) => match self.source.stopped(recorder) {
                Ok(()) => self.put_away(index),
                Err(error) => self.hand_on(index, Err(error)),
            },
            Err(source) => self.hand_on(index, Err(Unrecorded { index, source }.into())),
        }
    }

    fn finish(&self, (index, begun): Tag, ending: Ending, ran: Option<Ran<S::Recorder>>) {
        let wall_time_s = begun.elapsed().as_secs_f64();
        let row = self.source.end(Finished { index, ending, wall_time_s, ran });
        self.hand_on(index, row);
    }

    fn hand_on(&self, index: u64, row: Result<S::Row, S::Error>) {
        self.put_away(index);
        let is_error = row.is_err();
        // nobody listens any more when the sink has panicked
        let is_heard = self.rows.send(row).is_ok();
        self.stop.halted.fetch_or(is_error || !is_heard, Ordering::Relaxed);
    }

    fn put_away(&self, index: u64) {
        self.under_way.borrow_mut().retain(|i| *i != index);
    }
}

#[cfg(test)]
mod tests;

//! All threads at work: each takes the next samples, computes their rows and hands them on.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::thread;

use super::finished::Finished;
use super::row::Row;

/// Computes samples. One is shared by all threads.
pub trait Worker: Sync {
    /// What ends the sweep.
    type Error: Send;

    /// The rows of these samples; those that were stopped in flight are missing.
    ///
    /// # Errors
    /// What is no property of the sample, such as a full disk.
    fn compute(&self, samples: &[u64]) -> Result<Vec<Row>, Self::Error>;
}

/// What is to be done, and how.
#[derive(Clone, Copy, Debug)]
pub struct Job<'a> {
    /// The samples.
    pub samples: &'a Range<u64>,
    /// Those of them that are finished already.
    pub finished: &'a Finished,
    /// How many threads.
    pub threads: usize,
    /// How many samples a thread takes at a time.
    pub batch: usize,
    /// Once true, nothing new is begun.
    pub stop: &'a AtomicBool,
}

/// Computes every sample of the job that is not finished and hands each row to `sink` on the calling thread, in the order
/// in which they are finished. An error stops all threads; so does one of `sink`.
///
/// No more rows are under way than twice the threads.
///
/// # Errors
/// What a worker or `sink` reports.
pub fn run<W: Worker>(
    job: Job<'_>,
    worker: &W,
    sink: &mut dyn FnMut(Row) -> Result<(), W::Error>,
) -> Result<(), W::Error> {
    let next = AtomicU64::new(job.samples.start);
    let (rows, received) = sync_channel::<Result<Vec<Row>, W::Error>>(job.threads);
    thread::scope(|scope| {
        for number in 0..job.threads {
            let rows = rows.clone();
            let next = &next;
            let work = move || work(job, worker, next, rows);
            // where the system gives no more threads, those that there are do the work
            let begun = thread::Builder::new()
                .name(format!("sweep {number}"))
                .spawn_scoped(scope, work);
            if begun.is_err() && number == 0 {
                break;
            }
        }
        drop(rows);
        let mut ended = Ok(());
        for batch in received {
            if ended.is_err() {
                continue;
            }
            ended = batch.and_then(|rows| rows.into_iter().try_for_each(&mut *sink));
            if ended.is_err() {
                job.stop.store(true, Ordering::Relaxed);
            }
        }
        ended
    })
}

/// One thread.
fn work<W: Worker>(
    job: Job<'_>,
    worker: &W,
    next: &AtomicU64,
    rows: SyncSender<Result<Vec<Row>, W::Error>>,
) {
    while !job.stop.load(Ordering::Relaxed) {
        let batch = next_batch(job, next);
        if batch.is_empty() || rows.send(worker.compute(&batch)).is_err() {
            return;
        }
    }
}

/// The next samples that are not finished.
fn next_batch(job: Job<'_>, next: &AtomicU64) -> Vec<u64> {
    let mut batch = Vec::with_capacity(job.batch);
    while batch.len() < job.batch {
        let index = next.fetch_add(1, Ordering::Relaxed);
        if index >= job.samples.end {
            break;
        }
        if !job.finished.has(index) {
            batch.push(index);
        }
    }
    batch
}

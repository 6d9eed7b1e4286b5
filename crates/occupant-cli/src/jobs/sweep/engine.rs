//! All threads at work: each takes the next sample whenever it has room for one, and hands its row on.

use std::ops::{ControlFlow, Range};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::thread;

use crate::files::study_folder::finished::Finished;
use crate::files::study_folder::row::Row;

/// Computes samples. One is shared by all threads.
pub(crate) trait Worker: Sync {
    /// What ends the sweep.
    type Error: Send;

    /// Computes the samples that `next` gives until there are no more, and hands on the row of each when it is finished; of
    /// a sample that was stopped in flight there is none. `hand_on` may break off.
    ///
    /// # Errors
    /// What is no property of a sample, such as a full disk.
    fn work(&self, next: &dyn Fn() -> Option<u64>, hand_on: HandOn<'_>) -> Result<(), Self::Error>;
}

/// Takes a finished row.
pub(crate) type HandOn<'a> = &'a dyn Fn(Row) -> ControlFlow<()>;

/// What is to be done, and how.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Job<'a> {
    pub(crate) samples: &'a Range<u64>,
    /// Those of them that are finished already.
    pub(crate) finished: &'a Finished,
    pub(crate) threads: usize,
    /// Once true, nothing new is begun.
    pub(crate) stop: &'a AtomicBool,
}

/// Computes every sample of the job that is not finished and hands each row to `sink` on the calling thread, in the order
/// in which they are finished. An error stops all threads; so does one of `sink`. Rows do not pile up: a thread waits
/// until the sink has room.
///
/// # Errors
/// What a worker or `sink` reports.
pub(crate) fn run<W: Worker>(
    job: Job<'_>,
    worker: &W,
    sink: &mut dyn FnMut(Row) -> Result<(), W::Error>,
) -> Result<(), W::Error> {
    let counter = AtomicU64::new(job.samples.start);
    let (rows, received) = sync_channel(job.threads);
    thread::scope(|scope| {
        for number in 0..job.threads {
            let (rows, counter) = (rows.clone(), &counter);
            // where the system gives no more threads, those that there are do the work
            let _fewer = thread::Builder::new()
                .name(format!("sweep {number}"))
                .spawn_scoped(scope, move || work(job, worker, counter, &rows));
        }
        drop(rows);
        let mut ended = Ok(());
        for row in received {
            // after an error the rest is thrown away, so that no thread waits for room
            if ended.is_ok() {
                ended = row.and_then(&mut *sink);
                if ended.is_err() {
                    job.stop.store(true, Ordering::Relaxed);
                }
            }
        }
        ended
    })
}

fn work<W: Worker>(job: Job<'_>, worker: &W, counter: &AtomicU64, rows: &SyncSender<Result<Row, W::Error>>) {
    let hand_on = |row| match rows.send(Ok(row)) {
        Ok(()) => ControlFlow::Continue(()),
        Err(_) => ControlFlow::Break(()),
    };
    if let Err(error) = worker.work(&|| next_sample(job, counter), &hand_on) {
        // whoever does not listen any more has heard of another error
        let _unheard = rows.send(Err(error));
    }
}

/// The next sample that is not finished.
fn next_sample(job: Job<'_>, counter: &AtomicU64) -> Option<u64> {
    while !job.stop.load(Ordering::Relaxed) {
        let index = counter.fetch_add(1, Ordering::Relaxed);
        if index >= job.samples.end {
            return None;
        }
        if !job.finished.has(index) {
            return Some(index);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::study_folder::row::tests::row;

    /// Makes rows without work; sample 7 ends the sweep if it is asked to.
    struct Maker {
        breaks_at_7: bool,
    }

    impl Worker for Maker {
        type Error = &'static str;

        fn work(&self, next: &dyn Fn() -> Option<u64>, hand_on: HandOn<'_>) -> Result<(), Self::Error> {
            while let Some(index) = next() {
                if self.breaks_at_7 && index == 7 {
                    return Err("seven");
                }
                if hand_on(row(index)).is_break() {
                    break;
                }
            }
            Ok(())
        }
    }

    fn run_all(threads: usize, worker: &Maker, sink_fails_at: u64) -> (Vec<u64>, Result<(), &'static str>) {
        let mut finished = Finished::none(1000);
        (0..1000).filter(|i| i % 3 == 0).for_each(|i| {
            finished.add(i);
        });
        let stop = AtomicBool::new(false);
        let job = Job { samples: &(5..1000), finished: &finished, threads, stop: &stop };
        let mut seen = Vec::new();
        let ended = run(job, worker, &mut |row| {
            if row.index == sink_fails_at {
                return Err("full");
            }
            seen.push(row.index);
            Ok(())
        });
        seen.sort_unstable();
        (seen, ended)
    }

    #[test]
    fn every_sample_that_is_not_finished_is_computed_once_by_any_number_of_threads() {
        let wanted: Vec<u64> = (5..1000).filter(|i| i % 3 != 0).collect();
        for threads in [1, 2, 7] {
            let (seen, ended) = run_all(threads, &Maker { breaks_at_7: false }, u64::MAX);
            assert_eq!(seen, wanted);
            assert_eq!(ended, Ok(()));
        }
    }

    #[test]
    fn an_error_of_a_worker_or_of_the_sink_ends_the_sweep_and_no_thread_hangs() {
        for threads in [1, 2, 7] {
            let (_, ended) = run_all(threads, &Maker { breaks_at_7: true }, u64::MAX);
            assert_eq!(ended, Err("seven"));
            let (seen, ended) = run_all(threads, &Maker { breaks_at_7: false }, 500);
            assert_eq!(ended, Err("full"));
            assert!(!seen.contains(&500));
        }
    }
}

//! How far a sweep is.

use std::time::{Duration, Instant};

use crate::base::progress::{Runs, counted};
use crate::files::study_folder::{Row, Status};

/// A line so often where there is no terminal.
const LINE_EVERY: Duration = Duration::from_secs(10);

#[derive(Debug)]
pub(crate) struct Progress {
    runs: Runs,
    samples: u64,
    /// Samples that were finished before this process.
    before: u64,
    /// Samples that were computed by this process.
    pub(crate) computed: u64,
    failed: u64,
    began: Instant,
}

impl Progress {
    /// Of `samples`, `before` are finished.
    pub(crate) fn new(samples: u64, before: u64, quiet: bool) -> Self {
        let runs = Runs::new(samples, &counted("samples"), LINE_EVERY, quiet);
        if let Some(bar) = runs.bar() {
            bar.set_position(before);
            bar.reset_eta();
        }
        Progress { runs, samples, before, computed: 0, failed: 0, began: Instant::now() }
    }

    pub(crate) fn see(&mut self, row: &Row) {
        self.computed += 1;
        self.failed += u64::from(row.status != Status::Completed);
        let done = self.before + self.computed;
        if let Some(bar) = self.runs.bar() {
            bar.set_position(done);
            if self.failed > 0 {
                bar.set_message(format!(", {} failed", self.failed));
            }
        } else if self.runs.is_line_due() {
            let rate = self.computed as f64 / self.elapsed_s();
            let to_go_s = (self.samples.saturating_sub(done)) as f64 / rate;
            self.runs.say(&format!(
                "{done} of {} samples, {rate:.1}/s, {to_go_s:.0} s to go, {} failed",
                self.samples, self.failed
            ));
        }
    }

    /// Seconds since the beginning.
    pub(crate) fn elapsed_s(&self) -> f64 {
        self.began.elapsed().as_secs_f64()
    }

    /// No more.
    pub(crate) fn end(&self) {
        self.runs.end();
    }
}

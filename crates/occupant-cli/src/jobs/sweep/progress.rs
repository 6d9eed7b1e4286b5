//! How far a sweep is: a bar on a terminal, else a line now and then.

use std::time::{Duration, Instant};

use indicatif::ProgressBar;

use crate::base::progress::bar;
use crate::base::talk::say;
use crate::files::study_folder::row::{Row, Status};

/// A line so often where there is no terminal.
const LINE_EVERY: Duration = Duration::from_secs(10);

/// How far a sweep is.
#[derive(Debug)]
pub(crate) struct Progress {
    bar: ProgressBar,
    quiet: bool,
    samples: u64,
    /// Samples that were finished before this process.
    before: u64,
    now: u64,
    failed: u64,
    began: Instant,
    line: Instant,
}

impl Progress {
    /// Of `samples`, `before` are finished.
    pub(crate) fn new(samples: u64, before: u64, quiet: bool) -> Self {
        let template = "{bar:30} {pos} of {len} samples, {per_sec}, {eta} to go{msg}";
        let bar = bar(Some(samples), template, quiet).with_position(before);
        bar.reset_eta();
        Progress { bar, quiet, samples, before, now: 0, failed: 0, began: Instant::now(), line: Instant::now() }
    }

    pub(crate) fn see(&mut self, row: &Row) {
        self.now += 1;
        self.failed += u64::from(row.status != Status::Completed);
        if self.quiet {
            return;
        }
        if !self.bar.is_hidden() {
            self.bar.set_position(self.before + self.now);
            if self.failed > 0 {
                self.bar.set_message(format!(", {} failed", self.failed));
            }
        } else if self.line.elapsed() > LINE_EVERY {
            self.line = Instant::now();
            say(&self.line_text());
        }
    }

    /// So many were computed by this process.
    pub(crate) fn computed(&self) -> u64 {
        self.now
    }

    /// Seconds since the beginning.
    pub(crate) fn elapsed_s(&self) -> f64 {
        self.began.elapsed().as_secs_f64()
    }

    /// No more.
    pub(crate) fn end(&self) {
        self.bar.finish_and_clear();
    }

    fn line_text(&self) -> String {
        let done = self.before + self.now;
        let rate = self.now as f64 / self.elapsed_s();
        let to_go_s = (self.samples.saturating_sub(done)) as f64 / rate;
        format!("{done} of {} samples, {rate:.1}/s, {to_go_s:.0} s to go, {} failed", self.samples, self.failed)
    }
}

//! Progress of a sweep.

use std::time::Duration;

use crate::base::progress::{Runs, Show};
use crate::files::study_folder::{Row, Status};

/// Interval of progress lines without a terminal.
const LINE_EVERY: Duration = Duration::from_secs(10);

/// Progress of a sweep.
#[derive(Debug)]
pub struct Progress {
    runs: Runs,
    /// Samples finished before this process.
    before: u64,
    /// Samples computed by this process.
    pub computed: u64,
    failed: u64,
}

impl Progress {
    /// Progress of `samples`, of which `before` are finished.
    pub fn new(samples: u64, before: u64, show: Show) -> Self {
        let runs = Runs::new(samples, "samples", LINE_EVERY, show).from(before);
        Progress { runs, before, computed: 0, failed: 0 }
    }

    /// Counts a row.
    pub fn see(&mut self, row: &Row) {
        self.computed += 1;
        self.failed += u64::from(row.status != Status::Completed);
        let done = self.before + self.computed;
        if let Some(bar) = self.runs.bar() {
            bar.set_position(done);
            if self.failed > 0 {
                bar.set_message(format!(", {} failed", self.failed));
            }
        } else if self.runs.is_line_due() {
            self.runs.say(&format!("{}, {} failed", self.runs.words(done), self.failed));
        }
    }

    /// Seconds since the beginning.
    pub fn elapsed_s(&self) -> f64 {
        self.runs.elapsed_s()
    }

    /// Ends the display.
    pub fn end(&self) {
        self.runs.end();
    }
}

//! Progress of a sweep.

use std::collections::BTreeMap;
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
    /// By kernel: the samples that it computed.
    kernels: BTreeMap<String, u64>,
}

impl Progress {
    /// Progress of `samples`, of which `before` are finished.
    pub fn new(samples: u64, before: u64, show: Show) -> Self {
        let runs = Runs::new(samples, "samples", LINE_EVERY, show).from(before);
        Progress { runs, before, computed: 0, failed: 0, kernels: BTreeMap::new() }
    }

    /// Counts a row.
    pub fn see(&mut self, row: &Row) {
        self.computed += 1;
        self.failed += u64::from(!matches!(row.status, Status::Completed | Status::Excluded));
        if !row.kernel.is_empty() {
            *self.kernels.entry(row.kernel.clone()).or_default() += 1;
        }
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

    /// What to say if some samples were computed by another kernel than `asked`.
    pub fn disobeyed(&self, asked: &str) -> Option<String> {
        let others = self.kernels.iter().filter(|(kernel, _)| *kernel != asked);
        let others: Vec<String> = others.map(|(kernel, count)| format!("{count} with {kernel}")).collect();
        let why = "a model that runs alone, or one in place of another on which the program stopped";
        (!others.is_empty()).then(|| format!("note: --kernel {asked}: {} ({why})", others.join(", ")))
    }

    /// Ends the display.
    pub fn end(&self) {
        self.runs.end();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::study_folder::row::tests::row;

    #[test]
    fn another_kernel_than_the_one_asked_for_is_told() {
        let mut progress = Progress::new(3, 0, Show { quiet: true, bar: |_, _| None });
        (0..3).for_each(|index| progress.see(&row(index)));
        assert_eq!(progress.disobeyed("scalar"), None);
        let told = progress.disobeyed("lanes8").unwrap();
        assert!(told.starts_with("note: --kernel lanes8: 3 with scalar"), "{told}");
    }
}

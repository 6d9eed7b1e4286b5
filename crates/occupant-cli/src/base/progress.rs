//! The progress bar of a run, on a terminal only.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use occupant_core::model::Model;
use occupant_core::results::outcome::Outcome;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;

/// A recorder that shows how far the run is.
#[derive(Debug)]
pub(crate) struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// A bar on standard error where that is a terminal, else nothing.
    pub(crate) fn new(quiet: bool) -> Self {
        Progress { bar: bar(None, "{bar:40} {msg}, {elapsed} so far, {eta} to go", quiet) }
    }
}

/// A bar on standard error where that is a terminal, else nothing.
pub(crate) fn bar(length: Option<u64>, template: &str, quiet: bool) -> ProgressBar {
    let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    let bar = ProgressBar::with_draw_target(length, target);
    // the words of the template are ours; should they not parse, the plain bar does
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar
}

impl Recorder for Progress {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        self.bar.set_length(model.output_count() as u64);
        Ok(())
    }

    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        if !self.bar.is_hidden() {
            self.bar.set_position(sample.index as u64 + 1);
            self.bar.set_message(format!("{:.1} ms", sample.time_s * 1e3));
        }
        Ok(Flow::Continue)
    }

    fn end(&mut self, _outcome: &Outcome) -> Result<(), RecorderError> {
        self.bar.finish_and_clear();
        Ok(())
    }
}

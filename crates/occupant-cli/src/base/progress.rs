//! How far a run is, or many runs are: a bar on a terminal; of many runs else a line now and then.

use std::fmt;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use occupant_core::model::Model;
use occupant_core::results::outcome::Outcome;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;

use super::talk::say;

/// A recorder that shows how far the run is.
#[derive(Debug)]
pub(crate) struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// A bar on standard error where that is a terminal, else nothing.
    pub(crate) fn new(quiet: bool) -> Self {
        Progress { bar: bar(None, &counted("outputs"), quiet) }
    }
}

/// A bar of many of `what`: how many, how fast, how long still, and what else is to be said.
pub(crate) fn counted(what: &str) -> String {
    format!("{{bar:30}} {{pos}} of {{len}} {what}, {{rate}}, {{eta}} to go{{msg}}")
}

/// A bar on standard error where that is a terminal, else nothing.
pub(crate) fn bar(length: Option<u64>, template: &str, quiet: bool) -> ProgressBar {
    let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    let bar = ProgressBar::with_draw_target(length, target);
    // the words of the template are ours; should they not parse, the plain bar does
    if let Ok(style) = ProgressStyle::with_template(template) {
        let rate = |state: &ProgressState, to: &mut dyn fmt::Write| {
            let _it_stays_empty = write!(to, "{:.1}/s", state.per_sec());
        };
        bar.set_style(style.with_key("rate", rate));
    }
    bar
}

/// How far many runs are: a bar on a terminal, else a line now and then.
#[derive(Debug)]
pub(crate) struct Runs {
    bar: ProgressBar,
    quiet: bool,
    what: &'static str,
    every: Duration,
    line: Instant,
    began: Instant,
    /// How many were done before this process.
    before: u64,
}

impl Runs {
    /// Of so many of `what`; without a terminal at most a line `every` so often.
    pub(crate) fn new(length: u64, what: &'static str, every: Duration, quiet: bool) -> Self {
        let (bar, now) = (bar(Some(length), &counted(what), quiet), Instant::now());
        Runs { bar, quiet, what, every, line: now, began: now, before: 0 }
    }

    /// So many were there before: they say nothing of the rate.
    pub(crate) fn from(mut self, before: u64) -> Self {
        self.bar.set_position(before);
        self.bar.reset_eta();
        self.before = before;
        self
    }

    /// Seconds since the beginning.
    pub(crate) fn elapsed_s(&self) -> f64 {
        self.began.elapsed().as_secs_f64()
    }

    /// The bar's words as a line: how many, how fast, how long still.
    pub(crate) fn words(&self, done: u64) -> String {
        let all = self.bar.length().unwrap_or(done);
        let computed = done.saturating_sub(self.before);
        if computed == 0 {
            return format!("{done} of {all} {}", self.what);
        }
        let rate = computed as f64 / self.elapsed_s();
        if done > all {
            return format!("{done} {}, {rate:.1}/s", self.what);
        }
        let to_go_s = all.saturating_sub(done) as f64 / rate;
        format!("{done} of {all} {}, {rate:.1}/s, {to_go_s:.0} s to go", self.what)
    }

    /// The bar, where there is one.
    pub(crate) fn bar(&self) -> Option<&ProgressBar> {
        (!self.bar.is_hidden()).then_some(&self.bar)
    }

    /// Whether lines are written, but none for a while.
    pub(crate) fn is_line_due(&self) -> bool {
        !self.quiet && self.line.elapsed() > self.every
    }

    /// Writes a line.
    pub(crate) fn say(&mut self, text: &str) {
        if !self.quiet {
            say(text);
            self.line = Instant::now();
        }
    }

    /// No more.
    pub(crate) fn end(&self) {
        self.bar.finish_and_clear();
    }
}

impl Recorder for Progress {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        self.bar.set_length(model.output_count() as u64);
        Ok(())
    }

    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        if !self.bar.is_hidden() {
            self.bar.set_position(sample.index as u64 + 1);
            self.bar.set_message(format!(", at {:.1} ms", sample.time_s * 1e3));
        }
        Ok(Flow::Continue)
    }

    fn end(&mut self, _outcome: &Outcome) -> Result<(), RecorderError> {
        self.bar.finish_and_clear();
        Ok(())
    }
}

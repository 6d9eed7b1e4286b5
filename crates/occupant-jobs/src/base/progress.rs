//! Progress of many runs: a bar if the caller has one, otherwise a line now and then.

use std::fmt;
use std::time::{Duration, Instant};

use super::say;

/// A bar that shows the progress of a job: on a terminal, in a notebook, on a page.
pub trait Bar: Send + Sync {
    /// Sets the number of all steps.
    fn set_length(&self, all: u64);
    /// Sets the number of finished steps.
    fn set_position(&self, done: u64);
    /// Sets the text beside the bar.
    fn set_message(&self, words: String);
    /// Excludes the work so far from the rate.
    fn forget_rate(&self);
    /// Removes the bar at the end of the job.
    fn clear(&self);
}

/// Progress display of a job.
#[derive(Clone, Copy)]
pub struct Show {
    /// Only warnings and errors.
    pub quiet: bool,
    /// Makes a bar for a number of items, such as `samples`; none where none can be displayed.
    pub bar: fn(u64, &str) -> Option<Box<dyn Bar>>,
}

impl Show {
    /// No display.
    pub const NOTHING: Show = Show { quiet: true, bar: |_, _| None };

    /// A bar of `all` items called `what`, unless the display is off.
    pub fn bar(self, all: u64, what: &str) -> Option<Box<dyn Bar>> {
        if self.quiet { None } else { (self.bar)(all, what) }
    }
}

/// Progress of many runs: a bar, or else occasional lines.
pub struct Runs {
    bar: Option<Box<dyn Bar>>,
    all: u64,
    quiet: bool,
    what: &'static str,
    every: Duration,
    line: Instant,
    began: Instant,
    /// Number of runs done before this process.
    before: u64,
}

impl fmt::Debug for Runs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Runs({} {} in all)", self.all, self.what)
    }
}

impl Runs {
    /// Progress of `all` items called `what`; without a bar at most one line per interval `every`.
    pub fn new(all: u64, what: &'static str, every: Duration, show: Show) -> Self {
        let now = Instant::now();
        Runs { bar: show.bar(all, what), all, quiet: show.quiet, what, every, line: now, began: now, before: 0 }
    }

    /// Sets the number of runs done before; they do not count for the rate.
    pub fn from(mut self, before: u64) -> Self {
        if let Some(bar) = &self.bar {
            bar.set_position(before);
            bar.forget_rate();
        }
        self.before = before;
        self
    }

    /// Seconds since the beginning.
    pub fn elapsed_s(&self) -> f64 {
        self.began.elapsed().as_secs_f64()
    }

    /// Count, rate and remaining time, as text.
    pub fn words(&self, done: u64) -> String {
        let (all, what) = (self.all, self.what);
        let computed = done.saturating_sub(self.before);
        if computed == 0 {
            return format!("{done} of {all} {what}");
        }
        let rate = computed as f64 / self.elapsed_s();
        if done > all {
            return format!("{done} {what}, {rate:.1}/s");
        }
        let to_go_s = (all - done) as f64 / rate;
        format!("{done} of {all} {what}, {rate:.1}/s, {to_go_s:.0} s to go")
    }

    /// The bar, if there is one.
    pub fn bar(&self) -> Option<&dyn Bar> {
        self.bar.as_deref()
    }

    /// Whether the next line is due.
    pub fn is_line_due(&self) -> bool {
        !self.quiet && self.line.elapsed() > self.every
    }

    /// Writes a line.
    pub fn say(&mut self, text: &str) {
        if !self.quiet {
            say(text);
            self.line = Instant::now();
        }
    }

    /// Ends the display.
    pub fn end(&self) {
        if let Some(bar) = &self.bar {
            bar.clear();
        }
    }
}

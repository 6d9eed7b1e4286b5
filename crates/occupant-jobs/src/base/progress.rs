//! How far many runs are: a bar where the caller has one, else a line now and then.

use std::fmt;
use std::time::{Duration, Instant};

use super::say;

/// A bar that shows how far a job is: on a terminal, in a notebook, on a page.
pub trait Bar: Send + Sync {
    /// There are so many in all.
    fn set_length(&self, all: u64);
    /// So many are done.
    fn set_position(&self, done: u64);
    /// What else is to be said beside it.
    fn set_message(&self, words: String);
    /// What was done until now says nothing of the rate.
    fn forget_rate(&self);
    /// The job is done: the bar goes.
    fn clear(&self);
}

/// What a job shows of its way.
#[derive(Clone, Copy)]
pub struct Show {
    /// Nothing but what nobody should overlook.
    pub quiet: bool,
    /// Makes a bar of so many of a thing, such as `samples`; none if nothing can show one.
    pub bar: fn(u64, &str) -> Option<Box<dyn Bar>>,
}

impl Show {
    /// Shows nothing.
    pub const NOTHING: Show = Show { quiet: true, bar: |_, _| None };

    /// A bar of so many of `what`, unless nothing is to be shown.
    pub fn bar(self, all: u64, what: &str) -> Option<Box<dyn Bar>> {
        if self.quiet { None } else { (self.bar)(all, what) }
    }
}

/// How far many runs are: a bar, else a line now and then.
pub struct Runs {
    bar: Option<Box<dyn Bar>>,
    all: u64,
    quiet: bool,
    what: &'static str,
    every: Duration,
    line: Instant,
    began: Instant,
    /// How many were done before this process.
    before: u64,
}

impl fmt::Debug for Runs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Runs({} {} in all)", self.all, self.what)
    }
}

impl Runs {
    /// Of so many of `what`; without a bar at most a line `every` so often.
    pub fn new(all: u64, what: &'static str, every: Duration, show: Show) -> Self {
        let now = Instant::now();
        Runs { bar: show.bar(all, what), all, quiet: show.quiet, what, every, line: now, began: now, before: 0 }
    }

    /// So many were there before: they say nothing of the rate.
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

    /// How many, how fast, how long still.
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

    /// The bar, where there is one.
    pub fn bar(&self) -> Option<&dyn Bar> {
        self.bar.as_deref()
    }

    /// Whether lines are written, but none for a while.
    pub fn is_line_due(&self) -> bool {
        !self.quiet && self.line.elapsed() > self.every
    }

    /// Says a line.
    pub fn say(&mut self, text: &str) {
        if !self.quiet {
            say(text);
            self.line = Instant::now();
        }
    }

    /// No more.
    pub fn end(&self) {
        if let Some(bar) = &self.bar {
            bar.clear();
        }
    }
}

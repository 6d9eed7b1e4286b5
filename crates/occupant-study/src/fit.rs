//! What a study says of a fit, in SI units: which tests, which channels, how far the search may go.

use super::Study;
use super::fit_section::{FilterChoice, FitChannel, FitTest, Misfit};
use super::law::{Law, Value, between, log_between};
use super::parameter::{Assignment, Parameter};
use crash_measures::trig::ln;

/// A fit as a study says it.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// What is made small.
    pub misfit: Misfit,
    /// Filter of channels that have none of their own.
    pub filter: FilterChoice,
    /// The channels that count; empty for all that the tests have.
    pub channels: Vec<FitChannel>,
    /// The tests; empty if the study leaves them to the command line.
    pub tests: Vec<FitTest>,
    /// First and last time that count, s, where a test says nothing else.
    pub window_s: [Option<f64>; 2],
    /// Names the random numbers.
    pub seed: u64,
    /// Evaluations of the global search.
    pub budget: u64,
    /// Candidates of the first generations.
    pub population: usize,
    /// A descent has arrived when scores differ by less.
    pub tolerance: f64,
    /// Scores worse by no more than this are as good.
    pub near: Option<f64>,
}

/// The ends between which a parameter is looked for, SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least value.
    pub from: f64,
    /// Greatest value.
    pub to: f64,
    /// Whether equal ratios are equal steps.
    pub log: bool,
}

impl Bounds {
    /// The ends of a law; none for one that has no ends, or nothing between its values.
    pub fn of(law: &Law) -> Option<Bounds> {
        let bounds = |from, to, log| Some(Bounds { from, to, log });
        match *law {
            Law::Uniform { from, to } => bounds(from, to, false),
            Law::LogUniform { from, to } => bounds(from, to, true),
            Law::Grid { from, to, log, .. } => bounds(from, to, log),
            Law::TruncatedNormal { from, to, .. } | Law::Triangular { from, to, .. } => bounds(from, to, false),
            Law::Normal { .. } | Law::List(_) | Law::Table => None,
        }
    }

    /// The value at a part of the way, 0 to 1.
    pub fn value(&self, u: f64) -> f64 {
        if self.log { log_between(self.from, self.to, u) } else { between(self.from, self.to, u) }
    }

    /// The part of the way at which a value stands; beyond 0 or 1 for one outside.
    pub fn part(&self, value: f64) -> f64 {
        if self.log {
            (ln(value) - ln(self.from)) / (ln(self.to) - ln(self.from))
        } else {
            (value - self.from) / (self.to - self.from)
        }
    }
}

impl Parameter {
    /// Between which ends it is looked for.
    pub fn bounds(&self) -> Option<Bounds> {
        Bounds::of(&self.law)
    }
}

impl Study {
    /// What the values of all parameters, SI units and in their order, put into the base scenario.
    pub fn assignments_of(&self, values: &[f64]) -> Vec<Assignment> {
        let mut list = Vec::new();
        for (parameter, value) in self.parameters.iter().zip(values) {
            parameter.assign(&Value::Number(*value), &mut list);
        }
        list
    }
}

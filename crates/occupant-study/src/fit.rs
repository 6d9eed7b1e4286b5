//! The fit of a study, in SI units: its tests, its channels, its search budget.

use super::Study;
use super::fit_section::{FilterChoice, FitChannel, FitTest, Misfit};
use super::law::Value;
use super::parameter::Assignment;

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

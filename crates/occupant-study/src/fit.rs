//! The fit of a study, in SI units: its tests, its channels, its search budget.

use super::Study;
use super::fit_section::{FilterChoice, FitChannel, FitTest, Misfit};
use super::law::Value;
use super::parameter::Assignment;

/// A fit, as defined by a study.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// Objective to minimise.
    pub misfit: Misfit,
    /// Filter of channels that have none of their own.
    pub filter: FilterChoice,
    /// Channels compared; empty for all that the tests have.
    pub channels: Vec<FitChannel>,
    /// The tests; empty if the study leaves them to the command line.
    pub tests: Vec<FitTest>,
    /// First and last time compared, s, unless a test has its own.
    pub window_s: [Option<f64>; 2],
    /// Seed of the random numbers.
    pub seed: u64,
    /// Evaluations of the global search.
    pub budget: u64,
    /// Candidates of the first generations.
    pub population: usize,
    /// Scores that differ by less count as converged.
    pub tolerance: f64,
    /// Parameter sets whose score is worse by no more than this count as equally good.
    pub near: Option<f64>,
}

impl Study {
    /// Assignments of parameter values (SI units, in the study's order) to the base scenario.
    pub fn assignments_of(&self, values: &[f64]) -> Vec<Assignment> {
        let mut list = Vec::new();
        for (parameter, value) in self.parameters.iter().zip(values) {
            parameter.assign(&Value::Number(*value), &mut list);
        }
        list
    }
}

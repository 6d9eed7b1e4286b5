//! The optimisation of a study: goals, constraints, search budget. Its numbers with units wait until the units of the
//! measures are known.

use placed_text::Value as Written;

use super::Study;
use super::parameter::Assignment;

/// An optimisation, as defined by a study.
#[derive(Clone, Debug, PartialEq)]
pub struct Optimise {
    /// Measures whose weighted sum is minimised.
    pub goals: Vec<Goal>,
    /// Limits on measures.
    pub constraints: Vec<Constraint>,
    /// Names of caveats that do not matter; a final `*` matches any ending.
    pub allow_caveats: Vec<String>,
    /// Quantile of the members of an ensemble, from 0.5 to 1.
    pub quantile: f64,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Candidates in all.
    pub budget: u64,
    /// Points of the front between several goals; 0 for none.
    pub front: u64,
    /// Candidates of the first generations.
    pub population: usize,
    /// Goals that differ by less count as converged.
    pub tolerance: f64,
}

/// A measure to be made as small or as large as possible.
#[derive(Clone, Debug, PartialEq)]
pub struct Goal {
    /// Its name.
    pub measure: String,
    /// Whether it is maximised.
    pub is_maximised: bool,
    /// Weight.
    pub weight: f64,
    /// Its divisor as written; the value in the base scenario if none.
    pub per: Option<Written>,
    /// Place of the name in the study.
    pub at: String,
    /// Place of `per` in the study.
    pub at_per: String,
}

/// A limit on a measure.
#[derive(Clone, Debug, PartialEq)]
pub struct Constraint {
    /// Its name.
    pub measure: String,
    /// Whether the limit is the least value allowed, instead of the largest.
    pub is_floor: bool,
    /// The limit as written.
    pub limit: Written,
    /// Place of the constraint in the study.
    pub at: String,
}

impl Constraint {
    /// The key of its limit.
    pub fn key(&self) -> &'static str {
        if self.is_floor { "at_least" } else { "at_most" }
    }
}

impl Study {
    /// Assignments of parameter values (SI units, in the study's order) to a member of its ensemble; member 0 is the
    /// sample itself.
    pub fn assignments_of_member(&self, values: &[f64], member: u64) -> Vec<Assignment> {
        let mut list = self.assignments_of(values);
        if let Some(ensemble) = &self.ensemble {
            ensemble.perturb(member, self.seed, &mut list);
        }
        list
    }
}

//! A table of samples: what each one was given, and what came of it. All analyses are made from it alone.

use occupant_study::{Role, Study};

use crate::base::{Told, Units};

/// A table of samples, in the order of their numbers.
#[derive(Clone, Debug, Default)]
pub struct Samples {
    /// Numbers of the samples, increasing; those that are not finished are not there.
    pub numbers: Vec<u64>,
    /// What each is in its design.
    pub roles: Vec<Role>,
    /// What was varied.
    pub inputs: Vec<Input>,
    /// What came of it.
    pub responses: Vec<Response>,
}

/// A parameter's column.
#[derive(Clone, Debug, Default)]
pub struct Input {
    /// Its name.
    pub name: String,
    /// Its SI unit is empty for plain numbers and words.
    pub unit: Told,
    /// Its values, NaN where a sample has none; of words, their places in `words`.
    pub values: Vec<f64>,
    /// The words of a parameter that has words for values; none for one with numbers.
    pub words: Option<Vec<String>>,
    /// Whether equal ratios of its values are as likely, so that it is drawn over powers of ten.
    pub by_ratios: bool,
    /// Whether each of its values was run with every sample of the other parameters.
    pub crossed: bool,
}

/// A figure's column.
#[derive(Clone, Debug, Default)]
pub struct Response {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: Told,
    /// Its values, NaN where a run failed or has none.
    pub values: Vec<f64>,
    /// With an ensemble: samples whose members agree, and samples whose members do not.
    pub stable: [u64; 2],
}

impl Samples {
    /// A table without rows, for a study and responses by name and unit; they are told in the units of the base scenario.
    pub fn new(study: &Study, responses: &[(String, String)]) -> Self {
        Samples::told_in(Units::of_scenario(study.base.units()), study, responses)
    }

    /// The same, told in these units.
    pub fn told_in(units: Units, study: &Study, responses: &[(String, String)]) -> Self {
        let input = |parameter: &occupant_study::Parameter| Input {
            name: parameter.name.clone(),
            unit: units.told_of(parameter, &study.base),
            by_ratios: parameter.law.goes_by_ratios(),
            crossed: parameter.crossed,
            ..Input::default()
        };
        let response = |(name, unit): &(String, String)| Response {
            name: name.clone(),
            unit: units.told(unit),
            ..Response::default()
        };
        Samples {
            inputs: study.parameters.iter().map(input).collect(),
            responses: responses.iter().map(response).collect(),
            ..Samples::default()
        }
    }

    /// How many samples there are.
    pub fn len(&self) -> usize {
        self.numbers.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.numbers.is_empty()
    }

    /// The row of a sample, if it is there.
    pub fn row_of(&self, number: u64) -> Option<usize> {
        self.numbers.binary_search(&number).ok()
    }

    /// Adds the row of a sample; `run` is the number of its first run.
    pub fn add(&mut self, study: &Study, run: u64) {
        self.numbers.push(study.sample_and_member(run).0);
        self.roles.push(study.role(run));
    }
}

impl Input {
    /// Whether its values are numbers.
    pub fn is_number(&self) -> bool {
        self.words.is_none()
    }

    /// Whether it takes more than one value.
    pub fn varies(&self) -> bool {
        varies(&self.values)
    }
}

/// Whether finite numbers differ by more than rounding.
pub fn varies(values: &[f64]) -> bool {
    let finite = || values.iter().copied().filter(|x| x.is_finite());
    let (low, high) = (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
    high - low > 1e-12 * low.abs().max(high.abs())
}

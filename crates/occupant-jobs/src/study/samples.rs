//! A table of samples: what each one was given, and what came of it. All analyses are made from it alone.

use occupant_study::{Role, Study};

use crate::base::{Told, Units};

/// A table of samples, ordered by index.
#[derive(Clone, Debug, Default)]
pub struct Samples {
    /// Indices of the finished samples, increasing.
    pub numbers: Vec<u64>,
    /// Role of each in its design.
    pub roles: Vec<Role>,
    /// Parameters.
    pub inputs: Vec<Input>,
    /// Responses.
    pub responses: Vec<Response>,
    /// Of a study too large for a table of all: one of so many samples is in it; 0 if all are.
    pub one_in: u64,
}

/// A parameter's column.
#[derive(Clone, Debug, Default)]
pub struct Input {
    /// Its name.
    pub name: String,
    /// Its units; the SI unit is empty for plain numbers and words.
    pub unit: Told,
    /// Its values, NaN where missing; for words, indices in `words`.
    pub values: Vec<f64>,
    /// Words of a parameter with text values; none for a numeric one.
    pub words: Option<Vec<String>>,
    /// Whether its law is logarithmic, so that it is drawn on a logarithmic axis.
    pub by_ratios: bool,
    /// Whether each of its values was run with every sample of the other parameters.
    pub crossed: bool,
    /// Least and greatest value of all samples, if not all are in the table.
    pub beyond: Option<[f64; 2]>,
}

/// A figure's column.
#[derive(Clone, Debug, Default)]
pub struct Response {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: Told,
    /// Its values, NaN where a run failed or lacks it.
    pub values: Vec<f64>,
    /// With an ensemble: number of samples whose members agree, and whose members do not.
    pub stable: [u64; 2],
}

impl Samples {
    /// An empty table for a study and responses by name and unit, displayed in the units of the base scenario.
    pub fn new(study: &Study, responses: &[(String, String)]) -> Self {
        Samples::told_in(Units::of_scenario(study.base.units()), study, responses)
    }

    /// An empty table with these display units.
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

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.numbers.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.numbers.is_empty()
    }

    /// The row of a sample, if it exists.
    pub fn row_of(&self, number: u64) -> Option<usize> {
        self.numbers.binary_search(&number).ok()
    }

    /// Adds the row of a sample; `run` is the index of its first run.
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

    /// Whether it has more than one value.
    pub fn varies(&self) -> bool {
        self.beyond.map_or_else(|| varies(&self.values), |ends| varies(&ends))
    }
}

/// Whether finite numbers differ by more than rounding.
pub fn varies(values: &[f64]) -> bool {
    let finite = || values.iter().copied().filter(|x| x.is_finite());
    let (low, high) = (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
    high - low > 1e-12 * low.abs().max(high.abs())
}

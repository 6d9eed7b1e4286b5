//! Studies: many runs of one scenario, in which some of its values are varied; [`risk`] of a vehicle's path without a run.
//!
//! ```text
//! text ─ StudyText ─ bind(base scenario) ─ Study ─ sample i ─ Draft i
//! ```
//!
//! Every sample is computed from its index alone: the same for any number of threads, on any machine, in any order, in
//! time and memory that grow with the number of parameters only.
//!
//! ```
//! use occupant_scenario::{Draft, Format};
//! use occupant_study::{StudyText, Value};
//!
//! let base = r#"
//!     title = "Free fall"
//!     time = { end = 0.5 }
//!     path = { kind = "fixed" }
//!     body = { preset = "male50" }
//!     joints = { preset = "male50" }
//!
//!     [initial_state]
//!     q     = [0, 0, 2,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0]
//!     rates = [0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0]
//! "#;
//! let study = r#"
//!     base = "free-fall.toml"
//!     design.kind = "full_factorial"
//!
//!     [[parameters]]
//!     path = "joints.neck.damping"
//!     grid = { from = "10 in lbf s/rad", to = "40 in lbf s/rad", steps = 3, scale = "log" }
//!
//!     [[parameters]]
//!     name = "joint stiffness"
//!     path = "joints.*.stiffness"
//!     apply = "factor"
//!     list = [0.5, 1, 2]
//! "#;
//! let text = StudyText::read(study, Format::Toml, "study.toml")?;
//! let base = Draft::read(base, Format::Toml, text.base())?;
//! let study = text.bind(base, &[], &|file| Err(format!("no file {file}")))?;
//!
//! assert_eq!(study.len(), 9);
//! let sample = study.sample(5); // the last parameter changes fastest
//! assert_eq!(sample[1].value, Value::Number(2.0));
//! let scenario = study.draft(5)?; // the base with the values of sample 5
//! # Ok::<(), occupant_scenario::Diagnostics>(())
//! ```

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod analysis;
mod bind;
pub mod certainty;
mod copula;
mod corners;
mod design;
mod direction_numbers;
pub mod engine;
mod ensemble;
mod fit;
mod fit_section;
mod inputs;
mod keep;
mod law;
pub mod misfit;
mod morris;
mod normal;
mod optimise;
mod optimise_section;
mod parameter;
mod permutation;
mod random;
mod relation;
pub mod risk;
mod rows;
mod saltelli;
pub mod search;
mod section;
mod segments;
#[cfg(feature = "sensitivity")]
pub mod sensitivity;
pub mod sketch;
mod sobol;
pub mod spread;
mod text;

pub use bind::{MOST_RUNS, is_allowed};
pub use corners::Corner;
pub use design::{Design, Role};
pub use ensemble::{Change, Ensemble, Perturbation, Tolerances, without_place};
pub use fit::Fit;
pub use fit_section::{FilterChoice, FitChannel, FitSection, FitTest, GainRange, Misfit, OffsetRange};
pub use inputs::InputWord;
pub use keep::Keep;
pub use law::{Bounds, Distribution, Law, Value};
pub use normal::quantile as normal_quantile;
pub use optimise::{Constraint, Goal, Optimise};
pub use optimise_section::{ConstraintSection, GoalSection, OptimiseSection};
pub use parameter::{Assignment, Parameter, Target};
pub use random::{of_resample, of_stretch};
pub use relation::{Relation, Within};
pub use rows::Rows;
pub use saltelli::Block;
pub use section::{ApplyChoice, LinearConstraintSection, RatingSection, StudySection, schema_json};
pub use text::StudyText;

use self::copula::Copula;
use self::design::Coordinate;
use self::sobol::Sobol;
use occupant_scenario::{Diagnostics, Draft};

#[cfg(test)]
mod tests;

/// A study checked against its base scenario.
#[derive(Clone, Debug)]
pub struct Study {
    /// The base scenario, with the values common to all runs.
    pub base: Draft,
    /// Name of the base scenario in the study.
    pub base_name: String,
    /// Values set in the base scenario by the study and the command line, in order: paths, and texts as read by
    /// [`Draft::set_value`].
    pub changes: Vec<(String, String)>,
    /// Seed of the random numbers.
    pub seed: u64,
    /// The varied parameters.
    pub parameters: Vec<Parameter>,
    /// The choice of samples.
    pub design: Design,
    sobol: Sobol,
    copula: Option<Copula>,
    /// Constraints between the parameters.
    pub relations: Vec<Relation>,
    /// The small changes of every sample, if any.
    pub ensemble: Option<Ensemble>,
    /// Runs whose full result file is kept.
    pub keep: Keep,
    /// Whether the table of results is also written as CSV.
    pub csv: bool,
    /// Patterns of the measures kept in the table; all if there are none.
    pub measures: Vec<String>,
    /// Warnings of a study that can be run.
    pub warnings: Diagnostics,
}

/// The value of one parameter in one sample.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// Index of the parameter in [`Study::parameters`].
    pub parameter: usize,
    /// Its value, SI units and radians; the base scenario's if the sample leaves it unchanged.
    pub value: Value,
    /// Whether the sample sets it.
    pub given: bool,
}

impl Study {
    /// An ensemble of one scenario: a study of one sample without parameters. Perturbations that do not apply to the
    /// scenario are left out.
    pub fn of_ensemble(
        base: Draft,
        name: impl Into<String>,
        members: u64,
        seed: u64,
        tolerances: &Tolerances,
    ) -> Study {
        let perturbations = ensemble::standard(&base, &[], tolerances);
        Study {
            base,
            base_name: name.into(),
            changes: Vec::new(),
            seed,
            parameters: Vec::new(),
            design: Design::Single,
            sobol: Sobol::new(0),
            copula: None,
            relations: Vec::new(),
            ensemble: Some(Ensemble { members: members.max(1), perturbations }),
            keep: Keep::None,
            csv: false,
            measures: Vec::new(),
            warnings: Diagnostics::new(),
        }
    }

    /// Adds uncertain inputs to an ensemble, each drawn by every member from its ready distribution; the parameters that they
    /// stand for.
    ///
    /// # Errors
    /// An input that the scenario does not have.
    pub fn vary(&mut self, words: &[InputWord]) -> Result<Vec<Parameter>, String> {
        let mut all = Vec::new();
        for word in words {
            let found = word.parameters(&self.base);
            all.extend(
                found.map_err(|needs| format!("the scenario has no input `{}`: it needs {needs}", word.word()))?,
            );
        }
        if let Some(ensemble) = &mut self.ensemble {
            ensemble.perturbations.extend(ensemble::of_parameters(all.clone()));
        }
        Ok(all)
    }

    /// Number of runs: samples of the design times members of the ensemble.
    pub fn len(&self) -> u64 {
        self.samples().saturating_mul(self.members())
    }

    /// Whether there are no runs.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of samples of the design.
    pub fn samples(&self) -> u64 {
        // bind has refused a design that cannot be counted
        self.design.len(&self.levels()).unwrap_or(0).saturating_mul(self.crossing())
    }

    /// Number of combinations of crossed values for each point of the design.
    pub fn crossing(&self) -> u64 {
        crossing(&self.parameters).unwrap_or(u64::MAX)
    }

    /// Number of consecutive samples that belong together: the rows of a point of Saltelli's blocks, a Morris trajectory, the
    /// combinations of crossed values of a point; else 1.
    pub fn unit(&self) -> u64 {
        self.crossing().saturating_mul(self.design.unit(self.parameters.len() as u64))
    }

    /// Runs per sample: members of the ensemble, or 1.
    pub fn members(&self) -> u64 {
        self.ensemble.as_ref().map_or(1, |e| e.members.max(1))
    }

    /// Sample and member of a run: run = sample · members + member. Member 0 is the sample itself.
    pub fn sample_and_member(&self, index: u64) -> (u64, u64) {
        (index / self.members(), index % self.members())
    }

    /// Values of all parameters in a run, in the order of [`Study::parameters`]. Members of one sample share them.
    pub fn sample(&self, index: u64) -> Vec<Setting> {
        let (sample, _) = self.sample_and_member(index);
        let crossing = self.crossing();
        let mut coordinates = self.design.coordinates(sample / crossing, self);
        if let Some(copula) = &self.copula {
            correlate(copula, &mut coordinates);
        }
        if crossing > 1 {
            let crossed: Vec<bool> = self.parameters.iter().map(|parameter| parameter.crossed).collect();
            design::cross(sample % crossing, &self.levels(), &crossed, &mut coordinates);
        }
        let settings = self.parameters.iter().zip(coordinates).enumerate();
        settings
            .map(|(parameter, (of, coordinate))| Setting {
                parameter,
                given: coordinate != Coordinate::Nominal,
                value: value_at(of, coordinate),
            })
            .collect()
    }

    /// Why a run is left out: the constraint that its sample breaks; none if it is to be run.
    pub fn excluded(&self, index: u64) -> Option<String> {
        let values = || self.sample(index).into_iter().map(|setting| setting.value);
        if self.relations.is_empty() { None } else { self.broken(values()) }
    }

    /// Assignments of a run to the base scenario, including the perturbations of its member, each path once.
    pub fn assignments(&self, index: u64) -> Vec<Assignment> {
        let mut list = Vec::new();
        for setting in self.sample(index).into_iter().filter(|s| s.given) {
            self.parameters[setting.parameter].assign(&setting.value, &mut list);
        }
        if let Some(ensemble) = &self.ensemble {
            let (_, member) = self.sample_and_member(index);
            ensemble.perturb(member, self.seed, &mut list);
        }
        list
    }

    /// Applies the assignments of a run to a copy of the base scenario.
    ///
    /// # Errors
    /// A path that does not exist in this draft; never in a clone of [`Study::base`].
    pub fn apply(&self, index: u64, draft: &mut Draft) -> Result<(), Diagnostics> {
        parameter::put(&self.assignments(index), draft)
    }

    /// The scenario of a run.
    ///
    /// # Errors
    /// None for a study that has been bound to its base.
    pub fn draft(&self, index: u64) -> Result<Draft, Diagnostics> {
        let mut draft = self.base.clone();
        self.apply(index, &mut draft)?;
        Ok(draft)
    }

    /// Role of a run's sample in its design.
    pub fn role(&self, index: u64) -> Role {
        let (sample, _) = self.sample_and_member(index);
        self.design.role(sample / self.crossing(), &self.levels(), self.seed)
    }

    /// The constraint that these values of all parameters break.
    fn broken(&self, values: impl Iterator<Item = Value>) -> Option<String> {
        let number = |(value, parameter): (Value, &Parameter)| match (value, parameter.nominal()) {
            (Value::Number(x), _) | (Value::Base, Value::Number(x)) => x,
            // the check has refused constraints on words
            _ => f64::NAN,
        };
        let numbers: Vec<f64> = values.zip(&self.parameters).map(number).collect();
        self.relations.iter().find_map(|relation| relation.broken(&numbers))
    }

    fn levels(&self) -> Vec<Option<u64>> {
        self.parameters.iter().map(|p| p.law.levels()).collect()
    }
}

/// Number of combinations of the values of all crossed parameters; none if it cannot be counted.
fn crossing(parameters: &[Parameter]) -> Option<u64> {
    let crossed = parameters.iter().filter(|parameter| parameter.crossed);
    crossed.map(|parameter| parameter.law.levels().unwrap_or(1)).try_fold(1_u64, u64::checked_mul)
}

fn value_at(parameter: &Parameter, coordinate: Coordinate) -> Value {
    match coordinate {
        Coordinate::Nominal => parameter.nominal(),
        Coordinate::Level(i) => parameter.law.level(i),
        Coordinate::Quantile(p) => parameter.law.quantile(p),
        Coordinate::Bounded(p, tail) => parameter.law.bounded_quantile(p, tail),
        Coordinate::Given(value) => value,
    }
}

/// Correlates the coordinates of a sample, all of which are probabilities.
fn correlate(copula: &Copula, coordinates: &mut [Coordinate]) {
    let mut u: Vec<f64> = coordinates
        .iter()
        .map(|c| match c {
            Coordinate::Quantile(p) => *p,
            _ => 0.5,
        })
        .collect();
    copula.correlate(&mut u);
    for (coordinate, u) in coordinates.iter_mut().zip(u) {
        *coordinate = Coordinate::Quantile(u);
    }
}

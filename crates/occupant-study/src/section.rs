//! A study as it is written: one field for each key of the text.
//!
//! The doc comments are the descriptions of the JSON Schema, so they address the author of a study.

use std::sync::OnceLock;

use crash_measures::rating::RATINGS;
use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value as Json;

use super::design::Design;
use super::fit_section::FitSection;
use super::inputs::InputWord;
use super::keep::KeepSection;
use super::law::Distribution;
use super::optimise_section::OptimiseSection;
use occupant_scenario::kind::UnitSystem;
use occupant_scenario::schema_of;
use occupant_scenario::{Angle, FRACTION, Length, NOT_NEGATIVE, Ratio};
use placed_text::Value;

/// The JSON Schema of a study file.
pub fn schema_json() -> &'static Json {
    static SCHEMA: OnceLock<Json> = OnceLock::new();
    SCHEMA.get_or_init(|| schema_of::<StudySection>("occupant study"))
}

/// Many runs of one scenario, in which some of its values are varied.
///
/// A bare number is in SI units with angles in degrees, or in the units named by `units`; a text carries its own unit,
/// such as "20 in lbf s/rad".
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StudySection {
    /// Title, one line.
    pub title: Option<String>,
    /// Notes for readers.
    pub notes: Option<String>,
    /// Units of bare numbers in this file; "si" if absent.
    pub units: Option<UnitSystem>,
    /// The scenario file to vary, relative to this file.
    pub base: String,
    /// Seed of the random numbers; the same seed gives the same samples on every machine; 0 if absent.
    #[schemars(extend("minimum" = 0))]
    pub seed: Option<u64>,
    /// Values set in all runs of this study, by path: `"time.end" = "0.25 s"`.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub set: IndexMap<String, Value>,
    /// Parameters to vary.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parameters: Vec<ParameterSection>,
    /// Rank correlations between parameters, zero where none is given.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub correlations: Vec<CorrelationSection>,
    /// Constraints between parameters: samples that break one are not run.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub constraints: Vec<LinearConstraintSection>,
    /// Design: the choice of samples.
    pub design: Option<Design>,
    /// Repeats every sample with small changes, to see which results are stable.
    pub ensemble: Option<EnsembleSection>,
    /// Target of `occupant fit`; a sweep ignores it.
    pub fit: Option<FitSection>,
    /// Target of `occupant optimise`; a sweep ignores it.
    pub optimise: Option<OptimiseSection>,
    /// Runs whose full result file is kept: "all", "none", a list of indices, or for example "worst 5 by hic15"; "none" if
    /// absent.
    pub keep: Option<KeepSection>,
    /// Files written besides the table of results.
    pub output: Option<StudyOutputSection>,
    /// Rates the bodies of a sweep's runs as a crash test is rated, when all are finished; needs `keep = "all"`.
    pub rating: Option<RatingSection>,
}

/// A parameter: one or several values of the scenario that are varied together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend(
    "x-exactly-one" = [["path", "paths", "segments", "input"]],
    "x-at-most-one" = [
        ["grid", "list", "range", "distribution", "usual", "segments", "input"], ["name", "segments", "input"],
        ["apply", "segments", "input"],
    ],
))]
pub struct ParameterSection {
    /// Name of its column in the table of results; its path if absent.
    pub name: Option<String>,
    /// Path of the value in the scenario, such as `joints.neck.damping` or, for a group, `joints.*.damping`.
    pub path: Option<String>,
    /// Paths of several values that are varied together.
    #[schemars(extend("minItems" = 1))]
    pub paths: Option<Vec<String>>,
    /// Adds one parameter per segment of the body, left and right together, such as `segments.thigh`: a factor on its mass
    /// and moments of inertia, uniform between 1 minus and 1 plus this. Anthropometric tables differ by about 15 %.
    pub segments: Option<Ratio<FRACTION>>,
    /// An uncertain input of a reconstruction by one word, with a ready distribution; it adds a parameter for each independent
    /// value, such as each seat.
    pub input: Option<InputWord>,
    /// How the number changes the scenario's value; "value" if absent.
    pub apply: Option<ApplyChoice>,
    /// Evenly spaced values.
    pub grid: Option<GridSection>,
    /// A list of values: numbers, or text such as names of materials or files.
    #[schemars(extend("minItems" = 1))]
    pub list: Option<Vec<Value>>,
    /// True: every value of its list or grid is run with every sample of the other parameters, such as each pulse with each
    /// seat. The number of runs is that of the design times the number of these values.
    pub crossed: Option<bool>,
    /// Uniform between two values.
    pub range: Option<RangeSection>,
    /// A probability distribution.
    pub distribution: Option<Distribution<Value>>,
    /// True: the built-in distribution for this path, about the value of the base scenario or its class. There is one for `track`, `recline`,
    /// `slack`, `lap_above`, `d_ring.behind` and `d_ring.above` of `car.seats.*`, `car.wheel.ahead` and `above`, `body.stature` and
    /// `body.mass`.
    pub usual: Option<bool>,
}

/// How the number of a parameter changes the scenario's value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ApplyChoice {
    /// It replaces the scenario's value.
    #[default]
    Value,
    /// It multiplies the scenario's value.
    Factor,
    /// It is added to the scenario's value.
    Offset,
}

/// Evenly spaced values, both ends included.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GridSection {
    /// First value.
    pub from: Value,
    /// Last value.
    pub to: Value,
    /// Number of values.
    #[schemars(extend("minimum" = 2))]
    pub steps: u64,
    /// "linear" has equal differences, "log" equal ratios; "linear" if absent.
    pub scale: Option<ScaleChoice>,
}

/// Uniform between two values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RangeSection {
    /// Least value.
    pub from: Value,
    /// Largest value.
    pub to: Value,
    /// "linear": uniform; "log": log-uniform; "linear" if absent.
    pub scale: Option<ScaleChoice>,
}

/// Spacing of values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ScaleChoice {
    /// Equal differences.
    #[default]
    Linear,
    /// Equal ratios.
    Log,
}

/// A correlation between two parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CorrelationSection {
    /// Names of the two parameters.
    pub between: [String; 2],
    /// Spearman's rank correlation, from −1 to 1.
    pub rank: f64,
}

/// A constraint between parameters: the sum of their values, each times its factor, stays from `min` to `max`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LinearConstraintSection {
    /// Its name in messages and in the table of results; its place in this file if absent.
    pub name: Option<String>,
    /// Names of parameters with their factors, such as `{ "lap limit" = 1, "torso limit" = -1 }`; all of one quantity. Values are
    /// those of the columns of the table: of `apply = "factor"` the factor.
    pub sum: IndexMap<String, f64>,
    /// Least sum; a text carries its unit, such as "500 N".
    pub min: Option<Value>,
    /// Largest sum.
    pub max: Option<Value>,
}

/// Small random changes of every sample, each uniform within ± its tolerance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EnsembleSection {
    /// Number of runs per sample; the first is the sample itself, unchanged.
    #[schemars(extend("minimum" = 2))]
    pub members: u64,
    /// Tolerance of each angle of the posture, or of the angles of the initial state.
    pub posture: Option<Angle<NOT_NEGATIVE>>,
    /// Tolerance of the occupant's position: heels and lateral seat position, or position in the initial state.
    pub place: Option<Length<NOT_NEGATIVE>>,
    /// Tolerance of the strength of the pulse, such as "1 %".
    pub path: Option<Ratio<FRACTION>>,
    /// Tolerance of the stiffness of each material and each belt, such as "2 %".
    pub stiffness: Option<Ratio<FRACTION>>,
    /// Tolerance of mass and inertia of each segment of the body, left and right together, such as "15 %", by which
    /// anthropometric tables differ.
    pub segments: Option<Ratio<FRACTION>>,
    /// Uncertain inputs of a reconstruction, by their words in `[[parameters]] input`: each member draws its own from their
    /// ready distributions. Without other keys nothing else is changed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub inputs: Vec<InputWord>,
    /// Further changes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub perturbations: Vec<PerturbationSection>,
}

/// A small random change of one value, or of several together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend(
    "x-exactly-one" = [["path", "paths"], ["offset", "factor"]],
))]
pub struct PerturbationSection {
    /// Path of the value.
    pub path: Option<String>,
    /// Paths of several values that change together.
    #[schemars(extend("minItems" = 1))]
    pub paths: Option<Vec<String>>,
    /// Varied by up to ± this value.
    pub offset: Option<Value>,
    /// Varied by up to ± this fraction, such as "2 %".
    pub factor: Option<Ratio<FRACTION>>,
}

/// Files written besides the table of results.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StudyOutputSection {
    /// Whether the table is also written as CSV; false if absent.
    pub csv: Option<bool>,
    /// Measures that the table keeps, by their columns' names, with `*` for any part: `["hic15", "chest*"]`. All if absent.
    #[schemars(extend("minItems" = 1))]
    pub measures: Option<Vec<String>>,
}

/// A rating of the bodies of a sweep's runs, as `occupant measures --rating` makes it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RatingSection {
    /// Name of the rating.
    #[schemars(extend("enum" = names_of_ratings()))]
    pub name: String,
    /// Occupants of the rating, each by a part of case, seat and dummy, such as "sled-mid driver". One for each occupant
    /// of each run, in the order of the runs: all are rated together. One alone: each body is rated as this one. If
    /// absent, each is rated as those with its dummy.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub places: Vec<String>,
    /// A table of values (CSV, XLSX) in the layout of the rating's template, relative to this file. They count before
    /// measures.
    pub values: Option<String>,
}

fn names_of_ratings() -> Vec<&'static str> {
    RATINGS.iter().map(|rating| rating.name).collect()
}

//! A study as it is written: one field for each key of the text.
//!
//! The doc comments are the descriptions of the JSON Schema, so they address the author of a study.

use std::sync::OnceLock;

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value as Json;

use super::design::Design;
use super::fit_section::FitSection;
use super::keep::KeepSection;
use super::law::Distribution;
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
    /// One line that names the study.
    pub title: Option<String>,
    /// What the study is about, for readers.
    pub notes: Option<String>,
    /// Units of bare numbers in this file; "si" if absent.
    pub units: Option<UnitSystem>,
    /// The scenario file that is varied, its name relative to this file.
    pub base: String,
    /// Names the random numbers of the study; the same seed gives the same samples everywhere; 0 if absent.
    #[schemars(extend("minimum" = 0))]
    pub seed: Option<u64>,
    /// Values that the base scenario has in all runs of this study, by path: `"time.end" = "0.25 s"`.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub set: IndexMap<String, Value>,
    /// What is varied.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parameters: Vec<ParameterSection>,
    /// Rank correlations between parameters, zero where none is given.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub correlations: Vec<CorrelationSection>,
    /// How the samples are chosen.
    pub design: Option<Design>,
    /// Repeats every sample with small changes, to see which figures are stable.
    pub ensemble: Option<EnsembleSection>,
    /// What `occupant fit` makes the parameters reproduce; a sweep does not look at it.
    pub fit: Option<FitSection>,
    /// Of which runs the whole motion is kept: "all", "none", a list of indices, or such as "worst 5 by hic15"; "none"
    /// if absent.
    pub keep: Option<KeepSection>,
    /// What is written besides the table of results.
    pub output: Option<StudyOutputSection>,
}

/// Something that is varied.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend(
    "x-exactly-one" = [["path", "paths", "segments"]],
    "x-at-most-one" = [
        ["grid", "list", "range", "distribution", "usual", "segments"], ["name", "segments"], ["apply", "segments"],
    ],
))]
pub struct ParameterSection {
    /// Name of its column in the table of results; its path if absent.
    pub name: Option<String>,
    /// Where it stands in the scenario, such as `joints.neck.damping` or, for a group, `joints.*.damping`.
    pub path: Option<String>,
    /// Several places that are varied together.
    #[schemars(extend("minItems" = 1))]
    pub paths: Option<Vec<String>>,
    /// Stands for one parameter a segment of the body, left and right together, such as `segments.thigh`: a factor on
    /// its mass and moments of inertia, evenly between 1 minus and 1 plus this. By "15 %" tables of people differ.
    pub segments: Option<Ratio<FRACTION>>,
    /// What is done with the number; "value" if absent.
    pub apply: Option<ApplyChoice>,
    /// Evenly spaced values.
    pub grid: Option<GridSection>,
    /// These values: numbers, or texts such as names of materials or of files.
    #[schemars(extend("minItems" = 1))]
    pub list: Option<Vec<Value>>,
    /// True: every value of its list or grid is run with every sample of the other parameters, such as each pulse with each
    /// seat. The number of runs is that of the design times the number of these values.
    pub crossed: Option<bool>,
    /// Any value between two.
    pub range: Option<RangeSection>,
    /// Values as likely as a distribution says.
    pub distribution: Option<Distribution<Value>>,
    /// True: as a car's seats, belts and wheel and a person's stature and mass are usually spread, about what the base scenario or its class
    /// says. Of `track`, `recline`, `slack`, `lap_above`, `d_ring.behind` and `d_ring.above` of `car.seats.*`, `car.wheel.ahead` and `above`,
    /// `body.stature` and `body.mass`.
    pub usual: Option<bool>,
}

/// What is done with the number of a parameter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ApplyChoice {
    /// It replaces what the scenario says.
    #[default]
    Value,
    /// What the scenario says is multiplied by it.
    Factor,
    /// It is added to what the scenario says.
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
    /// How many values.
    #[schemars(extend("minimum" = 2))]
    pub steps: u64,
    /// "linear" has equal differences, "log" equal ratios; "linear" if absent.
    pub scale: Option<ScaleChoice>,
}

/// Any value between two, each equally likely.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RangeSection {
    /// Least value.
    pub from: Value,
    /// Largest value.
    pub to: Value,
    /// With "log" equal ratios are equally likely; "linear" if absent.
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

/// Small changes of every sample. A change is anywhere within plus and minus its tolerance, each place as likely.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EnsembleSection {
    /// How many runs for each sample; the first is the sample itself, unchanged.
    #[schemars(extend("minimum" = 2))]
    pub members: u64,
    /// Tolerance of each angle of the posture, or of the angles of the initial state.
    pub posture: Option<Angle<NOT_NEGATIVE>>,
    /// Tolerance of the place of the occupant: heels and lateral seat place, or position in the initial state.
    pub place: Option<Length<NOT_NEGATIVE>>,
    /// Tolerance of the strength of the pulse, such as "1 %".
    pub path: Option<Ratio<FRACTION>>,
    /// Tolerance of the stiffness of each material and each belt, such as "2 %".
    pub stiffness: Option<Ratio<FRACTION>>,
    /// Tolerance of mass and inertia of each segment of the body, left and right together, such as "15 %", by which
    /// tables of people differ.
    pub segments: Option<Ratio<FRACTION>>,
    /// Further changes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub perturbations: Vec<PerturbationSection>,
}

/// A small change of one place, or of several together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend(
    "x-exactly-one" = [["path", "paths"], ["offset", "factor"]],
))]
pub struct PerturbationSection {
    /// Where.
    pub path: Option<String>,
    /// Several places that change together.
    #[schemars(extend("minItems" = 1))]
    pub paths: Option<Vec<String>>,
    /// Up to this much is added or taken away.
    pub offset: Option<Value>,
    /// Up to this part is added or taken away, such as "2 %".
    pub factor: Option<Ratio<FRACTION>>,
}

/// What is written besides the table of results.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StudyOutputSection {
    /// Whether the table is also written as CSV; false if absent.
    pub csv: Option<bool>,
}

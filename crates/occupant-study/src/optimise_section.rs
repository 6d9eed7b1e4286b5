//! The `[optimise]` of a study as it is written.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use placed_text::Value;

/// Target of `occupant optimise`: a measure or a weighted sum of measures, and what must hold at the optimum.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["minimise", "maximise", "goals"]]))]
pub struct OptimiseSection {
    /// The measure to make as small as possible, such as "hic15": a column of the table of a sweep.
    pub minimise: Option<String>,
    /// The measure to make as large as possible.
    pub maximise: Option<String>,
    /// Several measures: the weighted sum of all, each divided by its `per`, is made as small as possible.
    #[schemars(extend("minItems" = 1))]
    pub goals: Option<Vec<GoalSection>>,
    /// Limits that the optimum keeps.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub constraints: Vec<ConstraintSection>,
    /// Caveats that do not matter, by name; a final `*` matches any ending, "*" all. A candidate with any other caveat on
    /// one of the measures above does not win.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub allow_caveats: Vec<String>,
    /// With an `ensemble` in the study: the quantile of its members that counts for each measure, to the bad side; 0.95
    /// if absent.
    #[schemars(extend("minimum" = 0.5, "maximum" = 1))]
    pub quantile: Option<f64>,
    /// With several goals: the number of points of the front between them to look for, with half of the budget. A point of the
    /// front is a candidate than which no other is better in one goal and as good in all others. None if absent.
    #[schemars(extend("minimum" = 2, "maximum" = 100))]
    pub front: Option<u64>,
    /// Candidates in all, each a run or those of an ensemble; 60 per parameter if absent, twice as many with `front`.
    #[schemars(extend("minimum" = 1))]
    pub budget: Option<u64>,
    /// Candidates per generation of the first descent; 16, or 4 + 3 ln n if that is more, if absent.
    #[schemars(extend("minimum" = 4))]
    pub population: Option<u64>,
    /// Converged when goals differ by less than this; 0.0001 if absent.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub tolerance: Option<f64>,
}

/// One of several measures of a goal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["minimise", "maximise"]]))]
pub struct GoalSection {
    /// The measure to make as small as possible.
    pub minimise: Option<String>,
    /// The measure to make as large as possible.
    pub maximise: Option<String>,
    /// Weight; 1 if absent.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub weight: Option<f64>,
    /// The measure is divided by this, such as its limit: "60 mm"; its value in the base scenario if absent.
    pub per: Option<Value>,
}

/// A limit that the optimum keeps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["at_most", "at_least"]]))]
pub struct ConstraintSection {
    /// The measure, such as "chest.three_ms_cumulative".
    pub measure: String,
    /// Largest value allowed.
    pub at_most: Option<Value>,
    /// Least value allowed.
    pub at_least: Option<Value>,
}

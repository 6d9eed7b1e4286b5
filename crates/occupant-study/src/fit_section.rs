//! The `[fit]` of a study as it is written.

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use occupant_scenario::Time;
use placed_text::Value;

/// What `occupant fit` makes the parameters of the study reproduce: measured channels of one test or several.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FitSection {
    /// What is made small; "rms" if absent.
    pub objective: Option<Misfit>,
    /// Filter of measured and computed channels alike; "none" if absent.
    pub filter: Option<FilterChoice>,
    /// First time that counts, on the clock of the run; that of the test or the run, whichever is later, if absent.
    pub from: Option<Time>,
    /// Last time that counts.
    pub to: Option<Time>,
    /// The channels that count; all that the tests have if absent.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub channels: Vec<FitChannel>,
    /// The tests; those of --to if absent.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tests: Vec<FitTest>,
    /// Evaluations of the global search, each a run of every experiment; 400 for each parameter if absent. Refinement and
    /// intervals come on top.
    #[schemars(extend("minimum" = 1))]
    pub budget: Option<u64>,
    /// Candidates of a generation of the first descent; 16, or 4 + 3 ln n if that is more, if absent.
    #[schemars(extend("minimum" = 4))]
    pub population: Option<u64>,
    /// A descent has arrived when scores differ by less; 0.0001 if absent.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub tolerance: Option<f64>,
    /// Sets of parameters whose score is worse by no more than this are as good as the best, and the intervals hold them;
    /// if absent, with "rms" what the noise of the test leaves open (95 %), else 0.01.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub near: Option<f64>,
}

/// What a fit makes small. Each is 0 where a run is the test.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Misfit {
    /// 1 less the rating of ISO/TS 18571, weighted mean of the channels.
    Iso18571,
    /// Root mean square difference over the measured peak, weighted root mean square of the channels.
    #[default]
    Rms,
    /// Error of the largest value over the measured one, and of its time over the length of the window, root mean square
    /// of both and of the channels, weighted.
    PeakAndTime,
}

/// A filter of measured and computed channels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum FilterChoice {
    /// As they are.
    #[default]
    #[serde(rename = "none")]
    None,
    /// Each channel the class that SAE J211 gives its quantity.
    #[serde(rename = "j211")]
    J211,
    /// Channel frequency class 60.
    #[serde(rename = "CFC60")]
    Cfc60,
    /// Channel frequency class 180.
    #[serde(rename = "CFC180")]
    Cfc180,
    /// Channel frequency class 600.
    #[serde(rename = "CFC600")]
    Cfc600,
    /// Channel frequency class 1000.
    #[serde(rename = "CFC1000")]
    Cfc1000,
}

/// A channel that counts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FitChannel {
    /// Its name, such as `upper_torso.acceleration.x`; `occupant export` lists them.
    #[serde(rename = "channel")]
    pub name: String,
    /// How much it counts; 1 if absent.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub weight: Option<f64>,
    /// Its own filter; that of the fit if absent.
    pub filter: Option<FilterChoice>,
}

/// A test, and the scenario that stands for it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FitTest {
    /// Its name in results; that of the file if absent.
    pub name: Option<String>,
    /// The measured signals, relative to this file: a text table (CSV) or an ISO-MME test; that of --to if absent.
    pub file: Option<String>,
    /// Its own scenario, relative to this file; that of the study if absent.
    pub base: Option<String>,
    /// Values that its scenario has besides those of the study, by path: `"path.speed" = "25 mph"`.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub set: IndexMap<String, Value>,
    /// First time that counts in this test, on the clock of the run.
    pub from: Option<Time>,
    /// Last time that counts in this test.
    pub to: Option<Time>,
    /// Time added to the clock of the test; 0 if absent.
    pub shift: Option<Time>,
    /// What may be wrong with that clock: a time, looked for together with the parameters, that is added as well; none if
    /// absent.
    pub offset: Option<OffsetRange>,
    /// What may be wrong with its amplifiers: all its measured values over the true ones, looked for together with the
    /// parameters; 1 if absent.
    pub gain: Option<GainRange>,
    /// How much the test counts; 1 if absent.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub weight: Option<f64>,
    /// Which column is which channel: "column=channel", "column[unit]=channel", "column=-channel" for opposite signs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub map: Vec<String>,
    /// Position of the occupant in ISO-MME codes, one character; "1" if absent.
    pub seat: Option<String>,
}

/// Between which times an offset is looked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OffsetRange {
    /// Least.
    pub from: Time,
    /// Largest.
    pub to: Time,
}

/// Between which numbers a gain is looked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GainRange {
    /// Least, above 0.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub from: f64,
    /// Largest.
    pub to: f64,
}

impl FitChannel {
    /// How much it counts.
    pub fn weight(&self) -> f64 {
        self.weight.unwrap_or(1.0)
    }
}

impl FitTest {
    /// First and last time that count, s.
    pub fn window_s(&self) -> [Option<f64>; 2] {
        [&self.from, &self.to].map(|time| time.as_ref().map(Time::si))
    }

    /// Added to its clock, s.
    pub fn shift_s(&self) -> f64 {
        self.shift.as_ref().map_or(0.0, Time::si)
    }

    /// Between which ends its offset, s, and its gain are looked for.
    pub fn nuisances(&self) -> [Option<[f64; 2]>; 2] {
        let offset = self.offset.as_ref().map(|range| [range.from.si(), range.to.si()]);
        [offset, self.gain.as_ref().map(|range| [range.from, range.to])]
    }

    /// How much it counts.
    pub fn weight(&self) -> f64 {
        self.weight.unwrap_or(1.0)
    }

    /// Position of the occupant in ISO-MME codes; the first character of what is written.
    pub fn seat(&self) -> char {
        self.seat.as_deref().and_then(|seat| seat.chars().next()).unwrap_or('1')
    }
}

//! The `[fit]` of a study as it is written.

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use occupant_scenario::Time;
use placed_text::Value;

/// Target of `occupant fit`: measured channels of one or several tests.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FitSection {
    /// Objective to minimise; "rms" if absent.
    pub objective: Option<Misfit>,
    /// Filter of both measured and computed channels; "none" if absent.
    pub filter: Option<FilterChoice>,
    /// First time compared, on the clock of the run; the later start of test and run if absent.
    pub from: Option<Time>,
    /// Last time compared.
    pub to: Option<Time>,
    /// Channels compared; all that the tests have if absent.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub channels: Vec<FitChannel>,
    /// The tests; those of --to if absent.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tests: Vec<FitTest>,
    /// Evaluations of the global search, each a run of every experiment; 400 per parameter if absent. Refinement and
    /// intervals need more.
    #[schemars(extend("minimum" = 1))]
    pub budget: Option<u64>,
    /// Candidates per generation of the first descent; 16, or 4 + 3 ln n if that is more, if absent.
    #[schemars(extend("minimum" = 4))]
    pub population: Option<u64>,
    /// Converged when scores differ by less than this; 0.0001 if absent.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub tolerance: Option<f64>,
    /// Parameter sets whose score is worse by no more than this count as equally good and define the intervals; if
    /// absent, with "rms" the 95 % confidence region given the test's noise, else 0.01.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub near: Option<f64>,
}

/// Objective of a fit; 0 if run and test are equal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Misfit {
    /// 1 − rating of ISO/TS 18571, weighted mean of the channels.
    Iso18571,
    /// Root mean square difference divided by the measured peak, weighted root mean square of the channels.
    #[default]
    Rms,
    /// Relative error of the peak, and error of its time divided by the length of the window, root mean square of both
    /// and of the channels, weighted.
    PeakAndTime,
}

/// A filter of measured and computed channels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum FilterChoice {
    /// Unfiltered.
    #[default]
    #[serde(rename = "none")]
    None,
    /// The filter class of SAE J211 for each channel's quantity.
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

/// A channel to compare.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FitChannel {
    /// Its name, such as `upper_torso.acceleration.x`; `occupant export` lists them.
    #[serde(rename = "channel")]
    pub name: String,
    /// Weight; 1 if absent.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub weight: Option<f64>,
    /// Filter of this channel; that of the fit if absent.
    pub filter: Option<FilterChoice>,
}

/// A test and the scenario that reproduces it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FitTest {
    /// Its name in results; that of the file if absent.
    pub name: Option<String>,
    /// The measured signals, relative to this file: a text table (CSV) or an ISO-MME test; that of --to if absent.
    pub file: Option<String>,
    /// Its own scenario, relative to this file; that of the study if absent.
    pub base: Option<String>,
    /// Further scenario values of this test, by path: `"path.speed" = "25 mph"`.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub set: IndexMap<String, Value>,
    /// First time compared in this test, on the clock of the run.
    pub from: Option<Time>,
    /// Last time compared in this test.
    pub to: Option<Time>,
    /// Time added to the clock of the test; 0 if absent.
    pub shift: Option<Time>,
    /// Unknown time offset of the test, added to its clock and fitted with the parameters; none if absent.
    pub offset: Option<OffsetRange>,
    /// Unknown gain of the test, measured over true values, fitted with the parameters; 1 if absent.
    pub gain: Option<GainRange>,
    /// Weight of the test; 1 if absent.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub weight: Option<f64>,
    /// Assignment of columns to channels: "column=channel", "column[unit]=channel", "column=-channel" for opposite
    /// signs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub map: Vec<String>,
    /// Position of the occupant in ISO-MME codes, one character; "1" if absent.
    pub seat: Option<String>,
}

/// Range of an unknown time offset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OffsetRange {
    /// Lower bound.
    pub from: Time,
    /// Upper bound.
    pub to: Time,
}

/// Range of an unknown gain.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GainRange {
    /// Lower bound, above 0.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub from: f64,
    /// Upper bound.
    pub to: f64,
}

impl FitChannel {
    /// Weight.
    pub fn weight(&self) -> f64 {
        self.weight.unwrap_or(1.0)
    }
}

impl FitTest {
    /// First and last time compared, s.
    pub fn window_s(&self) -> [Option<f64>; 2] {
        [&self.from, &self.to].map(|time| time.as_ref().map(Time::si))
    }

    /// Time added to its clock, s.
    pub fn shift_s(&self) -> f64 {
        self.shift.as_ref().map_or(0.0, Time::si)
    }

    /// Ranges of its unknown offset, s, and of its unknown gain.
    pub fn nuisances(&self) -> [Option<[f64; 2]>; 2] {
        let offset = self.offset.as_ref().map(|range| [range.from.si(), range.to.si()]);
        [offset, self.gain.as_ref().map(|range| [range.from, range.to])]
    }

    /// Weight.
    pub fn weight(&self) -> f64 {
        self.weight.unwrap_or(1.0)
    }

    /// Position of the occupant in ISO-MME codes: the first character of the text.
    pub fn seat(&self) -> char {
        self.seat.as_deref().and_then(|seat| seat.chars().next()).unwrap_or('1')
    }
}

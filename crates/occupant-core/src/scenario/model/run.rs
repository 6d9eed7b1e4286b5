//! `[time]`, `[integrator]` and `[output]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Length, Ratio, Speed, Time};

/// When the run starts and ends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimeSection {
    /// Start; 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<Time>,
    /// End.
    pub end: Time,
}

/// What is recorded.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct OutputSection {
    /// Time between two records; 1 ms if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub interval: Option<Time>,
    /// Also record the report's coordinates q₁…q₃₁ and their rates; false if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub report_coordinates: Option<bool>,
}

/// How the equations of motion are integrated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum IntegratorSection {
    /// The classical fourth-order Runge–Kutta method with a fixed step, as in the report.
    Rk4(Rk4Section),
    /// An embedded 3(2) pair that chooses its step.
    Adaptive(AdaptiveSection),
}

/// Settings of "rk4".
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rk4Section {
    /// Step.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub step: Time,
}

/// Settings of "adaptive".
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AdaptiveSection {
    /// Relative tolerance of velocities; 3e-6 if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub relative: Option<Ratio>,
    /// Absolute tolerance of positions; 3e-7 m if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub absolute_length: Option<Length>,
    /// Absolute tolerance of velocities; 3e-5 m/s if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub absolute_speed: Option<Speed>,
    /// Smallest step, and the first; 1e-8 s if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub min_step: Option<Time>,
    /// Largest step; 2 ms if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub max_step: Option<Time>,
}

//! `[materials]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Length, Ratio, Speed, Stiffness};

/// A contact material: a bilinear spring that gives back part of its energy, and friction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-together" = [["k2", "delta_b"]]))]
pub struct MaterialSection {
    /// K₁, stiffness up to `delta_b`.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub k1: Stiffness,
    /// Δ_b, deformation at which the stiffness changes. Without it the spring is linear.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub delta_b: Option<Length>,
    /// K₂, stiffness beyond `delta_b`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub k2: Option<Stiffness>,
    /// μ₁, fraction of the energy stored up to `delta_b` that unloading returns.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub mu1: Ratio,
    /// μ₂, the same beyond `delta_b`; equal to `mu1` if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub mu2: Option<Ratio>,
    /// Coefficient of friction.
    #[schemars(extend("minimum" = 0))]
    pub friction: Ratio,
    /// v_s, sliding speed at which friction reaches 71 % of its full value; 5 in/s if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub friction_speed: Option<Speed>,
    /// Whether crush is remembered after contact has ended; "reset" if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub memory: Option<MemoryChoice>,
}

/// Whether crush is remembered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum MemoryChoice {
    /// Forgotten when contact ends: padding that recovers.
    Reset,
    /// Kept for that sphere and surface: crushed metal.
    Retain,
}

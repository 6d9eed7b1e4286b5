//! `[belts]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Length, Ratio, Stiffness};

/// A belt that loops round one sphere of the body: the pelvis for a lap belt, the chest for a torso belt.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-at-most-one" = [["slack", "length"]], "x-together" = [["k2", "delta_b"]]))]
pub struct BeltSection {
    /// Name of the sphere, such as "pelvis" or "chest".
    pub sphere: String,
    /// The two anchor points [x, y, z], vehicle axes.
    pub anchors: [[Length; 3]; 2],
    /// K₁, loop force per elongation of the belt up to `delta_b`.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub k1: Stiffness,
    /// Elongation at which the stiffness changes. Without it the webbing is linear.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub delta_b: Option<Length>,
    /// K₂, stiffness beyond `delta_b`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub k2: Option<Stiffness>,
    /// Added to the length at the start; negative is preload; 0 if absent. Give this or `length`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slack: Option<Length>,
    /// Unstretched length of the loop.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length: Option<Length>,
    /// μ₁, fraction of the energy stored up to `delta_b` that unloading returns; 1 if absent, as in the report.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub mu1: Option<Ratio>,
    /// μ₂, the same beyond `delta_b`; equal to `mu1` if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub mu2: Option<Ratio>,
}

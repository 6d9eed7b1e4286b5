//! `[surfaces]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Angle, Length, Ratio};

/// A plane surface: `points`, `edge` with `half_width`, `disc`, or `plane`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend(
    "x-exactly-one" = [["points", "edge", "disc", "plane"]],
    "x-together" = [["edge", "half_width"]],
))]
pub struct SurfaceSection {
    /// Name of its material in `materials`.
    pub material: String,
    /// What it is fixed to; "vehicle" if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame: Option<FrameChoice>,
    /// Corners [x, y, z] in order round a convex plane polygon.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minItems" = 3))]
    pub points: Option<Vec<[Length; 3]>>,
    /// Two points [x, z] of a rectangle seen from the side.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub edge: Option<[[Length; 2]; 2]>,
    /// Half the rectangle's width.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub half_width: Option<Length>,
    /// Half the width at the second point of `edge`, where it differs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub end_half_width: Option<Length>,
    /// Lateral place of the rectangle's middle; 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y: Option<Length>,
    /// A circular disc, such as a steering wheel.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub disc: Option<DiscSection>,
    /// A whole plane without bounds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plane: Option<PlaneSection>,
    /// A point on the open side, in the surface's frame; the scenario's `inside` if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inside: Option<[Length; 3]>,
    /// "order" takes the open side from the order of the corners, or from `normal`, instead of from a point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub facing: Option<FacingChoice>,
    /// Names of the spheres that can touch it; all if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spheres: Option<Vec<String>>,
}

/// A circular disc.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["tilt", "normal"]]))]
pub struct DiscSection {
    /// Centre.
    pub centre: [Length; 3],
    /// Diameter.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub diameter: Length,
    /// Angle of the disc's plane from the vertical, its upper edge ahead, as a steering wheel's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tilt: Option<Angle>,
    /// Normal of the disc; any length.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal: Option<[Ratio; 3]>,
}

/// A plane without bounds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaneSection {
    /// A point of it.
    pub point: [Length; 3],
    /// Its normal; any length.
    pub normal: [Ratio; 3],
}

/// What a surface is fixed to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum FrameChoice {
    /// The vehicle: x forward, y right, z down from its centre of gravity.
    Vehicle,
    /// Space: x forward, y left, z up.
    Space,
}

/// How the open side is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum FacingChoice {
    /// Corners run counter-clockwise seen from the open side; a normal points to it.
    Order,
}

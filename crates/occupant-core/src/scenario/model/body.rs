//! `[body]`.

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Acceleration, Force, Inertia, Length, Mass};

/// A preset, changes to it, or a whole body of one's own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BodySection {
    /// Body to start from: "male50". Keys given here replace its values. Without a preset everything must be given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("enum" = ["male50"]))]
    pub preset: Option<String>,
    /// L_s, distance of a shoulder joint from the middle plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub shoulder_half_width: Option<Length>,
    /// L_H, distance of a hip joint from the middle plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub hip_half_width: Option<Length>,
    /// Gravity by which a `weight` is divided to give a mass; standard gravity if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub weighed_at: Option<Acceleration>,
    /// The twelve segments. `upper_arms`, `forearms`, `thighs`, `lower_legs` stand for left and right.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub segments: Option<Segments>,
    /// Contact spheres by name. The report's 17 (`head`, `chest`, `pelvis`, `left_shoulder`, …) know their place and need
    /// only a radius; `shoulders`, `elbows`, `hands`, `thighs`, `knees`, `shins`, `feet` stand for left and right.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub spheres: IndexMap<String, SphereSection>,
}

/// The twelve segments of the body.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Segments {
    /// 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub middle_torso: Option<SegmentSection>,
    /// 2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub upper_torso: Option<SegmentSection>,
    /// 3, with the neck.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub head: Option<SegmentSection>,
    /// 4, the pelvis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lower_torso: Option<SegmentSection>,
    /// 5 and 6.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub upper_arms: Option<SegmentSection>,
    /// 5.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_upper_arm: Option<SegmentSection>,
    /// 6.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub right_upper_arm: Option<SegmentSection>,
    /// 7 and 8, with the hands.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub forearms: Option<SegmentSection>,
    /// 7, with the hand.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_forearm: Option<SegmentSection>,
    /// 8, with the hand.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub right_forearm: Option<SegmentSection>,
    /// 9 and 10.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thighs: Option<SegmentSection>,
    /// 9.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_thigh: Option<SegmentSection>,
    /// 10.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub right_thigh: Option<SegmentSection>,
    /// 11 and 12, with the feet.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lower_legs: Option<SegmentSection>,
    /// 11, with the foot.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_lower_leg: Option<SegmentSection>,
    /// 12, with the foot.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub right_lower_leg: Option<SegmentSection>,
}

/// One segment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(extend("x-at-most-one" = [["mass", "weight"]]))]
pub struct SegmentSection {
    /// L, distance between the segment's ends.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length: Option<Length>,
    /// ρ, distance of the centre of gravity from the lower end, standing posture (the distal end of a limb).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cg_from_lower_end: Option<Length>,
    /// Mass. Give this or `weight`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub mass: Option<Mass>,
    /// Weight, a force; divided by `body.weighed_at` to give the mass.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub weight: Option<Force>,
    /// I_x, I_y, I_z about the centre of gravity; X ahead, Y left, Z up when standing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia: Option<[Inertia; 3]>,
}

/// A contact sphere.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SphereSection {
    /// Radius.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius: Option<Length>,
    /// Segment that carries it; the 17 of the report know theirs.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("enum" = [
        "middle_torso", "upper_torso", "head", "lower_torso", "left_upper_arm", "right_upper_arm",
        "left_forearm", "right_forearm", "left_thigh", "right_thigh", "left_lower_leg", "right_lower_leg",
    ]))]
    pub segment: Option<String>,
    /// Centre from the segment's lower end, in segment axes (X ahead, Y left, Z up when standing).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre: Option<[Length; 3]>,
    /// True takes the sphere away.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub remove: Option<bool>,
}

//! `[joints]` and `[joint_sets]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Angle, Ratio, RotationalDamping, RotationalStiffness};

/// The eleven joints. What is said of one joint replaces what is said of its pair, that replaces what is said of `all`,
/// and that replaces the preset. Every joint needs a damping from somewhere.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct JointsSection {
    /// Joints to start from: "male50".
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("enum" = ["male50"]))]
    pub preset: Option<String>,
    /// ε that keeps joint angles smooth where two segments are in line; 0.001 if absent, 0 is the report's formula.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub epsilon: Option<Ratio>,
    /// All eleven.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub all: Option<JointSection>,
    /// 1, between upper torso and head.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub neck: Option<JointSection>,
    /// 4, between middle and upper torso.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub upper_back: Option<JointSection>,
    /// 7, between middle and lower torso.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lower_back: Option<JointSection>,
    /// Both shoulders.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shoulders: Option<JointSection>,
    /// 3.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_shoulder: Option<JointSection>,
    /// 2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub right_shoulder: Option<JointSection>,
    /// Both elbows.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elbows: Option<JointSection>,
    /// 5, hinge.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_elbow: Option<JointSection>,
    /// 6, hinge.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub right_elbow: Option<JointSection>,
    /// Both hips.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hips: Option<JointSection>,
    /// 9.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_hip: Option<JointSection>,
    /// 8.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub right_hip: Option<JointSection>,
    /// Both knees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub knees: Option<JointSection>,
    /// 11, hinge.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_knee: Option<JointSection>,
    /// 10, hinge.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub right_knee: Option<JointSection>,
}

impl JointsSection {
    /// What is said of one joint by its own name.
    pub fn of(&self, name: &str) -> Option<&JointSection> {
        match name {
            "neck" => self.neck.as_ref(),
            "right_shoulder" => self.right_shoulder.as_ref(),
            "left_shoulder" => self.left_shoulder.as_ref(),
            "upper_back" => self.upper_back.as_ref(),
            "left_elbow" => self.left_elbow.as_ref(),
            "right_elbow" => self.right_elbow.as_ref(),
            "lower_back" => self.lower_back.as_ref(),
            "right_hip" => self.right_hip.as_ref(),
            "left_hip" => self.left_hip.as_ref(),
            "right_knee" => self.right_knee.as_ref(),
            "left_knee" => self.left_knee.as_ref(),
            _ => None,
        }
    }
}

/// Properties of a joint.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct JointSection {
    /// Name of a joint set in `joint_sets`; keys given here replace its values.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub set: Option<String>,
    /// J_N, viscous damping; a bare number is per radian.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub damping: Option<RotationalDamping>,
    /// J_t, damping of turning about the outer segment's long axis; ball joints only, 0 if absent as in the report.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub twist_damping: Option<RotationalDamping>,
    /// Limit of the angle between the two segments; ball joints only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stop: Option<StopSection>,
    /// Limit towards smaller angles; elbows and knees only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lower_stop: Option<StopSection>,
    /// Limit towards larger angles; elbows and knees only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub upper_stop: Option<StopSection>,
    /// K, rotational stiffness; ball joints only (the report has it in the two back joints).
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub stiffness: Option<RotationalStiffness>,
    /// β₀, angle at which the stiffness gives no torque; the angle at the start if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub rest_angle: Option<Angle>,
}

/// Damping that grows towards a limit of travel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StopSection {
    /// Angle at which the damping starts to grow.
    pub begin: Angle,
    /// Angle at which it is full, and beyond which it stays so.
    pub full: Angle,
    /// J_S, the full damping.
    #[schemars(extend("minimum" = 0))]
    pub damping: RotationalDamping,
}

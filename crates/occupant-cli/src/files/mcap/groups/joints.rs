//! Angles of all joints.

use occupant_core::body::joint::Joint;

use crate::files::mcap::column::{Group, TIME, Value, column};
use Value::Number;

/// Message `occupant.JointAngles`: field number = the report's joint number + 1.
pub(crate) const JOINTS: Group = Group {
    message: "JointAngles",
    columns: &[
        TIME,
        column(2, "neck_rad", Number(|s, _| s.joint_angle_rad(Joint::Neck)), BALL),
        column(3, "right_shoulder_rad", Number(|s, _| s.joint_angle_rad(Joint::RightShoulder)), BALL),
        column(4, "left_shoulder_rad", Number(|s, _| s.joint_angle_rad(Joint::LeftShoulder)), BALL),
        column(5, "upper_back_rad", Number(|s, _| s.joint_angle_rad(Joint::UpperBack)), BALL),
        column(6, "left_elbow_rad", Number(|s, _| s.joint_angle_rad(Joint::LeftElbow)), ELBOW),
        column(7, "right_elbow_rad", Number(|s, _| s.joint_angle_rad(Joint::RightElbow)), ELBOW),
        column(8, "lower_back_rad", Number(|s, _| s.joint_angle_rad(Joint::LowerBack)), BALL),
        column(9, "right_hip_rad", Number(|s, _| s.joint_angle_rad(Joint::RightHip)), BALL),
        column(10, "left_hip_rad", Number(|s, _| s.joint_angle_rad(Joint::LeftHip)), BALL),
        column(11, "right_knee_rad", Number(|s, _| s.joint_angle_rad(Joint::RightKnee)), KNEE),
        column(12, "left_knee_rad", Number(|s, _| s.joint_angle_rad(Joint::LeftKnee)), KNEE),
    ],
};

const BALL: &str = "β, angle between the Z axes of the two segments";
const ELBOW: &str = "α about Y; negative brings the hand forward";
const KNEE: &str = "α about Y; positive brings the heel back";

//! `[joints]` and `[joint_sets]`: their keys, and the [`Joints`] they come to.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::Builder;
use super::limits::{BendLimitSection, CentreSection, FrictionSection, LockSection, RangeLimitSection, limits};
use super::quantity::{NOT_NEGATIVE, si_or};
use super::{Angle, Ratio, RotationalDamping, RotationalStiffness};
use crate::body::tti12::TTI12;
use crate::forces::joint::{AngularSpring, BallJoint, HingeJoint, JointLaw, Joints, Stop};
use placed_text::{Problem, with_key};

/// The eleven joints. What is said of one joint replaces what is said of its pair, that replaces what is said of `all`,
/// and that replaces the preset. Every joint needs a damping from somewhere.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct JointsSection {
    /// Joints to start from: "male50", the viscous stops of the report; "gebod", elastic limits of the GEBOD generator;
    /// "dummy50-like", "dummy05f-like", "dummy06c-like", what the calibration of dummies asks of neck, trunk and hips.
    #[schemars(extend("enum" = ["male50", "gebod", "dummy50-like", "dummy05f-like", "dummy06c-like"]))]
    pub(crate) preset: Option<String>,
    /// ε that keeps joint angles smooth where two segments are in line; 0.001 if absent, 0 is the report's formula.
    pub(crate) epsilon: Option<Ratio<NOT_NEGATIVE>>,
    /// All eleven.
    pub(crate) all: Option<JointSection>,
    /// 1, between upper torso and head.
    pub(crate) neck: Option<JointSection>,
    /// 4, between middle and upper torso.
    pub(crate) upper_back: Option<JointSection>,
    /// 7, between middle and lower torso.
    pub(crate) lower_back: Option<JointSection>,
    /// Both shoulders.
    pub(crate) shoulders: Option<JointSection>,
    /// 3.
    pub(crate) left_shoulder: Option<JointSection>,
    /// 2.
    pub(crate) right_shoulder: Option<JointSection>,
    /// Both elbows.
    pub(crate) elbows: Option<JointSection>,
    /// 5, hinge.
    pub(crate) left_elbow: Option<JointSection>,
    /// 6, hinge.
    pub(crate) right_elbow: Option<JointSection>,
    /// Both hips.
    pub(crate) hips: Option<JointSection>,
    /// 9.
    pub(crate) left_hip: Option<JointSection>,
    /// 8.
    pub(crate) right_hip: Option<JointSection>,
    /// Both knees.
    pub(crate) knees: Option<JointSection>,
    /// 11, hinge.
    pub(crate) left_knee: Option<JointSection>,
    /// 10, hinge.
    pub(crate) right_knee: Option<JointSection>,
}

/// Properties of a joint.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct JointSection {
    /// Name of a joint set in `joint_sets`; keys given here replace its values.
    pub(crate) set: Option<String>,
    /// J_N, viscous damping; a bare number is per radian.
    pub(crate) damping: Option<RotationalDamping<NOT_NEGATIVE>>,
    /// J_t, damping of turning about the outer segment's long axis; ball joints only, 0 if absent as in the report.
    pub(crate) twist_damping: Option<RotationalDamping<NOT_NEGATIVE>>,
    /// Limit of the angle between the two segments; ball joints only.
    pub(crate) stop: Option<StopSection>,
    /// Limit towards smaller angles; elbows and knees only.
    pub(crate) lower_stop: Option<StopSection>,
    /// Limit towards larger angles; elbows and knees only.
    pub(crate) upper_stop: Option<StopSection>,
    /// K, rotational stiffness; ball joints only (the report has it in the two back joints).
    pub(crate) stiffness: Option<RotationalStiffness<NOT_NEGATIVE>>,
    /// β₀, angle at which the stiffness gives no torque; the angle at the start if absent.
    pub(crate) rest_angle: Option<Angle<NOT_NEGATIVE>>,
    /// Where the limits of a ball joint count from: along the outer segment, straight, if absent.
    pub(crate) centre: Option<Box<CentreSection>>,
    /// Elastic limit of the bend away from the centre axis; ball joints only.
    pub(crate) limit: Option<Box<BendLimitSection>>,
    /// Elastic limit of the twist; ball joints only.
    pub(crate) twist_limit: Option<Box<RangeLimitSection>>,
    /// Elastic limit of the angle; elbows and knees only.
    pub(crate) angle_limit: Option<Box<RangeLimitSection>>,
    /// Dry friction.
    pub(crate) friction: Option<Box<FrictionSection>>,
    /// Held until a moment is reached.
    pub(crate) lock: Option<Box<LockSection>>,
}

/// Damping that grows towards a limit of travel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct StopSection {
    /// Angle at which the damping starts to grow.
    pub(crate) begin: Angle,
    /// Angle at which it is full, and beyond which it stays so.
    pub(crate) full: Angle,
    /// J_S, the full damping.
    pub(crate) damping: RotationalDamping<NOT_NEGATIVE>,
}

/// The eleven joints; `section` is explicit.
pub(super) fn joints(b: &mut Builder, section: &JointsSection) -> Joints {
    report_undamped(b);
    let mut joints = Joints::free(&TTI12);
    for joint in TTI12.joints() {
        let row = &TTI12[joint];
        let law = if row.is_hinge() { JointLaw::from(hinge(b, row.name)) } else { JointLaw::from(ball(b, row.name)) };
        joints = joints.with(joint, law);
        joints.limits.extend(said_of(b, row.name).and_then(|section| limits(b, joint, &section)));
    }
    joints.with_epsilon(si_or(&section.epsilon, Joints::EPSILON))
}

/// What is said of a joint; nothing where its damping is missing, which is reported for all joints at once.
fn given(b: &Builder, name: &str) -> Option<JointSection> {
    said_of(b, name).filter(|section| section.damping.is_some())
}

/// What is said of one joint by its own name.
pub(super) fn said_of(b: &Builder, name: &str) -> Option<JointSection> {
    b.section(&format!("joints.{name}"))
}

/// One message for all joints that nobody gave a damping.
fn report_undamped(b: &mut Builder) {
    let names = TTI12.joint_rows().iter().map(|row| row.name);
    let undamped: Vec<&str> = names.filter(|name| given(b, name).is_none()).collect();
    let Some((first, others)) = undamped.split_first() else { return };
    let found = match others.len() {
        0 => format!("joint `{first}` has no damping"),
        n => format!("joint `{first}` and {n} more have no damping"),
    };
    let hint = "joints.all.damping is that of every joint, joints.preset = \"male50\" gives a starting set";
    let expected = "a damping for each of the eleven joints";
    b.report(Problem::error(format!("joints.{first}"), found, expected).with_hint(Some(hint)));
}

fn ball(b: &mut Builder, name: &str) -> BallJoint {
    let Some(section) = given(b, name) else { return BallJoint::default() };
    let path = format!("joints.{name}");
    let expected = "`stop`, the limit of the angle between its segments";
    b.refuse_keys(
        &path,
        &["lower_stop", "upper_stop", "angle_limit"],
        |key| format!("`{key}` of a ball joint"),
        expected,
    );
    let spring = section.stiffness.as_ref().map(|stiffness| AngularSpring {
        stiffness_n_m: stiffness.si(),
        rest_rad: section.rest_angle.as_ref().map(Angle::si),
    });
    if section.rest_angle.is_some() && spring.is_none() {
        b.error(&with_key(&path, "rest_angle"), "`rest_angle` without `stiffness`", "both or neither");
    }
    BallJoint {
        damping_n_m_s: si_or(&section.damping, f64::NAN),
        twist_damping_n_m_s: si_or(&section.twist_damping, 0.0),
        stop: section.stop.as_ref().map(stop),
        spring,
    }
}

fn hinge(b: &mut Builder, name: &str) -> HingeJoint {
    let Some(section) = given(b, name) else { return HingeJoint::default() };
    let path = format!("joints.{name}");
    let foreign = ["stop", "twist_damping", "stiffness", "rest_angle", "centre", "limit", "twist_limit"];
    let expected =
        "`damping`, `lower_stop`, `upper_stop`, `angle_limit`, `friction`, `lock`: elbows and knees are hinges";
    b.refuse_keys(&path, &foreign, |key| format!("`{key}` of a hinge"), expected);
    HingeJoint {
        damping_n_m_s: si_or(&section.damping, f64::NAN),
        lower_stop: section.lower_stop.as_ref().map(stop),
        upper_stop: section.upper_stop.as_ref().map(stop),
    }
}

fn stop(section: &StopSection) -> Stop {
    Stop { begin_rad: section.begin.si(), full_rad: section.full.si(), damping_n_m_s: section.damping.si() }
}

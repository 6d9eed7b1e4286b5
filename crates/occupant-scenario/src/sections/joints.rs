//! `[joints]` and `[joint_sets]`: their keys, converted to [`Joints`].

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::Builder;
use super::limits::{BendLimitSection, CentreSection, FrictionSection, LockSection, RangeLimitSection, limits};
use super::quantity::{NOT_NEGATIVE, si_or};
use super::{Angle, BodySection, Ratio, RotationalDamping, RotationalStiffness};
use crate::presets::OF_PEOPLE;
use occupant_core::body::{JointKind, Tree};
use occupant_core::forces::joint::{AngularSpring, BallJoint, HingeJoint, JointLaw, Joints, Stop};
use placed_text::{Problem, with_key};

/// The joints. A single joint overrides its pair, a pair overrides `all`, and `all` overrides the preset. Every joint
/// needs a damping from one of them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct JointsSection {
    /// Joint set to start from: "male50", the viscous stops of the 1970 report; "gebod", the elastic limits of the
    /// GEBOD generator; "person", with a passive spine, neck and clavicles; "volunteer", the same with active
    /// muscles (`muscles.readiness`); "dummy50-like", "dummy50-1973-like", "dummy05f-like", "dummy06c-like", which meet
    /// the calibration corridors of dummies for neck, trunk and hips.
    #[schemars(extend("enum" = ["male50", "gebod", "person", "volunteer", "dummy50-like", "dummy50-1973-like", "dummy05f-like", "dummy06c-like"]))]
    pub(crate) preset: Option<String>,
    /// ε, smooths joint angles where two segments are in line; 0.001 if absent, 0 is the formula of the 1970 report.
    pub(crate) epsilon: Option<Ratio<NOT_NEGATIVE>>,
    /// Values for all joints.
    pub(crate) all: Option<JointSection>,
    /// Joints by name: `neck`, `upper_back`, `lower_back`, `left_shoulder`, `left_elbow`, `left_hip`, `left_knee` and those
    /// of the right; bodies with more segments have others. `sternoclaviculars`, `shoulders`, `elbows`, `wrists`, `hips`, `knees`,
    /// `ankles` stand for both sides.
    #[serde(flatten)]
    pub(crate) named: IndexMap<String, JointSection>,
}

impl JointsSection {
    /// Whether they start from those of a dummy.
    pub(crate) fn is_of_dummy(&self) -> bool {
        self.preset.as_deref().is_some_and(|name| name.starts_with("dummy"))
    }
}

/// Properties of a joint.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct JointSection {
    /// Name of a joint set in `joint_sets`; other keys override its values.
    pub(crate) set: Option<String>,
    /// J_N, viscous damping; a bare number is per radian.
    pub(crate) damping: Option<RotationalDamping<NOT_NEGATIVE>>,
    /// J_t, damping of twist about the outer segment's long axis; ball joints only; 0 if absent, as in the 1970 report.
    pub(crate) twist_damping: Option<RotationalDamping<NOT_NEGATIVE>>,
    /// Limit of the angle between the two segments; ball joints only.
    pub(crate) stop: Option<StopSection>,
    /// Lower angle limit; elbows and knees only.
    pub(crate) lower_stop: Option<StopSection>,
    /// Upper angle limit; elbows and knees only.
    pub(crate) upper_stop: Option<StopSection>,
    /// K, rotational stiffness; ball joints only (the 1970 report uses it in the two back joints).
    pub(crate) stiffness: Option<RotationalStiffness<NOT_NEGATIVE>>,
    /// β₀, angle at which the stiffness gives no torque; the initial angle if absent.
    pub(crate) rest_angle: Option<Angle<NOT_NEGATIVE>>,
    /// Axis from which the limits of a ball joint are measured; along the straight outer segment if absent.
    pub(crate) centre: Option<Box<CentreSection>>,
    /// Elastic limit of bending away from the centre axis; ball joints only.
    pub(crate) limit: Option<Box<BendLimitSection>>,
    /// Elastic limit of twist; ball joints only.
    pub(crate) twist_limit: Option<Box<RangeLimitSection>>,
    /// Elastic limit of the angle; elbows and knees only.
    pub(crate) angle_limit: Option<Box<RangeLimitSection>>,
    /// Dry friction.
    pub(crate) friction: Option<Box<FrictionSection>>,
    /// A lock that holds up to a moment.
    pub(crate) lock: Option<Box<LockSection>>,
}

/// Damping that grows towards a limit of travel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct StopSection {
    /// Angle at which the damping starts to grow.
    pub(crate) begin: Angle,
    /// Angle from which the damping is full.
    pub(crate) full: Angle,
    /// J_S, the full damping.
    pub(crate) damping: RotationalDamping<NOT_NEGATIVE>,
}

/// The joints of a tree; `section` is explicit.
pub(super) fn joints(b: &mut Builder, section: &JointsSection, tree: &'static Tree) -> Joints {
    for name in section.named.keys().filter(|name| tree.joint_named(name).is_none()) {
        let names: Vec<&str> =
            tree.joint_rows().iter().map(|row| row.name).chain(["all", "preset", "epsilon"]).collect();
        b.unknown(&with_key("joints", name), "joint", name, &names);
    }
    report_undamped(b, section, tree);
    let mut joints = Joints::free(tree);
    for joint in tree.joints().filter(|joint| tree[*joint].kind != JointKind::Fixed) {
        let row = &tree[joint];
        let own = section.given(row.name);
        let law = if row.is_hinge() {
            JointLaw::from(own.map_or_else(HingeJoint::default, |own| hinge(b, row.name, own)))
        } else {
            JointLaw::from(own.map_or_else(BallJoint::default, |own| ball(b, row.name, own)))
        };
        joints = joints.with(joint, law);
        joints.limits.extend(section.named.get(row.name).and_then(|own| limits(b, joint, row, own)));
    }
    joints.with_epsilon(si_or(&section.epsilon, Joints::EPSILON))
}

/// Refuses the active neck of a preset, and warns about the passive one, if the neck of the tree is a single joint.
pub(super) fn check_neck(b: &mut Builder, preset: &str, tree: &Tree) {
    if !OF_PEOPLE.contains(&preset) || tree.joint_named("neck").is_none() || tree.joint_named("neck_base").is_some() {
        return;
    }
    let found = format!("the neck of \"{preset}\" in a body with a one-joint neck");
    let expected = "body.segment_count = 15, 17 or 19, with a two-joint neck";
    let problem = if preset == "person" { Problem::warning } else { Problem::error };
    let why = "with one joint the head would not lag behind, and the limits would be those of one joint of two";
    b.report(problem("joints.preset".to_owned(), found, expected.to_owned()).with_hint(Some(why)));
}

/// Warns about the muscles of a preset in the body of a child.
pub(super) fn check_grown(b: &mut Builder, preset: &str, body: Option<&BodySection>) {
    let of = body.and_then(|body| body.preset.as_deref()).unwrap_or_default();
    if preset == "volunteer" && of.starts_with("child") {
        let found = format!("the muscles of a grown man in the body \"{of}\"");
        let expected = "\"person\", or `[muscles]` of your own, as strong as a child's";
        b.report(Problem::warning("joints.preset".to_owned(), found, expected.to_owned()));
    }
}

impl JointsSection {
    /// Properties of a joint; none without damping, which is reported for all joints at once.
    fn given(&self, name: &str) -> Option<&JointSection> {
        self.named.get(name).filter(|section| section.damping.is_some())
    }
}

/// One message for all joints without a damping.
fn report_undamped(b: &mut Builder, section: &JointsSection, tree: &Tree) {
    let names = tree.joint_rows().iter().filter(|row| row.kind != JointKind::Fixed).map(|row| row.name);
    let undamped: Vec<&str> = names.filter(|name| section.given(name).is_none()).collect();
    let Some((first, others)) = undamped.split_first() else { return };
    let found = match others.len() {
        0 => format!("joint `{first}` has no damping"),
        n => format!("joint `{first}` and {n} more have no damping"),
    };
    let hint = "set joints.all.damping for all joints, or start from joints.preset = \"male50\"";
    let expected = "a damping for each joint";
    b.report(Problem::error(format!("joints.{first}"), found, expected).with_hint(Some(hint)));
}

fn ball(b: &mut Builder, name: &str, section: &JointSection) -> BallJoint {
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

fn hinge(b: &mut Builder, name: &str, section: &JointSection) -> HingeJoint {
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

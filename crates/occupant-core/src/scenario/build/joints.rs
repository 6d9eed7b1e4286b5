//! `[joints]` → [`Joints`].

use super::builder::Builder;
use crate::body::Joint;
use crate::body::tti12::TTI12;
use crate::forces::joint::{AngularSpring, BallJoint, HingeJoint, JointLaw, Joints, Stop};
use crate::scenario::document::{Node, Table};
use crate::scenario::model::{JointSection, JointsSection, StopSection};
use crate::scenario::path_text::with_key;

/// The eleven joints; `section` is explicit.
pub(super) fn joints(b: &mut Builder, section: &JointsSection) -> Joints {
    report_undamped(b, section);
    let mut joints = Joints::free(&TTI12);
    for joint in TTI12.joints() {
        let law = if TTI12[joint].is_hinge() {
            hinge(b, joint, section).into()
        } else {
            JointLaw::from(ball(b, joint, section))
        };
        joints = joints.with(joint, law);
    }
    joints.with_epsilon(b.optional("joints.epsilon", &section.epsilon, Joints::EPSILON))
}

/// What is said of a joint; nothing where its damping is missing, which is reported for all joints at once.
fn given<'s>(b: &mut Builder, joint: Joint, joints: &'s JointsSection) -> Option<&'s JointSection> {
    let section = joints.of(TTI12[joint].name)?;
    if let Some(name) = &section.set {
        // Sets that exist have been laid under the joint: this one does not.
        let path = format!("joints.{}.set", TTI12[joint].name);
        let sets = b.root.get("joint_sets").and_then(Node::as_table);
        let names: Vec<&str> = sets.into_iter().flat_map(Table::iter).map(|entry| entry.key.as_str()).collect();
        b.index_of(&path, "joint set", name, names.into_iter());
    }
    section.damping.is_some().then_some(section)
}

/// One message for all joints that nobody gave a damping.
fn report_undamped(b: &mut Builder, section: &JointsSection) {
    let names = TTI12.joint_rows().iter().map(|row| row.name);
    let undamped: Vec<&str> = names.filter(|name| section.of(name).is_none_or(|said| said.damping.is_none())).collect();
    let Some((first, others)) = undamped.split_first() else {
        return;
    };
    let found = match others.len() {
        0 => format!("joint `{first}` has no damping"),
        n => format!("joint `{first}` and {n} more have no damping"),
    };
    b.error_with_hint(
        &format!("joints.{first}"),
        found,
        "a damping for each of the eleven joints",
        "joints.all.damping is that of every joint, joints.preset = \"male50\" gives a starting set",
    );
}

fn ball(b: &mut Builder, joint: Joint, joints: &JointsSection) -> BallJoint {
    let Some(section) = given(b, joint, joints) else {
        return BallJoint::default();
    };
    let path = format!("joints.{}", TTI12[joint].name);
    for (key, stop) in [("lower_stop", &section.lower_stop), ("upper_stop", &section.upper_stop)] {
        if stop.is_some() {
            let found = format!("`{key}` of a ball joint");
            b.error(&with_key(&path, key), found, "`stop`, the limit of the angle between its segments");
        }
    }
    let spring = section.stiffness.as_ref().map(|stiffness| AngularSpring {
        stiffness_n_m: b.si(&with_key(&path, "stiffness"), stiffness),
        rest_rad: section.rest_angle.as_ref().map(|angle| b.si(&with_key(&path, "rest_angle"), angle)),
    });
    if section.rest_angle.is_some() && spring.is_none() {
        b.error(&with_key(&path, "rest_angle"), "`rest_angle` without `stiffness`", "both or neither");
    }
    BallJoint {
        damping_n_m_s: b.needed(&path, "damping", &section.damping),
        twist_damping_n_m_s: b.optional(&with_key(&path, "twist_damping"), &section.twist_damping, 0.0),
        stop: stop(b, &path, "stop", &section.stop),
        spring,
    }
}

fn hinge(b: &mut Builder, joint: Joint, joints: &JointsSection) -> HingeJoint {
    let Some(section) = given(b, joint, joints) else {
        return HingeJoint::default();
    };
    let path = format!("joints.{}", TTI12[joint].name);
    let foreign = [
        ("stop", section.stop.is_some()),
        ("twist_damping", section.twist_damping.is_some()),
        ("stiffness", section.stiffness.is_some()),
        ("rest_angle", section.rest_angle.is_some()),
    ];
    for (key, there) in foreign {
        if there {
            let expected = "`damping`, `lower_stop`, `upper_stop`: elbows and knees are hinges";
            b.error(&with_key(&path, key), format!("`{key}` of a hinge"), expected);
        }
    }
    HingeJoint {
        damping_n_m_s: b.needed(&path, "damping", &section.damping),
        lower_stop: stop(b, &path, "lower_stop", &section.lower_stop),
        upper_stop: stop(b, &path, "upper_stop", &section.upper_stop),
    }
}

fn stop(b: &mut Builder, path: &str, key: &str, section: &Option<StopSection>) -> Option<Stop> {
    let section = section.as_ref()?;
    let path = with_key(path, key);
    Some(Stop {
        begin_rad: b.si(&with_key(&path, "begin"), &section.begin),
        full_rad: b.si(&with_key(&path, "full"), &section.full),
        damping_n_m_s: b.si(&with_key(&path, "damping"), &section.damping),
    })
}

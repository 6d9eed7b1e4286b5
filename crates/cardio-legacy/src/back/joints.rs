//! Joints → series 11.

use occupant_core::body::joint::{BallJoint, HingeJoint, Joints, Stop};
use occupant_core::body::tree::Joint;
use occupant_core::body::tti12::*;

use super::Back;
use crate::layout::Unit;

pub(super) fn read(back: &mut Back<'_>) {
    let joints = back.setup.joints.clone();
    let smooth = joints.epsilon == Joints::free(&TTI12).epsilon;
    back.misfit_if(!smooth, "joints.epsilon: cards cannot choose it");
    let same = joints[LEFT_SHOULDER] == joints[RIGHT_SHOULDER] && joints[LEFT_HIP] == joints[RIGHT_HIP];
    back.misfit_if(!same, "shoulders or hips that differ between left and right: cards have one of each");
    let same = joints[LEFT_ELBOW] == joints[RIGHT_ELBOW] && joints[LEFT_KNEE] == joints[RIGHT_KNEE];
    back.misfit_if(!same, "elbows or knees that differ between left and right: cards have one of each");
    ball(back, "neck", &ball_of(&joints, NECK), ["XJNN", "XJSN", "AGNN", "AGSN"], None);
    ball(back, "shoulders", &ball_of(&joints, LEFT_SHOULDER), ["XJNS", "XJSS", "AGNS", "AGSS"], None);
    ball(
        back,
        "upper_back",
        &ball_of(&joints, UPPER_BACK),
        ["XJNUB", "XJSUB", "AGNUB", "AGSUB"],
        Some(("SPJNT4", "BETA4")),
    );
    ball(
        back,
        "lower_back",
        &ball_of(&joints, LOWER_BACK),
        ["XJNLB", "XJSLB", "AGNLB", "AGSLB"],
        Some(("SPJNT7", "BETA7")),
    );
    ball(back, "hips", &ball_of(&joints, LEFT_HIP), ["XJNH", "XJSH", "AGNH", "AGSH"], None);
    hinge(back, "elbows", &hinge_of(&joints, LEFT_ELBOW), ["XJNE", "XJSE", "AGNE", "AGSE"]);
    hinge(back, "knees", &hinge_of(&joints, LEFT_KNEE), ["XJNK", "XJSK", "AGNK", "AGSK"]);
}

/// The law of a ball joint of the report's body.
pub(super) fn ball_of(joints: &Joints, joint: Joint) -> BallJoint {
    joints[joint].ball().copied().unwrap_or_default()
}

fn hinge_of(joints: &Joints, joint: Joint) -> HingeJoint {
    joints[joint].hinge().copied().unwrap_or_default()
}

fn ball(back: &mut Back<'_>, name: &str, joint: &BallJoint, fields: [&str; 4], spring: Option<(&str, &str)>) {
    let [normal, full, begin, end] = fields;
    back.misfit_if(joint.twist_damping_n_m_s != 0.0, &format!("joints.{name}.twist_damping: cards have none"));
    back.set(normal, joint.damping_n_m_s, Unit::RotaryDamping);
    stop(back, joint.stop, [begin, end, full]);
    match (joint.spring, spring) {
        (Some(_), None) => {
            back.misfit(format!("joints.{name}.stiffness: cards have springs in the two back joints only"))
        }
        (Some(data), Some((stiffness, rest))) => {
            back.set(stiffness, data.stiffness_n_m, Unit::RotaryStiffness);
            if let Some(rest_rad) = data.rest_rad {
                back.set(rest, rest_rad, Unit::Radian);
            }
        }
        (None, Some((stiffness, _))) => back.builder.set(stiffness, "0"),
        (None, None) => {}
    }
}

fn hinge(back: &mut Back<'_>, name: &str, joint: &HingeJoint, [normal, full, begin, end]: [&str; 4]) {
    back.set(normal, joint.damping_n_m_s, Unit::RotaryDamping);
    for (side, data) in [(1, joint.lower_stop), (2, joint.upper_stop)] {
        stop(back, data, [&format!("{begin}({side})"), &format!("{end}({side})"), full]);
    }
    if let (Some(lower), Some(upper)) = (joint.lower_stop, joint.upper_stop) {
        let differ = lower.damping_n_m_s != upper.damping_n_m_s;
        back.misfit_if(
            differ,
            &format!("joints.{name}: the two stops have different dampings; cards have one, {full}"),
        );
    }
}

/// No stop is two angles of zero.
fn stop(back: &mut Back<'_>, stop: Option<Stop>, [begin, end, full]: [&str; 3]) {
    match stop {
        Some(stop) => {
            back.set(begin, stop.begin_rad, Unit::Radian);
            back.set(end, stop.full_rad, Unit::Radian);
            back.set(full, stop.damping_n_m_s, Unit::RotaryDamping);
        }
        None => {
            back.builder.set(begin, "0");
            back.builder.set(end, "0");
        }
    }
}

//! Joints → series 11.

use occupant_core::body::joint::{BallJoint, HingeJoint, Joints, Stop};

use super::Back;
use crate::layout::Unit;

pub(super) fn read(back: &mut Back<'_>) {
    let joints = back.setup.joints;
    let smooth = joints.epsilon == Joints::default().epsilon;
    back.misfit_if(!smooth, "joints.epsilon: cards cannot choose it");
    let same = joints.left_shoulder == joints.right_shoulder && joints.left_hip == joints.right_hip;
    back.misfit_if(!same, "shoulders or hips that differ between left and right: cards have one of each");
    let same = joints.left_elbow == joints.right_elbow && joints.left_knee == joints.right_knee;
    back.misfit_if(!same, "elbows or knees that differ between left and right: cards have one of each");
    ball(back, "neck", &joints.neck, ["XJNN", "XJSN", "AGNN", "AGSN"], None);
    ball(back, "shoulders", &joints.left_shoulder, ["XJNS", "XJSS", "AGNS", "AGSS"], None);
    ball(back, "upper_back", &joints.upper_back, ["XJNUB", "XJSUB", "AGNUB", "AGSUB"], Some(("SPJNT4", "BETA4")));
    ball(back, "lower_back", &joints.lower_back, ["XJNLB", "XJSLB", "AGNLB", "AGSLB"], Some(("SPJNT7", "BETA7")));
    ball(back, "hips", &joints.left_hip, ["XJNH", "XJSH", "AGNH", "AGSH"], None);
    hinge(back, "elbows", &joints.left_elbow, ["XJNE", "XJSE", "AGNE", "AGSE"]);
    hinge(back, "knees", &joints.left_knee, ["XJNK", "XJSK", "AGNK", "AGSK"]);
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

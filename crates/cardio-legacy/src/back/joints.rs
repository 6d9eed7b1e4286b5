//! Joints → series 11.

use occupant_core::body::tti12::*;
use occupant_core::forces::joint::{BallJoint, HingeJoint, Joints, Stop};

use super::Back;
use crate::cards::{JOINTS, Joint};

pub(super) fn read(back: &mut Back<'_>) {
    let joints = back.setup.joints.clone();
    let smooth = joints.epsilon == Joints::free(&TTI12).epsilon;
    back.misfit_if(!smooth, "joints.epsilon: cards cannot choose it");
    back.misfit_if(joints.has_limits(), "elastic limits and dry friction of joints: cards have viscous stops only");
    let same = joints[LEFT_SHOULDER] == joints[RIGHT_SHOULDER] && joints[LEFT_HIP] == joints[RIGHT_HIP];
    back.misfit_if(!same, "shoulders or hips that differ between left and right: cards have one of each");
    let same = joints[LEFT_ELBOW] == joints[RIGHT_ELBOW] && joints[LEFT_KNEE] == joints[RIGHT_KNEE];
    back.misfit_if(!same, "elbows or knees that differ between left and right: cards have one of each");
    let balls = [NECK, LEFT_SHOULDER, UPPER_BACK, LOWER_BACK, LEFT_HIP].map(|joint| ball_of(&joints, joint));
    for (card, joint) in JOINTS.iter().filter(|joint| !joint.is_hinge()).zip(balls) {
        ball(back, card, &joint);
    }
    for (card, joint) in JOINTS.iter().filter(|joint| joint.is_hinge()).zip([LEFT_ELBOW, LEFT_KNEE]) {
        let joint = joints[joint].hinge().copied().unwrap_or_default();
        hinge(back, card, &joint);
    }
}

/// Law of a ball joint of the report's body.
pub(super) fn ball_of(joints: &Joints, joint: occupant_core::body::Joint) -> BallJoint {
    joints[joint].ball().copied().unwrap_or_default()
}

fn ball(back: &mut Back<'_>, card: &Joint, joint: &BallJoint) {
    let name = card.key;
    back.misfit_if(joint.twist_damping_n_m_s != 0.0, format!("joints.{name}.twist_damping: cards have none"));
    back.set(card.damping(), joint.damping_n_m_s);
    stops(back, card, &[joint.stop]);
    match (joint.spring, card.spring) {
        (Some(_), None) => {
            back.misfit(format!("joints.{name}.stiffness: cards have springs in the two back joints only"))
        }
        (Some(data), Some([stiffness, rest])) => {
            back.set(stiffness, data.stiffness_n_m);
            if let Some(rest_rad) = data.rest_rad {
                back.set(rest, rest_rad);
            }
        }
        (None, Some([stiffness, _])) => back.deck.set(stiffness, "0"),
        (None, None) => {}
    }
}

fn hinge(back: &mut Back<'_>, card: &Joint, joint: &HingeJoint) {
    back.set(card.damping(), joint.damping_n_m_s);
    stops(back, card, &[joint.lower_stop, joint.upper_stop]);
    if let (Some(lower), Some(upper)) = (joint.lower_stop, joint.upper_stop) {
        let (name, full) = (card.key, card.full_damping());
        back.misfit_if(
            lower.damping_n_m_s != upper.damping_n_m_s,
            format!("joints.{name}: the two stops have different dampings; cards have one, {full}"),
        );
    }
}

/// Two zero angles stand for no stop.
fn stops(back: &mut Back<'_>, card: &Joint, stops: &[Option<Stop>]) {
    for ([begin, end], stop) in card.stops().into_iter().zip(stops) {
        if let Some(stop) = stop {
            back.set(begin, stop.begin_rad);
            back.set(end, stop.full_rad);
            back.set(card.full_damping(), stop.damping_n_m_s);
        } else {
            back.deck.set(&begin, "0");
            back.deck.set(&end, "0");
        }
    }
}

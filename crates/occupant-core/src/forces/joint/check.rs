//! Dampers, stops and springs of the joints.

use crate::forces::element::Instant;
use crate::forces::joint::{BallJoint, HingeJoint, JointLaw, JointSystem, Joints, Stop};
use placed_text::Problems;

pub(super) fn check(j: &Joints, problems: &mut Problems) {
    // ball joints first, as ever
    for (joint, law) in j.iter() {
        if let JointLaw::Ball(ball) = law {
            check_ball(ball, &format!("joints.{}", j.tree()[joint].name), problems);
        }
    }
    for (joint, law) in j.iter() {
        if let JointLaw::Hinge(hinge) = law {
            check_hinge(hinge, &format!("joints.{}", j.tree()[joint].name), problems);
        }
    }
    if !(0.0..=0.1).contains(&j.epsilon) {
        problems.error("joints.epsilon", format!("{}", j.epsilon), "a number from 0 to 0.1");
    }
}

fn check_ball(ball: &BallJoint, path: &str, problems: &mut Problems) {
    problems.check_at_least_zero(&format!("{path}.damping"), ball.damping_n_m_s, "N·m·s");
    problems.check_at_least_zero(&format!("{path}.twist_damping"), ball.twist_damping_n_m_s, "N·m·s");
    if let Some(stop) = &ball.stop {
        check_stop(stop, 1.0, ball.damping_n_m_s, &format!("{path}.stop"), problems);
        if stop.begin_rad < 0.0 || stop.full_rad > std::f64::consts::PI {
            problems.error(
                format!("{path}.stop"),
                format!("a stop from {:.1}° to {:.1}°", stop.begin_rad.to_degrees(), stop.full_rad.to_degrees()),
                "angles between 0° and 180°, the range of the angle between two segments",
            );
        }
    }
    if let Some(spring) = &ball.spring {
        problems.check_at_least_zero(&format!("{path}.stiffness"), spring.stiffness_n_m, "N·m/rad");
        if spring.rest_rad.is_some_and(|r| !r.is_finite()) {
            problems.error(format!("{path}.rest_angle"), "not a finite number", "an angle");
        }
    }
}

fn check_hinge(hinge: &HingeJoint, path: &str, problems: &mut Problems) {
    problems.check_at_least_zero(&format!("{path}.damping"), hinge.damping_n_m_s, "N·m·s");
    if let Some(stop) = &hinge.lower_stop {
        check_stop(stop, -1.0, hinge.damping_n_m_s, &format!("{path}.lower_stop"), problems);
    }
    if let Some(stop) = &hinge.upper_stop {
        check_stop(stop, 1.0, hinge.damping_n_m_s, &format!("{path}.upper_stop"), problems);
    }
}

fn check_stop(stop: &Stop, sign: f64, damping: f64, path: &str, problems: &mut Problems) {
    problems.check_at_least_zero(&format!("{path}.damping"), stop.damping_n_m_s, "N·m·s");
    let rise = sign * (stop.full_rad - stop.begin_rad);
    if !rise.is_finite() || rise < 0.0 {
        problems.error_with_hint(
            path,
            format!(
                "a stop that begins at {:.1}° and is full at {:.1}°",
                stop.begin_rad.to_degrees(),
                stop.full_rad.to_degrees()
            ),
            if sign > 0.0 {
                "`full` at or above `begin` for an upper stop"
            } else {
                "`full` at or below `begin` for a lower stop"
            },
            "interchange the two angles",
        );
    }
    if stop.damping_n_m_s < damping {
        problems.warning(
            path,
            format!("damping at the stop {} N·m·s below the joint's own {damping} N·m·s", stop.damping_n_m_s),
            "a stop that resists more than the free joint",
        );
    }
}

/// Angle beyond its stop at which a joint may begin, rad: stops are dampers, and people stretch their arms.
const BEYOND_RAD: f64 = 0.2;

/// Warns of joints that begin beyond their stops, in an impossible posture.
pub(super) fn start(joints: &Joints, law: &JointSystem<f64>, at: &Instant<'_, f64>, problems: &mut Problems) {
    let balls = law.balls.iter().enumerate().map(|(i, ball)| (ball.joint, law.beta(i, at.k)));
    let hinges = law.hinges.iter().zip(at.state.hinge()).map(|(hinge, angle_rad)| (hinge.joint, *angle_rad));
    for (joint, angle_rad) in balls.chain(hinges) {
        let (lower, upper) = match &joints[joint] {
            JointLaw::Ball(ball) => (None, ball.stop),
            JointLaw::Hinge(hinge) => (hinge.lower_stop, hinge.upper_stop),
        };
        let lower = lower.filter(|stop| angle_rad < stop.full_rad - BEYOND_RAD);
        if let Some(stop) = lower.or(upper.filter(|stop| angle_rad > stop.full_rad + BEYOND_RAD)) {
            let (angle, full) = (angle_rad.to_degrees(), stop.full_rad.to_degrees());
            let found = format!("{angle:.1}° at the start, beyond its stop, which is full at {full:.1}°");
            problems.warning(
                format!("joints.{}", joints.tree()[joint].name),
                found,
                "a posture that the body can take",
            );
        }
    }
}

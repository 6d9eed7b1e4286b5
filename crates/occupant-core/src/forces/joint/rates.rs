//! The fastest rates of joints.

use nalgebra::Matrix3;

use super::{Ball, BallJoint, JointSystem, Joints};
use crate::body::Joint;
use crate::forces::rate::Rate;
use crate::motion::mobility::{Mobility, greatest};

/// Rates of joints: the damper at its strongest, and the spring.
pub(super) fn rates(j: &Joints, mobility: &Mobility<'_>) -> Vec<Rate> {
    let name = |joint: Joint| j.tree()[joint].name;
    let mut rates = Vec::new();
    let system = JointSystem::new(j, mobility.skeleton, |_| 0.0);
    for ball in &system.balls {
        let Some(law) = j[ball.joint].ball() else { continue };
        rates.extend(ball_rates(name(ball.joint), law, mobility, ball, j.epsilon));
    }
    for (i, joint) in system.hinges.iter().map(|hinge| hinge.joint).enumerate() {
        let Some(law) = j[joint].hinge() else { continue };
        let stops = [law.lower_stop, law.upper_stop];
        let strongest = stops.iter().flatten().fold(law.damping_n_m_s, |most, stop| most.max(stop.damping_n_m_s));
        rates.extend(Rate::of_damper(name(joint), 1.0 / mobility.of_hinge(i), strongest));
    }
    rates
}

fn ball_rates(name: &str, joint: &BallJoint, mobility: &Mobility<'_>, ball: &Ball<f64>, epsilon: f64) -> Vec<Rate> {
    let relative = mobility.of_joint(ball.segments.0, ball.segments.1);
    let (z_k, z_l) = ball.axes(&mobility.kinematics);
    let (z_k, z_l) = (z_k.to_vector(), z_l.to_vector());
    let n = z_k.cross(&z_l);
    let sine_squared = (n.norm_squared() + epsilon * epsilon).max(1e-30);
    // T = −J·C·ω with C = [n nᵀ + ε²(1 − Z_k Z_kᵀ)]/(s² + ε²)
    let plane = Matrix3::identity() - z_k * z_k.transpose();
    let shape = (n * n.transpose() + plane * (epsilon * epsilon)) / sine_squared;
    let damping = joint.stop.map_or(joint.damping_n_m_s, |s| s.damping_n_m_s.max(joint.damping_n_m_s));
    // the eigenvalues of C·W are those of LᵀCL, W = L·Lᵀ
    let give = relative.cholesky().map_or(0.0, |c| greatest(c.l().transpose() * shape * c.l()));
    let mut rates = Vec::new();
    if give > 0.0 {
        rates.extend(Rate::of_damper(name, 1.0 / give, damping));
    }
    let twist = z_l.dot(&(relative * z_l));
    rates.extend(Rate::of_damper(&format!("{name}, twist"), 1.0 / twist, joint.twist_damping_n_m_s));
    let bend = n.dot(&(relative * n)) / sine_squared;
    if let Some(spring) = joint.spring.filter(|s| s.stiffness_n_m > 0.0 && bend > 0.0) {
        rates.push(Rate::of_spring(name.to_owned(), "spring".to_owned(), 1.0 / bend, spring.stiffness_n_m));
    }
    rates
}

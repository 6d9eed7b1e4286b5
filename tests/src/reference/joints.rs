//! Joint angles and the viscous dampers: Eqs 57–61 and 69–77, with ε, stops and twist as this project decided them.

use super::{
    DOF,
    dual::Number,
    equations::varied,
    geometry::all_axes,
    motion::{moving, space_angular_velocities},
    vector::Vector,
};
use nalgebra::Vector3;
use occupant_core::body::Joint;
use occupant_core::body::tti12;
use occupant_core::forces::joint::{BallJoint, HingeJoint, Joints, Stop};

/// The law of a ball joint.
///
/// # Panics
/// If the joint is a hinge.
pub fn ball(joints: &Joints, joint: Joint) -> BallJoint {
    *joints[joint].ball().expect("a ball joint")
}

/// The law of a hinge.
///
/// # Panics
/// If the joint is a ball joint.
pub fn hinge(joints: &Joints, joint: Joint) -> HingeJoint {
    *joints[joint].hinge().expect("a hinge")
}

/// The seven ball joints with their segments k and l (Fig. 8).
pub(super) fn balls(joints: &Joints) -> [(BallJoint, usize, usize); 7] {
    [
        (ball(joints, tti12::NECK), 2, 3),
        (ball(joints, tti12::RIGHT_SHOULDER), 2, 6),
        (ball(joints, tti12::LEFT_SHOULDER), 2, 5),
        (ball(joints, tti12::UPPER_BACK), 1, 2),
        (ball(joints, tti12::LOWER_BACK), 1, 4),
        (ball(joints, tti12::RIGHT_HIP), 4, 10),
        (ball(joints, tti12::LEFT_HIP), 4, 9),
    ]
}

/// The four hinges with the number of their coordinate α (Eq. 72).
fn hinges(joints: &Joints) -> [(HingeJoint, usize); 4] {
    [
        (hinge(joints, tti12::LEFT_ELBOW), 22),
        (hinge(joints, tti12::RIGHT_ELBOW), 23),
        (hinge(joints, tti12::RIGHT_KNEE), 31),
        (hinge(joints, tti12::LEFT_KNEE), 30),
    ]
}

/// β between the Z axes of segments k and l: Eq. 71 for ε = 0, else atan2(√(s² + ε²), Z_k·Z_l).
pub fn joint_angle<T: Number>(q: &[T; DOF], k: usize, l: usize, epsilon: f64) -> T {
    let axes = all_axes(q);
    let (z_k, z_l) = (axes[k - 1].z, axes[l - 1].z);
    let n = z_k.cross(z_l);
    let sine = (n.dot(n) + T::constant(epsilon * epsilon)).sqrt();
    sine.atan2(z_k.dot(z_l))
}

/// R₁…R₃₁.
pub fn damping_forces(joints: &Joints, q: &[f64; DOF], rates: &[f64; DOF]) -> [f64; DOF] {
    let mut r = [0.0; DOF];
    for (ball, k, l) in balls(joints) {
        let beta = joint_angle(&moving(q, rates), k, l, joints.epsilon);
        let damping = ball_damping(&ball, beta.value, beta.slope);
        for (j, r_j) in r.iter_mut().enumerate() {
            let beta_j = joint_angle(&varied(q, j), k, l, joints.epsilon).slope;
            *r_j -= damping * beta.slope * beta_j; // (76)
        }
        let turn = relative_turn_forces(&ball, damping, joints.epsilon, (k, l), q, rates);
        r = std::array::from_fn(|j| r[j] + turn[j]);
    }
    for (hinge, number) in hinges(joints) {
        let (alpha, rate) = (q[number - 1], rates[number - 1]);
        r[number - 1] -= hinge_damping(&hinge, alpha, rate) * rate; // (77)
    }
    r
}

/// What ε and twist damping add: torque −J ε² ω_⊥/(s² + ε²) − J_t Z_l (Z_l·ω) on l, opposite on k.
fn relative_turn_forces(
    ball: &BallJoint,
    damping: f64,
    epsilon: f64,
    (k, l): (usize, usize),
    q: &[f64; DOF],
    rates: &[f64; DOF],
) -> [f64; DOF] {
    let axes = all_axes(q);
    let vector = |v: Vector<f64>| Vector3::from(v);
    let (z_k, z_l) = (vector(axes[k - 1].z), vector(axes[l - 1].z));
    let omegas = space_angular_velocities(q, rates);
    let omega = vector(omegas[l - 1] - omegas[k - 1]);
    let omega_across = omega - z_k * z_k.dot(&omega);
    let s2 = z_k.cross(&z_l).norm_squared();
    let share = epsilon.powi(2) / (s2 + epsilon.powi(2));
    let torque = -damping * share * omega_across - ball.twist_damping_n_m_s * z_l * z_l.dot(&omega);
    // Virtual work of the pair of torques: T·∂(ω_l − ω_k)/∂q̇_j.
    let still = q.map(Number::constant);
    std::array::from_fn(|j| {
        let turned = space_angular_velocities(&still, &varied(rates, j));
        torque.dot(&vector((turned[l - 1] - turned[k - 1]).slope()))
    })
}

/// J of Fig. 9: the stop works only while β rises.
fn ball_damping(ball: &BallJoint, beta: f64, beta_rate: f64) -> f64 {
    match ball.stop {
        Some(stop) if beta_rate > 0.0 => stopped(ball.damping_n_m_s, &stop, beta),
        _ => ball.damping_n_m_s,
    }
}

/// J of Figs 10 and 11: each stop works only while the hinge moves into it.
fn hinge_damping(hinge: &HingeJoint, alpha: f64, alpha_rate: f64) -> f64 {
    let stop = if alpha_rate > 0.0 { hinge.upper_stop } else { hinge.lower_stop };
    stop.map_or(hinge.damping_n_m_s, |stop| stopped(hinge.damping_n_m_s, &stop, alpha))
}

/// From J_N at the beginning of the stop linearly to J_S.
fn stopped(normal: f64, stop: &Stop, angle: f64) -> f64 {
    let way = (angle - stop.begin_rad) / (stop.full_rad - stop.begin_rad);
    normal + (stop.damping_n_m_s - normal) * way.clamp(0.0, 1.0)
}

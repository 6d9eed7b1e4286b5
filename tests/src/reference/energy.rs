//! The energies: Eqs 54, 55 and 57.

use super::{
    DOF,
    dual::Number,
    geometry::pose,
    joints::{balls, joint_angle},
    motion::{angular_velocities, moving_pose},
    vector::Vector,
};
use nalgebra::Vector3;
use occupant_core::body::Body;
use occupant_core::forces::joint::Joints;

/// U, Eq. 54.
pub fn kinetic_energy<T: Number>(body: &Body, q: &[T; DOF], rates: &[T; DOF]) -> T {
    let half = T::constant(0.5);
    let pose = moving_pose(body, q, rates);
    let omega = angular_velocities(q, rates);
    let mut energy = T::constant(0.0);
    for (i, segment) in body.segments.iter().enumerate() {
        let velocity = pose.cg[i].slope();
        energy = energy + half * T::constant(segment.mass_kg) * velocity.dot(velocity);
        for (axis, &w) in omega[i].0.iter().enumerate() {
            energy = energy + half * T::constant(segment.inertia_kg_m2[axis]) * w * w;
        }
    }
    energy
}

/// V_p = −Σ M g·X, Eq. 55 where g = (0, 0, −g).
pub fn gravity_energy<T: Number>(body: &Body, gravity: &Vector3<f64>, q: &[T; DOF]) -> T {
    let pose = pose(body, q);
    let mut energy = T::constant(0.0);
    for (segment, cg) in body.segments.iter().zip(pose.cg) {
        energy = energy - T::constant(segment.mass_kg) * Vector::constant(gravity).dot(cg);
    }
    energy
}

/// V_s = ½ K (β − β₀)² of every joint with a spring, Eq. 57 for the two back joints.
///
/// # Panics
/// If a spring has no rest angle.
pub fn spine_energy<T: Number>(joints: &Joints, q: &[T; DOF]) -> T {
    let mut energy = T::constant(0.0);
    for (ball, k, l) in balls(joints) {
        let Some(spring) = ball.spring else { continue };
        let rest = spring.rest_rad.expect("the reference needs a rest angle");
        let bend = joint_angle(q, k, l, joints.epsilon) - T::constant(rest);
        energy = energy + T::constant(0.5 * spring.stiffness_n_m) * bend * bend;
    }
    energy
}

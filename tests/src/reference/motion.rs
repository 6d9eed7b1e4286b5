//! Velocities and accelerations in space: angular velocities by Eqs 39–46, everything else by differentiation.

use super::{
    DOF,
    dual::{Dual, Number},
    geometry::{Pose, pose},
    vector::Vector,
};
use nalgebra::Vector3;
use occupant_core::body::tti12;
use occupant_core::body::{Body, Segment};

/// The eight segments with Euler angles of their own.
pub const FREE: [Segment; 8] = [
    tti12::MIDDLE_TORSO,
    tti12::UPPER_TORSO,
    tti12::HEAD,
    tti12::LOWER_TORSO,
    tti12::LEFT_UPPER_ARM,
    tti12::RIGHT_UPPER_ARM,
    tti12::LEFT_THIGH,
    tti12::RIGHT_THIGH,
];

/// The four segments on hinges.
pub const HINGED: [Segment; 4] =
    [tti12::LEFT_FOREARM, tti12::RIGHT_FOREARM, tti12::LEFT_LOWER_LEG, tti12::RIGHT_LOWER_LEG];

/// 31 speeds, or their rates, without Euler angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpaceMotion {
    /// Of T1, space axes.
    pub t1: Vector3<f64>,
    /// Angular, space axes, in the order of [`FREE`].
    pub angular: [Vector3<f64>; 8],
    /// α̇ or α̈, in the order of [`HINGED`].
    pub hinge: [f64; 4],
}

/// The speeds that belong to q̇.
pub fn space_velocities(q: &[f64; DOF], rates: &[f64; DOF]) -> SpaceMotion {
    let omega = space_angular_velocities(q, rates);
    space_motion(rates, omega.map(Vector3::from))
}

/// The accelerations that belong to q̈.
pub fn space_accelerations(q: &[f64; DOF], rates: &[f64; DOF], accelerations: &[f64; DOF]) -> SpaceMotion {
    let omega = space_angular_velocities(&moving(q, rates), &moving(rates, accelerations));
    space_motion(accelerations, omega.map(|w| w.slope().into()))
}

fn space_motion(q: &[f64; DOF], angular: [Vector3<f64>; 12]) -> SpaceMotion {
    SpaceMotion {
        t1: Vector3::new(q[0], q[1], q[2]),
        angular: FREE.map(|s| angular[s.index()]),
        hinge: [q[21], q[22], q[29], q[30]],
    }
}

/// x + τ ẋ.
pub(super) fn moving<T: Number>(x: &[T; DOF], rate: &[T; DOF]) -> [Dual<T>; DOF] {
    std::array::from_fn(|j| Dual::new(x[j], rate[j]))
}

/// The pose with its time derivative.
pub(super) fn moving_pose<T: Number>(body: &Body, q: &[T; DOF], rates: &[T; DOF]) -> Pose<Dual<T>> {
    pose(body, &moving(q, rates))
}

/// ω of every segment in its own axes.
pub(super) fn angular_velocities<T: Number>(q: &[T; DOF], rates: &[T; DOF]) -> [Vector<T>; 12] {
    let [w5, w6, w9, w10] = [16, 19, 24, 27].map(|first| euler_rates(q, rates, first));
    let lower = |w, number: usize| hinge_rates(w, q[number - 1], rates[number - 1]);
    [
        euler_rates(q, rates, 4),
        euler_rates(q, rates, 7),
        euler_rates(q, rates, 10),
        euler_rates(q, rates, 13),
        w5,
        w6,
        lower(w5, 22),
        lower(w6, 23),
        w9,
        w10,
        lower(w9, 30),
        lower(w10, 31),
    ]
}

/// ω of every segment in space axes.
pub(super) fn space_angular_velocities<T: Number>(q: &[T; DOF], rates: &[T; DOF]) -> [Vector<T>; 12] {
    let axes = super::geometry::all_axes(q);
    let local = angular_velocities(q, rates);
    std::array::from_fn(|i| {
        let [wx, wy, wz] = local[i].0;
        axes[i].x * wx + axes[i].y * wy + axes[i].z * wz
    })
}

/// Eq. 44, `first` the number of the coordinate φ.
fn euler_rates<T: Number>(q: &[T; DOF], rates: &[T; DOF], first: usize) -> Vector<T> {
    let (theta, psi) = (q[first], q[first + 1]);
    let [phi_rate, theta_rate, psi_rate] = [rates[first - 1], rates[first], rates[first + 1]];
    Vector([
        -phi_rate * theta.sin() * psi.cos() + theta_rate * psi.sin(), // (44a)
        phi_rate * theta.sin() * psi.sin() + theta_rate * psi.cos(),  // (44b)
        phi_rate * theta.cos() + psi_rate,                            // (44c)
    ])
}

/// Eqs 45, 46: ω̄ₘ from ωₙ and α̇ₘ.
fn hinge_rates<T: Number>(w: Vector<T>, alpha: T, alpha_rate: T) -> Vector<T> {
    let [wx, wy, wz] = w.0;
    Vector([
        wx * alpha.cos() - wz * alpha.sin(), // (46a)
        wy + alpha_rate,                     // (46b)
        wx * alpha.sin() + wz * alpha.cos(), // (46c)
    ])
}

//! The report's generalized coordinates q₁…q₃₁: an input and output format.
//!
//! Order (Appendix III): q₁–q₃ place of T1 in space; φ, θ, ψ (z–y–z Euler angles, absolute) of segments 1, 2, 3, 4 as
//! q₄–q₁₅, of 5 as q₁₆–q₁₈, of 6 as q₁₉–q₂₁; α₇, α₈ as q₂₂, q₂₃; φ, θ, ψ of 9 as q₂₄–q₂₆, of 10 as q₂₇–q₂₉; α₁₁, α₁₂ as
//! q₃₀, q₃₁. They are singular where sin θ = 0 (an upright torso, a hanging arm); nothing is integrated in them.
//!
//! Our decision where sin θ < 1e−8: φ turns Y along the horizontal part of ω (φ = 0 if there is none), ψ takes the rest,
//! φ̇ = 0 and θ̇ = |ω_horizontal|, so that velocities survive.

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

use crate::body::tti12::TTI12;
use crate::motion::closed::{FREE, LIMBS};
use crate::motion::kinematics::axes;
use crate::motion::layout::Layout;
use crate::motion::state::{Quat, Shape, State};
use crate::motion::vector::{V3, v3};
use occupant_units::trig::{atan2, sin_cos};

/// Number of degrees of freedom.
pub const DOF: usize = 3 + 3 * FREE.len() + LIMBS.len();

/// Index in q of φ, θ, ψ of each free segment, in the order of the state's orientations.
pub const EULER_START: [usize; FREE.len()] = places(FREE);

/// Index in q of α of each hinged segment, in the order of the state's hinges.
pub(crate) const HINGE_PLACE: [usize; LIMBS.len()] = places(LOWER);

/// Hinged segments.
const LOWER: [usize; LIMBS.len()] = [LIMBS[0].1, LIMBS[1].1, LIMBS[2].1, LIMBS[3].1];

/// First index in q of these segments: T1 first, then all segments in the tree's order.
const fn places<const N: usize>(segments: [usize; N]) -> [usize; N] {
    let mut places = [3; N];
    let mut i = 0;
    while i < N {
        let (mut free, mut hinged) = (0, 0);
        while free < FREE.len() && FREE[free] < segments[i] {
            free += 1;
        }
        while hinged < LOWER.len() && LOWER[hinged] < segments[i] {
            hinged += 1;
        }
        places[i] += 3 * free + hinged;
        i += 1;
    }
    places
}

/// sin θ below which the Euler angles count as singular.
const SINGULAR: f64 = 1e-8;

/// q and q̇: metres and radians, metres and radians per second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReportCoordinates {
    /// q₁…q₃₁.
    pub q: [f64; DOF],
    /// q̇₁…q̇₃₁.
    pub rates: [f64; DOF],
}

impl ReportCoordinates {
    /// State with these coordinates.
    pub fn to_state(&self) -> State<f64> {
        let (q, rates) = (&self.q, &self.rates);
        let mut state = State::zero(Shape::of(&Layout::of(&TTI12)));
        state.set_t1(v3(q[0], q[1], q[2]));
        state.set_velocity(v3(rates[0], rates[1], rates[2]));
        for (slot, &at) in EULER_START.iter().enumerate() {
            let angles = [q[at], q[at + 1], q[at + 2]];
            state.set_orientation(slot, quaternion(&euler_rotation(angles)));
            let omega = angular_velocity(angles, [rates[at], rates[at + 1], rates[at + 2]]);
            state.set_omega(slot, V3::of(&omega));
        }
        for (slot, &at) in HINGE_PLACE.iter().enumerate() {
            state.hinge_mut()[slot] = q[at];
            state.hinge_rate_mut()[slot] = rates[at];
        }
        state
    }

    /// Coordinates of a state; none for a state of another shape than that of the report's body.
    pub fn from_state(state: &State<f64>) -> Option<Self> {
        if state.shape() != Shape::of(&Layout::of(&TTI12)) {
            return None;
        }
        let (mut q, mut rates) = ([0.0; DOF], [0.0; DOF]);
        q[..3].copy_from_slice(&state.numbers()[..3]);
        rates[..3].copy_from_slice(state.velocity().to_vector().as_slice());
        for (slot, &at) in EULER_START.iter().enumerate() {
            let rotation = axes(&state.orientation(slot)).to_matrix();
            let (angles, angle_rates) = euler(&rotation, state.omega(slot).to_vector());
            q[at..at + 3].copy_from_slice(&angles);
            rates[at..at + 3].copy_from_slice(&angle_rates);
        }
        for (slot, &at) in HINGE_PLACE.iter().enumerate() {
            q[at] = state.hinge()[slot];
            rates[at] = state.hinge_rate()[slot];
        }
        Some(ReportCoordinates { q, rates })
    }
}

/// T = R_z(φ) R_y(θ) R_z(ψ), the product of the rotations (2), (3) and (4).
pub(crate) fn euler_rotation([phi, theta, psi]: [f64; 3]) -> Matrix3<f64> {
    let ((sf, cf), (st, ct), (sp, cp)) = (sin_cos(phi), sin_cos(theta), sin_cos(psi));
    Matrix3::new(
        cf * ct * cp - sf * sp,  // (6a)
        -cf * ct * sp - sf * cp, // (6b)
        cf * st,                 // (6c)
        sf * ct * cp + cf * sp,  // (6d)
        -sf * ct * sp + cf * cp, // (6e)
        sf * st,                 // (6f)
        -st * cp,                // (6g)
        st * sp,                 // (6h)
        ct,                      // (6i)
    )
}

/// ω = φ̇ Z′ + θ̇ Y₁ + ψ̇ Z_n, the sum of three angular velocities (39), in space axes; components along the segment's
/// axes are (44).
fn angular_velocity([phi, theta, _]: [f64; 3], rates: [f64; 3]) -> Vector3<f64> {
    let ((sf, cf), (st, ct)) = (sin_cos(phi), sin_cos(theta));
    let turned_y = Vector3::new(-sf, cf, 0.0);
    let z = Vector3::new(cf * st, sf * st, ct);
    Vector3::z() * rates[0] + turned_y * rates[1] + z * rates[2]
}

/// Euler angles and rates of an orientation with the angular velocity `omega` (space axes).
fn euler(rotation: &Matrix3<f64>, omega: Vector3<f64>) -> ([f64; 3], [f64; 3]) {
    let z = rotation.column(2);
    let sine = (z.x * z.x + z.y * z.y).sqrt();
    if sine < SINGULAR {
        return euler_when_vertical(rotation, omega);
    }
    let (phi, theta) = (atan2(z.y, z.x), atan2(sine, z.z));
    let psi = atan2(rotation[(2, 1)], -rotation[(2, 0)]);
    let (cf, sf) = (z.x / sine, z.y / sine);
    let theta_rate = omega.y * cf - omega.x * sf;
    let psi_rate = (omega.x * cf + omega.y * sf) / sine;
    let phi_rate = omega.z - psi_rate * z.z;
    ([phi, theta, psi], [phi_rate, theta_rate, psi_rate])
}

fn euler_when_vertical(rotation: &Matrix3<f64>, omega: Vector3<f64>) -> ([f64; 3], [f64; 3]) {
    let horizontal = (omega.x * omega.x + omega.y * omega.y).sqrt();
    let phi = if horizontal > 0.0 { atan2(-omega.x, omega.y) } else { 0.0 };
    let up = rotation[(2, 2)] > 0.0;
    let theta = if up { 0.0 } else { std::f64::consts::PI };
    let rest = euler_rotation([phi, theta, 0.0]).tr_mul(rotation);
    let psi = atan2(rest[(1, 0)], rest[(0, 0)]);
    let psi_rate = if up { omega.z } else { -omega.z };
    ([phi, theta, psi], [0.0, horizontal, psi_rate])
}

/// The unit quaternion of a rotation matrix.
pub(crate) fn quaternion(rotation: &Matrix3<f64>) -> Quat<f64> {
    let q = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*rotation));
    let Quaternion { coords } = *q.quaternion();
    Quat { w: coords.w, v: v3(coords.x, coords.y, coords.z) }
}

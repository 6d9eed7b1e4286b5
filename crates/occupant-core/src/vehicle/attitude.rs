//! Roll, pitch and yaw of the vehicle: matrix, angular velocity, angular acceleration (Eqs 78 and 79).
//!
//! The aeronautical standard: from the vehicle-space axes (X′_v forward, Y′_v right, Z′_v down) yaw ψ about Z′_v, then
//! pitch θ about the new Y, then roll φ about the new X. The report needs only the matrix A (Eq. 79). The
//! rates are ours: each angle turns about its own axis, and the angular velocity is the sum of the three turns.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, Vector3};

use occupant_units::trig;

/// Attitude of a vehicle by the aeronautical standard, rad, positive nose up (pitch), to the right (yaw), right side
/// down (roll).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Attitude {
    /// Roll φ about the vehicle's X axis, rad.
    pub roll_rad: f64,
    /// Pitch θ, rad.
    pub pitch_rad: f64,
    /// Yaw ψ about the vertical, rad.
    pub yaw_rad: f64,
}

/// cos θ below which the vehicle points vertically, and roll and yaw have the same axis.
const LOCKED_COSINE: f64 = 1e-9;

impl Attitude {
    /// Matrix A (3×3) from vehicle to vehicle-space components (78).
    pub fn matrix(&self) -> Matrix3<f64> {
        Trigonometry::of(self.to_vector()).matrix()
    }

    /// The attitude whose matrix is `matrix` (A of Eq. 79), as roll, pitch and yaw nearest to those of `near`.
    ///
    /// With the vehicle upright on its nose or tail only the difference of roll and yaw is known; the roll is then that
    /// of `near`.
    pub fn from_matrix(matrix: &Matrix3<f64>, near: &Attitude) -> Self {
        let a = |row: usize, column: usize| matrix[(row - 1, column - 1)];
        // A₃₁ = −sin θ (79g), A₃₂ = cos θ sin φ (79h), A₃₃ = cos θ cos φ (79i)
        let cos_pitch = (a(3, 2) * a(3, 2) + a(3, 3) * a(3, 3)).sqrt();
        let pitch_rad = trig::atan2(-a(3, 1), cos_pitch);
        let free = cos_pitch > LOCKED_COSINE;
        let (roll_rad, yaw_rad) = if free {
            // A₁₁ = cos ψ cos θ (79a), A₂₁ = sin ψ cos θ (79d)
            (trig::atan2(a(3, 2), a(3, 3)), trig::atan2(a(2, 1), a(1, 1)))
        } else if a(3, 1) < 0.0 {
            // θ = π/2: A₁₂ = sin(φ − ψ) (79b), A₂₂ = cos(φ − ψ) (79e)
            (near.roll_rad, near.roll_rad - trig::atan2(a(1, 2), a(2, 2)))
        } else {
            // θ = −π/2: A₁₂ = −sin(φ + ψ) (79b), A₂₂ = cos(φ + ψ) (79e)
            (near.roll_rad, trig::atan2(-a(1, 2), a(2, 2)) - near.roll_rad)
        };
        Attitude { roll_rad, pitch_rad, yaw_rad }.unwrapped_after(near)
    }

    /// The same attitude with roll, pitch and yaw nearest to those of `previous`.
    ///
    /// An attitude has many names: whole turns may be added to each angle, and (φ + π, π − θ, ψ + π) is the same
    /// attitude as (φ, θ, ψ). The second matters for a vehicle that pitches past the vertical.
    pub(crate) fn unwrapped_after(&self, previous: &Attitude) -> Self {
        let reference = previous.to_vector();
        let nearest = |angles: Vector3<f64>| angles.zip_map(&reference, nearest_turn);
        let plain = nearest(self.to_vector());
        let other = nearest(Vector3::new(self.roll_rad + PI, PI - self.pitch_rad, self.yaw_rad + PI));
        let other_is_nearer = (other - reference).norm_squared() < (plain - reference).norm_squared();
        Attitude::from_vector(if other_is_nearer { other } else { plain })
    }

    /// (φ, θ, ψ), rad.
    pub(super) fn to_vector(self) -> Vector3<f64> {
        Vector3::new(self.roll_rad, self.pitch_rad, self.yaw_rad)
    }

    /// From (φ, θ, ψ), rad.
    pub(super) fn from_vector(angles: Vector3<f64>) -> Self {
        Attitude { roll_rad: angles.x, pitch_rad: angles.y, yaw_rad: angles.z }
    }
}

/// `angle` plus the multiple of 2π that brings it nearest to `reference`, rad.
fn nearest_turn(angle: f64, reference: f64) -> f64 {
    angle - TAU * ((angle - reference) / TAU).round()
}

/// Rotation of a vehicle, in vehicle-space axes.
pub(super) struct Turning {
    /// A (Eq. 79).
    pub matrix: Matrix3<f64>,
    /// Angular velocity, rad/s.
    pub velocity_rad_s: Vector3<f64>,
    /// Angular acceleration, rad/s².
    pub acceleration_rad_s2: Vector3<f64>,
}

/// Matrix, angular velocity and angular acceleration of an attitude whose angles (φ, θ, ψ) have the first and second
/// derivatives `rates` and `second_rates`, in vehicle-space axes.
pub(super) fn turning(angles: Vector3<f64>, rates: Vector3<f64>, second_rates: Vector3<f64>) -> Turning {
    let trigonometry = Trigonometry::of(angles);
    let [roll_axis, pitch_axis, yaw_axis] = trigonometry.axes();
    // ω = φ̇ e_φ + θ̇ e_θ + ψ̇ e_ψ
    let yaw_turn = yaw_axis * rates.z;
    let yaw_and_pitch_turn = yaw_turn + pitch_axis * rates.y;
    // Each axis is carried by the turns before it: ė_θ = ψ̇ e_ψ × e_θ, ė_φ = (ψ̇ e_ψ + θ̇ e_θ) × e_φ
    let pitch_axis_rate = yaw_turn.cross(&pitch_axis);
    let roll_axis_rate = yaw_and_pitch_turn.cross(&roll_axis);
    Turning {
        matrix: trigonometry.matrix(),
        velocity_rad_s: yaw_and_pitch_turn + roll_axis * rates.x,
        // ω̇ = φ̈ e_φ + θ̈ e_θ + ψ̈ e_ψ + φ̇ ė_φ + θ̇ ė_θ
        acceleration_rad_s2: roll_axis * second_rates.x
            + pitch_axis * second_rates.y
            + yaw_axis * second_rates.z
            + roll_axis_rate * rates.x
            + pitch_axis_rate * rates.y,
    }
}

/// Sines and cosines of roll, pitch and yaw.
struct Trigonometry {
    roll: (f64, f64),
    pitch: (f64, f64),
    yaw: (f64, f64),
}

impl Trigonometry {
    fn of(angles: Vector3<f64>) -> Self {
        Trigonometry { roll: trig::sin_cos(angles.x), pitch: trig::sin_cos(angles.y), yaw: trig::sin_cos(angles.z) }
    }

    /// A (Eq. 79), element by element.
    fn matrix(&self) -> Matrix3<f64> {
        let ((s_phi, c_phi), (s_theta, c_theta), (s_psi, c_psi)) = (self.roll, self.pitch, self.yaw);
        Matrix3::new(
            c_psi * c_theta,                          // A₁₁ = cos ψ cos θ (79a)
            -s_psi * c_phi + c_psi * s_theta * s_phi, // A₁₂ = −sin ψ cos φ + cos ψ sin θ sin φ (79b)
            s_psi * s_phi + c_psi * s_theta * c_phi,  // A₁₃ = sin ψ sin φ + cos ψ sin θ cos φ (79c)
            s_psi * c_theta,                          // A₂₁ = sin ψ cos θ (79d)
            c_psi * c_phi + s_psi * s_theta * s_phi,  // A₂₂ = cos ψ cos φ + sin ψ sin θ sin φ (79e)
            -c_psi * s_phi + s_psi * s_theta * c_phi, // A₂₃ = −cos ψ sin φ + sin ψ sin θ cos φ (79f)
            -s_theta,                                 // A₃₁ = −sin θ (79g)
            c_theta * s_phi,                          // A₃₂ = cos θ sin φ (79h)
            c_theta * c_phi,                          // A₃₃ = cos θ cos φ (79i)
        )
    }

    /// Axes of roll, pitch and yaw in vehicle-space, in this order.
    fn axes(&self) -> [Vector3<f64>; 3] {
        let ((s_theta, c_theta), (s_psi, c_psi)) = (self.pitch, self.yaw);
        [
            Vector3::new(c_psi * c_theta, s_psi * c_theta, -s_theta),
            Vector3::new(-s_psi, c_psi, 0.0),
            Vector3::new(0.0, 0.0, 1.0),
        ]
    }
}

/// Rotation matrix (3×3) of the rotation vector `turn_rad`, rad: the exponential of its cross-product matrix.
pub(super) fn rotation_by(turn_rad: Vector3<f64>) -> Matrix3<f64> {
    let angle = turn_rad.norm();
    let (sine, _) = trig::sin_cos(angle);
    let (half_sine, _) = trig::sin_cos(0.5 * angle);
    // sin a / a and (1 − cos a) / a², whose limits at a = 0 are 1 and ½
    let (first, second) =
        if angle > 1e-8 { (sine / angle, 2.0 * (half_sine / angle) * (half_sine / angle)) } else { (1.0, 0.5) };
    let cross = turn_rad.cross_matrix();
    // exp[u]× = 1 + (sin a / a) [u]× + ((1 − cos a) / a²) [u]×²
    Matrix3::identity() + cross * first + cross * cross * second
}

#[cfg(test)]
#[path = "tests/attitude.rs"]
mod tests;

//! Strapdown integration: from readings along the turning axes of the vehicle to its position and attitude.
//!
//! In an interval of length h the rate is a straight line ω = ω₀ + b s. The attitude is A(s) = A₀ exp[u(s)]× with
//!
//! ```text
//! u(s) = ω₀ s + ½ b s² + (s³/12) ω₀ × b
//! ```
//!
//! the first two terms of the Magnus series; the third is of the order h⁵ and is neglected. The second term accounts
//! for coning motion. Accelerations are transformed to vehicle-space axes at both ends and in the middle, and a
//! parabola goes through the three: velocity and position are its integrals.

use nalgebra::{Matrix3, Vector3};

use super::readings::Readings;
use super::{SensorDefinition, SensorGravity};
use crate::vehicle::attitude::{Attitude, rotation_by};
use crate::vehicle::problem::PathProblem;

/// Motion of the sensors from one node to the next, in vehicle-space axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    /// Start, s.
    pub start_s: f64,
    /// Roll, pitch and yaw there, unwrapped.
    pub attitude: Attitude,
    place_m: Vector3<f64>,
    velocity_m_s: Vector3<f64>,
    /// Acceleration a₀ + a₁ s + a₂ s².
    acceleration: [Vector3<f64>; 3],
    /// A₀.
    rotation: Matrix3<f64>,
    /// ω₀, vehicle axes, rad/s.
    rate_rad_s: Vector3<f64>,
    /// b, vehicle axes, rad/s².
    rate_slope_rad_s2: Vector3<f64>,
}

/// Motion of the sensors at one instant, in vehicle-space axes.
pub(super) struct SensorMotion {
    pub place_m: Vector3<f64>,
    pub velocity_m_s: Vector3<f64>,
    pub acceleration_m_s2: Vector3<f64>,
    /// Vehicle components to vehicle-space components.
    pub rotation: Matrix3<f64>,
    pub angular_velocity_rad_s: Vector3<f64>,
    pub angular_acceleration_rad_s2: Vector3<f64>,
}

impl Piece {
    /// The motion at `t_s`.
    pub(crate) fn at(&self, t_s: f64) -> SensorMotion {
        let s = t_s - self.start_s;
        let rotation = self.rotation_after(s);
        SensorMotion {
            place_m: self.place_after(s),
            velocity_m_s: self.velocity_after(s),
            acceleration_m_s2: self.acceleration[0] + (self.acceleration[1] + self.acceleration[2] * s) * s,
            rotation,
            angular_velocity_rad_s: rotation * (self.rate_rad_s + self.rate_slope_rad_s2 * s),
            // dω/dt along turning axes is that along fixed ones: ω × ω = 0
            angular_acceleration_rad_s2: rotation * self.rate_slope_rad_s2,
        }
    }

    /// A₀ exp[u(s)]×.
    fn rotation_after(&self, s: f64) -> Matrix3<f64> {
        let coning = self.rate_rad_s.cross(&self.rate_slope_rad_s2) * (s / 12.0);
        let turn_rad = (self.rate_rad_s + (self.rate_slope_rad_s2 * 0.5 + coning) * s) * s;
        self.rotation * rotation_by(turn_rad)
    }

    /// v₀ + a₀ s + ½ a₁ s² + ⅓ a₂ s³.
    fn velocity_after(&self, s: f64) -> Vector3<f64> {
        let [a0, a1, a2] = self.acceleration;
        self.velocity_m_s + (a0 + (a1 / 2.0 + a2 * (s / 3.0)) * s) * s
    }

    /// x₀ + v₀ s + ½ a₀ s² + ⅙ a₁ s³ + 1⁄12 a₂ s⁴.
    fn place_after(&self, s: f64) -> Vector3<f64> {
        let [a0, a1, a2] = self.acceleration;
        self.place_m + (self.velocity_m_s + (a0 / 2.0 + (a1 / 6.0 + a2 * (s / 12.0)) * s) * s) * s
    }
}

/// The pieces between the nodes, and the attitude at the last one; `velocity_m_s` is that of the c.g. where the path starts,
/// vehicle-space axes.
///
/// # Errors
/// Readings so large that place or velocity are no numbers.
pub(super) fn integrate(
    readings: &Readings,
    start: &SensorDefinition,
    velocity_m_s: Vector3<f64>,
) -> Result<(Vec<Piece>, Attitude), Vec<PathProblem>> {
    let field = Field::new(readings, start);
    let mut attitude = start.initial.attitude;
    let mut rotation = attitude.matrix();
    let arm_m = rotation * start.offset_m;
    // v_s = v_cg + ω × A r
    let mut place_m = start.initial.position_m + arm_m;
    let mut velocity_m_s = velocity_m_s + (rotation * readings.rate_rad_s[0]).cross(&arm_m);
    let mut pieces = Vec::with_capacity(readings.time_s.len());
    for i in 0..readings.time_s.len() - 1 {
        let h_s = readings.time_s[i + 1] - readings.time_s[i];
        let mut piece = Piece {
            start_s: readings.time_s[i],
            attitude,
            place_m,
            velocity_m_s,
            acceleration: [Vector3::zeros(); 3],
            rotation,
            rate_rad_s: readings.rate_rad_s[i],
            rate_slope_rad_s2: (readings.rate_rad_s[i + 1] - readings.rate_rad_s[i]) / h_s,
        };
        let next = orthogonal(piece.rotation_after(h_s));
        let first = field.acceleration(&rotation, readings.acceleration_m_s2[i]);
        let middle = field.acceleration(&piece.rotation_after(0.5 * h_s), readings.middle_m_s2[i]);
        let last = field.acceleration(&next, readings.acceleration_m_s2[i + 1]);
        piece.acceleration = parabola(first, middle, last, h_s);
        place_m = piece.place_after(h_s);
        velocity_m_s = piece.velocity_after(h_s);
        rotation = next;
        attitude = Attitude::from_matrix(&rotation, &attitude);
        if !(place_m.norm() + velocity_m_s.norm() + rotation.norm()).is_finite() {
            return Err(vec![PathProblem::not_finite("integrated place", f64::NAN)]);
        }
        pieces.push(piece);
    }
    Ok((pieces, attitude))
}

/// Conversion of readings to accelerations in vehicle-space axes.
struct Field {
    present: [bool; 3],
    strength: f64,
    /// Gravity contained in the readings at every instant.
    gravity_m_s2: Vector3<f64>,
    /// Constant subtracted by zeroing, vehicle axes.
    zeroed_m_s2: Vector3<f64>,
}

impl Field {
    fn new(readings: &Readings, start: &SensorDefinition) -> Self {
        let down = Vector3::new(0.0, 0.0, start.gravity_m_s2);
        let at_start = start.initial.attitude.matrix().tr_mul(&down);
        let (gravity_m_s2, zeroed_m_s2) = match start.gravity {
            SensorGravity::Included => (down, Vector3::zeros()),
            SensorGravity::Zeroed => (down, at_start),
            SensorGravity::Removed => (Vector3::zeros(), Vector3::zeros()),
        };
        Field { present: readings.present, strength: start.strength, gravity_m_s2, zeroed_m_s2 }
    }

    /// a = s A (f − f₀ + Aᵀ g), of the recorded axes; f₀ was subtracted by zeroing, s is the strength.
    fn acceleration(&self, rotation: &Matrix3<f64>, reading_m_s2: Vector3<f64>) -> Vector3<f64> {
        let mut along = reading_m_s2 - self.zeroed_m_s2 + rotation.tr_mul(&self.gravity_m_s2);
        for axis in 0..3 {
            if !self.present[axis] {
                along[axis] = 0.0;
            }
        }
        rotation * along * self.strength
    }
}

/// The parabola a₀ + a₁ s + a₂ s² through three values at 0, h/2 and h.
fn parabola(first: Vector3<f64>, middle: Vector3<f64>, last: Vector3<f64>, h_s: f64) -> [Vector3<f64>; 3] {
    [first, (middle * 4.0 - first * 3.0 - last) / h_s, (first - middle * 2.0 + last) * (2.0 / h_s / h_s)]
}

/// Product of rotations, orthogonalized against rounding: R ← ½ R (3 − RᵀR).
fn orthogonal(rotation: Matrix3<f64>) -> Matrix3<f64> {
    rotation * (Matrix3::identity() * 3.0 - rotation.tr_mul(&rotation)) * 0.5
}

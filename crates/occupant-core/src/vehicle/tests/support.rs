//! What the tests of the path share: seeded numbers, differences, integrals, bounds. A number in a comment beside a bound
//! is the value measured.

use std::ops::{Add, Mul, Sub};

use nalgebra::{Matrix3, Vector3};

use crate::vehicle::FrameMotion;

/// Seeded numbers (SplitMix64), the same in every run.
pub(super) struct Seeded(pub u64);

impl Seeded {
    /// Uniform between `low` and `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        low + (high - low) * ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Three of them.
    pub fn vector(&mut self, low: f64, high: f64) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.between(low, high))
    }
}

/// Acceleration in space, m/s², of the point of a frame that is at `point_space_m` now: a + α × r + ω × (ω × r).
pub(super) fn acceleration_at(frame: &FrameMotion, point_space_m: Vector3<f64>) -> Vector3<f64> {
    let (arm_m, omega) = (point_space_m - frame.origin_m, frame.angular_velocity_rad_s);
    frame.acceleration_m_s2 + frame.angular_acceleration_rad_s2.cross(&arm_m) + omega.cross(&omega.cross(&arm_m))
}

/// Derivative of `f` at `at` by the four-point central difference, of fourth order in `step`.
pub(super) fn differentiate<T>(f: impl Fn(f64) -> T, at: f64, step: f64) -> T
where
    T: Sub<Output = T> + Add<Output = T> + Mul<f64, Output = T>,
{
    let near = f(at + step) - f(at - step);
    let far = f(at + 2.0 * step) - f(at - 2.0 * step);
    (near * 8.0 - far) * (1.0 / (12.0 * step))
}

/// ω of a rotation R with derivative Ṙ: [ω]× = Ṙ Rᵀ. Also checks that ṘRᵀ is skew within `bound`.
pub(super) fn omega_of(rotation: Matrix3<f64>, derivative: Matrix3<f64>, bound: f64) -> Vector3<f64> {
    let spin = derivative * rotation.transpose();
    assert_below("symmetric part of ṘRᵀ", (spin + spin.transpose()).amax(), bound);
    Vector3::new(spin[(2, 1)], spin[(0, 2)], spin[(1, 0)])
}

/// ∫f from `from` to `to` by Gauss-Legendre with five points in each of `parts` parts; exact for polynomials of
/// degree nine.
pub(super) fn integrate(f: impl Fn(f64) -> f64, from: f64, to: f64, parts: usize) -> f64 {
    let inner = (5.0 - 2.0 * (10.0f64 / 7.0).sqrt()).sqrt() / 3.0;
    let outer = (5.0 + 2.0 * (10.0f64 / 7.0).sqrt()).sqrt() / 3.0;
    let root = 70.0f64.sqrt();
    let (inner_weight, outer_weight) = ((322.0 + 13.0 * root) / 900.0, (322.0 - 13.0 * root) / 900.0);
    let half = 0.5 * (to - from) / parts as f64;
    (0..parts)
        .map(|part| {
            let middle = from + half * (2 * part + 1) as f64;
            let pair = |x: f64| f(middle - half * x) + f(middle + half * x);
            half * (128.0 / 225.0 * f(middle) + inner_weight * pair(inner) + outer_weight * pair(outer))
        })
        .sum()
}

/// Fails with both numbers unless `found` is below `bound` (a NaN fails).
#[track_caller]
pub(super) fn assert_below(what: &str, found: f64, bound: f64) {
    assert!(found < bound, "{what}: found {found:e}, expected below {bound:e}");
}

//! Sines, arcs and exponentials that give the same bits on every machine.
//!
//! The standard library hands these functions to the C library of the platform, whose last digit differs from one
//! system to the next. An occupant's motion after a hard contact is chaotic: a last digit grows into a visible
//! difference within a second. So that one scenario and one version give one result everywhere, every
//! transcendental function goes through this file, to the pure Rust crate `libm`, and so do the functions of `nalgebra`
//! (feature `libm_force` of `simba`). A lint holds it (`clippy.toml`). Square roots are
//! rounded correctly by every platform (IEEE 754) and need no detour. Angles are in rad.

pub use libm::{acos, asin, atan, atan2, cbrt, cos, erfc, exp, hypot, log as ln, log10, pow, sin, sincos as sin_cos};

/// xⁿ by squaring. The standard library leaves the order of the products open, and so the last digit.
pub fn powi(x: f64, n: i32) -> f64 {
    let (mut power, mut square, mut left) = (1.0, x, n.unsigned_abs());
    while left > 0 {
        if left & 1 == 1 {
            power *= square;
        }
        square *= square;
        left >>= 1;
    }
    if n < 0 { 1.0 / power } else { power }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bits of the crate's results, written down once; a platform or a version that changes one fails here.
    #[test]
    fn the_same_bits_everywhere() {
        let (sine, cosine) = sin_cos(1.0);
        let found = [sine, cosine, atan2(2.0, -3.0), asin(0.3), acos(0.3), exp(0.7)].map(f64::to_bits);
        let written_down = [
            0x3FEA_ED54_8F09_0CEE, // sin 1
            0x3FE1_4A28_0FB5_068C, // cos 1
            0x4004_6DC0_9EC2_9433, // atan2(2, −3)
            0x3FD3_8015_9E14_F6FF, // asin 0.3
            0x3FF4_41F5_ECBE_EF59, // acos 0.3
            0x4000_1C2A_6126_8987, // e^0.7
        ];
        assert_eq!(found, written_down);
    }

    #[test]
    fn whole_powers() {
        assert_eq!([powi(3.0, 0), powi(3.0, 5), powi(2.0, -3), powi(-2.0, 3)], [1.0, 243.0, 0.125, -8.0]);
        assert_eq!([powi(10.0, -2), powi(10.0, 22), powi(2.0, i32::MIN)], [0.01, 1e22, 0.0]);
    }

    #[test]
    fn the_functions_are_the_ones_they_are_named_after() {
        let angle = 0.4321;
        let (sine, cosine) = sin_cos(angle);
        // Measured: 0 to 1.1e-16.
        assert!((asin(sine) - angle).abs() < 4e-16);
        assert!((acos(cosine) - angle).abs() < 4e-16);
        assert!((atan2(sine, cosine) - angle).abs() < 4e-16);
        assert!((exp(angle) * exp(-angle) - 1.0).abs() < 4e-16);
    }
}

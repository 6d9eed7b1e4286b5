//! Sine, cosine and hypotenuse, correctly rounded, under the names that the standard library of wasm32 calls.
//!
//! The core takes its transcendental functions from `libm`, which has the same bits everywhere. The rotations of `nalgebra`
//! take theirs from the platform: natively from its C library, which rounds correctly but for rare cases, in a browser from
//! the standard library, whose last digit differs now and then. With these, a page has the command's bits.

/// A number as the sum of two, the second below half a digit of the first.
#[derive(Clone, Copy)]
struct Double(f64, f64);

/// π/2 in three parts, to 160 bits.
const QUARTER: [f64; 3] = [std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];
/// Terms of the series, enough for 2⁻¹¹⁰ up to π/4.
const TERMS: u32 = 16;

impl Double {
    fn sum(a: f64, b: f64) -> Self {
        let sum = a + b;
        let part = sum - a;
        Double(sum, (a - (sum - part)) + (b - part))
    }

    fn plus(self, other: Double) -> Self {
        let Double(high, low) = Double::sum(self.0, other.0);
        Double::sum(high, low + (self.1 + other.1))
    }

    fn times(self, other: Double) -> Self {
        let high = self.0 * other.0;
        let low = self.0.mul_add(other.0, -high) + (self.0 * other.1 + self.1 * other.0);
        Double::sum(high, low)
    }

    fn over(self, whole: f64) -> Self {
        let high = self.0 / whole;
        let rest = (-high).mul_add(whole, self.0) + self.1;
        Double::sum(high, rest / whole)
    }
}

/// Quarter turns in an angle, and what is left of it.
fn reduced(angle: f64) -> (i64, Double) {
    let quarters = (angle / QUARTER[0]).round();
    let mut rest = Double(angle, 0.0);
    for part in QUARTER {
        let product = quarters * part;
        rest = rest.plus(Double(-product, -quarters.mul_add(part, -product)));
    }
    (quarters as i64, rest)
}

/// Sum of r^(2n + first) / (2n + first)! with alternating signs.
fn series(rest: Double, first: u32) -> f64 {
    let square = rest.times(rest);
    let mut term = if first == 1 { rest } else { Double(1.0, 0.0) };
    let mut sum = term;
    for n in 1..TERMS {
        let whole = f64::from((2 * n + first) * (2 * n + first - 1));
        let next = term.times(square).over(whole);
        term = Double(-next.0, -next.1);
        sum = sum.plus(term);
    }
    sum.0 + sum.1
}

/// Beyond this, rad, the parts of π/2 are too few; nothing turns so far.
const FAR: f64 = 1e6;

fn turned(angle: f64, ahead: i64) -> f64 {
    let (quarters, rest) = reduced(angle);
    match (quarters + ahead).rem_euclid(4) {
        0 => series(rest, 1),
        1 => series(rest, 0),
        2 => -series(rest, 1),
        _ => -series(rest, 0),
    }
}

/// Sine of an angle, rad.
#[cfg_attr(target_family = "wasm", allow(unsafe_code))]
// SAFETY: it is what the standard library expects under this name
#[cfg_attr(target_family = "wasm", unsafe(no_mangle))]
pub extern "C" fn sin(angle: f64) -> f64 {
    match angle.abs() {
        0.0 => angle,
        size if size < FAR => turned(angle, 0),
        _ => libm::sin(angle),
    }
}

/// Cosine of an angle, rad.
#[cfg_attr(target_family = "wasm", allow(unsafe_code))]
// SAFETY: it is what the standard library expects under this name
#[cfg_attr(target_family = "wasm", unsafe(no_mangle))]
pub extern "C" fn cos(angle: f64) -> f64 {
    if angle.abs() < FAR { turned(angle, 1) } else { libm::cos(angle) }
}

/// Length of the hypotenuse.
#[cfg_attr(target_family = "wasm", allow(unsafe_code))]
// SAFETY: it is what the standard library expects under this name
#[cfg_attr(target_family = "wasm", unsafe(no_mangle))]
pub extern "C" fn hypot(a: f64, b: f64) -> f64 {
    let size = a.abs().max(b.abs());
    if !(1e-100..1e100).contains(&size) {
        return libm::hypot(a, b);
    }
    let square = |x: f64| Double(x * x, x.mul_add(x, -(x * x)));
    let sum = square(a).plus(square(b));
    let root = sum.0.sqrt();
    root + (root.mul_add(-root, sum.0) + sum.1) / (2.0 * root)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where the platform has glibc it is the reference; elsewhere its functions are close at least.
    #[test]
    fn they_round_as_the_platform_does() {
        let mut unlike = 0;
        for i in 0..200_000 {
            let angle = f64::from(i) * 7.1e-5 - 7.0;
            for (ours, theirs) in [(sin(angle), angle.sin()), (cos(angle), angle.cos())] {
                assert!((ours - theirs).abs() <= 1.2e-16, "{angle}: {ours} and {theirs}");
                unlike += u32::from(ours.to_bits() != theirs.to_bits());
            }
        }
        if cfg!(all(target_os = "linux", target_env = "gnu")) {
            // measured: 560, at which the platform rounds the other way
            assert!(unlike < 1000, "{unlike} of 400000 differ");
        }
        let sides = (1..1000).map(|i| (f64::from(i) * 0.37, 300.1 - f64::from(i) * 0.61));
        assert!(sides.clone().all(|(a, b)| (hypot(a, b) - a.hypot(b)).abs() <= 3e-16 * hypot(a, b)));
        assert_eq!((hypot(3.0, 4.0), hypot(0.0, -2.0), hypot(0.0, 0.0)), (5.0, 2.0, 0.0));
        assert_eq!((sin(0.0), cos(0.0), sin(-0.0).is_sign_negative()), (0.0, 1.0, true));
    }
}

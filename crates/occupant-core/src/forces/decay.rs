//! Exponential and logarithm, with the same bits on every machine and in all lanes.
//!
//! Code for lanes avoids closures passed to `fold` and the like: they are compiled outside the function that may use
//! wide registers, where each instruction becomes a call.

use crate::motion::scalar::Scalar;

/// exp(−x) of x ≥ 0 to 1e-14, constant beyond 32: a Taylor sum at x/64, squared six times.
#[inline(always)]
pub(crate) fn decay<S: Scalar>(x: S) -> S {
    let y = x.min(S::of(32.0)) * S::of(-1.0 / 64.0);
    let mut sum = S::one();
    for n in (1..=14).rev() {
        sum = S::one() + y * sum * S::of(1.0 / f64::from(n));
    }
    for _ in 0..6 {
        sum = sum * sum;
    }
    sum
}

/// ln x of 0.45 ≤ x ≤ 1 to 1e-15: 2 artanh z with z = (x − 1)/(x + 1) as a sum of powers.
#[inline(always)]
pub(crate) fn logarithm<S: Scalar>(x: S) -> S {
    let z = (x - S::one()) / (x + S::one());
    let square = z * z;
    let mut sum = S::zero();
    for n in (0..=16).rev() {
        sum = sum * square + S::of(1.0 / f64::from(2 * n + 1));
    }
    S::of(2.0) * z * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithm_is_the_natural_one() {
        for i in 0..=550 {
            let x = 0.45 + 0.001 * f64::from(i);
            // measured: 2.2e-16
            assert!((logarithm(x) - x.ln()).abs() < 1e-15, "{x}");
        }
    }
}

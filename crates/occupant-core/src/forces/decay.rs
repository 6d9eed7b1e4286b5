//! The exponential, with the same bits on every machine and in all lanes.

use crate::motion::scalar::Scalar;

/// exp(−x) of x ≥ 0 to 1e-14, constant beyond 32: a Taylor sum at x/64, squared six times.
#[inline(always)]
pub(crate) fn decay<S: Scalar>(x: S) -> S {
    let y = x.min(S::of(32.0)) * S::of(-1.0 / 64.0);
    let sum = (1..=14).rev().fold(S::one(), |sum, n| S::one() + y * sum * S::of(1.0 / f64::from(n)));
    (0..6).fold(sum, |power, _| power * power)
}

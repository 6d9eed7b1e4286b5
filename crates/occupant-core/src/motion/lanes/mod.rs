//! Several runs side by side: a scalar of four or eight lanes, each with the bits that an `f64` would have.
//!
//! The vector unit rounds sums, products, quotients and square roots like scalars, nothing is contracted, and arcs and
//! sines use the same operations as the scalar library ([`trig`]). Values may only be created if the processor has
//! their instructions; tests compare them with an array.

#[cfg(target_arch = "x86_64")]
mod processor;
mod trig;

use crate::motion::scalar::Scalar;

#[cfg(target_arch = "x86_64")]
pub(crate) use processor::{Avx2, Avx512};
#[cfg(test)]
pub(crate) use tests::plain::Plain;

/// Whether the processor supports [`Avx2`].
#[cfg(target_arch = "x86_64")]
pub(crate) fn has_avx2() -> bool {
    is_x86_feature_detected!("avx2")
}

/// Whether the processor supports [`Avx512`].
#[cfg(target_arch = "x86_64")]
pub(crate) fn has_avx512() -> bool {
    is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq")
}

/// Numbers of several runs side by side.
pub(crate) trait Lanes: Scalar {
    /// Number of lanes.
    const COUNT: usize;

    /// The number of lane `i`.
    fn lane(&self, i: usize) -> f64;

    /// Sets the number of lane `i`.
    fn set_lane(&mut self, i: usize, value: f64);

    /// Each number with the lower half of its 64 bits cleared.
    fn upper_half(self) -> Self;

    /// The same with another number in lane `i`.
    #[inline(always)]
    fn with_lane(mut self, i: usize, value: f64) -> Self {
        self.set_lane(i, value);
        self
    }

    /// True if all lanes are.
    #[inline(always)]
    fn all(mask: Self::Mask) -> bool {
        !Self::any(!mask)
    }
}

#[cfg(test)]
mod tests;

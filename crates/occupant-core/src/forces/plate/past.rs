//! Memory of a band between steps.

use crate::motion::scalar::Scalar;

/// Memory of a band.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BandPast<S> {
    /// x_m: the largest x and the largest −x since the last change of sign, m.
    pub(super) greatest: [S; 2],
}

impl<S> BandPast<S> {
    /// Count of its numbers.
    pub(super) const SIZE: usize = 2;
}

impl<S: Scalar> BandPast<S> {
    pub(super) fn none() -> Self {
        BandPast { greatest: [S::zero(); 2] }
    }

    /// Updates it with x at an accepted step.
    #[inline(always)]
    pub(super) fn commit(&mut self, x: S) {
        let (o, is_out, [inward, outward]) = (S::zero(), x.lt(S::zero()), self.greatest);
        self.greatest = [S::select(is_out, o, inward.max(x)), S::select(is_out, outward.max(-x), o)];
    }
}

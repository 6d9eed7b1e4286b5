//! Memory of a band between steps.

use crate::motion::scalar::Scalar;

/// Memory of a band.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BandPast<S> {
    /// x_m: the largest x, and the largest −x, of the present sign alone, m.
    pub(super) greatest: [S; 2],
}

impl<S> BandPast<S> {
    /// How many numbers it has.
    pub(super) const SIZE: usize = 2;
}

impl<S: Scalar> BandPast<S> {
    pub(super) fn none() -> Self {
        BandPast { greatest: [S::zero(); 2] }
    }

    /// Takes x at an accepted step over.
    #[inline(always)]
    pub(super) fn commit(&mut self, x: S) {
        let (o, is_out, [inward, outward]) = (S::zero(), x.lt(S::zero()), self.greatest);
        self.greatest = [S::select(is_out, o, inward.max(x)), S::select(is_out, outward.max(-x), o)];
    }
}

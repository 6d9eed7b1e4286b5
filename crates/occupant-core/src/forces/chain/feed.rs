//! Feed of the first strap at one instant: tension and webbing over the unknown of the march.

use super::device::DeviceLaw;
use crate::motion::scalar::Scalar;

/// Tension and feed at the first node as functions of x.
pub(super) struct Feed<'a, S: Scalar> {
    pub(super) law: &'a DeviceLaw<S>,
    /// Where x is Δp, and where it is δ; elsewhere it is T₀.
    pub(super) is_open: S::Mask,
    pub(super) is_limited: S::Mask,
    pub(super) tension: S,
    pub(super) passed: S,
    /// p_L minus the payout of the last commit.
    pub(super) base: S,
    pub(super) greatest: S,
    /// Share of the second limiter.
    pub(super) share: S,
}

/// T₀ and Δp, and their derivatives.
pub(super) struct Fed<S> {
    pub(super) tension: S,
    pub(super) tension_rate: S,
    pub(super) passed: S,
    pub(super) passed_rate: S,
}

impl<S: Scalar> Feed<'_, S> {
    /// The same with Δp prescribed in some lanes.
    #[inline(always)]
    pub(super) fn given(self, mask: S::Mask, passed: S) -> Self {
        Feed { is_open: self.is_open & !mask, passed: S::select(mask, passed, self.passed), ..self }
    }

    /// Least x for which the belt is under tension.
    #[inline(always)]
    pub(super) fn least(&self) -> S {
        let Some(limiter) = &self.law.limiter else { return S::zero() };
        let mut foot = limiter.set(self.greatest);
        if let Some((second, ..)) = &self.law.second {
            let other = second.set(self.greatest);
            let part = S::select(self.share.lt(S::one()), foot.min(other), other);
            foot = S::select(self.share.gt(S::zero()), part, foot);
        }
        S::select(self.is_limited, foot, S::zero())
    }

    #[inline(always)]
    pub(super) fn at(&self, x: S) -> Fed<S> {
        let (o, one) = (S::zero(), S::one());
        let mut fed = Fed { tension: x, tension_rate: one, passed: self.passed, passed_rate: o };
        if self.law.limiter.is_some() {
            let [force, slope] = self.law.limit(x, self.greatest, self.share);
            fed.tension = S::select(self.is_limited, force, fed.tension);
            fed.tension_rate = S::select(self.is_limited, slope, fed.tension_rate);
            fed.passed = S::select(self.is_limited, self.base + x, fed.passed);
            fed.passed_rate = S::select(self.is_limited, one, fed.passed_rate);
        }
        if self.law.reel.is_some() {
            fed.tension = S::select(self.is_open, self.tension, fed.tension);
            fed.tension_rate = S::select(self.is_open, o, fed.tension_rate);
            fed.passed = S::select(self.is_open, x, fed.passed);
            fed.passed_rate = S::select(self.is_open, one, fed.passed_rate);
        }
        fed
    }

    /// δ.
    #[inline(always)]
    pub(super) fn delta(&self, x: S) -> S {
        S::select(self.is_limited, x, S::zero())
    }
}

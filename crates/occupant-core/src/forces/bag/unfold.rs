//! Unfolding of a bag: the volume of its envelope grows linearly, all its lengths as the cube root of it.

use super::data::{Bag, FOLDED};
use crate::forces::element::{Instant, passes};
use crate::motion::scalar::Scalar;

/// Times of a bag.
#[derive(Clone, Copy, Debug)]
pub(super) struct UnfoldLaw<S> {
    /// t_f and t_d, s.
    fires: S,
    lasts: S,
}

/// State of unfolding.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unfolded<S: Scalar> {
    /// Whether it has fired.
    pub(super) fired: S::Mask,
    /// g, V_e over V_f.
    pub(super) share: S,
    /// ġ, 1/s.
    pub(super) growth: S,
    /// λ = g^(1/3).
    pub(super) scale: S,
}

/// Whether it is later than `time`: at that time itself true for a step that begins there, false for one that ends
/// there.
#[inline(always)]
pub(super) fn later<S: Scalar>(at: &Instant<'_, S>, time: S) -> S::Mask {
    let now = at.frames.time;
    if at.accepted { !now.lt(time) } else { now.gt(time) }
}

impl<S: Scalar> UnfoldLaw<S> {
    /// Fraction between two times at which it fires.
    pub(super) fn due(&self, [before, now]: [S; 2]) -> S {
        passes(self.fires, before, now)
    }
}

impl<S: Copy> UnfoldLaw<S> {
    pub(super) fn zip<A: Copy, T>(&self, other: &UnfoldLaw<A>, f: &impl Fn(S, A) -> T) -> UnfoldLaw<T> {
        UnfoldLaw { fires: f(self.fires, other.fires), lasts: f(self.lasts, other.lasts) }
    }
}

impl<S: Scalar> UnfoldLaw<S> {
    pub(super) fn new(bag: &Bag) -> Self {
        UnfoldLaw { fires: S::of(bag.fires_s), lasts: S::of(bag.deploy_s) }
    }

    /// Whether it has fired.
    #[inline(always)]
    pub(super) fn fired(&self, at: &Instant<'_, S>) -> S::Mask {
        later(at, self.fires)
    }

    #[inline(always)]
    pub(super) fn at(&self, at: &Instant<'_, S>) -> Unfolded<S> {
        let (one, rest) = (S::one(), S::of(1.0 - FOLDED));
        let share = S::of(FOLDED) + rest * ((at.frames.time - self.fires) / self.lasts).clamp01();
        let grows = self.fired(at) & !later(at, self.fires + self.lasts);
        let scale = if S::any(share.lt(one)) { cube_root(share) } else { one };
        let growth = S::select(grows, rest / self.lasts, S::zero());
        Unfolded { fired: self.fired(at), share, growth, scale: S::select(share.lt(one), scale, one) }
    }
}

/// x^(1/3) of 0.02 ≤ x ≤ 1, by Halley's iteration.
#[inline(always)]
fn cube_root<S: Scalar>(x: S) -> S {
    let two = S::of(2.0);
    let mut root = S::of(0.45) + S::of(0.6) * x;
    for _ in 0..4 {
        let cube = root * root * root;
        root = root * (cube + two * x) / (two * cube + x);
    }
    root
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cube_root_is_one() {
        for i in 20..=1000 {
            let x = 0.001 * f64::from(i);
            // measured: 2.2e-16
            assert!((cube_root(x) - x.cbrt()).abs() < 1e-15, "{x}");
        }
    }
}

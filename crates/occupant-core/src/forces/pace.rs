//! Largest step that cannot miss a force.

use crate::motion::scalar::Scalar;

/// Largest length of the step that begins at the latest commit.
#[derive(Clone, Copy, Debug)]
pub struct Pace<S> {
    /// Length up to which a step needs no limit, s.
    free: S,
    /// Limit for longer steps, s.
    until: S,
}

impl<S: Scalar> Pace<S> {
    /// No limit.
    #[inline(always)]
    pub(crate) fn any() -> Self {
        Pace { free: S::of(f64::INFINITY), until: S::of(f64::INFINITY) }
    }

    /// In the lanes `here`, limits steps longer than `free` to `until`, both in s.
    #[inline(always)]
    pub(crate) fn bound(&mut self, here: S::Mask, free: S, until: S) {
        self.free = S::select(here, self.free.min(free), self.free);
        self.until = S::select(here, self.until.min(until), self.until);
    }

    /// `yes` where the mask is true, else `no`.
    #[inline(always)]
    pub(crate) fn select(mask: S::Mask, yes: Self, no: Self) -> Self {
        Pace { free: S::select(mask, yes.free, no.free), until: S::select(mask, yes.until, no.until) }
    }

    /// The same with each number replaced by f of it.
    #[cfg(any(target_arch = "x86_64", test))]
    pub(crate) fn map<T>(self, f: impl Fn(S) -> T) -> Pace<T> {
        Pace { free: f(self.free), until: f(self.until) }
    }

    /// The stricter of both limits.
    #[inline(always)]
    pub(crate) fn and(self, other: Self) -> Self {
        Pace { free: self.free.min(other.free), until: self.until.min(other.until) }
    }

    /// Length of a step with the planned length `h`, s.
    #[inline(always)]
    pub(crate) fn step(&self, h: S) -> S {
        S::select(self.free.lt(h), h.min(self.until), h)
    }
}

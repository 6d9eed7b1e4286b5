//! How long a step may be in which a force must not be missed.

use crate::motion::scalar::Scalar;

/// How long the step may be that begins at the latest commit.
#[derive(Clone, Copy, Debug)]
pub struct Pace<S> {
    /// Steps up to this long see all that comes, s.
    free: S,
    /// Longer ones end here, s.
    until: S,
}

impl<S: Scalar> Pace<S> {
    /// Whatever length.
    #[inline(always)]
    pub(crate) fn any() -> Self {
        Pace { free: S::of(f64::INFINITY), until: S::of(f64::INFINITY) }
    }

    /// Where `here`, steps longer than `free` are to end at `until`, both in s.
    #[inline(always)]
    pub(crate) fn bound(&mut self, here: S::Mask, free: S, until: S) {
        self.free = S::select(here, self.free.min(free), self.free);
        self.until = S::select(here, self.until.min(until), self.until);
    }

    /// What is within both.
    #[inline(always)]
    pub(crate) fn and(self, other: Self) -> Self {
        Pace { free: self.free.min(other.free), until: self.until.min(other.until) }
    }

    /// The length of a step that was to be `h`, s.
    #[inline(always)]
    pub(crate) fn step(&self, h: S) -> S {
        S::select(self.free.lt(h), h.min(self.until), h)
    }
}

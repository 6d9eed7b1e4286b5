//! Conditions that fire a device of a belt: a time known before the run, or a quantity of the belt at accepted steps.

use super::data::{Cue, NEVER, Watched};
use crate::forces::element::passes;
use crate::motion::scalar::Scalar;

/// Constants of a trigger condition.
#[derive(Clone, Copy, Debug)]
pub(super) struct CueLaw<S> {
    pub(super) due: S,
    watch: Option<(Watched, [S; 3])>,
}

/// Stored quantities of a trigger condition and its belt at a commit.
pub(super) struct Cued<S> {
    pub(super) time_s: S,
    pub(super) due_s: S,
    pub(super) since_s: S,
    /// In the order of [`Watched`]; an acceleration is not stored.
    pub(super) seen: [Option<S>; 4],
}

impl CueLaw<f64> {
    pub(super) fn can_fire(&self) -> bool {
        self.due < NEVER || self.watch.is_some()
    }
}

impl<S: Scalar<Mask = bool>> CueLaw<S> {
    /// Fraction between two commits at which its condition began to hold, or had held for long enough; none if neither,
    /// or if unknown.
    pub(super) fn due(&self, before: &Cued<S>, now: &Cued<S>) -> Option<S> {
        let (of, [threshold, lasting, _]) = self.watch?;
        let is = |time_s: S| time_s.lt(S::of(NEVER));
        if is(before.since_s) {
            let fires = is(now.due_s) && !is(before.due_s);
            fires.then(|| passes(before.since_s + lasting, before.time_s, now.time_s))
        } else {
            let seen = before.seen[of as usize].zip(now.seen[of as usize]);
            seen.filter(|_| is(now.since_s)).map(|(before, now)| passes(threshold, before, now))
        }
    }
}

impl<S: Copy> CueLaw<S> {
    /// Index of the watched quantity; conditions on the same quantity can be evaluated side by side.
    pub(super) fn watched(&self) -> Option<usize> {
        self.watch.map(|(of, _)| of as usize)
    }

    pub(super) fn zip<A: Copy, T>(&self, other: &CueLaw<A>, f: &impl Fn(S, A) -> T) -> CueLaw<T> {
        let both = self.watch.iter().zip(&other.watch).next();
        let watch = both.map(|((of, a), (_, b))| (*of, std::array::from_fn(|i| f(a[i], b[i]))));
        CueLaw { due: f(self.due, other.due), watch }
    }
}

impl<S: Scalar> CueLaw<S> {
    pub(super) fn new(cue: &Cue) -> Self {
        let watch = cue.watch.map(|w| (w.of, [w.threshold, w.lasting_s, w.delay_s].map(S::of)));
        CueLaw { due: S::of(cue.due_s), watch }
    }

    /// Due time, and time since when its condition holds; `seen` are the quantities in the order of [`Watched`].
    #[inline(always)]
    pub(super) fn commit(&self, time: S, seen: &[S; 4], due: &mut S, since: &mut S) {
        let Some((of, [threshold, lasting, delay])) = self.watch else { return };
        let holds = !seen[of as usize].lt(threshold);
        *since = S::select(holds, since.min(time), S::of(NEVER));
        let fires = holds & !(time - *since).lt(lasting) & due.gt(S::of(0.5 * NEVER));
        *due = S::select(fires, time + delay, *due);
    }
}

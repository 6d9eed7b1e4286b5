//! A spool: its lock and its pretensioner.

use super::cue::CueLaw;
use super::data::{Pull, Reel};
use super::device::{Moment, Phase};
use super::past::DevicePast;
use crate::forces::element::passes;
use crate::forces::function::steps::Steps;
use crate::motion::scalar::Scalar;

/// Constants of a spool.
#[derive(Clone, Debug)]
pub(super) struct ReelLaw<S> {
    on_spool: S,
    pub(super) tension: S,
    pub(super) lock: CueLaw<S>,
    lock_after: [S; 2],
    pub(super) pull: Option<PullLaw<S>>,
}

/// Constants of a pretensioner.
#[derive(Clone, Debug)]
pub(super) struct PullLaw<S> {
    pub(super) cue: CueLaw<S>,
    pub(super) table: Steps<S>,
    pub(super) by_force: Option<S>,
    stall: S,
}

impl ReelLaw<f64> {
    pub(super) fn new(reel: &Reel) -> Self {
        let pull = |pull: &Pull| PullLaw {
            cue: CueLaw::new(&pull.cue),
            table: Steps::new(&pull.table),
            by_force: pull.by_force,
            stall: pull.stall_n,
        };
        ReelLaw {
            on_spool: reel.on_spool_m,
            tension: reel.tension_n,
            lock: CueLaw::new(&reel.lock),
            lock_after: reel.lock_after,
            pull: reel.pull.as_ref().map(pull),
        }
    }
}

impl<S: Scalar<Mask = bool>> ReelLaw<S> {
    /// Fraction between two commits at which the previous phase was due to end.
    pub(super) fn due(&self, before: &Moment<'_, S>, now: &Moment<'_, S>, level: S) -> Option<S> {
        let (a, time) = (before.past, now.past.time);
        let at = |due: S| (!time.lt(due)).then(|| passes(due, a.time, time));
        let paid = |out: S| (!now.payout().lt(out)).then(|| passes(out, before.payout(), now.payout()));
        let [after, within] = self.lock_after;
        let ends = if a.phase.lt(S::of(Phase::LOCKING)) {
            [at(a.lock_due), paid(self.on_spool), None]
        } else if a.phase.lt(S::of(Phase::PULLING)) {
            [paid(a.mark + after), at(a.lock_due + within), paid(self.on_spool)]
        } else {
            let tight = |pull: &PullLaw<S>| {
                let most = pull.stall.min(level);
                (!now.tension.lt(most)).then(|| passes(most, before.tension, now.tension))
            };
            let end = self.pull.as_ref().map(|pull| a.pull_due + pull.table.end());
            [self.pull.as_ref().and_then(tight), end.and_then(at), None]
        };
        ends.into_iter().flatten().reduce(S::min)
    }
}

impl<S: Copy> ReelLaw<S> {
    /// Structure that must be equal for side-by-side evaluation.
    pub(super) fn shape(&self) -> [Option<usize>; 4] {
        let pull = self.pull.as_ref();
        [
            self.lock.watched(),
            pull.map(|pull| pull.table.len()),
            pull.and_then(|pull| pull.by_force).map(|_| 0),
            pull.and_then(|pull| pull.cue.watched()),
        ]
    }

    pub(super) fn zip<A: Copy, T>(&self, other: &ReelLaw<A>, f: &impl Fn(S, A) -> T) -> ReelLaw<T> {
        let pull = |(a, b): (&PullLaw<S>, &PullLaw<A>)| PullLaw {
            cue: a.cue.zip(&b.cue, f),
            table: a.table.zip(&b.table, f),
            by_force: a.by_force.zip(b.by_force).map(|(a, b)| f(a, b)),
            stall: f(a.stall, b.stall),
        };
        ReelLaw {
            on_spool: f(self.on_spool, other.on_spool),
            tension: f(self.tension, other.tension),
            lock: self.lock.zip(&other.lock, f),
            lock_after: std::array::from_fn(|i| f(self.lock_after[i], other.lock_after[i])),
            pull: self.pull.as_ref().zip(other.pull.as_ref()).map(pull),
        }
    }
}

impl<S: Scalar> ReelLaw<S> {
    /// End of the pretensioner; it starts when due. It stops for good when the tension reaches its own force or
    /// `level`, the yield force of the limiter, whichever comes first; it does not act on a belt already that tight.
    #[inline(always)]
    pub(super) fn commit_pull(&self, time: S, seen: &[S; 4], level: S, past: &mut DevicePast<S>) -> S::Mask {
        let Some(pull) = &self.pull else { return S::truth(false) };
        let [tension, payout, speed, _] = *seen;
        pull.cue.commit(time, seen, &mut past.pull_due, &mut past.pull_since);
        let is_pulling = past.phase.gt(S::of(Phase::LOCKING)) & past.phase.lt(S::of(Phase::LOCKED));
        let age = time - past.pull_due;
        let is_tight = !tension.lt(pull.stall.min(level));
        // as it is foreseen: no rounding between both
        let mut stops = !time.lt(past.pull_due + pull.table.end()) | is_tight;
        if pull.by_force.is_some() {
            stops = stops | (!speed.lt(S::zero()) & tension.gt(pull.table.at(age)));
        }
        let fires = !time.lt(past.pull_due) & !past.pulled.gt(S::zero());
        let fails = fires & is_tight & past.phase.lt(S::of(Phase::LOCKED));
        let stops = stops & is_pulling | fails;
        past.pulled = S::select(fires, S::one(), past.pulled);
        let fires = fires & !is_tight;
        past.phase = S::select(fires, S::of(Phase::PULLING), past.phase);
        past.mark = S::select(fires, payout, past.mark);
        stops
    }

    /// Locks an open spool, starting when its trigger has fired.
    #[inline(always)]
    pub(super) fn commit_lock(&self, time: S, payout: S, past: &mut DevicePast<S>) -> S::Mask {
        let is_open = past.phase.lt(S::of(Phase::LOCKING));
        let begins = is_open & !time.lt(past.lock_due);
        past.phase = S::select(begins, S::of(Phase::LOCKING), past.phase);
        past.mark = S::select(begins, payout, past.mark);
        let is_locking = past.phase.lt(S::of(Phase::PULLING)) & past.phase.gt(S::of(Phase::OPEN));
        let [after, within] = self.lock_after;
        let locks = is_locking & (!(payout - past.mark).lt(after) | !(time - past.lock_due).lt(within));
        locks | (past.phase.lt(S::of(Phase::PULLING)) & !payout.lt(self.on_spool))
    }
}

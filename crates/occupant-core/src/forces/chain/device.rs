//! The device at the first node of a belt: an anchor, a limiter, or a spool with its phases.
//!
//! The march has one unknown x at the first node: its tension T₀ if the spool is fixed, the deformation δ of the
//! limiter (T₀ = Q(δ), p = p_L + δ), or the webbing Δp that has left since the last commit if the tension is given.
//! Webbing fed and tension never fall with x.

use std::array::from_fn;

use super::cue::{CueLaw, Cued};
use super::data::{Cue, Device, NEVER};
use super::feed::Feed;
use super::past::{DevicePast, NodePast};
use super::reel::ReelLaw;
use crate::forces::decay::decay;
use crate::forces::element::passes;
use crate::forces::function::{Function, FunctionLaw};
use crate::motion::scalar::Scalar;

/// Time constant of the average from which webbing acceleration is computed, s.
const SENSOR_S: f64 = 5e-3;

/// Speed at which a limiter counts as unloading, m/s: above rounding errors.
const BACK_M_S: f64 = 1e-4;

/// Bisections that resolve an interval fully.
const HALVES: u32 = 54;

/// Phases of the first node. For spools only: open, locking, pulled in; a fixed one is locked.
pub(super) struct Phase;

impl Phase {
    pub(super) const OPEN: f64 = 1.0;
    pub(super) const LOCKING: f64 = 2.0;
    pub(super) const PULLING: f64 = 3.0;
    pub(super) const LOCKED: f64 = 4.0;
}

/// Constants of a device.
#[derive(Clone, Debug)]
pub(super) struct DeviceLaw<S> {
    pub(super) limiter: Option<FunctionLaw<S>>,
    pub(super) second: Option<(FunctionLaw<S>, CueLaw<S>, S)>,
    pub(super) reel: Option<ReelLaw<S>>,
    release: CueLaw<S>,
    /// Yield forces of the limiters; [`NEVER`] if they do not yield.
    levels: [S; 2],
}

impl DeviceLaw<f64> {
    pub(super) fn new(data: &Device, release: &Cue) -> Self {
        let level = |law: Option<&Function>| law.and_then(Function::yields).map_or(NEVER, |[_, force]| force);
        DeviceLaw {
            levels: [level(data.limiter.as_ref()), level(data.second.as_ref().map(|second| &second.0))],
            limiter: data.limiter.as_ref().map(FunctionLaw::new),
            second: data.second.as_ref().map(|(law, cue, over)| (FunctionLaw::new(law), CueLaw::new(cue), *over)),
            reel: data.reel.as_ref().map(ReelLaw::new),
            release: CueLaw::new(release),
        }
    }

    /// Reports a curve that was exceeded.
    pub(super) fn overrun(&self, of: &str, greatest: f64) -> Option<String> {
        let laws = self.limiter.iter().chain(self.second.iter().map(|second| &second.0));
        laws.filter_map(|law| law.overrun(of, greatest, |way| format!("{:.1} mm", 1e3 * way))).next()
    }
}

/// A commit of a device: its stored state, its node's action, and the tension of the first strap.
#[derive(Clone, Copy)]
pub(super) struct Moment<'a, S> {
    pub(super) past: &'a DevicePast<S>,
    pub(super) first: &'a NodePast<S>,
    pub(super) tension: S,
}

impl<S: Copy> Moment<'_, S> {
    pub(super) fn payout(&self) -> S {
        self.first.fed
    }
}

impl DeviceLaw<f64> {
    /// Whether it has a spool, a limiter, or a trigger.
    pub(super) fn can_switch(&self) -> bool {
        self.reel.is_some() || self.limiter.is_some() || self.release.can_fire()
    }
}

impl<S: Scalar<Mask = bool>> DeviceLaw<S> {
    /// Fraction between two commits at which the first switch was due.
    pub(super) fn due(&self, before: &Moment<'_, S>, now: &Moment<'_, S>) -> Option<S> {
        let (a, b) = (before.past, now.past);
        let at = |due: S| (!b.time.lt(due)).then(|| passes(due, a.time, b.time));
        let cued = |of: &Moment<'_, S>, due_s: S, since_s: S| Cued {
            time_s: of.past.time,
            due_s,
            since_s,
            seen: [Some(of.tension), Some(of.payout()), Some(of.past.speed), None],
        };
        let cue = |law: Option<&CueLaw<S>>, due: fn(&DevicePast<S>) -> [S; 2]| {
            let [from, to] = [before, now].map(|of| cued(of, due(of.past)[0], due(of.past)[1]));
            law.and_then(|law| law.due(&from, &to))
        };
        let reel = self.reel.as_ref();
        let pull = reel.and_then(|reel| reel.pull.as_ref());
        let all = [
            cue(Some(&self.release), |p| [p.release_due, p.release_since]),
            cue(self.second.as_ref().map(|second| &second.1), |p| [p.switch_due, p.switch_since]),
            cue(reel.map(|reel| &reel.lock), |p| [p.lock_due, p.lock_since]),
            cue(pull.map(|pull| &pull.cue), |p| [p.pull_due, p.pull_since]),
            at(a.release_due).filter(|_| a.free.lt(b.free)),
            at(a.pull_due).filter(|_| a.pulled.lt(b.pulled)),
            reel.filter(|_| a.phase.lt(b.phase) || b.phase.lt(a.phase)).and_then(|reel| {
                let level = self.level(self.share(b.time, b));
                reel.due(before, now, level)
            }),
            self.turns(before, now),
            self.takes_over(before, now),
        ];
        all.into_iter().flatten().reduce(S::min)
    }
}

impl<S: Scalar<Mask = bool>> DeviceLaw<S> {
    /// Fraction between two commits at which the second limiter began or ended to take over; the step after that, or
    /// after a lock, determines how the payout continues.
    fn takes_over(&self, before: &Moment<'_, S>, now: &Moment<'_, S>) -> Option<S> {
        match [before, now].map(|of| of.first.pays_anew()) {
            [true, false] => Some(S::zero()),
            [false, true] => {
                let (due, over) = (now.past.switch_due, self.second.as_ref()?.2);
                let [from, to] = [before, now].map(|of| of.past.time);
                let comes = [due, due + over].into_iter().find(|at| from.lt(*at) && !to.lt(*at));
                comes.map(|at| passes(at, from, to))
            }
            _ => None,
        }
    }

    /// Fraction between two commits at which the limiter began to unload, or to reload.
    fn turns(&self, before: &Moment<'_, S>, now: &Moment<'_, S>) -> Option<S> {
        match [before, now].map(|of| of.first.goes_back()) {
            [false, true] => Some(passes(S::of(BACK_M_S), -before.past.speed, -now.past.speed)),
            [true, false] => Some(passes(before.past.greatest, before.past.solution, now.past.solution)),
            _ => None,
        }
    }
}

impl<S: Copy> DeviceLaw<S> {
    /// Structure that must be equal for side-by-side evaluation.
    pub(super) fn shape(&self) -> Vec<Option<usize>> {
        let mut list = vec![
            self.limiter.as_ref().map(FunctionLaw::len),
            self.second.as_ref().map(|(law, ..)| law.len()),
            self.second.as_ref().and_then(|(_, cue, _)| cue.watched()),
            self.release.watched(),
            self.reel.as_ref().map(|_| 0),
        ];
        list.extend(self.reel.iter().flat_map(ReelLaw::shape));
        list
    }

    pub(super) fn zip<A: Copy, T>(&self, other: &DeviceLaw<A>, f: &impl Fn(S, A) -> T) -> DeviceLaw<T> {
        let second = self.second.as_ref().zip(other.second.as_ref());
        DeviceLaw {
            limiter: self.limiter.as_ref().zip(other.limiter.as_ref()).map(|(a, b)| a.zip(b, f)),
            second: second.map(|(a, b)| (a.0.zip(&b.0, f), a.1.zip(&b.1, f), f(a.2, b.2))),
            reel: self.reel.as_ref().zip(other.reel.as_ref()).map(|(a, b)| a.zip(b, f)),
            release: self.release.zip(&other.release, f),
            levels: from_fn(|i| f(self.levels[i], other.levels[i])),
        }
    }
}

impl<S: Scalar> DeviceLaw<S> {
    /// Tension of an open spool.
    pub(super) fn open_tension(&self) -> Option<S> {
        self.reel.as_ref().map(|reel| reel.tension)
    }

    /// Initial stored state for this tension of the first strap.
    pub(super) fn start(&self, time: S, tension: S) -> DevicePast<S> {
        let never = S::of(NEVER);
        let mut past = DevicePast { time, solution: tension, phase: S::of(Phase::LOCKED), ..DevicePast::none() };
        (past.lock_since, past.pull_since, past.switch_since, past.release_since) = (never, never, never, never);
        (past.lock_due, past.pull_due, past.switch_due) = (never, never, never);
        past.release_due = self.release.due;
        past.switch_due = self.second.as_ref().map_or(never, |second| second.1.due);
        if let Some(reel) = &self.reel {
            (past.phase, past.solution) = (S::of(Phase::OPEN), S::zero());
            past.lock_due = reel.lock.due;
            past.pull_due = reel.pull.as_ref().map_or(never, |pull| pull.cue.due);
        } else {
            self.lock(S::truth(true), S::zero(), tension, S::zero(), &mut past);
        }
        past
    }

    /// Share of the second limiter at a time.
    #[inline(always)]
    fn share(&self, time: S, past: &DevicePast<S>) -> S {
        let Some((_, _, over)) = &self.second else { return S::zero() };
        ((time - past.switch_due) / *over).clamp01()
    }

    /// Yield force of the limiter: webbing is paid out at it under any load.
    #[inline(always)]
    fn level(&self, share: S) -> S {
        let [first, second] = self.levels;
        if self.second.is_some() { first + (second - first) * share } else { first }
    }

    /// Limiter takes over in some lanes, at the present tension and payout: T₀ = Q(δ₀), p_L = p − δ₀. If the tension is
    /// above its level it begins to yield.
    #[inline(always)]
    fn lock(&self, locks: S::Mask, share: S, tension: S, payout: S, past: &mut DevicePast<S>) {
        past.phase = S::select(locks, S::of(Phase::LOCKED), past.phase);
        past.solution = S::select(locks, tension, past.solution);
        if let Some(limiter) = &self.limiter {
            let [level, other] = self.levels;
            let (mut delta, _, _) = limiter.reach(tension.min(level), past.greatest, limiter.set(past.greatest));
            if let (Some((second, ..)), true) = (&self.second, S::any(locks & share.gt(S::zero()))) {
                let (of_second, _, _) = second.reach(tension.min(other), past.greatest, second.set(past.greatest));
                let both = self.reach(share, tension.min(self.level(share)), [delta, of_second], past.greatest);
                delta = S::select(share.gt(S::zero()), both, delta);
            }
            past.greatest = S::select(locks, past.greatest.max(delta), past.greatest);
            past.base = S::select(locks, payout - delta, past.base);
            past.solution = S::select(locks, delta, past.solution);
        }
    }

    /// δ at which both limiters together have this tension, between the δ of each.
    #[inline(always)]
    fn reach(&self, share: S, tension: S, [a, b]: [S; 2], greatest: S) -> S {
        let (mut low, mut high) = (a.min(b), a.max(b));
        for _ in 0..HALVES {
            let middle = (low + high) * S::of(0.5);
            let is_below = self.limit(middle, greatest, share)[0].lt(tension);
            (low, high) = (S::select(is_below, middle, low), S::select(is_below, high, middle));
        }
        // nothing but the slopes is left to be done
        let [force, slope] = self.limit(high, greatest, share);
        let rest = tension - force;
        high + S::select(slope.gt(S::zero()), (rest - rest.value_alone()) / slope.value_alone(), S::zero())
    }

    /// Force of the limiters and its derivative at δ.
    #[inline(always)]
    pub(super) fn limit(&self, delta: S, greatest: S, share: S) -> [S; 2] {
        let Some(limiter) = &self.limiter else { return [S::zero(); 2] };
        let mut q = limiter.respond(delta, greatest);
        if let (Some((second, ..)), true) = (&self.second, S::any(share.gt(S::zero()))) {
            let other = second.respond(delta, greatest);
            q.force += (other.force - q.force) * share;
            q.slope += (other.slope - q.slope) * share;
        }
        [q.force, q.slope]
    }

    /// Feed of the first strap at a time; `payout` is that of the last commit.
    #[inline(always)]
    pub(super) fn feed(&self, time: S, past: &DevicePast<S>, payout: S) -> Feed<'_, S> {
        let o = S::zero();
        let is_locked = past.phase.gt(S::of(Phase::PULLING));
        let (mut is_open, mut tension, mut passed) = (S::truth(false), o, o);
        let share = self.share(time, past);
        if let Some(reel) = &self.reel {
            is_open = past.phase.lt(S::of(Phase::PULLING));
            tension = reel.tension;
            if let Some(pull) = &reel.pull {
                let is_pulling = !is_open & !is_locked;
                let given = pull.table.at(time - past.pull_due);
                if pull.by_force.is_some() {
                    let force = given.min(self.level(share));
                    (is_open, tension) = (is_open | is_pulling, S::select(is_pulling, force, tension));
                } else {
                    passed = S::select(is_pulling, past.mark - given - payout, o);
                }
            }
        }
        let is_limited = if self.limiter.is_some() { is_locked } else { S::truth(false) };
        let mut unknown = o;
        if let Some(law) = &self.limiter {
            unknown = law.unknown(past.greatest);
        }
        if let Some((second, ..)) = &self.second {
            unknown = S::select(share.lt(S::one()), unknown, o);
            unknown += S::select(share.gt(o), second.unknown(past.greatest), o);
        }
        Feed {
            law: self,
            is_open,
            is_limited,
            tension,
            passed,
            base: past.base - payout + unknown,
            greatest: past.greatest,
            share,
        }
    }

    /// Limits a pretensioner given by force: it only pulls in, at most at its largest speed; elsewhere, the amount
    /// passed instead since the last commit.
    #[inline(always)]
    pub(super) fn bounded(&self, feed: &Feed<'_, S>, past: &DevicePast<S>, time: S, passed: S) -> Option<(S::Mask, S)> {
        let speed = self.reel.as_ref()?.pull.as_ref()?.by_force?;
        let is_pulling = feed.is_open & past.phase.gt(S::of(Phase::LOCKING));
        let bound = passed.min(S::zero()).max(-(speed * (time - past.time)));
        Some((is_pulling & (bound.lt(passed) | passed.lt(bound)), bound))
    }

    /// Phases at an accepted step, from the tension of the first strap and the payout now and before.
    #[inline(always)]
    pub(super) fn commit(
        &self,
        time: S,
        tension: S,
        [payout, before]: [S; 2],
        (past, first): (&mut DevicePast<S>, &mut NodePast<S>),
    ) {
        let h = time - past.time;
        let mean = (payout - before) / h;
        let speed = first.pay(mean, h);
        past.average += (mean - past.average) * (S::one() - decay(h * S::of(1.0 / SENSOR_S)));
        let acceleration = (speed - past.average) * S::of(1.0 / SENSOR_S);
        past.speed = speed;
        let seen = [tension, payout, speed, acceleration];
        self.release.commit(time, &seen, &mut past.release_due, &mut past.release_since);
        past.free = S::select(!time.lt(past.release_due), S::one(), past.free);
        if let Some((_, cue, over)) = &self.second {
            cue.commit(time, &seen, &mut past.switch_due, &mut past.switch_since);
            let comes = |at: S| past.time.lt(at) & !time.lt(at);
            first.pay_anew(comes(past.switch_due) | comes(past.switch_due + *over));
        }
        if let Some(reel) = &self.reel {
            reel.lock.commit(time, &seen, &mut past.lock_due, &mut past.lock_since);
            let share = self.share(time, past);
            let stops = reel.commit_pull(time, &seen, self.level(share), past);
            let locks = stops | reel.commit_lock(time, payout, past);
            self.lock(locks, share, tension, payout, past);
            let is_pulling = past.phase.gt(S::of(Phase::LOCKING)) & past.phase.lt(S::of(Phase::LOCKED));
            past.solution = S::select(is_pulling, tension, past.solution);
            let by_force = reel.pull.as_ref().is_some_and(|pull| pull.by_force.is_some());
            let is_open = past.phase.lt(S::of(if by_force { Phase::LOCKED } else { Phase::PULLING }));
            past.solution = S::select(is_open, S::zero(), past.solution);
            self.follow(payout, past, first);
            first.pay_anew(locks);
            first.normal_z = S::select(locks, S::zero(), first.normal_z);
        } else {
            self.follow(payout, past, first);
        }
    }

    /// Updates the limiter at an accepted step.
    #[inline(always)]
    fn follow(&self, payout: S, past: &mut DevicePast<S>, first: &mut NodePast<S>) {
        if self.limiter.is_none() {
            return;
        }
        let (delta, is_locked) = (payout - past.base, past.phase.gt(S::of(Phase::PULLING)));
        let is_less = delta.lt(past.greatest);
        let is_back = (first.goes_back() & is_less) | (!first.goes_back() & past.speed.lt(S::of(-BACK_M_S)));
        first.normal_z = S::select(is_locked & is_back, S::one(), S::zero());
        past.greatest = S::select(is_locked, past.greatest.max(delta), past.greatest);
        past.solution = S::select(is_locked, delta, past.solution);
    }

    /// Recoverable energy of the limiter, J.
    #[inline(always)]
    pub(super) fn stored(&self, feed: &Feed<'_, S>, delta: S) -> S {
        let Some(limiter) = &self.limiter else { return S::zero() };
        let mut energy = limiter.stored(delta, feed.greatest);
        if let Some((second, ..)) = &self.second {
            energy += (second.stored(delta, feed.greatest) - energy) * feed.share;
        }
        S::select(feed.is_limited, energy, S::zero())
    }
}

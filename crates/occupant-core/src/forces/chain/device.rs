//! What holds the first node of a belt: an anchor, a limiter, or a spool with its phases.
//!
//! The march has one unknown x at the first node: its tension T₀ where the spool is held, the deformation δ of the limiter
//! (T₀ = Q(δ), p = p_L + δ), or the webbing Δp that has left since the last commit where the tension is given. Webbing fed
//! and tension never fall with x.

use super::data::{Cue, Device, NEVER, Pull, Reel, Watched};
use super::past::DevicePast;
use crate::forces::function::FunctionLaw;
use crate::motion::scalar::Scalar;

/// Time constant of the average that the acceleration of webbing is measured against, s.
const SENSOR_S: f64 = 5e-3;

/// Phases of the first node. Those of spools alone: open, locking, pulled in; what stands fast is locked.
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
    limiter: Option<FunctionLaw<S>>,
    second: Option<(FunctionLaw<S>, CueLaw<S>, S)>,
    reel: Option<ReelLaw<S>>,
    release: CueLaw<S>,
}

#[derive(Clone, Debug)]
struct ReelLaw<S> {
    on_spool: S,
    tension: S,
    lock: CueLaw<S>,
    lock_after: [S; 2],
    pull: Option<PullLaw<S>>,
}

#[derive(Clone, Debug)]
struct PullLaw<S> {
    cue: CueLaw<S>,
    table: Steps<S>,
    by_force: Option<S>,
    stall: S,
}

#[derive(Clone, Copy, Debug)]
struct CueLaw<S> {
    due: S,
    watch: Option<(Watched, [S; 3])>,
}

/// A table that is constant before its first and after its last row.
#[derive(Clone, Debug)]
pub(super) struct Steps<S>(Vec<[S; 2]>);

/// How tension and webbing fed at the first node follow from x.
pub(super) struct Feed<'a, S: Scalar> {
    law: &'a DeviceLaw<S>,
    /// Where x is Δp, and where it is δ; elsewhere it is T₀.
    pub(super) is_open: S::Mask,
    is_limited: S::Mask,
    tension: S,
    passed: S,
    /// p_L less the payout of the last commit.
    base: S,
    greatest: S,
    /// Share of the second limiter.
    share: S,
}

/// T₀ and Δp, and their derivatives.
pub(super) struct Fed<S> {
    pub(super) tension: S,
    pub(super) tension_rate: S,
    pub(super) passed: S,
    pub(super) passed_rate: S,
}

impl<S: Copy> CueLaw<S> {
    fn zip<A: Copy, T>(&self, other: &CueLaw<A>, f: &impl Fn(S, A) -> T) -> CueLaw<T> {
        let both = self.watch.iter().zip(&other.watch).next();
        let watch = both.map(|((of, a), (_, b))| (*of, std::array::from_fn(|i| f(a[i], b[i]))));
        CueLaw { due: f(self.due, other.due), watch }
    }
}

impl<S: Copy> Steps<S> {
    pub(super) fn zip<A: Copy, T>(&self, other: &Steps<A>, f: &impl Fn(S, A) -> T) -> Steps<T> {
        Steps(self.0.iter().zip(&other.0).map(|(a, b)| [f(a[0], b[0]), f(a[1], b[1])]).collect())
    }

    pub(super) fn len(&self) -> usize {
        self.0.len()
    }
}

impl<S: Scalar> Steps<S> {
    pub(super) fn new(rows: &[[f64; 2]]) -> Self {
        Steps(rows.iter().map(|row| row.map(S::of)).collect())
    }

    /// Value at a time.
    #[inline(always)]
    pub(super) fn at(&self, time: S) -> S {
        let Some(first) = self.0.first() else { return S::zero() };
        let rows = self.0.iter().zip(self.0.iter().skip(1));
        rows.fold(first[1], |value, (a, b)| value + (b[1] - a[1]) * ((time - a[0]) / (b[0] - a[0])).clamp01())
    }

    #[inline(always)]
    fn end(&self) -> S {
        self.0.last().map_or(S::zero(), |row| row[0])
    }
}

impl<S: Scalar> CueLaw<S> {
    fn new(cue: &Cue) -> Self {
        let watch = cue.watch.map(|w| (w.of, [w.threshold, w.lasting_s, w.delay_s].map(S::of)));
        CueLaw { due: S::of(cue.due_s), watch }
    }

    /// When it is due and since when its condition holds; `seen` are the quantities in the order of [`Watched`].
    #[inline(always)]
    fn commit(&self, time: S, seen: &[S; 4], due: &mut S, since: &mut S) {
        let Some((of, [threshold, lasting, delay])) = self.watch else { return };
        let holds = !seen[of as usize].lt(threshold);
        *since = S::select(holds, since.min(time), S::of(NEVER));
        let fires = holds & !(time - *since).lt(lasting) & due.gt(S::of(0.5 * NEVER));
        *due = S::select(fires, time + delay, *due);
    }
}

impl DeviceLaw<f64> {
    pub(super) fn new(data: &Device, release: &Cue) -> Self {
        let pull = |pull: &Pull| PullLaw {
            cue: CueLaw::new(&pull.cue),
            table: Steps::new(&pull.table),
            by_force: pull.by_force,
            stall: pull.stall_n,
        };
        let reel = |reel: &Reel| ReelLaw {
            on_spool: reel.on_spool_m,
            tension: reel.tension_n,
            lock: CueLaw::new(&reel.lock),
            lock_after: reel.lock_after,
            pull: reel.pull.as_ref().map(pull),
        };
        DeviceLaw {
            limiter: data.limiter.as_ref().map(FunctionLaw::new),
            second: data.second.as_ref().map(|(law, cue, over)| (FunctionLaw::new(law), CueLaw::new(cue), *over)),
            reel: data.reel.as_ref().map(reel),
            release: CueLaw::new(release),
        }
    }
}

impl<S: Copy> DeviceLaw<S> {
    /// What must be equal for two to be computed side by side.
    pub(super) fn shape(&self) -> Vec<Option<usize>> {
        let watch = |cue: &CueLaw<S>| cue.watch.map(|(of, _)| of as usize);
        let pull = self.reel.as_ref().and_then(|reel| reel.pull.as_ref());
        vec![
            self.limiter.as_ref().map(FunctionLaw::len),
            self.second.as_ref().map(|(law, ..)| law.len()),
            self.second.as_ref().and_then(|(_, cue, _)| watch(cue)),
            self.reel.as_ref().map(|_| 0),
            self.reel.as_ref().and_then(|reel| watch(&reel.lock)),
            pull.map(|pull| pull.table.len()),
            pull.and_then(|pull| pull.by_force).map(|_| 0),
            pull.and_then(|pull| watch(&pull.cue)),
            watch(&self.release),
        ]
    }

    pub(super) fn zip<A: Copy, T>(&self, other: &DeviceLaw<A>, f: &impl Fn(S, A) -> T) -> DeviceLaw<T> {
        let pull = |(a, b): (&PullLaw<S>, &PullLaw<A>)| PullLaw {
            cue: a.cue.zip(&b.cue, f),
            table: a.table.zip(&b.table, f),
            by_force: a.by_force.zip(b.by_force).map(|(a, b)| f(a, b)),
            stall: f(a.stall, b.stall),
        };
        let reel = |(a, b): (&ReelLaw<S>, &ReelLaw<A>)| ReelLaw {
            on_spool: f(a.on_spool, b.on_spool),
            tension: f(a.tension, b.tension),
            lock: a.lock.zip(&b.lock, f),
            lock_after: std::array::from_fn(|i| f(a.lock_after[i], b.lock_after[i])),
            pull: a.pull.as_ref().zip(b.pull.as_ref()).map(pull),
        };
        let second = self.second.as_ref().zip(other.second.as_ref());
        DeviceLaw {
            limiter: self.limiter.as_ref().zip(other.limiter.as_ref()).map(|(a, b)| a.zip(b, f)),
            second: second.map(|(a, b)| (a.0.zip(&b.0, f), a.1.zip(&b.1, f), f(a.2, b.2))),
            reel: self.reel.as_ref().zip(other.reel.as_ref()).map(reel),
            release: self.release.zip(&other.release, f),
        }
    }
}

impl<S: Scalar> DeviceLaw<S> {
    /// Tension of an open spool.
    pub(super) fn open_tension(&self) -> Option<S> {
        self.reel.as_ref().map(|reel| reel.tension)
    }

    /// What it remembers at the start, where the first strap has this tension.
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
            self.lock(S::truth(true), tension, S::zero(), &mut past);
        }
        past
    }

    /// The limiter takes over in some lanes, with the tension and the payout that there are: T₀ = Q(δ₀), p_L = p − δ₀.
    fn lock(&self, locks: S::Mask, tension: S, payout: S, past: &mut DevicePast<S>) {
        past.phase = S::select(locks, S::of(Phase::LOCKED), past.phase);
        past.solution = S::select(locks, tension, past.solution);
        if let Some(limiter) = &self.limiter {
            let (delta, _, _) = limiter.reach(tension, past.greatest, limiter.set(past.greatest));
            past.greatest = S::select(locks, past.greatest.max(delta), past.greatest);
            past.base = S::select(locks, payout - delta, past.base);
            past.solution = S::select(locks, delta, past.solution);
        }
    }

    /// How the first strap is fed at a time; `payout` is that of the last commit.
    #[inline(always)]
    pub(super) fn feed(&self, time: S, past: &DevicePast<S>, payout: S) -> Feed<'_, S> {
        let o = S::zero();
        let is_locked = past.phase.gt(S::of(Phase::PULLING));
        let (mut is_open, mut tension, mut passed) = (S::truth(false), o, o);
        if let Some(reel) = &self.reel {
            is_open = past.phase.lt(S::of(Phase::PULLING));
            tension = reel.tension;
            if let Some(pull) = &reel.pull {
                let is_pulling = !is_open & !is_locked;
                let given = pull.table.at(time - past.pull_due);
                if pull.by_force.is_some() {
                    (is_open, tension) = (is_open | is_pulling, S::select(is_pulling, given, tension));
                } else {
                    passed = S::select(is_pulling, past.mark - given - payout, o);
                }
            }
        }
        let is_limited = if self.limiter.is_some() { is_locked } else { S::truth(false) };
        let share = self.second.as_ref().map_or(o, |second| ((time - past.switch_due) / second.2).clamp01());
        Feed {
            law: self,
            is_open,
            is_limited,
            tension,
            passed,
            base: past.base - payout,
            greatest: past.greatest,
            share,
        }
    }

    /// A pretensioner that pulls by force takes webbing in only, and not faster than it can: where webbing passed since the
    /// last commit is outside, how much passes instead.
    #[inline(always)]
    pub(super) fn bounded(&self, feed: &Feed<'_, S>, past: &DevicePast<S>, time: S, passed: S) -> Option<(S::Mask, S)> {
        let speed = self.reel.as_ref()?.pull.as_ref()?.by_force?;
        let is_pulling = feed.is_open & past.phase.gt(S::of(Phase::LOCKING));
        let bound = passed.min(S::zero()).max(-(speed * (time - past.time)));
        Some((is_pulling & (bound.lt(passed) | passed.lt(bound)), bound))
    }

    /// Phases at an accepted step, with the tension of the first strap and the payout now and before.
    pub(super) fn commit(&self, time: S, tension: S, [payout, before]: [S; 2], past: &mut DevicePast<S>) {
        let h = time - past.time;
        let speed = (payout - before) / h;
        let acceleration = (speed - past.average) * S::of(1.0 / SENSOR_S);
        past.average += (speed - past.average) * (h / (S::of(SENSOR_S) + h));
        past.speed = speed;
        let seen = [tension, payout, speed, acceleration];
        self.release.commit(time, &seen, &mut past.release_due, &mut past.release_since);
        past.free = S::select(!time.lt(past.release_due), S::one(), past.free);
        if let Some((_, cue, _)) = &self.second {
            cue.commit(time, &seen, &mut past.switch_due, &mut past.switch_since);
        }
        if let Some(reel) = &self.reel {
            reel.lock.commit(time, &seen, &mut past.lock_due, &mut past.lock_since);
            let stops = reel.commit_pull(time, &seen, past);
            let locks = reel.commit_lock(time, payout, past);
            self.lock(stops | locks, tension, payout, past);
            let is_pulling = past.phase.gt(S::of(Phase::LOCKING)) & past.phase.lt(S::of(Phase::LOCKED));
            past.solution = S::select(is_pulling, tension, past.solution);
            let by_force = reel.pull.as_ref().is_some_and(|pull| pull.by_force.is_some());
            let is_open = past.phase.lt(S::of(if by_force { Phase::LOCKED } else { Phase::PULLING }));
            past.solution = S::select(is_open, S::zero(), past.solution);
        }
        if self.limiter.is_some() {
            let is_locked = past.phase.gt(S::of(Phase::PULLING));
            past.greatest = S::select(is_locked, past.greatest.max(payout - past.base), past.greatest);
            past.solution = S::select(is_locked, payout - past.base, past.solution);
        }
    }

    /// Recoverable energy of the limiter, J.
    pub(super) fn stored(&self, feed: &Feed<'_, S>, delta: S) -> S {
        let Some(limiter) = &self.limiter else { return S::zero() };
        let energy = |law: &FunctionLaw<S>| law.returned_to(law.respond(delta, feed.greatest).loading)[1];
        let first = energy(limiter);
        let both = self.second.as_ref().map_or(first, |second| first + (energy(&second.0) - first) * feed.share);
        S::select(feed.is_limited, both, S::zero())
    }
}

impl<S: Scalar> ReelLaw<S> {
    /// Where the pretensioner comes to its end; it begins where it is due.
    fn commit_pull(&self, time: S, seen: &[S; 4], past: &mut DevicePast<S>) -> S::Mask {
        let Some(pull) = &self.pull else { return S::truth(false) };
        let [tension, payout, speed, _] = *seen;
        pull.cue.commit(time, seen, &mut past.pull_due, &mut past.pull_since);
        let is_pulling = past.phase.gt(S::of(Phase::LOCKING)) & past.phase.lt(S::of(Phase::LOCKED));
        let age = time - past.pull_due;
        let mut stops = !age.lt(pull.table.end()) | !tension.lt(pull.stall);
        if pull.by_force.is_some() {
            stops = stops | (!speed.lt(S::zero()) & tension.gt(pull.table.at(age)));
        }
        let stops = stops & is_pulling;
        let fires = !age.lt(S::zero()) & !past.pulled.gt(S::zero());
        past.phase = S::select(fires, S::of(Phase::PULLING), past.phase);
        past.mark = S::select(fires, payout, past.mark);
        past.pulled = S::select(fires, S::one(), past.pulled);
        stops
    }

    /// Where an open spool locks; it begins to where its trigger has fired.
    fn commit_lock(&self, time: S, payout: S, past: &mut DevicePast<S>) -> S::Mask {
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

impl<S: Scalar> Feed<'_, S> {
    /// The same with Δp given in some lanes.
    #[inline(always)]
    pub(super) fn given(self, mask: S::Mask, passed: S) -> Self {
        Feed { is_open: self.is_open & !mask, passed: S::select(mask, passed, self.passed), ..self }
    }

    /// The least x at which the belt has any tension.
    #[inline(always)]
    pub(super) fn least(&self) -> S {
        let Some(limiter) = &self.law.limiter else { return S::zero() };
        let foot = limiter.set(self.greatest);
        let foot = self.law.second.as_ref().map_or(foot, |(second, ..)| {
            let other = second.set(self.greatest);
            let part = S::select(self.share.lt(S::one()), foot.min(other), other);
            S::select(self.share.gt(S::zero()), part, foot)
        });
        S::select(self.is_limited, foot, S::zero())
    }

    #[inline(always)]
    pub(super) fn at(&self, x: S) -> Fed<S> {
        let (o, one) = (S::zero(), S::one());
        let mut fed = Fed { tension: x, tension_rate: one, passed: self.passed, passed_rate: o };
        if let Some(limiter) = &self.law.limiter {
            let mut q = limiter.respond(x, self.greatest);
            if let (Some((second, ..)), true) = (&self.law.second, S::any(self.share.gt(o))) {
                let other = second.respond(x, self.greatest);
                q.force += (other.force - q.force) * self.share;
                q.slope += (other.slope - q.slope) * self.share;
            }
            fed.tension = S::select(self.is_limited, q.force, fed.tension);
            fed.tension_rate = S::select(self.is_limited, q.slope, fed.tension_rate);
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

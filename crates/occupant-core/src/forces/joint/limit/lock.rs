//! Locks: a joint keeps its posture until a moment is reached.
//!
//! A rotational spring to the posture at locking: with ρ, the rotation vector from it, the torque is −Kρ and its
//! potential ½K|ρ|². When K|ρ| has reached T_y at an accepted step, the lock opens and its stored energy is lost. A
//! lock that slips keeps its torque at T_y, and its posture follows along ρ so that K|ρ| = T_y; it loses T_y for each
//! radian.

use super::super::posture::{Posture, length};
use super::LimitAction;
use crate::forces::element::passes;
use crate::motion::scalar::Scalar;
use crate::motion::vector::{M3, V3, v3};

/// Time below the relock speed after which an open lock closes, s.
const CALM_S: f64 = 5e-3;

/// A lock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lock<S> {
    /// T_y, N·m.
    pub until: S,
    /// K, N·m/rad.
    pub stiffness: S,
    /// Whether the lock slips instead of opening.
    pub slips: bool,
    /// Speed below which it closes again, rad/s; 0: never.
    pub relock_below: S,
}

/// Memory of a lock between steps; all 0 without a lock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LockPast<S> {
    /// 1: closed; −1: open, below the relock speed; 0: open, above it.
    pub(super) closed: S,
    /// Posture that the lock holds.
    pub(super) held: Posture<S>,
    /// Latest time at which it was closed or turned fast, s.
    pub(super) restless: S,
    /// Speed of the joint while the lock is open, rad/s.
    pub(super) speed: S,
    /// Energy dissipated since the start, J.
    pub(super) lost: S,
}

/// The two segments of a joint.
pub(super) struct Pair<'a, S> {
    /// Axes of the inner and the outer segment.
    pub(super) axes: (&'a M3<S>, &'a M3<S>),
    /// Angular velocity of the outer segment relative to the inner, space axes, rad/s.
    pub(super) omega: V3<S>,
    pub(super) time: S,
    pub(super) accepted: bool,
}

impl<S: Copy> Lock<S> {
    pub(super) fn zip<A: Copy, T>(&self, other: &Lock<A>, f: &impl Fn(S, A) -> T) -> Lock<T> {
        Lock {
            until: f(self.until, other.until),
            stiffness: f(self.stiffness, other.stiffness),
            slips: self.slips,
            relock_below: f(self.relock_below, other.relock_below),
        }
    }
}

impl<S> LockPast<S> {
    /// Calls f with each pair of corresponding numbers of two memories.
    pub(super) fn each<A>(&mut self, other: &mut LockPast<A>, f: &mut impl FnMut(&mut S, &mut A)) {
        let (Posture(held), Posture(others)) = (&mut self.held, &mut other.held);
        f(&mut self.closed, &mut other.closed);
        for (a, b) in [(&mut held.x, &mut others.x), (&mut held.y, &mut others.y), (&mut held.z, &mut others.z)] {
            f(&mut a.x, &mut b.x);
            f(&mut a.y, &mut b.y);
            f(&mut a.z, &mut b.z);
        }
        f(&mut self.restless, &mut other.restless);
        f(&mut self.speed, &mut other.speed);
        f(&mut self.lost, &mut other.lost);
    }
}

impl<A: Copy> LockPast<A> {
    /// Memory with each number replaced by f of it, in the order of [`LockPast::each`].
    pub(super) fn map<S>(&self, f: &mut impl FnMut(A) -> S) -> LockPast<S> {
        let closed = f(self.closed);
        let Posture(M3 { x, y, z }) = self.held;
        let mut axis = |v: V3<A>| v3(f(v.x), f(v.y), f(v.z));
        let held = Posture(M3 { x: axis(x), y: axis(y), z: axis(z) });
        LockPast { closed, held, restless: f(self.restless), speed: f(self.speed), lost: f(self.lost) }
    }
}

impl<S: Scalar<Mask = bool>> LockPast<S> {
    /// Fraction of the step at which a lock was due to close, or a joint crossed the relock speed; a lock that opens
    /// does not record its time.
    pub(super) fn due(&self, now: &Self, lock: &Lock<S>, times_s: [S; 2]) -> Option<S> {
        let is_calm = |past: &Self| past.closed.lt(S::zero());
        let closes = || passes(self.restless + S::of(CALM_S), times_s[0], times_s[1]);
        match [self.is_closed(), now.is_closed()] {
            [false, true] if is_calm(self) => Some(closes()),
            [false, false] if is_calm(now) => Some(passes(-lock.relock_below, -self.speed, -now.speed)),
            // it may have closed before it was fast
            [false, false] => Some(passes(lock.relock_below, self.speed, now.speed).min(closes())),
            _ => None,
        }
    }
}

impl<S: Scalar> LockPast<S> {
    /// Memory without a lock.
    pub(super) fn none() -> Self {
        let (o, none) = (S::zero(), V3::zero());
        LockPast { closed: o, held: Posture(M3 { x: none, y: none, z: none }), restless: o, speed: o, lost: o }
    }

    /// Closed in the present posture.
    pub(super) fn start(pair: &Pair<'_, S>) -> Self {
        let (k, l) = pair.axes;
        LockPast { closed: S::one(), held: Posture::new(k, l, V3::zero()), ..LockPast::none() }
    }

    #[inline(always)]
    fn is_closed(&self) -> S::Mask {
        self.closed.gt(S::zero())
    }
}

impl<S: Scalar> Lock<S> {
    /// Action of the lock, and the lanes in which it is closed. At an accepted step it first updates the memory with
    /// the present posture.
    #[inline(always)]
    pub(super) fn act(&self, pair: &Pair<'_, S>, past: &mut LockPast<S>, action: &mut LimitAction<S>) -> S::Mask {
        if pair.accepted {
            self.commit(pair, past);
        }
        let closed = past.is_closed();
        action.lost += past.lost;
        if S::any(closed) {
            let (moment, stored) = self.respond(pair, past);
            (action.lock, action.closed) = (moment, past.closed.max(S::zero()));
            action.stored += stored;
        }
        closed
    }

    #[inline(always)]
    fn commit(&self, pair: &Pair<'_, S>, past: &mut LockPast<S>) {
        let ((k, l), closed) = (pair.axes, past.is_closed());
        let turned = past.held.turned_to(k, l);
        let (angle, most) = (length(turned), self.until / self.stiffness);
        // beyond by more than rounding: a commit of the same posture, as at the start of a resumed run, changes nothing
        let yields = closed & angle.gt(most * S::of(1.0 + 1e-9));
        if self.slips {
            let followed = Posture::new(k, l, turned * (most / angle));
            past.held = followed.zip(&past.held, &|new, old| S::select(yields, new, old));
            past.lost = S::select(yields, past.lost + self.until * (angle - most), past.lost);
            return;
        }
        past.lost = S::select(yields, past.lost + self.stored(angle), past.lost);
        let (o, speed, was_calm) = (S::zero(), length(pair.omega), past.closed.lt(S::zero()));
        let is_fast = !speed.lt(self.relock_below);
        past.restless = S::select(is_fast | !was_calm, pair.time, past.restless);
        let closes = was_calm & !is_fast & !(pair.time - past.restless).lt(S::of(CALM_S));
        past.held = Posture::new(k, l, V3::zero()).zip(&past.held, &|new, old| S::select(closes, new, old));
        let stays = closes | closed & !yields;
        past.closed = S::select(stays, S::one(), S::select(is_fast, o, -S::one()));
        past.speed = S::select(stays, o, speed);
    }

    /// Moment on the outer segment, space axes, and stored energy; zero if the lock is open.
    #[inline(always)]
    pub(super) fn respond(&self, pair: &Pair<'_, S>, past: &LockPast<S>) -> (V3<S>, S) {
        let (k, l) = pair.axes;
        let (turned, o) = (past.held.turned_to(k, l), S::zero());
        let angle = length(turned);
        let most = if self.slips { self.until / angle } else { self.stiffness };
        let closed = past.is_closed();
        let moment = -(turned * self.stiffness.min(most));
        (V3::select(closed, moment, V3::zero()), S::select(closed, self.stored(angle), o))
    }

    /// ½K|ρ|².
    #[inline(always)]
    fn stored(&self, angle: S) -> S {
        S::of(0.5) * self.stiffness * angle * angle
    }
}

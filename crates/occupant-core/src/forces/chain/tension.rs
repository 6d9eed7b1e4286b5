//! Straps with given lengths: their tensions, and the memory of straps and first node.
//!
//! A metre of unstretched webbing carries P = T(1 + ε) − w away from a strap, w its recoverable energy. The loss where
//! webbing passes is the difference of P on both sides times the webbing that passes.

use super::MOST_NODES;
use super::data::{Chain, NEVER, Rest};
use super::device::{DeviceLaw, Moment, Phase};
use super::feed::Feed;
use super::march::{Run, Solved, Tense, solve};
use super::past::{BACK_PER_S, ChainPast, NodePast};
use crate::forces::decay::decay;
use crate::forces::element::passes;
use crate::forces::function::FunctionLaw;
use crate::motion::scalar::Scalar;

/// Constants of webbing.
#[derive(Clone, Debug)]
pub(super) struct WebbingLaw<S> {
    curve: FunctionLaw<S>,
    /// Whether unloading matters: it is lossy and no limiter yields with it.
    turns: bool,
    /// κ, N, and τ, s, of a Maxwell element: κe with ė = ε̇ − e/τ.
    viscous: Option<[S; 2]>,
}

/// Constants of the straps of a chain.
#[derive(Clone, Debug)]
pub(super) struct Straps<S> {
    /// The node at the start of each, and μ there.
    pub(super) starts: Vec<usize>,
    pub(super) friction: Vec<S>,
    pub(super) webbing: WebbingLaw<S>,
    pub(super) device: DeviceLaw<S>,
    strength: S,
    rest: Rest,
}

/// Straps at one instant.
pub(super) struct Taut<'a, S: Scalar> {
    pub(super) runs: &'a [Run<S>],
    pub(super) straps: &'a [Tense<S>],
    pub(super) feed: Feed<'a, S>,
    pub(super) solved: Solved<S>,
}

/// Room for the straps of a chain.
#[derive(Clone, Debug)]
pub(super) struct Web<S> {
    runs: [Run<S>; MOST_NODES],
    straps: [Tense<S>; MOST_NODES],
}

impl<S: Scalar> Web<S> {
    pub(super) fn new() -> Self {
        Web { runs: [Run::none(); MOST_NODES], straps: [Tense::none(); MOST_NODES] }
    }
}

/// Webbing geometry: lengths of the straps, θ at the start of each, and distance carried by a sphere's surface beyond
/// the arc, as a fraction of the previous strap.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course<S> {
    pub(super) lengths: [S; MOST_NODES],
    pub(super) turns: [S; MOST_NODES],
    pub(super) carried: [S; MOST_NODES],
}

impl<S: Scalar> Course<S> {
    #[inline(always)]
    pub(super) fn none() -> Self {
        let none = [S::zero(); MOST_NODES];
        Course { lengths: none, turns: none, carried: none }
    }

    #[inline(always)]
    pub(super) fn clear(&mut self) {
        for numbers in [&mut self.lengths, &mut self.turns, &mut self.carried] {
            numbers.fill(S::zero());
        }
    }
}

impl<S: Scalar> Taut<'_, S> {
    /// Energy lost as webbing carried by a surface from the previous strap into this one stretches, J: P of this minus
    /// P of that per unstretched length, minus the difference of tensions times its length.
    #[inline(always)]
    fn stretched(&self, strap: usize, more: S) -> S {
        let (from, to) = (&self.straps[strap - 1], &self.straps[strap]);
        let length = self.runs[strap - 1].length;
        self.runs[strap].carried * (more * from.unstretched - (to.tension - from.tension) * length)
    }
}

impl WebbingLaw<f64> {
    fn new(chain: &Chain) -> Self {
        let curve = FunctionLaw::new(&chain.webbing);
        WebbingLaw { turns: curve.is_lossy() && chain.device.limiter.is_none(), curve, viscous: chain.viscous }
    }
}

impl<S: Copy> WebbingLaw<S> {
    fn zip<A: Copy, T>(&self, other: &WebbingLaw<A>, f: &impl Fn(S, A) -> T) -> WebbingLaw<T> {
        let viscous = self.viscous.zip(other.viscous);
        WebbingLaw {
            curve: self.curve.zip(&other.curve, f),
            turns: self.turns,
            viscous: viscous.map(|([a, b], [c, d])| [f(a, c), f(b, d)]),
        }
    }
}

impl<S: Scalar> WebbingLaw<S> {
    /// Strain at a tension, its derivative by the tension, and x*.
    #[inline(always)]
    pub(super) fn reach(&self, tension: S, run: &Run<S>) -> (S, S, S) {
        match self.viscous {
            None => self.curve.reach(tension, run.greatest, run.set),
            Some(_) => self.curve.reach_beside(tension, run.greatest, run.set, run.beside),
        }
    }

    /// Strain at which tension begins.
    #[inline(always)]
    pub(super) fn foot(&self, run: &Run<S>) -> S {
        if self.viscous.is_some() { self.reach(S::zero(), run).0 } else { run.set }
    }

    /// The Maxwell element a time h after the last commit as a spring, exact for a constant strain rate since: with a =
    /// exp(−h/τ) and b = (1 − a)τ/h, e = a eᶜ + b (ε − εᶜ). Its stiffness κb and the unloaded strain.
    #[inline(always)]
    fn beside(&self, h: S, past: &NodePast<S>) -> [S; 2] {
        let Some([stiffness, time]) = self.viscous else { return [S::zero(); 2] };
        let y = h / time;
        let a = decay(y);
        let small = y.lt(S::of(1e-6));
        let b = S::select(small, S::one() - y * S::of(0.5), (S::one() - a) / y.max(S::of(1e-12)));
        [stiffness * b, past.strain - past.viscous * a / b]
    }
}

impl Straps<f64> {
    /// Straps that start at these nodes.
    pub(super) fn new(chain: &Chain, starts: Vec<usize>) -> Self {
        Straps {
            friction: starts.iter().map(|&node| chain.nodes[node].friction).collect(),
            starts,
            webbing: WebbingLaw::new(chain),
            device: DeviceLaw::new(&chain.device, &chain.release),
            strength: chain.strength_n,
            rest: chain.rest,
        }
    }

    /// Reports a curve that was exceeded: of the webbing, or of its limiter.
    pub(super) fn overrun(&self, belt: &str, strain: f64, limiter_m: f64) -> Option<String> {
        let webbing = format!("the webbing of the belt {belt}");
        let stretched = self.webbing.curve.overrun(&webbing, strain, |strain| format!("{:.2} %", 1e2 * strain));
        stretched.or_else(|| self.device.overrun(&format!("the limiter of the belt {belt}"), limiter_m))
    }

    /// Initial strain of all straps, for a belt with the total length `whole`, m.
    pub(super) fn start_strain(&self, whole: f64) -> f64 {
        let of_tension = |tension| self.webbing.curve.reach(tension, 0.0, 0.0).0;
        match (self.device.open_tension(), self.rest) {
            (Some(tension), _) | (None, Rest::Pretension(tension)) => of_tension(tension),
            (None, Rest::Slack(slack)) => whole / (whole + slack) - 1.0,
            (None, Rest::Length(length)) => whole / length - 1.0,
        }
    }

    /// Stored state of straps at this strain.
    pub(super) fn start(&self, time_s: f64, strain: f64, lengths: &[f64; MOST_NODES], past: &mut ChainPast<f64>) {
        let greatest = strain.max(0.0);
        let response = self.webbing.curve.respond(strain, greatest);
        past.device = self.device.start(time_s, response.force);
        for (strap, &node) in self.starts.iter().enumerate() {
            let past = &mut past.nodes[node];
            past.unstretched = lengths[strap] / (1.0 + strain);
            (past.greatest, past.strain) = (greatest, greatest);
            past.carried = response.force * (1.0 + strain) - self.webbing.curve.returned_to(response.loading)[1];
        }
    }
}

impl Straps<f64> {
    pub(super) fn can_switch(&self) -> bool {
        self.strength < NEVER || self.webbing.turns || self.device.can_switch()
    }
}

impl<S: Scalar<Mask = bool>> Straps<S> {
    /// Tension of a strap at a commit, from its stored state.
    fn tension(&self, past: &NodePast<S>) -> S {
        let beside = self.webbing.viscous.map_or(S::zero(), |[stiffness, _]| stiffness * past.viscous);
        (self.webbing.curve.respond(past.strain, past.greatest).force + beside).max(S::zero())
    }

    /// Fraction between two commits at which the device was due to switch, or a strap to tear.
    pub(super) fn due(&self, before: &ChainPast<S>, now: &ChainPast<S>) -> Option<S> {
        let first = |past: &NodePast<S>| self.tension(past);
        let [from, to] = [before, now].map(|past| Moment {
            past: &past.device,
            first: &past.nodes[0],
            tension: first(&past.nodes[0]),
        });
        let greatest = |past: &ChainPast<S>| {
            self.starts.iter().fold(S::zero(), |most: S, &node| most.max(self.tension(&past.nodes[node])))
        };
        let [a, b] = [before, now].map(greatest);
        let tears =
            (before.device.free.lt(now.device.free) && b.gt(self.strength)).then(|| passes(self.strength, a, b));
        let turns = self.starts.iter().filter_map(|&node| Self::turns(&before.nodes[node], &now.nodes[node]));
        self.device.due(&from, &to).into_iter().chain(tears).chain(turns).reduce(S::min)
    }

    /// Fraction between two commits at which a strap was due to unload, or to reload.
    fn turns(before: &NodePast<S>, now: &NodePast<S>) -> Option<S> {
        match [before, now].map(|past| past.back.gt(S::zero())) {
            [false, true] => Some(passes(S::of(BACK_PER_S), -before.rate, -now.rate)),
            [true, false] => Some(passes(before.greatest, before.strain, now.strain)),
            _ => None,
        }
    }
}

impl<S: Copy> Straps<S> {
    pub(super) fn is_like<A: Copy>(&self, other: &Straps<A>) -> bool {
        self.webbing.viscous.is_some() == other.webbing.viscous.is_some()
            && self.webbing.turns == other.webbing.turns
            && self.webbing.curve.len() == other.webbing.curve.len()
            && self.device.shape() == other.device.shape()
    }

    pub(super) fn zip<A: Copy, T>(&self, other: &Straps<A>, f: &impl Fn(S, A) -> T) -> Straps<T> {
        Straps {
            starts: self.starts.clone(),
            friction: self.friction.iter().zip(&other.friction).map(|(a, b)| f(*a, *b)).collect(),
            webbing: self.webbing.zip(&other.webbing, f),
            device: self.device.zip(&other.device, f),
            strength: f(self.strength, other.strength),
            rest: self.rest,
        }
    }
}

impl<S: Scalar> Straps<S> {
    /// The straps at one instant, from their stored state, in this room.
    #[inline(always)]
    pub(super) fn taut<'a>(
        &'a self,
        time: S,
        course: &Course<S>,
        past: &ChainPast<S>,
        web: &'a mut Web<S>,
    ) -> Taut<'a, S> {
        let Web { runs, straps } = web;
        for (strap, &node) in self.starts.iter().enumerate() {
            let (own, run) = (&past.nodes[node], &mut runs[strap]);
            *run = Run::none();
            run.length = course.lengths[strap] + self.webbing.curve.unknown(own.greatest);
            run.before = own.unstretched;
            (run.greatest, run.play) = (own.greatest, own.play);
            run.set = self.webbing.curve.set(own.greatest);
            run.beside = self.webbing.beside(time - past.device.time, own);
            if strap > 0 {
                run.grip = self.friction[strap] * course.turns[strap];
                run.hold = decay(run.grip);
                run.carried = course.carried[strap];
            }
        }
        let feed = self.device.feed(time, &past.device, past.nodes[0].fed);
        let (runs, straps) = (&runs[..self.starts.len()], &mut straps[..self.starts.len()]);
        let is_free = past.device.free.gt(S::zero());
        let solved = solve(&self.webbing, &feed, runs, past.device.solution, is_free, straps);
        if let Some((mask, passed)) = self.device.bounded(&feed, &past.device, time, straps[0].fed)
            && S::any(mask)
        {
            let start = S::select(mask, straps[0].tension, past.device.solution);
            let feed = feed.given(mask, passed);
            let solved = solve(&self.webbing, &feed, runs, start, is_free, straps);
            return Taut { runs, straps, feed, solved };
        }
        Taut { runs, straps, feed, solved }
    }

    /// e of a strap's viscous element.
    #[inline(always)]
    fn viscous(&self, taut: &Taut<'_, S>, strap: usize) -> S {
        let Some([stiffness, _]) = self.webbing.viscous else { return S::zero() };
        let [kappa, rest] = taut.runs[strap].beside;
        kappa / stiffness * (taut.straps[strap].strain - rest)
    }

    /// Recoverable energy of a metre of unstretched webbing of a strap, N.
    #[inline(always)]
    fn stored_per_metre(&self, taut: &Taut<'_, S>, strap: usize) -> S {
        let e = self.viscous(taut, strap);
        let [stiffness, _] = self.webbing.viscous.unwrap_or([S::zero(); 2]);
        self.webbing.curve.returned_to(taut.straps[strap].loading)[1] + stiffness * e * e * S::of(0.5)
    }

    /// Recoverable energy of a strap, J; the first includes the limiter.
    #[inline(always)]
    pub(super) fn stored(&self, taut: &Taut<'_, S>, strap: usize) -> S {
        let webbing = taut.straps[strap].unstretched * self.stored_per_metre(taut, strap);
        if strap == 0 { webbing + self.device.stored(&taut.feed, taut.feed.delta(taut.solved.x)) } else { webbing }
    }

    /// Recoverable energy of all straps and the limiter, J.
    #[inline(always)]
    pub(super) fn stored_in_all(&self, taut: &Taut<'_, S>) -> S {
        let mut sum = S::zero();
        for strap in 0..self.starts.len() {
            sum += self.stored(taut, strap);
        }
        sum
    }

    /// Σ (P_j − P_{j−1}) Δs_j with the mean of old and new, J: dissipated where webbing has passed since the last
    /// commit.
    #[inline(always)]
    pub(super) fn passing(&self, taut: &Taut<'_, S>, past: &ChainPast<S>) -> S {
        let (mut sum, mut before) = (S::zero(), S::zero());
        for (strap, &node) in self.starts.iter().enumerate() {
            let tense = &taut.straps[strap];
            let both = self.carried(taut, strap) + past.nodes[node].carried;
            sum += if strap > 0 { S::of(0.5) * (both - before) * tense.fed } else { S::zero() };
            before = both;
        }
        sum
    }

    /// P of a strap.
    #[inline(always)]
    fn carried(&self, taut: &Taut<'_, S>, strap: usize) -> S {
        let tense = &taut.straps[strap];
        tense.tension * (S::one() + tense.strain) - self.stored_per_metre(taut, strap)
    }

    /// Stores in `next` an accepted step that began with `past`.
    #[inline(always)]
    pub(super) fn commit(&self, time: S, taut: &Taut<'_, S>, past: &ChainPast<S>, next: &mut ChainPast<S>) {
        let (straps, half) = (taut.straps, S::of(0.5));
        let (mut before, mut pulled, mut greatest) = (S::zero(), S::zero(), S::zero());
        for (strap, &node) in self.starts.iter().enumerate() {
            let (tense, own) = (&straps[strap], &mut next.nodes[node]);
            let carried = self.carried(taut, strap);
            let both = carried + own.carried;
            if strap > 0 {
                // (P_j − P_{j−1}) Δs_j with the mean of old and new
                own.lost += half * (both - before) * tense.slip + taut.stretched(strap, carried - pulled);
            }
            (before, pulled) = (both, carried);
            own.carried = carried;
            if self.webbing.turns {
                own.turn(tense.strain, time - past.device.time);
            }
            (own.viscous, own.strain) = (self.viscous(taut, strap), tense.strain);
            let greatest_strain = own.greatest.max(tense.loading);
            let lost = [self.webbing.curve.returned_to(own.greatest), self.webbing.curve.returned_to(greatest_strain)];
            let [[.., was], [.., is]] = lost;
            own.lost += half * (own.unstretched + tense.unstretched) * (is - was);
            own.greatest = greatest_strain;
            (own.unstretched, own.play) = (tense.unstretched, tense.play);
            own.fed += tense.fed;
            greatest = greatest.max(tense.tension);
        }
        if let Some((strap, &node)) = self.starts.iter().enumerate().next_back() {
            // what comes into the last strap stays there: no residual adds up
            next.nodes[node].unstretched = taut.runs[strap].before + straps[strap].fed;
        }
        let first = half * (past.nodes[0].carried + next.nodes[0].carried) * straps[0].fed;
        self.book(taut, first, past, next);
        next.device.solution = taut.solved.x;
        let payout = [next.nodes[0].fed, past.nodes[0].fed];
        self.device.commit(time, straps[0].tension, payout, (&mut next.device, &mut next.nodes[0]));
        next.device.free = S::select(greatest.gt(self.strength), S::one(), next.device.free);
        let feed = self.device.feed(time, &next.device, next.nodes[0].fed);
        next.device.stored = self.device.stored(&feed, feed.delta(next.device.solution));
    }

    /// Books the flow at the first node: work of the pretensioner, or dissipation of limiter and spool.
    #[inline(always)]
    fn book(&self, taut: &Taut<'_, S>, flow: S, past: &ChainPast<S>, next: &mut ChainPast<S>) {
        let (phase, o) = (past.device.phase, S::zero());
        let is_pulling = phase.gt(S::of(Phase::LOCKING)) & phase.lt(S::of(Phase::LOCKED));
        let is = self.device.stored(&taut.feed, taut.feed.delta(taut.solved.x));
        next.device.driven -= S::select(is_pulling, flow, o);
        next.nodes[0].lost += S::select(is_pulling, o, flow - (is - past.device.stored));
    }
}

//! Tensions of a chain: one number at the first node determines all of them.
//!
//! From x at the first node follow T₀ and Δs₀ = Δp ([`super::device`]); along the straps N_i = ℓ_i/(1 + ε_i(T_i)),
//! Δs_{i+1} = Δs_i + N_iᶜ − N_i, and T_{i+1} = T_i exp(μθ z) with z = clamp(zᶜ + Δs/x_s, −1, 1): Coulomb friction with a play
//! of x_s each way (our decision); what the surface of a sphere has carried over passes without slip. At the last node nothing
//! may pass: R(x) = Δs_{n+1} = 0. R rises strictly with x.

use super::feed::Feed;
use super::tension::WebbingLaw;
use crate::forces::decay::decay;
use crate::motion::scalar::Scalar;

/// x_s, m.
const PLAY_M: f64 = 5e-4;

/// Largest number of marches per solution.
const MARCHES: usize = 80;

/// Data of a strap and the node at its start.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run<S> {
    pub(super) length: S,
    /// Nᶜ.
    pub(super) before: S,
    /// Largest loading strain, and permanent strain.
    pub(super) greatest: S,
    pub(super) set: S,
    /// μθ and exp(−μθ).
    pub(super) grip: S,
    pub(super) hold: S,
    /// zᶜ.
    pub(super) play: S,
    /// Feed without slip, as a fraction of the previous strap.
    pub(super) carried: S,
    /// Viscous element: stiffness κb, strain at which it is unloaded.
    pub(super) beside: [S; 2],
}

/// A strap during the march.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tense<S> {
    pub(super) tension: S,
    /// N.
    pub(super) unstretched: S,
    pub(super) strain: S,
    /// x*.
    pub(super) loading: S,
    /// Δs of the node at its start.
    pub(super) fed: S,
    /// Part of it that has slipped.
    pub(super) slip: S,
    /// z there.
    pub(super) play: S,
}

impl<S: Scalar> Run<S> {
    /// No webbing, and no friction.
    #[inline(always)]
    pub(super) fn none() -> Self {
        let o = S::zero();
        let (hold, beside) = (S::one(), [o; 2]);
        Run { length: o, before: o, greatest: o, set: o, grip: o, hold, play: o, carried: o, beside }
    }
}

impl<S: Scalar> Tense<S> {
    #[inline(always)]
    pub(super) fn none() -> Self {
        let o = S::zero();
        Tense { tension: o, unstretched: o, strain: o, loading: o, fed: o, slip: o, play: o }
    }
}

/// A solved chain.
pub(super) struct Solved<S: Scalar> {
    pub(super) x: S,
    /// Webbing passed beyond the last node, zero except for rounding, m.
    pub(super) residual: S,
    /// The same if it is larger and no tensions were found; else 0.
    pub(super) unsolved: S,
}

/// R and its derivative at x, and the straps.
#[inline(always)]
pub(super) fn march<S: Scalar>(
    webbing: &WebbingLaw<S>,
    feed: &Feed<'_, S>,
    runs: &[Run<S>],
    x: S,
    straps: &mut [Tense<S>],
) -> (S, S) {
    let start = feed.at(x);
    let (mut tension, mut slope) = (start.tension, start.tension_rate);
    let (mut fed, mut fed_slope) = (start.passed, start.passed_rate);
    // N of the strap before, and how fast it shrinks with x
    let (mut before, mut shrinks) = (S::zero(), S::zero());
    for (i, (run, strap)) in runs.iter().zip(straps).enumerate() {
        strap.slip = fed - run.carried * before;
        if i > 0 {
            let (ratio, part) = run.ratio(strap);
            slope = ratio * (slope + tension * (part * (fed_slope + run.carried * shrinks)));
            tension = ratio * tension;
        }
        let (strain, give, loading) = webbing.reach(tension, run);
        let inverse = S::one() / (S::one() + strain);
        let unstretched = run.length * inverse;
        (strap.tension, strap.unstretched, strap.strain) = (tension, unstretched, strain);
        (strap.loading, strap.fed) = (loading, fed);
        (before, shrinks) = (unstretched, unstretched * inverse * give * slope);
        fed += run.before - unstretched;
        fed_slope += shrinks;
    }
    (fed, fed_slope)
}

impl<S: Scalar> Run<S> {
    /// T_{i+1}/T_i and the derivative of its logarithm with respect to Δs.
    #[inline(always)]
    fn ratio(&self, strap: &mut Tense<S>) -> (S, S) {
        let (o, one) = (S::zero(), S::one());
        let free = self.play + strap.slip * S::of(1.0 / PLAY_M);
        let z = free.max(-one).min(one);
        strap.play = z;
        let is_inside = free.lt(one) & (-one).lt(free);
        let falls = z.lt(o);
        let mut hold = self.hold;
        if S::any(is_inside) {
            hold = S::select(is_inside, decay(self.grip * z.abs()), hold);
        }
        let ratio = S::select(falls, hold, one / hold);
        (ratio, S::select(is_inside, self.grip * S::of(1.0 / PLAY_M), o))
    }
}

/// Root search of R: Newton's method in a shrinking bracket.
struct Bracket<S> {
    x: S,
    low: S,
    high: S,
    /// |R| before.
    last: S,
}

impl<S: Scalar> Bracket<S> {
    /// Starts at x, with lower bound `least` except where the first node is open.
    #[inline(always)]
    fn new(x: S, is_open: S::Mask, least: S) -> Self {
        Bracket { x, low: S::select(is_open, S::of(-1e300), least), high: S::of(1e300), last: S::of(1e300) }
    }

    /// Takes a step from R and its derivative at x, except where `done`; true if none is left.
    #[inline(always)]
    fn step(&mut self, r: S, slope: S, done: S::Mask) -> S::Mask {
        let Bracket { x, low, high, last } = self;
        let below = r.lt(S::zero());
        (*low, *high) = (S::select(below, *x, *low), S::select(below, *high, *x));
        let (newton, middle) = (*x - r / slope, (*low + *high) * S::of(0.5));
        let is_bracketed = low.gt(S::of(-1e290)) & high.lt(S::of(1e290));
        let leaves = !(low.lt(newton) & newton.lt(*high));
        // a step that did not halve R has met a corner, or the last bits
        let is_slow = !(r.abs() * S::of(2.0)).lt(*last);
        *last = r.abs();
        let next = S::select(is_bracketed & (leaves | is_slow), middle, newton);
        // no number between the ends of the bracket, or a step within the last bit
        let stays = !(newton.lt(*x) | x.lt(newton));
        let is_found = (stays | is_bracketed & !(low.lt(middle) & middle.lt(*high))) & r.abs().lt(S::of(1e300));
        *x = S::select(done | is_found, *x, next);
        is_found
    }
}

/// The solved chain: slack, or at the root of R; writes its straps.
#[inline(always)]
pub(super) fn solve<S: Scalar>(
    webbing: &WebbingLaw<S>,
    feed: &Feed<'_, S>,
    runs: &[Run<S>],
    start: S,
    is_free: S::Mask,
    straps: &mut [Tense<S>],
) -> Solved<S> {
    let (o, least) = (S::zero(), feed.least());
    straps.fill(Tense::none());
    let passed = feed.at(least).passed;
    let surplus = passed + surplus(webbing, runs);
    let is_number = surplus.abs().lt(S::of(1e300));
    let is_slack = (!feed.is_open & !surplus.lt(o) & is_number) | is_free;
    let mut length = o;
    for run in runs {
        length += run.length;
    }
    let limit = length * S::of(1e-13);

    let mut bracket = Bracket::new(S::select(feed.is_open, start, start.max(least)), feed.is_open, least);
    let (mut done, mut r, mut slope) = (is_slack, o, S::one());
    for _ in 0..MARCHES {
        (r, slope) = march(webbing, feed, runs, bracket.x, straps);
        done = done | r.abs().lt(limit);
        if !S::any(!done) {
            break;
        }
        done = done | bracket.step(r, slope, done);
    }
    let mut x = bracket.x;
    if S::HAS_SLOPES {
        // one more step gives the exact derivative and leaves the value as it is
        x -= (r - r.value_alone()) / slope.value_alone();
        (r, _) = march(webbing, feed, runs, x, straps);
    }
    let residual = S::select(is_slack, o, r);
    let unsolved = S::select(done, o, S::of(f64::MIN_POSITIVE).max(residual.abs()));
    let broken = S::select(done, o, S::of(f64::NAN));
    for strap in straps.iter_mut() {
        strap.tension += broken;
    }
    if S::any(is_slack) {
        slacken(webbing, runs, passed, is_slack, straps);
    }
    Solved { x: S::select(is_slack, least, x), residual, unsolved }
}

/// Excess length without tension, when every strap has its geometric length, m.
#[inline(always)]
fn surplus<S: Scalar>(webbing: &WebbingLaw<S>, runs: &[Run<S>]) -> S {
    let mut sum = S::zero();
    for run in runs {
        sum += run.before - run.length / (S::one() + webbing.foot(run));
    }
    sum
}

/// Straps without tension: nothing passes except the feed of the first node.
#[inline(always)]
fn slacken<S: Scalar>(webbing: &WebbingLaw<S>, runs: &[Run<S>], passed: S, is_slack: S::Mask, straps: &mut [Tense<S>]) {
    let o = S::zero();
    for (i, (run, strap)) in runs.iter().zip(straps).enumerate() {
        let fed = if i == 0 { passed } else { o };
        let (unstretched, strain, play) = (run.before + fed, webbing.foot(run), run.play);
        let slack = Tense { tension: o, unstretched, strain, loading: o, fed, slip: o, play };
        *strap = strap.zip(&slack, &|tense, slack| S::select(is_slack, slack, tense));
    }
}

impl<S: Copy> Tense<S> {
    #[inline(always)]
    fn zip(&self, other: &Self, f: &impl Fn(S, S) -> S) -> Self {
        Tense {
            tension: f(self.tension, other.tension),
            unstretched: f(self.unstretched, other.unstretched),
            strain: f(self.strain, other.strain),
            loading: f(self.loading, other.loading),
            fed: f(self.fed, other.fed),
            slip: f(self.slip, other.slip),
            play: f(self.play, other.play),
        }
    }
}

//! Range of a derivative: it is compared with the secants of finite changes.
//!
//! Of two secants of one change, to either side, the mean is free of curvature, and half their difference is nothing but
//! curvature, in proportion to the change, unless the figure has a corner. So the derivative holds if it is the mean at all
//! changes, and if what is left of the difference towards a change of nothing is nothing. To one side alone the secants
//! themselves are extrapolated.

use super::finite::{Beside, Finite, Neighbours, Seen};
use super::ladder::Slope;

/// Largest relative error with which a derivative holds.
pub const HOLDS: f64 = 0.02;
/// Relative change of a figure below which a parameter has no influence.
const NO_INFLUENCE: f64 = 1e-9;
/// Least scale for comparing secants: this fraction of the figure over the parameter's size.
const LEAST: f64 = 1e-6;
/// Time difference above which a peak is a different peak, s.
const OTHER_PEAK_S: f64 = 1e-3;

/// Reliability of a derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// The slopes on both sides agree with the derivative within `off`, and those of straight lines within [`HOLDS`]
    /// for changes up to `up_to` of the parameter's size; beyond that, or at once if it is 0, the figure is curved.
    Holds {
        /// Largest relative difference of a slope from the derivative.
        off: f64,
        /// Largest change over which the figure is linear.
        up_to: f64,
    },
    /// The figure does not change.
    NoInfluence,
    /// Secants differ from the derivative.
    DoesNotHold {
        /// Relative difference of a secant from the derivative; infinite without a derivative.
        off: f64,
        /// The change.
        at: f64,
        /// The reason, if known.
        why: Why,
    },
    /// No neighbouring run has the figure.
    Unchecked,
}

/// Reason why a derivative does not hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// A neighbouring run did not complete, or lacks the figure.
    NoRun,
    /// Contacts of other surfaces, or in another order.
    OtherTouches,
    /// The figure is reached at another time.
    OtherPeak,
    /// The two sides have different slopes (a kink).
    Corner,
    /// All secants agree, but not with the derivative.
    OtherSlope,
    /// The secants disagree with each other.
    Irregular,
}

impl Why {
    /// Short name.
    pub fn name(self) -> &'static str {
        match self {
            Why::NoRun => "no run",
            Why::OtherTouches => "other contacts",
            Why::OtherPeak => "other peak",
            Why::Corner => "corner",
            Why::OtherSlope => "other slope",
            Why::Irregular => "irregular",
        }
    }

    /// Description in words.
    pub fn words(self) -> &'static str {
        match self {
            Why::NoRun => "a comparison run did not complete or lacks this measure",
            Why::OtherTouches => "the body touches other surfaces, or in another order",
            Why::OtherPeak => "another peak becomes the largest",
            Why::Corner => "the measure has a corner here: its slope differs between the two sides",
            Why::OtherSlope => {
                "finite changes agree on a different slope: the steps of the run are too long, or an event is not followed"
            }
            Why::Irregular => {
                "finite changes have no consistent slope: an event starts within them, or integration error hides their effect"
            }
        }
    }
}

/// A derivative compared with secants of finite changes.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// By change: slopes of the secants below and above; NaN without a run.
    pub secants: Vec<[f64; 2]>,
    /// By change: largest relative difference of a secant from the derivative.
    pub off: Vec<f64>,
    /// The verdict.
    pub verdict: Verdict,
}

/// Secants of one change, below and above.
struct Pair {
    part: f64,
    /// Slopes on the sides that the scenario allows.
    slopes: Vec<f64>,
    /// Whether a figure is missing on one of them.
    lacks: bool,
    /// Largest relative difference from the derivative.
    off: f64,
}

/// Compares the derivative of figure `i` with the finite changes of parameter `k` of this size.
pub fn compare(slope: &Slope, size: f64, neighbours: &Neighbours, k: usize, i: usize) -> Comparison {
    let finite = &neighbours.finite[k];
    let value = neighbours.here.figure(i).unwrap_or(f64::NAN);
    let secant = |f: &Finite, side: usize| {
        let change = if side == 0 { -f.change } else { f.change };
        f.sides[side].figure(i).map_or(f64::NAN, |figure| (figure - value) / change)
    };
    let scale = value.abs() / size;
    let off = Distance { slope: slope.value, least: slope.value.abs().max(LEAST * scale) };
    let secants: Vec<[f64; 2]> = finite.iter().map(|f| [secant(f, 0), secant(f, 1)]).collect();
    let pair = |(f, both): (&Finite, &[f64; 2])| {
        let slopes: Vec<f64> = both.iter().copied().filter(|s| s.is_finite()).collect();
        let lacks = f.sides.iter().any(|side| *side != Beside::Refused && side.figure(i).is_none());
        let worst = slopes.iter().map(|s| off.of(*s)).reduce(f64::max).unwrap_or(f64::NAN);
        Pair { part: f.part, lacks, off: worst, slopes }
    };
    let pairs: Vec<Pair> = finite.iter().zip(&secants).map(pair).collect();
    let still = |s: &f64| s.abs() <= NO_INFLUENCE * scale || *s == 0.0;
    let is_still = still(&slope.value) && pairs.iter().all(|p| !p.lacks && p.slopes.iter().all(still));
    let verdict = match () {
        () if pairs.iter().all(|p| p.slopes.is_empty()) => Verdict::Unchecked,
        () if is_still => Verdict::NoInfluence,
        () => verdict(&pairs, &off, |at, found| why(neighbours, &finite[at], &pairs, found, i)),
    };
    Comparison { secants, off: pairs.iter().map(|p| p.off).collect(), verdict }
}

/// Differences of slopes from the derivative.
struct Distance {
    slope: f64,
    least: f64,
}

impl Distance {
    fn of(&self, slope: f64) -> f64 {
        if slope == self.slope { 0.0 } else { (slope - self.slope).abs() / self.least }
    }
}

/// Slopes found from secants.
struct Found {
    /// By change: difference of the mean of both sides, corrected for curvature, from the derivative.
    means: Vec<f64>,
    /// Difference of the two sides, extrapolated to zero change.
    apart: f64,
    /// Largest difference of two means.
    spread: f64,
}

impl Found {
    fn of(pairs: &[Pair], off: &Distance) -> Self {
        let towards_0 = |a: f64, b: f64, [p, q]: [f64; 2]| (a * q - b * p) / (q - p);
        let (first, last) = (&pairs[0], &pairs[pairs.len() - 1]);
        let parts = |other: &Pair| [first.part, other.part];
        let (means, apart): (Vec<f64>, f64) = if first.slopes.len() == 2 {
            let half = |p: &Pair| 0.5 * (p.slopes.last().copied().unwrap_or(f64::NAN) - p.slopes[0]);
            let means = pairs.iter().map(|p| p.slopes.iter().sum::<f64>() / p.slopes.len() as f64).collect();
            (means, towards_0(half(first), half(last), parts(last)).abs() / off.least)
        } else {
            let slope = |p: &Pair| p.slopes.first().copied().unwrap_or(f64::NAN);
            (pairs[1..].iter().map(|p| towards_0(slope(first), slope(p), parts(p))).collect(), 0.0)
        };
        let (low, high) = means.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), s| (s.min(l), s.max(h)));
        Found { means: means.iter().map(|s| off.of(*s)).collect(), apart, spread: (high - low) / off.least }
    }
}

/// The verdict; `why` gives the reason if a pair fails.
fn verdict(pairs: &[Pair], off: &Distance, why: impl Fn(usize, Option<&Found>) -> Why) -> Verdict {
    let even = pairs.iter().all(|p| p.slopes.len() == pairs[0].slopes.len() && !p.slopes.is_empty());
    if let Some(at) = pairs.iter().position(|p| p.lacks || !even) {
        return Verdict::DoesNotHold { off: f64::INFINITY, at: pairs[at].part, why: why(at, None) };
    }
    let found = Found::of(pairs, off);
    let worst = found.means.iter().copied().fold(found.apart, f64::max);
    if worst <= HOLDS {
        let straight = pairs.iter().take_while(|p| p.off <= HOLDS).last();
        return Verdict::Holds { off: worst, up_to: straight.map_or(0.0, |p| p.part) };
    }
    let fails = found.means.iter().position(|off| off.is_nan() || *off > HOLDS).unwrap_or(0);
    let at = fails + pairs.len() - found.means.len();
    Verdict::DoesNotHold { off: worst, at: pairs[at].part, why: why(at, Some(&found)) }
}

/// The reason why the derivative fails at a change.
fn why(all: &Neighbours, at: &Finite, pairs: &[Pair], found: Option<&Found>, i: usize) -> Why {
    let (Some(here), Some(found)) = (all.here.seen(), found) else { return Why::NoRun };
    let sides = || at.sides.iter().filter_map(Beside::seen);
    let is_other = |seen: &Seen| (seen.times_s[i] - here.times_s[i]).abs() > OTHER_PEAK_S;
    match () {
        () if pairs.iter().any(|p| p.lacks) => Why::NoRun,
        () if sides().any(|seen| seen.touches != here.touches) => Why::OtherTouches,
        () if sides().any(is_other) => Why::OtherPeak,
        () if found.spread > HOLDS => Why::Irregular,
        () if found.apart > HOLDS => Why::Corner,
        () => Why::OtherSlope,
    }
}

//! What a random sample says of the distribution behind it: quantiles and probabilities with 95 % intervals, a histogram.
//!
//! The intervals of quantiles are order statistics. Of n independent values, the number B below the true quantile of
//! probability p has the binomial distribution (n, p), whatever the distribution of the values. So the value of rank l is
//! above the quantile with the probability P(B < l), and the value of rank u is at or below it with P(B ≥ u). Each end is
//! the innermost rank for which this is at most 2.5 %: H. A. David, H. N. Nagaraja, "Order Statistics", 3rd edition (2003),
//! section 7.1. A bootstrap of extreme quantiles would be too narrow.

use crate::sketch::{Ordered, Sketch};
use occupant_units::trig;
use occupant_units::trig::ln;
use serde::Serialize;

/// Probabilities of the quantiles that are reported.
pub const PARTS: [f64; 7] = [0.025, 0.05, 0.25, 0.5, 0.75, 0.95, 0.975];

/// Probability that an interval misses to one side, at most.
const TAIL: f64 = 0.025;
/// The 97.5 % quantile of the standard normal distribution.
const Z: f64 = 1.959_963_984_540_054;
/// Width of an interval that counts as narrow enough to quote a probability.
pub const NARROW: f64 = 0.1;
/// Largest number of bars of a histogram.
const BARS: f64 = 40.0;

/// A quantile of the distribution behind a sample.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Quantile {
    /// Its probability, 0 to 1.
    pub part: f64,
    /// Its estimate: definition 7 of Hyndman and Fan, as [`quantile`](crate::spread::quantile).
    pub value: f64,
    /// Lower end of the 95 % interval; none if the sample is too small for it.
    pub low: Option<f64>,
    /// Upper end.
    pub high: Option<f64>,
    /// Least number of values that gives both ends.
    pub needed: usize,
}

/// How often a limit is exceeded.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Exceedance {
    /// Values above the limit.
    pub above: usize,
    /// All values.
    pub of: usize,
    /// Their ratio.
    pub probability: f64,
    /// Lower end of Wilson's 95 % interval.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// Number of values for which the interval of this ratio would be no wider than [`NARROW`].
    pub needed: usize,
}

/// Numbers of values in intervals of equal width, each with its lower and without its upper end.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Histogram {
    /// Lower end of the first interval.
    pub from: f64,
    /// Width of an interval.
    pub width: f64,
    /// Values in each.
    pub counts: Vec<usize>,
}

/// The quantiles at [`PARTS`], with intervals; empty without values.
pub fn quantiles(values: &Ordered) -> Vec<Quantile> {
    if values.is_empty() {
        return Vec::new();
    }
    let one = |part: f64| {
        let [low, high] = ranks(values.len(), part).map(|rank| Some(values.at(rank? - 1)));
        Quantile { part, value: values.quantile(part), low, high, needed: needed(part) }
    };
    PARTS.map(one).to_vec()
}

/// How often finite values exceed a limit; none without values.
pub fn exceedance(values: &Sketch, limit: f64) -> Option<Exceedance> {
    let (of, above) = (values.len(), values.above(limit));
    let [low, high] = wilson(above, of)?;
    let probability = above as f64 / of as f64;
    Some(Exceedance { above, of, probability, low, high, needed: needed_for(probability) })
}

/// Wilson's 95 % interval of a probability of which `some` of `all` independent trials are known: E. B. Wilson, "Probable
/// inference, the law of succession, and statistical inference", J. American Statistical Association 22 (1927). None
/// without trials.
pub fn wilson(some: usize, all: usize) -> Option<[f64; 2]> {
    let n = all as f64;
    let p = some as f64 / n;
    let [low, high] = wilson_of(p, n);
    // the ends of no and of all are exact
    let low = if some == 0 { 0.0 } else { low };
    let high = if some == all { 1.0 } else { high };
    (all > 0).then_some([low, high])
}

fn wilson_of(p: f64, n: f64) -> [f64; 2] {
    let (zz, centre) = (Z * Z / n, p + Z * Z / (2.0 * n));
    let half = Z * (p * (1.0 - p) / n + zz / (4.0 * n)).sqrt();
    [(centre - half) / (1.0 + zz), (centre + half) / (1.0 + zz)].map(|x| x.clamp(0.0, 1.0))
}

/// Least number of trials after which the interval of `p` is no wider than [`NARROW`].
fn needed_for(p: f64) -> usize {
    let is_narrow = |n: usize| {
        let [low, high] = wilson_of(p, n as f64);
        high - low <= NARROW
    };
    let (mut low, mut high) = (1, 1000);
    while high - low > 1 {
        let middle = (low + high) / 2;
        if is_narrow(middle) { high = middle } else { low = middle }
    }
    high
}

/// Least number of values that gives both ends of the interval of a quantile: max(p, 1 − p)ⁿ ≤ 2.5 %.
pub fn needed(part: f64) -> usize {
    let far = part.max(1.0 - part);
    let n = (ln(TAIL) / ln(far)).ceil();
    if n.is_finite() { n.max(1.0) as usize } else { usize::MAX }
}

/// Ranks, from 1, of the values between which a quantile lies with at least 95 %; none where the sample is too small.
fn ranks(n: usize, part: f64) -> [Option<usize>; 2] {
    let (first, weights) = binomial(n, part);
    // how many weights from one end add up to 2.5 % at most
    fn within<'w>(weights: impl Iterator<Item = &'w f64>) -> usize {
        let sums = weights.scan(0.0, |sum, weight| {
            *sum += weight;
            Some(*sum)
        });
        sums.take_while(|sum| *sum <= TAIL).count()
    }
    // the largest l with P(B ≤ l − 1) ≤ 2.5 %; below the first weight there is nothing
    let below = within(weights.iter());
    let above = weights.len() - within(weights.iter().rev());
    let (l, u) = (first + below, first + above);
    [(l >= 1).then_some(l), (u <= n).then_some(u)]
}

/// Weights of the binomial distribution (n, p) that are not negligible, from the number `first` on; they sum to 1. From the
/// mode outward, w(k + 1)/w(k) = (n − k)/(k + 1)·p/(1 − p): nothing underflows.
fn binomial(n: usize, p: f64) -> (usize, Vec<f64>) {
    const LEAST: f64 = 1e-18;
    let mode = (((n + 1) as f64 * p) as usize).min(n);
    let odds = p / (1.0 - p);
    let mut below = Vec::new();
    let mut weight = 1.0;
    for k in (0..mode).rev() {
        weight *= (k + 1) as f64 / ((n - k) as f64 * odds);
        if weight < LEAST {
            break;
        }
        below.push(weight);
    }
    let first = mode - below.len();
    let mut weights: Vec<f64> = below.into_iter().rev().chain([1.0]).collect();
    weight = 1.0;
    for k in mode..n {
        weight *= (n - k) as f64 / (k + 1) as f64 * odds;
        if weight < LEAST {
            break;
        }
        weights.push(weight);
    }
    let all: f64 = weights.iter().sum();
    weights.iter_mut().for_each(|w| *w /= all);
    (first, weights)
}

/// A histogram in intervals of 1, 2 or 5 times a power of ten of the unit `per`, about as wide as D. Freedman and
/// P. Diaconis advise (Z. Wahrscheinlichkeitstheorie 57, 1981): 2·IQR·n^(−1/3). None without values that differ.
pub fn histogram(values: &Ordered, per: f64) -> Option<Histogram> {
    let ends = [values.steps().next()?.0, values.greatest()?];
    let [least, greatest] = ends.map(|end| end / per);
    let range = greatest - least;
    if !(range.is_finite() && range > 1e-12 * least.abs().max(greatest.abs())) {
        return None;
    }
    let quarters = (values.quantile(0.75) - values.quantile(0.25)) / per;
    let advised = 2.0 * quarters / trig::cbrt(values.len() as f64);
    let width = round_up(advised.clamp(range / BARS, range / 4.0));
    let place = |x: f64| (x / per / width).floor();
    let [first, last] = ends.map(place);
    let mut counts = vec![0; (last - first) as usize + 1];
    let mut below = 0;
    for (x, upto) in values.steps() {
        counts[(place(x) - first) as usize] += upto - below;
        below = upto;
    }
    Some(Histogram { from: first * width * per, width: width * per, counts })
}

/// The next 1, 2 or 5 times a power of ten.
fn round_up(x: f64) -> f64 {
    let power = trig::powi(10.0, trig::log10(x).floor() as i32);
    let steps = [1.0, 2.0, 5.0, 10.0];
    steps.into_iter().map(|step| step * power).find(|width| *width >= x * (1.0 - 1e-12)).unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests;

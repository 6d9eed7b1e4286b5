//! What many runs say of one figure, so that it can be quoted: quantiles and probabilities with their intervals, what was
//! varied, what was left out, in numbers and as one paragraph.

mod limits;
mod paragraph;

pub use limits::{Limits, fitting, parse_limit};
pub use paragraph::percent;

use occupant_core::results::summary::FigureLimit;
use occupant_study::certainty::{Exceedance, Histogram, Quantile, exceedance, histogram, quantiles};
use occupant_study::sketch::{Ordered, Sketch};
use serde::Serialize;

use crate::base::Units;

/// How the runs relate to the distributions of the inputs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// Independent random samples: the intervals hold.
    Random,
    /// Samples spread more evenly than random ones: the intervals are as a rule too wide.
    Even,
    /// No sample of a distribution, for this reason: no intervals, no probabilities.
    None(String),
}

/// What was simulated, common to all figures.
#[derive(Clone, Debug)]
pub struct About {
    /// The program, the scenario, the number of runs and their design, as the beginning of a sentence.
    pub simulated: String,
    /// What each run is, such as `run` or `sample, the median of 8 runs`; singular and plural.
    pub each: [String; 2],
    /// Each varied input with its distribution.
    pub varied: Vec<String>,
    /// Number of runs left out of all figures, with the reason.
    pub left_out: Vec<LeftOut>,
    /// How the runs were chosen.
    pub sampling: Sampling,
}

/// Runs that are not among the values of a figure.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct LeftOut {
    /// Their number.
    pub runs: u64,
    /// Why.
    pub reason: String,
}

/// Values of a figure.
#[derive(Clone, Copy, Debug)]
pub struct Values<'a> {
    /// Name of the figure.
    pub figure: &'a str,
    /// Its SI unit.
    pub unit: &'a str,
    /// The combination of crossed values that these runs have, if any.
    pub case: Option<&'a str>,
    /// One value for each run; missing where it has none.
    pub values: &'a Sketch,
    /// The unchanged run of an ensemble.
    pub unchanged: Option<f64>,
    /// Runs with caveats on the figure, of so many, and the names of these.
    pub caveats: (usize, usize, &'a [String]),
}

/// What the runs say of a figure; SI units.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Statement {
    /// The figure.
    pub figure: String,
    /// Its unit, `1` for a plain number.
    pub unit: String,
    /// The combination of crossed values; absent without them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub case: Option<String>,
    /// Runs with the figure.
    pub runs: usize,
    /// Runs that are left out.
    pub left_out: Vec<LeftOut>,
    /// The unchanged run of an ensemble, which is not among the values.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unchanged: Option<f64>,
    /// Quantiles with their 95 % intervals.
    pub quantiles: Vec<Quantile>,
    /// Why there are no intervals and no probabilities; absent if there are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub without_intervals: Option<String>,
    /// Limits, with the probability that they are exceeded.
    pub limits: Vec<Exceeded>,
    /// Runs with caveats on the figure, of so many: of all cases, and all members of ensembles.
    pub runs_with_caveats: [usize; 2],
    /// The caveats.
    pub caveats: Vec<String>,
    /// The values in intervals of equal width; null if they are all the same.
    pub histogram: Option<Histogram>,
    /// The text to quote.
    pub paragraph: String,
    /// Largest error of the rank of a quantile, as a fraction of the runs; absent if it is exact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rank_error: Option<f64>,
    /// The values.
    #[serde(skip)]
    pub values: Ordered,
}

/// A limit, and how often it is exceeded.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Exceeded {
    /// Largest value allowed.
    pub most: f64,
    /// Rules that set it; empty for a limit that the user gave.
    pub rules: Vec<&'static str>,
    /// The dummy for which they set it.
    pub dummy: Option<&'static str>,
    /// Whether it was read in a source that quotes a rule, or was given by the user.
    pub quoted: bool,
    /// How often it is exceeded.
    #[serde(flatten)]
    pub found: Exceedance,
}

impl Statement {
    /// What the values say; none without a value.
    pub fn of(about: &About, of: &Values<'_>, limits: &Limits, units: Units) -> Option<Statement> {
        let values = of.values.ordered();
        let mut quantiles = quantiles(&values);
        let without_intervals = match &about.sampling {
            Sampling::None(why) => Some(why.clone()),
            _ => None,
        };
        if without_intervals.is_some() {
            quantiles.iter_mut().for_each(|q| (q.low, q.high) = (None, None));
        }
        let mut statement = Statement {
            figure: of.figure.to_owned(),
            unit: of.unit.to_owned(),
            case: of.case.map(str::to_owned),
            runs: values.len(),
            left_out: left_out(about, of),
            unchanged: of.unchanged.filter(|x| x.is_finite()),
            without_intervals,
            limits: exceeded(&limits.of(of.figure), of.values),
            runs_with_caveats: [of.caveats.0, of.caveats.1],
            caveats: of.caveats.2.to_vec(),
            histogram: histogram(&values, units.told(of.unit).shown.0),
            paragraph: String::new(),
            rank_error: Some(of.values.error()).filter(|error| *error > 0.0),
            quantiles,
            values,
        };
        statement.paragraph = paragraph::paragraph(about, &statement, units);
        (statement.runs > 0).then_some(statement)
    }

    /// A quantile by its probability.
    pub fn quantile(&self, part: f64) -> Option<&Quantile> {
        self.quantiles.iter().find(|q| q.part == part)
    }
}

/// Runs that are left out: those without any figure, then those that lack this one.
fn left_out(about: &About, of: &Values<'_>) -> Vec<LeftOut> {
    let missing = of.values.missing() as u64;
    if of.case.is_some() {
        let reason = "its run failed, lost its energy balance or lacks this figure".to_owned();
        return if missing > 0 { vec![LeftOut { runs: missing, reason }] } else { Vec::new() };
    }
    let known: u64 = about.left_out.iter().map(|left| left.runs).sum();
    let mut all = about.left_out.clone();
    if missing > known {
        all.push(LeftOut { runs: missing - known, reason: "lack this figure".to_owned() });
    }
    all
}

/// How often each limit is exceeded; rules with the same limit together.
fn exceeded(limits: &[&FigureLimit], values: &Sketch) -> Vec<Exceeded> {
    let mut all: Vec<Exceeded> = Vec::new();
    for limit in limits {
        if let Some(known) = all.iter_mut().find(|known| known.most == limit.most && !known.rules.is_empty())
            && let Some(rule) = limit.rule
        {
            if !known.rules.contains(&rule) {
                known.rules.push(rule);
            }
            known.quoted |= limit.quoted;
            continue;
        }
        let rules = limit.rule.into_iter().collect();
        let (most, dummy, quoted) = (limit.most, limit.dummy, limit.quoted);
        all.extend(exceedance(values, most).map(|found| Exceeded { most, rules, dummy, quoted, found }));
    }
    all
}

//! How the values of one parameter are spread: levels to go through, or a distribution to draw from.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::normal;
use occupant_units::trig::{exp, ln};

/// A value of a parameter: SI units, angles in radians.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A name.
    Text(String),
    /// True or false.
    Truth(bool),
    /// What the base scenario says, where that is not one single value.
    Base,
}

/// How likely each value is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[schemars(rename = "DistributionSection")]
pub enum Distribution<N> {
    /// Every value between two equally likely.
    Uniform {
        /// Least value.
        from: N,
        /// Largest value.
        to: N,
    },
    /// Every ratio between two values equally likely.
    LogUniform {
        /// Least value.
        from: N,
        /// Largest value.
        to: N,
    },
    /// Gauss's bell.
    Normal {
        /// Mean.
        mean: N,
        /// Standard deviation.
        sd: N,
    },
    /// Gauss's bell between two values.
    TruncatedNormal {
        /// Mean before it is cut.
        mean: N,
        /// Standard deviation before it is cut.
        sd: N,
        /// Least value.
        from: N,
        /// Largest value.
        to: N,
    },
    /// Straight lines up to the likeliest value and down again.
    Triangular {
        /// Least value.
        from: N,
        /// Likeliest value.
        mode: N,
        /// Largest value.
        to: N,
    },
}

/// How the values of one parameter are spread.
#[derive(Clone, Debug, PartialEq)]
pub enum Law {
    /// Given values, each as likely.
    List(Vec<Value>),
    /// Evenly spaced values, both ends included, each as likely.
    Grid {
        /// First.
        from: f64,
        /// Last.
        to: f64,
        /// How many, at least 2.
        steps: u64,
        /// Equal ratios instead of equal differences; both ends are then positive.
        log: bool,
    },
    /// As likely as a distribution says.
    Distribution(Distribution<f64>),
    /// The design's own table says.
    Table,
}

impl Law {
    /// Whether equal ratios of its values are as likely, not equal differences.
    pub fn goes_by_ratios(&self) -> bool {
        matches!(self, Law::Grid { log: true, .. } | Law::Distribution(Distribution::LogUniform { .. }))
    }

    /// How many values there are, if they can be counted.
    pub fn levels(&self) -> Option<u64> {
        match self {
            Law::List(values) => Some(values.len() as u64),
            Law::Grid { steps, .. } => Some(*steps),
            _ => None,
        }
    }

    /// A value by its number, from 0; the last for a number that is too great.
    pub fn level(&self, i: u64) -> Value {
        match self {
            Law::List(values) => {
                let last = values.len().saturating_sub(1);
                let at = usize::try_from(i).map_or(last, |i| i.min(last));
                values.get(at).cloned().unwrap_or(Value::Base)
            }
            Law::Grid { from, to, steps, log } => {
                let last = steps.saturating_sub(1).max(1);
                let bounds = Bounds { from: *from, to: *to, log: *log };
                Value::Number(bounds.value(i.min(last) as f64 / last as f64))
            }
            _ => Value::Base,
        }
    }

    /// The value below which a part `p` of all values lies, 0 ≤ p ≤ 1. Levels share the probability equally.
    pub fn quantile(&self, p: f64) -> Value {
        match self {
            Law::List(_) | Law::Grid { .. } => {
                let levels = self.levels().unwrap_or(1);
                self.level(((p * levels as f64) as u64).min(levels.saturating_sub(1)))
            }
            Law::Distribution(distribution) => Value::Number(distribution.quantile(p)),
            Law::Table => Value::Base,
        }
    }

    /// As [`Law::quantile`], where a distribution without ends is cut off at `tail` and 1 − `tail`.
    pub fn bounded_quantile(&self, p: f64, tail: f64) -> Value {
        match self {
            Law::Distribution(Distribution::Normal { .. }) => self.quantile(tail + (1.0 - 2.0 * tail) * p),
            _ => self.quantile(p),
        }
    }

    /// The ends between which a value can be looked for; none for a law that has no ends, or nothing between its values.
    pub fn bounds(&self) -> Option<Bounds> {
        let bounds = |from, to, log| Some(Bounds { from, to, log });
        match *self {
            Law::Grid { from, to, log, .. } => bounds(from, to, log),
            Law::Distribution(ref distribution) => match *distribution {
                Distribution::LogUniform { from, to } => bounds(from, to, true),
                Distribution::Uniform { from, to }
                | Distribution::TruncatedNormal { from, to, .. }
                | Distribution::Triangular { from, to, .. } => bounds(from, to, false),
                Distribution::Normal { .. } => None,
            },
            Law::List(_) | Law::Table => None,
        }
    }
}

impl Distribution<f64> {
    /// The number below which a part `p` of all lies.
    fn quantile(&self, p: f64) -> f64 {
        match *self {
            Distribution::Uniform { from, to } => between(from, to, p),
            Distribution::LogUniform { from, to } => log_between(from, to, p),
            Distribution::Normal { mean, sd } => mean + sd * normal::quantile(p),
            Distribution::TruncatedNormal { mean, sd, from, to } => truncated(mean, sd, [from, to], p),
            Distribution::Triangular { from, mode, to } => triangular(from, mode, to, p),
        }
    }
}

/// The ends between which a parameter is looked for, SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least value.
    pub from: f64,
    /// Largest value.
    pub to: f64,
    /// Whether equal ratios are equal steps.
    pub log: bool,
}

impl Bounds {
    /// The value at a part of the way, 0 to 1.
    pub fn value(&self, u: f64) -> f64 {
        if self.log { log_between(self.from, self.to, u) } else { between(self.from, self.to, u) }
    }

    /// The part of the way at which a value stands; beyond 0 or 1 for one outside.
    pub fn part(&self, value: f64) -> f64 {
        if self.log {
            (ln(value) - ln(self.from)) / (ln(self.to) - ln(self.from))
        } else {
            (value - self.from) / (self.to - self.from)
        }
    }
}
/// a + (b − a)·p, exact at both ends.
fn between(a: f64, b: f64, p: f64) -> f64 {
    a * (1.0 - p) + b * p
}

/// a·(b/a)^p, exact at both ends.
fn log_between(a: f64, b: f64, p: f64) -> f64 {
    match p {
        0.0 => a,
        1.0 => b,
        _ => held(exp(between(ln(a), ln(b), p)), a.min(b), a.max(b)),
    }
}

/// μ + σ Φ⁻¹(Φ(a) + p(Φ(b) − Φ(a))), taken in the lower half, where Φ keeps its digits.
fn truncated(mean: f64, sd: f64, [from, to]: [f64; 2], p: f64) -> f64 {
    let (a, b) = ((from - mean) / sd, (to - mean) / sd);
    let z = if a > 0.0 {
        -normal::quantile(between(normal::cumulative(-a), normal::cumulative(-b), p))
    } else {
        normal::quantile(between(normal::cumulative(a), normal::cumulative(b), p))
    };
    held(mean + sd * z, from, to)
}

/// a + √(p(b − a)(c − a)) up to the mode c, b − √((1 − p)(b − a)(b − c)) beyond.
fn triangular(a: f64, c: f64, b: f64, p: f64) -> f64 {
    let x = if p * (b - a) < c - a {
        a + (p * (b - a) * (c - a)).sqrt()
    } else {
        b - ((1.0 - p) * (b - a) * (b - c)).sqrt()
    };
    held(x, a, b)
}

/// x between two ends; ends that are reversed or no numbers hold nothing.
fn held(x: f64, from: f64, to: f64) -> f64 {
    if from <= to { x.clamp(from, to) } else { x }
}

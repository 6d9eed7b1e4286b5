//! Law of the values of one parameter: a list of levels, or a distribution.

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
    /// The base scenario's value, where it is not one single value.
    Base,
}

/// A probability distribution.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[schemars(rename = "DistributionSection")]
pub enum Distribution<N> {
    /// Uniform between two values.
    Uniform {
        /// Least value.
        from: N,
        /// Largest value.
        to: N,
    },
    /// Log-uniform between two values.
    LogUniform {
        /// Least value.
        from: N,
        /// Largest value.
        to: N,
    },
    /// Normal distribution.
    Normal {
        /// Mean.
        mean: N,
        /// Standard deviation.
        sd: N,
    },
    /// Normal distribution, truncated to a range.
    TruncatedNormal {
        /// Mean before truncation.
        mean: N,
        /// Standard deviation before truncation.
        sd: N,
        /// Least value.
        from: N,
        /// Largest value.
        to: N,
    },
    /// Triangular distribution: its density is linear up to the mode and down again.
    Triangular {
        /// Least value.
        from: N,
        /// Mode.
        mode: N,
        /// Largest value.
        to: N,
    },
}

/// Law of a parameter's values.
#[derive(Clone, Debug, PartialEq)]
pub enum Law {
    /// A list of values, equally likely.
    List(Vec<Value>),
    /// Evenly spaced values, both ends included, equally likely.
    Grid {
        /// First.
        from: f64,
        /// Last.
        to: f64,
        /// Number of values, at least 2.
        steps: u64,
        /// True: equal ratios, between positive ends; false: equal differences.
        log: bool,
    },
    /// A distribution.
    Distribution(Distribution<f64>),
    /// Values in the design's table.
    Table,
}

impl Law {
    /// Whether the law is logarithmic: equal ratios instead of equal differences.
    pub fn goes_by_ratios(&self) -> bool {
        matches!(self, Law::Grid { log: true, .. } | Law::Distribution(Distribution::LogUniform { .. }))
    }

    /// Number of values of a discrete law.
    pub fn levels(&self) -> Option<u64> {
        match self {
            Law::List(values) => Some(values.len() as u64),
            Law::Grid { steps, .. } => Some(*steps),
            _ => None,
        }
    }

    /// Value number `i`, from 0; the last if the number is too large.
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

    /// Quantile at probability `p`, 0 ≤ p ≤ 1. Levels share the probability equally.
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

    /// As [`Law::quantile`], with unbounded distributions cut off at `tail` and 1 − `tail`.
    pub fn bounded_quantile(&self, p: f64, tail: f64) -> Value {
        match self {
            Law::Distribution(Distribution::Normal { .. }) => self.quantile(tail + (1.0 - 2.0 * tail) * p),
            _ => self.quantile(p),
        }
    }

    /// Bounds for a search; none for an unbounded or discrete law.
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
    /// Quantile at probability `p`.
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

/// Search bounds of a parameter, SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least value.
    pub from: f64,
    /// Largest value.
    pub to: f64,
    /// Whether the scale is logarithmic.
    pub log: bool,
}

impl Bounds {
    /// Value at a fraction of the range, 0 to 1.
    pub fn value(&self, u: f64) -> f64 {
        if self.log { log_between(self.from, self.to, u) } else { between(self.from, self.to, u) }
    }

    /// Position of a value as a fraction of the range; below 0 or above 1 outside it.
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

/// Quantile of the truncated normal distribution, μ + σ Φ⁻¹(Φ(a) + p(Φ(b) − Φ(a))), computed in the lower half for
/// accuracy.
fn truncated(mean: f64, sd: f64, [from, to]: [f64; 2], p: f64) -> f64 {
    let (a, b) = ((from - mean) / sd, (to - mean) / sd);
    let z = if a > 0.0 {
        -normal::quantile(between(normal::cumulative(-a), normal::cumulative(-b), p))
    } else {
        normal::quantile(between(normal::cumulative(a), normal::cumulative(b), p))
    };
    held(mean + sd * z, from, to)
}

/// Quantile of the triangular distribution: a + √(p(b − a)(c − a)) up to the mode c, b − √((1 − p)(b − a)(b − c))
/// beyond.
fn triangular(a: f64, c: f64, b: f64, p: f64) -> f64 {
    let x = if p * (b - a) < c - a {
        a + (p * (b - a) * (c - a)).sqrt()
    } else {
        b - ((1.0 - p) * (b - a) * (b - c)).sqrt()
    };
    held(x, a, b)
}

/// x clamped to a range; x itself if the bounds are reversed or NaN.
fn held(x: f64, from: f64, to: f64) -> f64 {
    if from <= to { x.clamp(from, to) } else { x }
}

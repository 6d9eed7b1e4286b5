//! How the values of one parameter are spread: levels to go through, or a distribution to draw from.

use super::normal;
use crash_measures::trig::{exp, ln};

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
    /// Equally likely between two ends.
    Uniform {
        /// Least.
        from: f64,
        /// Greatest.
        to: f64,
    },
    /// Equal ratios equally likely between two positive ends.
    LogUniform {
        /// Least.
        from: f64,
        /// Greatest.
        to: f64,
    },
    /// Normal.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation.
        sd: f64,
    },
    /// Normal between two ends.
    TruncatedNormal {
        /// Mean before it is cut.
        mean: f64,
        /// Standard deviation before it is cut.
        sd: f64,
        /// Least.
        from: f64,
        /// Greatest.
        to: f64,
    },
    /// Triangular.
    Triangular {
        /// Least.
        from: f64,
        /// Likeliest.
        mode: f64,
        /// Greatest.
        to: f64,
    },
    /// The design's own table says.
    Table,
}

impl Law {
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
            Law::Grid { from, to, steps, log } => Value::Number(grid_value(*from, *to, *steps, *log, i)),
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
            Law::Table => Value::Base,
            _ => Value::Number(self.number_at(p)),
        }
    }

    /// As [`Law::quantile`], where a distribution without ends is cut off at `tail` and 1 − `tail`.
    pub fn bounded_quantile(&self, p: f64, tail: f64) -> Value {
        match self {
            Law::Normal { .. } => self.quantile(tail + (1.0 - 2.0 * tail) * p),
            _ => self.quantile(p),
        }
    }

    fn number_at(&self, p: f64) -> f64 {
        match *self {
            Law::Uniform { from, to } => between(from, to, p),
            Law::LogUniform { from, to } => log_between(from, to, p),
            Law::Normal { mean, sd } => mean + sd * normal::quantile(p),
            Law::TruncatedNormal { mean, sd, from, to } => truncated(mean, sd, [from, to], p),
            Law::Triangular { from, mode, to } => triangular(from, mode, to, p),
            Law::List(_) | Law::Grid { .. } | Law::Table => f64::NAN,
        }
    }
}

/// a + (b − a)·p, exact at both ends.
pub(super) fn between(a: f64, b: f64, p: f64) -> f64 {
    a * (1.0 - p) + b * p
}

/// a·(b/a)^p, exact at both ends.
pub(super) fn log_between(a: f64, b: f64, p: f64) -> f64 {
    match p {
        0.0 => a,
        1.0 => b,
        _ => exp(between(ln(a), ln(b), p)).clamp(a.min(b), a.max(b)),
    }
}

fn grid_value(from: f64, to: f64, steps: u64, log: bool, i: u64) -> f64 {
    let last = steps.saturating_sub(1).max(1);
    let part = i.min(last) as f64 / last as f64;
    if log { log_between(from, to, part) } else { between(from, to, part) }
}

/// μ + σ Φ⁻¹(Φ(a) + p(Φ(b) − Φ(a))), taken in the lower half, where Φ keeps its digits.
fn truncated(mean: f64, sd: f64, [from, to]: [f64; 2], p: f64) -> f64 {
    let (a, b) = ((from - mean) / sd, (to - mean) / sd);
    let z = if a > 0.0 {
        -normal::quantile(between(normal::cumulative(-a), normal::cumulative(-b), p))
    } else {
        normal::quantile(between(normal::cumulative(a), normal::cumulative(b), p))
    };
    (mean + sd * z).clamp(from, to)
}

/// a + √(p(b − a)(c − a)) up to the mode c, b − √((1 − p)(b − a)(b − c)) beyond.
fn triangular(a: f64, c: f64, b: f64, p: f64) -> f64 {
    let x = if p * (b - a) < c - a {
        a + (p * (b - a) * (c - a)).sqrt()
    } else {
        b - ((1.0 - p) * (b - a) * (b - c)).sqrt()
    };
    x.clamp(a, b)
}

//! Scales of criteria.

use super::Method;
use super::far_side::{COLOURS, caps, colour};
use super::round::half_up;
use crate::measure::{Dummy, Quantity, limits};

/// A criterion of a region.
#[derive(Clone, Copy, Debug)]
pub struct Criterion {
    /// Name as the table has it.
    pub name: &'static str,
    /// Its scale.
    pub scale: Scale,
    /// Value at which the occupant loses all points.
    pub cap: Option<f64>,
    /// Whether it is asked only if the head has a hard contact ([`Scale::Gate`]).
    pub gated: bool,
}

/// A scale, in the unit of the table. Loads count without their sign.
#[derive(Clone, Copy, Debug)]
pub enum Scale {
    /// 100, 80, 40, 20 or 0 %: bands between the limits are thirds of their distance.
    Bands {
        /// Higher performance limit.
        high: f64,
        /// Lower performance limit.
        low: f64,
    },
    /// 100 % up to the higher performance limit, 0 % from the lower one on, linear between.
    Sliding {
        /// Higher performance limit.
        high: f64,
        /// Lower performance limit.
        low: f64,
    },
    /// Allowed up to this value.
    Most(f64),
    /// Allowed up to the limit of the rating's rule for the dummy.
    Rule(Quantity),
    /// Good, acceptable and marginal up to these values.
    Grades([f64; 3]),
    /// Probability of an injury from the value in SI.
    Risk(fn(f64) -> Option<f64>),
    /// Percent taken from the region from these values on.
    Deduction(&'static [(f64, f64)]),
    /// The value itself is taken from the region, %.
    Percent,
    /// No points; its cap alone counts.
    Cap,
    /// The same where another criterion is below a value: it then does not count.
    CapUnless {
        /// The other criterion of the region.
        other: &'static str,
        /// The value.
        below: f64,
    },
    /// Largest acceleration of a head without hard contact: up to it the gated criteria are not asked.
    Gate {
        /// The level.
        below: f64,
        /// Whether the region then has 100 %.
        full: bool,
    },
    /// Worst lower legs of other tests, %: 0 if any has none, else 100.
    Others,
    /// Colour of the head's excursion to the far side, by its place in [`COLOURS`]. The last takes all points.
    Excursion,
    /// The same where it must be near the colour of this load case.
    Beside(&'static str),
    /// Yes (1) or no (0), on which other criteria of the region depend.
    Answer,
}

use Scale::{
    Answer, Bands, Beside, Cap, CapUnless, Deduction, Excursion, Gate, Grades, Most, Others, Percent, Risk, Sliding,
};

/// A criterion without a cap.
pub(super) const fn criterion(name: &'static str, scale: Scale) -> Criterion {
    Criterion { name, scale, cap: None, gated: false }
}

pub(super) const fn bands(name: &'static str, high: f64, low: f64) -> Criterion {
    criterion(name, Bands { high, low })
}

pub(super) const fn sliding(name: &'static str, high: f64, low: f64) -> Criterion {
    criterion(name, Sliding { high, low })
}

pub(super) const fn grades(name: &'static str, good: f64, acceptable: f64, marginal: f64) -> Criterion {
    criterion(name, Grades([good, acceptable, marginal]))
}

pub(super) const fn most(name: &'static str, value: f64) -> Criterion {
    criterion(name, Most(value))
}

pub(super) const fn limited(name: &'static str, quantity: Quantity) -> Criterion {
    criterion(name, Scale::Rule(quantity))
}

pub(super) const fn risk(name: &'static str, curve: fn(f64) -> Option<f64>) -> Criterion {
    criterion(name, Risk(curve))
}

pub(super) const fn deduction(name: &'static str, steps: &'static [(f64, f64)]) -> Criterion {
    criterion(name, Deduction(steps))
}

pub(super) const fn cap(name: &'static str, value: f64) -> Criterion {
    criterion(name, Cap).cap(value)
}

pub(super) const fn gate(name: &'static str, below: f64, full: bool) -> Criterion {
    criterion(name, Gate { below, full })
}

impl Criterion {
    pub(super) const fn cap(mut self, value: f64) -> Self {
        self.cap = Some(value);
        self
    }

    pub(super) const fn gated(mut self) -> Self {
        self.gated = true;
        self
    }

    pub(super) const fn unless(mut self, other: &'static str, below: f64) -> Self {
        self.scale = CapUnless { other, below };
        self
    }

    /// Whether a value takes all points of the occupant.
    pub(super) fn caps(&self, value: f64, method: Method) -> bool {
        match (self.cap, method) {
            (None, _) => matches!(self.scale, Excursion) && caps(value),
            (Some(cap), Method::Bands) => half_up(value, 2) >= half_up(cap, 2),
            (Some(cap), _) => value > cap,
        }
    }

    /// Whether it belongs to the worst criterion of its region, as opposed to modifiers, caps, answers and the gate.
    pub(super) fn is_scored(&self) -> bool {
        !matches!(self.scale, Deduction(_) | Percent | Cap | CapUnless { .. } | Gate { .. } | Answer)
    }

    /// Percent that a value takes from its region.
    pub(super) fn deducted(&self, value: f64) -> f64 {
        match self.scale {
            Deduction(steps) => {
                steps.iter().rev().find(|(from, _)| value >= *from).map_or(0.0, |(_, percent)| *percent)
            }
            Percent => half_up(value, 2).max(0.0),
            _ => 0.0,
        }
    }
}

impl Scale {
    /// What a value, whose unit is a `factor` of the SI unit, is worth: percent of the points, 100 or 0 for met or not
    /// met, 3 to 0 for good to poor, the percentage of those without this injury. None if nothing is known for the
    /// dummy, or if other criteria decide.
    pub(super) fn worth(&self, value: f64, factor: f64, method: Method, dummy: Option<Dummy>) -> Option<f64> {
        match *self {
            Bands { high, low } => Some(band(value, high, low)),
            Sliding { high, low } if high == low => Some(if value <= high { 100.0 } else { 0.0 }),
            Sliding { high, low } => Some(100.0 * ((low - value) / (low - high)).clamp(0.0, 1.0)),
            Most(most) => Some(if value <= most { 100.0 } else { 0.0 }),
            Scale::Rule(_) => Some(if value <= self.most(factor, method, dummy)? { 100.0 } else { 0.0 }),
            Grades(bounds) => Some(bounds.iter().filter(|bound| value <= **bound).count() as f64),
            Risk(curve) => curve(value * factor).map(|risk| 100.0 * (1.0 - risk)),
            Others => Some(if value > 0.0 { 100.0 } else { 0.0 }),
            Deduction(_) | Percent | Cap | CapUnless { .. } | Gate { .. } => None,
            Excursion | Beside(_) | Answer => None,
        }
    }

    /// The largest value allowed, in the unit of the table.
    pub(super) fn most(&self, factor: f64, method: Method, dummy: Option<Dummy>) -> Option<f64> {
        match (*self, method) {
            (Most(most), _) => Some(most),
            (Scale::Rule(quantity), Method::Limits(rule)) => {
                limits(rule, dummy?).find(|limit| limit.quantity == quantity).map(|limit| limit.most / factor)
            }
            _ => None,
        }
    }

    /// The word for a value: a colour, or yes and no.
    #[must_use]
    pub fn word(&self, value: f64) -> Option<&'static str> {
        match self {
            Excursion | Beside(_) => COLOURS.get(colour(value)).copied(),
            Answer => Some(if value > 0.0 { "Yes" } else { "No" }),
            _ => None,
        }
    }

    /// Worth of a blank at its best.
    pub(super) fn best(&self) -> f64 {
        if matches!(self, Grades(_)) { 3.0 } else { 100.0 }
    }
}

/// Percent of a value by bands: limits and value have two decimals, and a value at a bound belongs to the worse band.
fn band(value: f64, high: f64, low: f64) -> f64 {
    let hundredths = |value: f64| (100.0 * half_up(value, 2)).round();
    let (value, high, low) = (hundredths(value), hundredths(high), hundredths(low));
    let bounds = [high, ((2.0 * high + low) / 3.0).round(), ((high + 2.0 * low) / 3.0).round(), low];
    let passed = bounds.iter().filter(|bound| value < **bound).count();
    [0.0, 20.0, 40.0, 80.0, 100.0][passed]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_are_thirds_and_a_bound_belongs_to_the_worse_one() {
        // HIC15, 500 and 700: 566.67, 633.33
        let of = |value| band(value, 500.0, 700.0);
        let found = [0.0, 499.99, 500.0, 566.66, 566.67, 633.32, 633.33, 699.99, 700.0, 1e9].map(of);
        assert_eq!(found, [100.0, 100.0, 80.0, 80.0, 40.0, 40.0, 20.0, 20.0, 0.0, 0.0]);
        // the value is rounded first
        assert_eq!([499.994, 499.995].map(of), [100.0, 80.0]);
        // one limit alone
        assert_eq!([87.99, 88.0].map(|v| band(v, 88.0, 88.0)), [100.0, 0.0]);
    }

    #[test]
    fn a_line_falls_from_the_higher_to_the_lower_limit() {
        let scale = Sliding { high: 18.0, low: 34.0 };
        let of = |value| scale.worth(value, 1.0, Method::Sliding, None).unwrap();
        assert_eq!([0.0, 18.0, 26.0, 30.0, 34.0, 99.0].map(of), [100.0, 100.0, 50.0, 25.0, 0.0, 0.0]);
    }

    #[test]
    fn deductions_take_the_last_step_that_is_reached() {
        let damage = deduction("DAMAGE", &[(0.42, 20.0), (0.47, 40.0)]);
        assert_eq!(
            [0.0, 0.419, 0.42, 0.469, 0.47, 9.0].map(|v| damage.deducted(v)),
            [0.0, 0.0, 20.0, 20.0, 40.0, 40.0]
        );
    }

    #[test]
    fn grades_count_from_good_to_poor() {
        let scale = Grades([560.0, 700.0, 840.0]);
        let found = [560.0, 560.1, 700.0, 840.0, 841.0].map(|v| scale.worth(v, 1.0, Method::Stars, None).unwrap());
        assert_eq!(found, [3.0, 2.0, 2.0, 1.0, 0.0]);
    }
}

//! Statistics of an ensemble's figures: medians, quantiles, bands over time, and which figures are stable.
//!
//! All functions take plain slices, one number for each member, member 0 the unperturbed one; a member that failed or has
//! no such figure is NaN and is counted as missing.

use serde::Serialize;

pub use crate::sketch::sorted;
use crate::sketch::{Sketch, quantile_of_sorted};

/// Spread of a figure over the members of an ensemble.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// Members that have the figure.
    pub members: usize,
    /// Members without it: failed runs, undefined figures.
    pub missing: usize,
    /// Least.
    pub least: f64,
    /// 5 % quantile of the members.
    pub q05: f64,
    /// 25 % quantile.
    pub q25: f64,
    /// Median.
    pub median: f64,
    /// 75 % quantile.
    pub q75: f64,
    /// 95 % quantile.
    pub q95: f64,
    /// Largest.
    pub greatest: f64,
}

/// Whether a figure may be quoted as a single number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The middle 90 % of the members agree within the tolerance.
    Stable,
    /// They do not agree, or the figure is missing in some members.
    NotStable,
    /// Too few members for a verdict.
    TooFew,
}

impl Verdict {
    /// The word in tables and JSON.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Stable => "stable",
            Verdict::NotStable => "not_stable",
            Verdict::TooFew => "too_few",
        }
    }
}

/// Limits on the spread of a stable figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rule {
    /// Width of the middle 90 %, relative to the median.
    pub relative: f64,
    /// Absolute width below which a figure is stable, however small its median.
    pub absolute: f64,
    /// Members needed for any verdict.
    pub least_members: usize,
}

impl Default for Rule {
    /// A tenth of the median, no plain difference, ten members.
    ///
    /// The tenth is ours: a difference that changes no conclusion from a figure known to two digits. With fewer than ten
    /// members the middle 90 % is little else than the two outermost ones.
    fn default() -> Self {
        Rule { relative: 0.10, absolute: 0.0, least_members: 10 }
    }
}

impl Rule {
    /// Largest width of the middle 90 % of a stable figure with this median: max(relative·|median|, absolute).
    pub fn within(&self, median: f64) -> f64 {
        (self.relative * median.abs()).max(self.absolute)
    }
}

impl Spread {
    /// The spread of a figure; none if no member has it.
    pub fn of(values: &[f64]) -> Option<Spread> {
        Spread::of_sketch(&Sketch::exact(values))
    }

    /// The spread of a stream; none if no member has the figure.
    pub fn of_sketch(sketch: &Sketch) -> Option<Spread> {
        let [least, greatest] = sketch.ends()?;
        let ordered = sketch.ordered();
        Some(Spread {
            members: sketch.len(),
            missing: sketch.missing(),
            least,
            q05: ordered.quantile(0.05),
            q25: ordered.quantile(0.25),
            median: ordered.quantile(0.5),
            q75: ordered.quantile(0.75),
            q95: ordered.quantile(0.95),
            greatest,
        })
    }

    /// Width of the middle 90 %.
    pub fn width(&self) -> f64 {
        self.q95 - self.q05
    }

    /// Whether the figure may be quoted as a single number: q₉₅ − q₀₅ ≤ max(relative·|median|, absolute), and no member
    /// lacks it.
    pub fn verdict(&self, rule: &Rule) -> Verdict {
        match (self.missing, self.members) {
            (_, n) if n + self.missing < rule.least_members => Verdict::TooFew,
            (0, _) if self.width() <= rule.within(self.median) => Verdict::Stable,
            _ => Verdict::NotStable,
        }
    }
}

/// Quantile `p` of the numbers, by linear interpolation between them: x at place (n − 1)p, which is
/// definition 7 of R. J. Hyndman, Y. Fan, "Sample quantiles in statistical packages", American Statistician 50 (1996),
/// and what NumPy does. None without numbers.
pub fn quantile(values: &[f64], p: f64) -> Option<f64> {
    let sorted = sorted(values);
    (!sorted.is_empty()).then(|| quantile_of_sorted(&sorted, p))
}

/// The median; none without numbers.
pub fn median(values: &[f64]) -> Option<f64> {
    quantile(values, 0.5)
}

/// Spread of one channel at each output time. NaN where no member has a value.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Band {
    /// 5 % quantile of the members.
    pub q05: Vec<f64>,
    /// 25 % quantile.
    pub q25: Vec<f64>,
    /// Median.
    pub median: Vec<f64>,
    /// 75 % quantile.
    pub q75: Vec<f64>,
    /// 95 % quantile.
    pub q95: Vec<f64>,
}

impl Band {
    /// The band of one channel, from a list per member with one number per output time. A member that ended early
    /// counts for the times it has.
    pub fn of(members: &[&[f64]]) -> Band {
        let times = members.iter().map(|m| m.len()).max().unwrap_or(0);
        let mut band = Band::default();
        for i in 0..times {
            let now: Vec<f64> = members.iter().filter_map(|m| m.get(i).copied()).collect();
            let spread = Spread::of(&now);
            let pick = |f: fn(&Spread) -> f64| spread.as_ref().map_or(f64::NAN, f);
            band.q05.push(pick(|s| s.q05));
            band.q25.push(pick(|s| s.q25));
            band.median.push(pick(|s| s.median));
            band.q75.push(pick(|s| s.q75));
            band.q95.push(pick(|s| s.q95));
        }
        band
    }

    /// Number of output times.
    pub fn len(&self) -> usize {
        self.median.len()
    }

    /// Whether it has none.
    pub fn is_empty(&self) -> bool {
        self.median.is_empty()
    }

    /// Largest magnitude of the median: the reference of a relative tolerance.
    pub fn peak(&self) -> f64 {
        let sizes = self.median.iter().map(|x| x.abs());
        sizes.filter(|x| x.is_finite()).fold(0.0, f64::max)
    }

    /// Index of the first output at which the middle 90 % is wider than `tolerance`, in the channel's unit; none if
    /// never.
    pub fn first_wider_than(&self, tolerance: f64) -> Option<usize> {
        let mut widths = self.q95.iter().zip(&self.q05).map(|(high, low)| high - low);
        widths.position(|width| width > tolerance)
    }

    /// The time at which the middle 90 % first is wider than `tolerance`; none if never.
    pub fn time_wider_than(&self, times_s: &[f64], tolerance: f64) -> Option<f64> {
        times_s.get(self.first_wider_than(tolerance)?).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_numpy() {
        // numpy.quantile([3, 1, 10, 4], [0, 0.05, 0.25, 0.5, 0.95, 1])
        let x = [3.0, 1.0, 10.0, 4.0];
        for (p, wanted) in [(0.0, 1.0), (0.05, 1.3), (0.25, 2.5), (0.5, 3.5), (0.95, 9.1), (1.0, 10.0)] {
            let found = quantile(&x, p).unwrap();
            assert!((found - wanted).abs() < 1e-14, "{p}: {found}");
        }
        assert_eq!(median(&[2.0]), Some(2.0));
        assert_eq!(median(&[f64::NAN, 5.0, f64::INFINITY, 7.0]), Some(6.0));
        assert_eq!(median(&[]), None);
        assert_eq!(Spread::of(&[f64::NAN]), None);
    }

    #[test]
    fn a_figure_is_stable_if_most_members_agree() {
        let rule = Rule::default();
        let verdict = |x: &[f64]| Spread::of(x).unwrap().verdict(&rule);
        let mut close: Vec<f64> = (0..20).map(|i| 100.0 + 0.4 * f64::from(i)).collect();
        // 90 % of 0 … 7.6 is 6.84, below a tenth of 103.8
        assert_eq!(verdict(&close), Verdict::Stable);
        // one wild member of twenty reaches into the middle 90 %
        close[3] = 300.0;
        assert_eq!(verdict(&close), Verdict::NotStable);
        let mirrored: Vec<f64> = (0..20).map(|i| -100.0 - 0.4 * f64::from(i)).collect();
        assert_eq!(verdict(&mirrored), Verdict::Stable);
        let wide: Vec<f64> = (0..20).map(|i| 100.0 + f64::from(i)).collect();
        assert_eq!(verdict(&wide), Verdict::NotStable);
        assert_eq!(verdict(&[1.0; 9]), Verdict::TooFew);
        // a figure that some members lack
        let mut lacking = vec![1.0; 20];
        lacking[7] = f64::NAN;
        assert_eq!(verdict(&lacking), Verdict::NotStable);
        // about nothing: only the plain difference helps
        let around: Vec<f64> = (0..20).map(|i| 1e-3 * f64::from(i - 10)).collect();
        assert_eq!(verdict(&around), Verdict::NotStable);
        let plain = Rule { absolute: 0.1, ..rule };
        assert_eq!(Spread::of(&around).unwrap().verdict(&plain), Verdict::Stable);
    }

    /// Members x = a·eᵗ with a evenly spread over ±1e-3: the middle 90 % is 1.8e-3·eᵗ wide.
    #[test]
    fn a_growing_difference_is_seen_when_it_passes_the_tolerance() {
        let times: Vec<f64> = (0..100).map(|i| 0.1 * f64::from(i)).collect();
        let members: Vec<Vec<f64>> = (0..=200)
            .map(|k| {
                let a = 1e-3 * (f64::from(k) / 100.0 - 1.0);
                times.iter().map(|t| 1.0 + a * t.exp()).collect()
            })
            .collect();
        let members: Vec<&[f64]> = members.iter().map(Vec::as_slice).collect();
        let band = Band::of(&members);
        assert!(band.median.iter().all(|x| (x - 1.0).abs() < 1e-12));
        let width = band.q95[50] - band.q05[50];
        assert!((width - 1.8e-3 * 5.0_f64.exp()).abs() < 1e-12, "{width}");
        // 1.8e-3·eᵗ = 0.5 at t = 5.627
        let time = band.time_wider_than(&times, 0.5).unwrap();
        assert!((time - 5.7).abs() < 1e-12, "{time}");
        assert_eq!(band.time_wider_than(&times, 1e9), None);
        assert_eq!((band.len(), band.peak()), (100, 1.0));
    }

    #[test]
    fn members_that_end_early_count_while_they_last() {
        let band = Band::of(&[&[1.0, 2.0], &[3.0, 4.0, 5.0], &[]]);
        assert_eq!(band.median, [2.0, 3.0, 5.0]);
        assert!(Band::of(&[]).is_empty());
        let gap = Band::of(&[&[f64::NAN, 1.0]]);
        assert!(gap.median[0].is_nan() && gap.first_wider_than(0.0).is_none());
    }
}

//! Level held for three milliseconds.
//!
//! Contiguous ("3S"): the highest L such that a ≥ L during one uninterrupted interval of at least
//! 3 ms. Cumulative ("3C"): the highest L such that the total time with a ≥ L is at least 3 ms. The
//! cumulative level is never below the contiguous one; UN R94/R137 use the cumulative one for the
//! head and FMVSS 208 words its 60 g chest limit cumulatively. Report both with their labels.
//!
//! On the straight line through the samples the time above L changes linearly with L between two
//! neighbouring sample values. So: bisect on the sorted sample values for the pair that brackets the
//! answer, then solve the linear equation there. No iteration tolerance. Only the high part of the
//! signal is sorted: from a level on that is held for long enough.

use crate::signal::{SignalError, require_positive, require_samples, whole_steps};

/// A level exceeded for a given time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThreeMs {
    /// The level, m/s² (or the unit of the signal given).
    pub level_mps2: f64,
    /// Start of the interval at or above the level; of the first one, where the time is cumulative, s.
    pub start_s: f64,
    /// End of the interval at or above the level; of the last one, where the time is cumulative, s.
    pub end_s: f64,
}

/// Level held for 3 ms without interruption.
///
/// # Errors
/// As [`clip_contiguous`].
pub fn three_ms_contiguous(resultant_mps2: &[f64], dt_s: f64) -> Result<ThreeMs, SignalError> {
    clip_contiguous(resultant_mps2, dt_s, 0.003)
}

/// Level exceeded for 3 ms in total.
///
/// # Errors
/// As [`clip_cumulative`].
pub fn three_ms_cumulative(resultant_mps2: &[f64], dt_s: f64) -> Result<ThreeMs, SignalError> {
    clip_cumulative(resultant_mps2, dt_s, 0.003)
}

/// [`three_ms_contiguous`] and [`three_ms_cumulative`], of one search for the high part of the signal.
///
/// # Errors
/// As [`clip_contiguous`].
pub fn three_ms_both(resultant_mps2: &[f64], dt_s: f64) -> Result<[ThreeMs; 2], SignalError> {
    let heights = Heights::new(resultant_mps2, dt_s, 0.003)?;
    Ok([heights.held(0.003, Counting::Contiguous)?, heights.held(0.003, Counting::Cumulative)?])
}

/// Level held for `duration_s` without interruption.
///
/// # Errors
/// A signal shorter than the duration, a sample that is not finite, an interval or duration that is
/// not positive.
pub fn clip_contiguous(values: &[f64], dt_s: f64, duration_s: f64) -> Result<ThreeMs, SignalError> {
    clip(values, dt_s, duration_s, Counting::Contiguous)
}

/// Level exceeded for `duration_s` in total.
///
/// # Errors
/// As [`clip_contiguous`].
pub fn clip_cumulative(values: &[f64], dt_s: f64, duration_s: f64) -> Result<ThreeMs, SignalError> {
    clip(values, dt_s, duration_s, Counting::Cumulative)
}

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Counting {
    /// In one interval.
    Contiguous,
    /// In all together.
    Cumulative,
}

/// Time at or above a level: one uninterrupted interval, or the sum of all.
#[derive(Clone, Copy)]
struct Above {
    start_s: f64,
    end_s: f64,
    time_s: f64,
    /// −d(time)/d(level) while the level passes no sample value, s per unit.
    loss_s: f64,
}

fn clip(values: &[f64], dt_s: f64, duration_s: f64, counting: Counting) -> Result<ThreeMs, SignalError> {
    Heights::new(values, dt_s, duration_s)?.held(duration_s, counting)
}

/// The high part of a signal, in which levels held for some time are searched.
pub(super) struct Heights {
    dt_s: f64,
    /// Time of the last sample, s.
    last_s: f64,
    /// The first sample.
    first: f64,
    /// Neighbours of which at least one is as high as the lowest of `levels`: index of the first, and both.
    flanks: Vec<(usize, f64, f64)>,
    /// Values from one that is held for long enough, ascending.
    levels: Vec<f64>,
}

impl Heights {
    /// The part in which levels held for up to `longest_s` are.
    pub(super) fn new(values: &[f64], dt_s: f64, longest_s: f64) -> Result<Self, SignalError> {
        require_positive("duration (s)", longest_s)?;
        require_samples("signal to clip", values, dt_s, 2)?;
        let last_s = (values.len() - 1) as f64 * dt_s;
        // so many samples of a single pulse take the time twice
        let mut count = 2 * whole_steps(longest_s, dt_s).min(values.len()) + 8;
        let mut sorted = values.to_vec();
        loop {
            let lowest = nth_largest(&mut sorted, count);
            let pairs = values.windows(2).enumerate().map(|(i, pair)| (i, pair[0], pair[1]));
            let mut all = Heights {
                dt_s,
                last_s,
                first: values[0],
                flanks: pairs.filter(|(_, a, b)| *a >= lowest || *b >= lowest).collect(),
                levels: Vec::new(),
            };
            if count >= values.len() || all.longest(lowest, Counting::Contiguous).time_s >= longest_s {
                all.levels = values.iter().copied().filter(|value| *value >= lowest).collect();
                all.levels.sort_by(f64::total_cmp);
                all.levels.dedup();
                return Ok(all);
            }
            count = count.saturating_mul(4);
        }
    }

    /// Highest level held for `duration_s`, at most that of [`Heights::new`].
    pub(super) fn held(&self, duration_s: f64, counting: Counting) -> Result<ThreeMs, SignalError> {
        // exact multiples of the interval must not fail by rounding
        let needed_s = duration_s * (1.0 - 1e-9);
        if self.last_s < needed_s {
            let found_s = self.last_s;
            return Err(SignalError::TooBrief { what: "signal to clip", found_s, needed_s: duration_s });
        }
        // the lowest level holds for long enough; find the first that does not
        let holds = |level: &f64| self.longest(*level, counting).time_s >= needed_s;
        let failing = self.levels.partition_point(holds);
        let lower = self.levels[failing.saturating_sub(1)];
        let level = match self.levels.get(failing) {
            Some(&upper) => self.solve_between(needed_s, lower, upper, counting),
            None => lower,
        };
        let interval = self.longest(level, counting);
        Ok(ThreeMs { level_mps2: level, start_s: interval.start_s, end_s: interval.end_s })
    }

    /// Highest level in [lower, upper) held for `needed_s`, with no sample between the two.
    fn solve_between(&self, needed_s: f64, lower: f64, upper: f64, counting: Counting) -> f64 {
        let middle = 0.5 * (lower + upper);
        let mut level = lower;
        self.intervals_above(middle, counting, |above| {
            if above.loss_s > 0.0 {
                // time(L) = time(middle) − loss·(L − middle) = needed
                level = level.max(middle + (above.time_s - needed_s) / above.loss_s);
            }
        });
        level.min(upper)
    }

    /// The longest interval at or above `level` (the total, where cumulative).
    fn longest(&self, level: f64, counting: Counting) -> Above {
        let mut longest = Above { start_s: 0.0, end_s: 0.0, time_s: -1.0, loss_s: 0.0 };
        self.intervals_above(level, counting, |above| {
            if above.time_s > longest.time_s {
                longest = above;
            }
        });
        longest
    }

    /// Calls `each` with every interval at or above `level`, or once with their sum where cumulative.
    fn intervals_above(&self, level: f64, counting: Counting, mut each: impl FnMut(Above)) {
        let mut total: Option<Above> = None;
        let mut close = |above: Above| match (counting, &mut total) {
            (Counting::Contiguous, _) => each(above),
            (Counting::Cumulative, None) => total = Some(above),
            (Counting::Cumulative, Some(sum)) => {
                sum.end_s = above.end_s;
                sum.time_s += above.time_s;
                sum.loss_s += above.loss_s;
            }
        };
        let mut open = (self.first >= level).then_some((0.0, 0.0));
        for &(i, a, b) in &self.flanks {
            if (a >= level) == (b >= level) {
                continue;
            }
            let crossing_s = self.dt_s * (i as f64 + (level - a) / (b - a));
            let loss_s = self.dt_s / (b - a).abs();
            match open.take() {
                None => open = Some((crossing_s, loss_s)),
                Some((start_s, loss_at_start_s)) => close(Above {
                    start_s,
                    end_s: crossing_s,
                    time_s: crossing_s - start_s,
                    loss_s: loss_at_start_s + loss_s,
                }),
            }
        }
        if let Some((start_s, loss_s)) = open {
            close(Above { start_s, end_s: self.last_s, time_s: self.last_s - start_s, loss_s });
        }
        if let Some(sum) = total {
            each(sum);
        }
    }
}

/// The value with so many at least as large, counted with it; the smallest if there are fewer. Reorders.
fn nth_largest(values: &mut [f64], count: usize) -> f64 {
    let from = values.len().saturating_sub(count);
    *values.select_nth_unstable_by(from, f64::total_cmp).1
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn sampled(length_s: f64, dt_s: f64, pulse: impl Fn(f64) -> f64) -> Vec<f64> {
        let n = (length_s / dt_s).round() as usize;
        (0..=n).map(|i| pulse(i as f64 * dt_s)).collect()
    }

    #[test]
    fn closed_forms_of_four_pulses() {
        let (a, length_s, dt_s) = (60.0, 0.04, 1e-5);
        let half_sine = sampled(length_s, dt_s, |t| a * (PI * t / length_s).sin());
        let haversine = sampled(length_s, dt_s, |t| a * (PI * t / length_s).sin().powi(2));
        let triangle = sampled(length_s, dt_s, |t| a * (1.0 - (2.0 * t / length_s - 1.0).abs()));
        let square = sampled(length_s, dt_s, |_| a);
        let cases = [
            (half_sine, a * (PI * 0.003 / (2.0 * length_s)).cos()),
            (haversine, a * (PI * (length_s - 0.003) / (2.0 * length_s)).sin().powi(2)),
            (triangle, a * (1.0 - 0.003 / length_s)),
            (square, a),
        ];
        for (signal, expected) in cases {
            let contiguous = three_ms_contiguous(&signal, dt_s).unwrap();
            let cumulative = three_ms_cumulative(&signal, dt_s).unwrap();
            // measured 8.1e-11: the crossings fall on samples
            assert!((contiguous.level_mps2 / expected - 1.0).abs() < 1e-9, "{contiguous:?} {expected}");
            assert!((cumulative.level_mps2 / contiguous.level_mps2 - 1.0).abs() < 1e-12);
            assert_eq!(three_ms_both(&signal, dt_s).unwrap(), [contiguous, cumulative]);
            if expected < a {
                assert!((contiguous.end_s - contiguous.start_s - 0.003).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn published_example() {
        // sin(100πt): 0.89101 between 3.5 and 6.5 ms
        let signal = sampled(0.01, 1e-4, |t| (100.0 * PI * t).sin());
        let found = three_ms_contiguous(&signal, 1e-4).unwrap();
        assert!((found.level_mps2 - 0.89101).abs() < 5e-6);
        assert!((found.start_s - 0.0035).abs() < 1e-6 && (found.end_s - 0.0065).abs() < 1e-6);
    }

    #[test]
    fn two_short_peaks_add_up_only_cumulatively() {
        // two triangles of 4 ms base and height 100: each holds 100·(1 − 3/4) = 25 for 3 ms alone;
        // together 2·4·(1 − L/100) ms = 3 ms gives L = 62.5
        let dt_s = 1e-3;
        let signal = [0., 50., 100., 50., 0., 0., 0., 50., 100., 50., 0.];
        assert!((three_ms_contiguous(&signal, dt_s).unwrap().level_mps2 - 25.0).abs() < 1e-6);
        let cumulative = three_ms_cumulative(&signal, dt_s).unwrap();
        assert!((cumulative.level_mps2 - 62.5).abs() < 1e-6);
        assert!((cumulative.start_s - 0.00125).abs() < 1e-9 && (cumulative.end_s - 0.00875).abs() < 1e-9);
    }

    #[test]
    fn plateaus_and_touching_minima_are_exact() {
        // a plateau of exactly 3 ms holds its own level
        let plateau = [0., 0., 7., 7., 7., 7., 0., 0.];
        assert_eq!(three_ms_contiguous(&plateau, 1e-3).unwrap().level_mps2, 7.0);
        // a minimum that touches the level does not interrupt
        let touching = [5., 9., 5., 9., 5., 1., 1.];
        assert_eq!(three_ms_contiguous(&touching, 1e-3).unwrap().level_mps2, 5.0);
        let constant = [4.0; 20];
        assert_eq!(three_ms_cumulative(&constant, 1e-3).unwrap().level_mps2, 4.0);
    }

    /// Time at or above a level, by its definition: of the longest interval, or of all.
    fn above(values: &[f64], dt_s: f64, level: f64, counting: Counting) -> f64 {
        let (mut sum_s, mut most_s) = (0.0, 0.0_f64);
        for pair in values.windows(2) {
            let (low, high) = (pair[0].min(pair[1]), pair[0].max(pair[1]));
            if counting == Counting::Contiguous && pair[0] < level {
                sum_s = 0.0;
            }
            sum_s += match () {
                () if low >= level => dt_s,
                () if high >= level => dt_s * (high - level) / (high - low),
                () => 0.0,
            };
            most_s = most_s.max(sum_s);
        }
        most_s
    }

    #[test]
    fn agrees_with_a_bisection_on_the_level() {
        let times = || (0..2500).map(f64::from);
        let smooth = times().map(|i| 40.0 + 30.0 * (i * 0.013).sin() + 20.0 * (i * 0.171).cos());
        // held for 3 ms only far below its peaks
        let comb = times().map(|i| if i % 2.0 == 0.0 { 90.0 + (i * 0.37).sin() } else { -5.0 + (i * 0.11).cos() });
        let spikes = times().map(|i| if i % 37.0 == 3.0 { 60.0 + (i * 0.37).sin() } else { (i * 0.05).sin() });
        for signal in [smooth.collect::<Vec<_>>(), comb.collect(), spikes.collect()] {
            for counting in [Counting::Contiguous, Counting::Cumulative] {
                let (mut low, mut high) = (-20.0, 100.0);
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if above(&signal, 1e-4, middle, counting) >= 0.003 { low = middle } else { high = middle }
                }
                let found = clip(&signal, 1e-4, 0.003, counting).unwrap().level_mps2;
                assert!((found - low).abs() < 1e-6, "{found} {low}");
            }
        }
    }

    #[test]
    fn unusable_signals_are_named() {
        assert!(matches!(three_ms_contiguous(&[1.0, 2.0], 1e-3), Err(SignalError::TooBrief { .. })));
        assert!(matches!(three_ms_both(&[1.0, 2.0], 1e-3), Err(SignalError::TooBrief { .. })));
        assert!(matches!(three_ms_cumulative(&[1.0; 9], f64::NAN), Err(SignalError::OutOfRange { .. })));
        assert!(matches!(clip_cumulative(&[1.0, f64::NAN, 1.0], 1e-3, 1e-3), Err(SignalError::NotFinite { .. })));
    }
}

//! How a measured channel and a computed one go together, beyond the score: what a wrong sign, a wrong unit or a wrong clock
//! of a test looks like.

use serde::Serialize;

use crate::compare::RATE_HZ;

/// Largest lag tried, samples.
const MOST_LAG: usize = 100;
/// Ratio of measured to computed peak, or its inverse, above which another unit or gain is suspected.
const PEAKS: f64 = 2.0;
/// Least lag that is reported, s, …
const LAG_S: f64 = 0.15e-3;
/// … if it lowers the mean square difference to this fraction.
const FALLS_TO: f64 = 0.8;

/// Agreement of a measured channel with the computed one.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Accord {
    /// Correlation, −1 to 1; 0 for a constant history.
    pub correlation: f64,
    /// Largest measured over largest computed magnitude; none if the computed one is 0.
    pub peak_ratio: Option<f64>,
    /// Lag of the measured signal, at most 10 ms, for the best agreement, s.
    pub lag_s: f64,
    /// Mean square difference with that shift, relative to that without.
    #[serde(skip)]
    falls_to: f64,
}

impl Accord {
    /// Agreement of two histories at 10 kHz over the same times.
    pub fn of(measured: &[f64], computed: &[f64]) -> Accord {
        let peak = |values: &[f64]| values.iter().fold(0.0, |g: f64, v| g.max(v.abs()));
        let most = MOST_LAG.min(measured.len() / 4);
        let late = |k: usize| mean_square(&measured[k..], computed);
        let early = |k: usize| mean_square(measured, &computed[k..]);
        let squares: Vec<f64> = (1..=most).rev().map(early).chain((0..=most).map(late)).collect();
        let mut best = most;
        for (at, square) in squares.iter().enumerate() {
            // of equals none, or the least
            if *square < squares[best] * (1.0 - 1e-9) {
                best = at;
            }
        }
        let between = match squares.get(best.wrapping_sub(1)..best + 2) {
            Some([a, b, c]) if a - 2.0 * b + c > 0.0 => 0.5 * (a - c) / (a - 2.0 * b + c),
            _ => 0.0,
        };
        Accord {
            correlation: correlation(measured, computed),
            peak_ratio: Some(peak(measured) / peak(computed)).filter(|ratio| ratio.is_finite()),
            lag_s: (best as f64 - most as f64 + between) / RATE_HZ,
            falls_to: if squares[most] > 0.0 { squares[best] / squares[most] } else { 1.0 },
        }
    }

    /// Suspected problems of the test.
    pub fn caution(&self, test: &str, channel: &str) -> Option<String> {
        let of = format!("{channel} of {test}");
        let ratio = self.peak_ratio.unwrap_or(f64::INFINITY);
        if self.correlation < 0.0 {
            let r = self.correlation;
            return Some(format!(
                "{of} has the opposite sign to the computed channel (correlation {r:.2}). If the sign is wrong: map = [\"column=-{channel}\"]"
            ));
        }
        if !(1.0 / PEAKS..=PEAKS).contains(&ratio) {
            return Some(format!(
                "the peak of {of} is {ratio:.3} times the computed one: check its unit, or set `gain`"
            ));
        }
        let (ms, falls) = (1e3 * self.lag_s, 100.0 * (1.0 - self.falls_to));
        (self.lag_s.abs() >= LAG_S && self.falls_to < FALLS_TO).then(|| {
            let word = if ms > 0.0 { "late" } else { "early" };
            format!(
                "{of} is {:.2} ms {word}: shifting it would reduce the mean square difference by {falls:.0} %. Set `shift`, or let the fit find it with `offset` of the test",
                ms.abs()
            )
        })
    }
}

/// Mean square difference over the common length.
fn mean_square(a: &[f64], b: &[f64]) -> f64 {
    let n = a.len().min(b.len());
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>() / n as f64
}

fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let (ma, mb) = (mean(a), mean(b));
    let (mut ab, mut aa, mut bb) = (0.0, 0.0, 0.0);
    for (a, b) in a.iter().zip(b) {
        ab += (a - ma) * (b - mb);
        aa += (a - ma) * (a - ma);
        bb += (b - mb) * (b - mb);
    }
    let r: f64 = ab / (aa * bb).sqrt();
    if r.is_finite() { r.clamp(-1.0, 1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sign_unit_and_clock_of_a_test_are_told() {
        let pulse = |late_s: f64, size: f64| -> Vec<f64> {
            let at = |i: usize| (i as f64 / RATE_HZ - 0.04 - late_s) / 0.01;
            (0..800).map(|i| size * (-at(i) * at(i)).exp()).collect()
        };
        let ours = pulse(0.0, 100.0);
        let of = |late_s, size| Accord::of(&pulse(late_s, size), &ours);
        assert_eq!(of(0.0, 95.0).caution("t", "c"), None);
        for late_s in [2e-3, -1.23e-3, 0.5e-3] {
            let found = of(late_s, 100.0);
            assert!((found.lag_s - late_s).abs() < 2e-6, "{late_s} {}", found.lag_s);
            let word = if late_s > 0.0 { "late" } else { "early" };
            assert!(found.caution("t", "c").is_some_and(|words| words.contains(word)));
        }
        assert!(of(0.0, -100.0).caution("t", "c").is_some_and(|words| words.contains("column=-c")));
        assert!(of(0.0, 0.1).caution("t", "c").is_some_and(|words| words.contains("0.001 times")));
        assert_eq!(Accord::of(&ours, &[0.0; 800]).peak_ratio, None);
    }
}

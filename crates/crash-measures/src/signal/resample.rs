//! Values between samples, and new sample intervals.
//!
//! Two interpolants: the straight line, which never overshoots, and the monotone cubic of Fritsch
//! and Carlson (1980; slopes as the weighted harmonic mean of Fritsch and Butland), which is smooth,
//! keeps rises rises and gives a continuous derivative: the way from recorded velocity changes to
//! accelerations. To lower a sample rate, filter first.

use super::{SignalError, require_positive, require_same_length, require_samples, whole_steps};

/// Largest number of steps of a resampled record: measures of six channels take half a kilobyte for each.
const MOST_STEPS: usize = 1_500_000;

/// Interpolation between samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interpolation {
    /// Linear.
    Linear,
    /// Monotone cubics.
    MonotoneCubic,
}

/// Values over increasing times that need not be equally spaced.
#[derive(Debug, Clone)]
pub struct Interpolant<'a> {
    time_s: &'a [f64],
    values: &'a [f64],
    /// Slopes at the samples; none for linear interpolation.
    slopes: Option<Vec<f64>>,
}

impl<'a> Interpolant<'a> {
    /// Prepares the interpolant.
    ///
    /// # Errors
    /// Fewer than two samples, different lengths, a number that is not finite, times that do not
    /// increase.
    pub fn new(time_s: &'a [f64], values: &'a [f64], shape: Interpolation) -> Result<Self, SignalError> {
        require_samples("signal to interpolate", values, 1.0, 2)?;
        require_samples("time", time_s, 1.0, 2)?;
        require_same_length("signal to interpolate", values, time_s)?;
        if let Some(index) = (1..time_s.len()).find(|&i| time_s[i] <= time_s[i - 1]) {
            return Err(SignalError::NotIncreasing { index, found_s: time_s[index], previous_s: time_s[index - 1] });
        }
        let slopes = match shape {
            Interpolation::Linear => None,
            Interpolation::MonotoneCubic => Some(monotone_slopes(time_s, values)),
        };
        Ok(Self { time_s, values, slopes })
    }

    /// The value at `time_s`; beyond the ends, the end value.
    #[must_use]
    pub fn value_at(&self, time_s: f64) -> f64 {
        let (i, h, s) = self.cell(time_s);
        let (a, b) = (self.values[i], self.values[i + 1]);
        match &self.slopes {
            None => a + (b - a) * s,
            // cubic Hermite polynomial on [0, 1]
            Some(m) => {
                let (s2, s3) = (s * s, s * s * s);
                (2.0 * s3 - 3.0 * s2 + 1.0) * a
                    + (3.0 * s2 - 2.0 * s3) * b
                    + h * ((s3 - 2.0 * s2 + s) * m[i] + (s3 - s2) * m[i + 1])
            }
        }
    }

    /// The derivative at `time_s`, unit of the values per second; at a sample of a linear interpolant that of the line
    /// to the right; beyond the ends that at the end.
    #[must_use]
    pub fn slope_at(&self, time_s: f64) -> f64 {
        let (i, h, s) = self.cell(time_s);
        let rise = (self.values[i + 1] - self.values[i]) / h;
        match &self.slopes {
            None => rise,
            Some(m) => {
                6.0 * (s - s * s) * rise + (1.0 - 4.0 * s + 3.0 * s * s) * m[i] + (3.0 * s * s - 2.0 * s) * m[i + 1]
            }
        }
    }

    /// Samples from the first time to the last whole interval.
    ///
    /// # Errors
    /// An interval that is not positive, or too short for the length of the record.
    pub fn resample(&self, dt_s: f64) -> Result<Vec<f64>, SignalError> {
        require_positive("new sample interval (s)", dt_s)?;
        let start_s = self.time_s[0];
        let steps = whole_steps(self.time_s[self.time_s.len() - 1] - start_s, dt_s);
        if steps > MOST_STEPS {
            let expected = "long enough for at most 1.5 million samples";
            return Err(SignalError::OutOfRange { what: "new sample interval (s)", found: dt_s, expected });
        }
        Ok((0..=steps).map(|i| self.value_at(start_s + i as f64 * dt_s)).collect())
    }

    /// Index of the interval, its length, and the position in it, 0..=1.
    fn cell(&self, time_s: f64) -> (usize, f64, f64) {
        let after = self.time_s.partition_point(|&t| t <= time_s);
        let i = after.saturating_sub(1).min(self.time_s.len() - 2);
        let h = self.time_s[i + 1] - self.time_s[i];
        (i, h, ((time_s - self.time_s[i]) / h).clamp(0.0, 1.0))
    }
}

/// A uniform signal at another interval, interpolated linearly.
///
/// # Errors
/// Fewer than two samples, a sample that is not finite, intervals that are not positive.
pub fn resample(values: &[f64], dt_s: f64, new_dt_s: f64) -> Result<Vec<f64>, SignalError> {
    require_samples("signal to resample", values, dt_s, 2)?;
    let time_s: Vec<f64> = (0..values.len()).map(|i| i as f64 * dt_s).collect();
    Interpolant::new(&time_s, values, Interpolation::Linear)?.resample(new_dt_s)
}

fn monotone_slopes(t: &[f64], y: &[f64]) -> Vec<f64> {
    let n = t.len();
    let h: Vec<f64> = t.windows(2).map(|w| w[1] - w[0]).collect();
    let d: Vec<f64> = (0..n - 1).map(|i| (y[i + 1] - y[i]) / h[i]).collect();
    if n == 2 {
        return vec![d[0]; 2];
    }
    let mut m = vec![0.0; n];
    for i in 1..n - 1 {
        if d[i - 1] * d[i] > 0.0 {
            let (w1, w2) = (2.0 * h[i] + h[i - 1], h[i] + 2.0 * h[i - 1]);
            m[i] = (w1 + w2) / (w1 / d[i - 1] + w2 / d[i]);
        }
    }
    m[0] = end_slope(h[0], h[1], d[0], d[1]);
    m[n - 1] = end_slope(h[n - 2], h[n - 3], d[n - 2], d[n - 3]);
    m
}

/// Three-point end slope, held to the sign and to three times the first rise.
fn end_slope(h0: f64, h1: f64, d0: f64, d1: f64) -> f64 {
    let slope = ((2.0 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
    if slope * d0 <= 0.0 {
        0.0
    } else if d0 * d1 <= 0.0 && slope.abs() > 3.0 * d0.abs() {
        3.0 * d0
    } else {
        slope
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_parabolas_are_reproduced() {
        let time_s = [0.0, 0.1, 0.25, 0.3, 0.5];
        let line: Vec<f64> = time_s.iter().map(|t| 2.0 - 3.0 * t).collect();
        for shape in [Interpolation::Linear, Interpolation::MonotoneCubic] {
            let through = Interpolant::new(&time_s, &line, shape).unwrap();
            for t in [0.0, 0.05, 0.27, 0.41, 0.5] {
                assert!((through.value_at(t) - (2.0 - 3.0 * t)).abs() < 1e-14);
                assert!((through.slope_at(t) + 3.0).abs() < 1e-13);
            }
            assert_eq!(through.value_at(9.0), line[4]);
        }
    }

    #[test]
    fn the_monotone_cubic_matches_reference_values_and_never_overshoots() {
        // a velocity change that rises to a plateau
        let time_s = [0.0, 0.01, 0.02, 0.03, 0.05];
        let dv_mps = [0.0, -1.0, -4.0, -6.0, -6.0];
        let cubic = Interpolant::new(&time_s, &dv_mps, Interpolation::MonotoneCubic).unwrap();
        // interior slopes are harmonic means: 2/(1/100 + 1/300) = 150, 2/(1/300 + 1/200) = 240
        assert!((cubic.slope_at(0.01) + 150.0).abs() < 1e-9);
        assert!((cubic.slope_at(0.02) + 240.0).abs() < 1e-9);
        assert_eq!(cubic.slope_at(0.03), 0.0);
        // (start) three-point slope (3·100 − 300)/2 = 0
        assert!(cubic.slope_at(0.0).abs() < 1e-9);
        let fine = cubic.resample(1e-4).unwrap();
        assert_eq!(fine.len(), 501);
        assert!(fine.windows(2).all(|w| w[1] <= w[0] + 1e-12));
        assert!(fine.iter().all(|v| (-6.0 - 1e-12..=1e-12).contains(v)));
        // the derivative integrates back to the velocity change
        let slopes: Vec<f64> = (0..=5000).map(|i| cubic.slope_at(f64::from(i) * 1e-5)).collect();
        let total = *super::super::integrate(&slopes, 1e-5, 0.0).unwrap().last().unwrap();
        assert!((total + 6.0).abs() < 1e-5, "{total}"); // measured 2.1e-6, trapezoids across corners
    }

    #[test]
    fn a_uniform_signal_keeps_its_samples() {
        let coarse = [0.0, 2.0, -1.0];
        assert_eq!(resample(&coarse, 1e-3, 5e-4).unwrap(), [0.0, 1.0, 2.0, 0.5, -1.0]);
        assert!(resample(&coarse, 1e-3, 0.0).is_err());
        assert!(resample(&coarse, 1e-3, 1e-15).is_err());
        let tied = Interpolant::new(&[0.0, 0.0], &[1.0, 2.0], Interpolation::Linear);
        assert!(matches!(tied, Err(SignalError::NotIncreasing { .. })));
    }
}

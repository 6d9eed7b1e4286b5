//! Two-pole Butterworth low-pass filter, run forward and backward.
//!
//! yₙ = a₀ xₙ + a₁ xₙ₋₁ + a₂ xₙ₋₂ + b₁ yₙ₋₁ + b₂ yₙ₋₂. One pass forward and one backward
//! make a four-pole filter without phase lag.

use super::{SignalError, require_positive, require_samples, whole_steps};
use std::f64::consts::{PI, SQRT_2};

/// Ratio of the corner of one pass to the −3 dB frequency of both passes together: (√2 − 1)^(−1/4).
pub const TWO_PASS_CORNER_RATIO: f64 = 1.246_504_702_770_927;

/// Continuation of a record beyond its ends before filtering.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Continuation {
    /// Reflected in its end points: 2x₀ − xᵢ before, 2x_N − x_{N−i} after. Filter passes start from
    /// the mean of their first ten values.
    PointReflection {
        /// Samples added at each end, at most one less than the record has.
        samples: usize,
    },
    /// End values held. Filter passes start at rest on the held value.
    Hold {
        /// Samples added at each end, at most two million.
        samples: usize,
    },
    /// The mean of the samples nearest to each end, held, so that a record may end at any phase of a vibration. Filter
    /// passes start at rest on it.
    HoldMean {
        /// Samples added at each end, at most two million.
        samples: usize,
        /// Number of samples averaged, at most all.
        of: usize,
    },
}

/// Coefficients of one pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LowPass {
    /// Weight of xₙ.
    pub a0: f64,
    /// Weight of xₙ₋₁.
    pub a1: f64,
    /// Weight of xₙ₋₂.
    pub a2: f64,
    /// Weight of yₙ₋₁.
    pub b1: f64,
    /// Weight of yₙ₋₂.
    pub b2: f64,
}

impl LowPass {
    /// A pass with its −3 dB corner at `corner_hz` for samples `dt_s` apart (bilinear transform,
    /// corner prewarped).
    ///
    /// # Errors
    /// A corner or interval that is not positive, or a corner at or above half the sample rate.
    pub fn with_corner(corner_hz: f64, dt_s: f64) -> Result<Self, SignalError> {
        require_positive("filter corner (Hz)", corner_hz)?;
        require_positive("sample interval (s)", dt_s)?;
        let nyquist_hz = 0.5 / dt_s;
        if corner_hz >= nyquist_hz {
            return Err(SignalError::CornerAboveNyquist { corner_hz, nyquist_hz });
        }
        // ω_d = 2π f,  ω_a = tan(ω_d T/2),  d = 1 + √2 ω_a + ω_a²
        let wa = libm::tan(PI * corner_hz * dt_s);
        let d = 1.0 + SQRT_2 * wa + wa * wa;
        let a0 = wa * wa / d;
        Ok(Self { a0, a1: 2.0 * a0, a2: a0, b1: -2.0 * (wa * wa - 1.0) / d, b2: (-1.0 + SQRT_2 * wa - wa * wa) / d })
    }

    /// The four-pole filter whose −3 dB frequency after both passes is `cutoff_hz`.
    ///
    /// # Errors
    /// As [`Self::with_corner`].
    pub fn with_two_pass_cutoff(cutoff_hz: f64, dt_s: f64) -> Result<Self, SignalError> {
        Self::with_corner(cutoff_hz * TWO_PASS_CORNER_RATIO, dt_s)
    }

    /// Filters forward and backward; the result has the length of the signal.
    ///
    /// # Errors
    /// Fewer than two samples or a sample that is not finite.
    pub fn filter_phaseless(&self, values: &[f64], continuation: Continuation) -> Result<Vec<f64>, SignalError> {
        require_samples("signal to filter", values, 1.0, 2)?;
        let (mut work, added) = continued(values, continuation);
        let settling = match continuation {
            Continuation::PointReflection { .. } => 10,
            Continuation::Hold { .. } | Continuation::HoldMean { .. } => 1,
        };
        self.pass(&mut work, settling);
        work.reverse();
        self.pass(&mut work, settling);
        work.reverse();
        Ok(work[added..added + values.len()].to_vec())
    }

    /// One pass in place, starting at rest on the mean of the first `settling` values.
    fn pass(&self, x: &mut [f64], settling: usize) {
        let settling = settling.min(x.len());
        let start = x[..settling].iter().sum::<f64>() / settling as f64;
        let (mut x2, mut x1) = (x[0], x[1]);
        let (mut y2, mut y1) = (start, start);
        x[0] = start;
        x[1] = start;
        for value in &mut x[2..] {
            let x0 = *value;
            let y0 = self.a0 * x0 + self.a1 * x1 + self.a2 * x2 + self.b1 * y1 + self.b2 * y2;
            (x2, x1, y2, y1) = (x1, x0, y1, y0);
            *value = y0;
        }
    }
}

/// Number of samples in `duration_s`, at least `least`.
pub(crate) fn padding_samples(duration_s: f64, dt_s: f64, least: usize) -> usize {
    whole_steps(duration_s, dt_s).max(least)
}

/// The record with its continuation, and the number of samples added before it.
fn continued(values: &[f64], continuation: Continuation) -> (Vec<f64>, usize) {
    let (first, last) = (values[0], values[values.len() - 1]);
    match continuation {
        Continuation::PointReflection { samples } => {
            let added = samples.min(values.len() - 1);
            let before = values[1..=added].iter().rev().map(|x| 2.0 * first - x);
            let after = values[values.len() - 1 - added..values.len() - 1].iter().rev().map(|x| 2.0 * last - x);
            (before.chain(values.iter().copied()).chain(after).collect(), added)
        }
        Continuation::Hold { samples } => held(values, [first, last], samples),
        Continuation::HoldMean { samples, of } => {
            let of = of.clamp(1, values.len());
            let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
            held(values, [mean(&values[..of]), mean(&values[values.len() - of..])], samples)
        }
    }
}

/// The record with this many samples of one value before it and of another after it.
fn held(values: &[f64], [before, after]: [f64; 2], samples: usize) -> (Vec<f64>, usize) {
    let samples = samples.min(2_000_000);
    let held = |value| std::iter::repeat_n(value, samples);
    (held(before).chain(values.iter().copied()).chain(held(after)).collect(), samples)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ratio_is_its_formula() {
        assert!((TWO_PASS_CORNER_RATIO - (SQRT_2 - 1.0).powf(-0.25)).abs() < 1e-15);
        assert!((13.0 * TWO_PASS_CORNER_RATIO - 16.20).abs() < 0.005);
    }

    #[test]
    fn constants_and_ramps_pass_unchanged() {
        let filter = LowPass::with_corner(100.0, 1e-4).unwrap();
        let constant = filter.filter_phaseless(&[3.0; 500], Continuation::Hold { samples: 50 }).unwrap();
        assert!(constant.iter().all(|y| (y - 3.0).abs() < 1e-12));
        let ramp: Vec<f64> = (0..2000).map(|i| 0.5 * f64::from(i)).collect();
        let same = filter.filter_phaseless(&ramp, Continuation::PointReflection { samples: 1500 }).unwrap();
        let worst = same.iter().zip(&ramp).map(|(y, x)| (y - x).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-9, "{worst:e}"); // measured 3.9e-11
    }

    #[test]
    fn half_power_at_the_two_pass_cutoff() {
        let dt_s = 1e-4;
        let filter = LowPass::with_two_pass_cutoff(13.0, dt_s).unwrap();
        let tone: Vec<f64> = (0..40_000).map(|i| (2.0 * PI * 13.0 * f64::from(i) * dt_s).sin()).collect();
        let out = filter.filter_phaseless(&tone, Continuation::Hold { samples: 0 }).unwrap();
        let peak = out[10_000..30_000].iter().fold(0.0f64, |m, y| m.max(y.abs()));
        // measured 2.6e-6: the corner is prewarped at 16.2 Hz, not at 13 Hz
        assert!((peak - 0.5f64.sqrt()).abs() < 1e-5, "{peak}");
        // no lag: the peak stands where the tone's stands
        let at = (10_000..11_000).max_by(|&i, &j| out[i].total_cmp(&out[j])).unwrap();
        let expected = (10_000..11_000).max_by(|&i, &j| tone[i].total_cmp(&tone[j])).unwrap();
        assert_eq!(at, expected);
    }

    #[test]
    fn a_corner_above_half_the_sample_rate_is_refused() {
        let error = LowPass::with_corner(2077.5, 1e-3).unwrap_err();
        assert!(matches!(error, SignalError::CornerAboveNyquist { .. }));
        assert!(error.to_string().contains("500 Hz"));
    }
}

//! Integrals of the straight line through the samples.

use super::{SignalError, require_samples};

/// ∫₀ᵗ x dt at every sample (trapezoids: exact for the straight line), starting at `initial`.
///
/// Unit: that of the samples times seconds.
///
/// # Errors
/// No sample, a sample that is not finite, an interval that is not positive.
pub fn integrate(values: &[f64], dt_s: f64, initial: f64) -> Result<Vec<f64>, SignalError> {
    require_samples("signal to integrate", values, dt_s, 1)?;
    let mut sum = initial;
    let mut integral = Vec::with_capacity(values.len());
    integral.push(sum);
    for pair in values.windows(2) {
        sum += 0.5 * dt_s * (pair[0] + pair[1]);
        integral.push(sum);
    }
    Ok(integral)
}

/// First and second integral of a signal, readable at any time and not only at samples.
///
/// Within an interval the line's integral is a parabola and its second integral a cubic; both are
/// evaluated exactly.
#[derive(Debug, Clone)]
pub struct CumulativeIntegral<'a> {
    values: &'a [f64],
    dt_s: f64,
    first: Vec<f64>,
}

impl<'a> CumulativeIntegral<'a> {
    /// Integrates from zero at the first sample.
    ///
    /// # Errors
    /// Fewer than two samples, a sample that is not finite, an interval that is not positive, an integral
    /// beyond the range of numbers.
    pub fn new(values: &'a [f64], dt_s: f64) -> Result<Self, SignalError> {
        require_samples("signal to integrate", values, dt_s, 2)?;
        Ok(Self { values, dt_s, first: integrate(values, dt_s, 0.0)? })
    }

    /// Time of the last sample, s.
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        (self.values.len() - 1) as f64 * self.dt_s
    }

    /// The integral at the samples.
    #[must_use]
    pub fn at_samples(&self) -> &[f64] {
        &self.first
    }

    /// The signal itself at `time_s`, clamped to the record.
    #[must_use]
    pub fn value_at(&self, time_s: f64) -> f64 {
        let (i, s) = self.cell(time_s);
        self.values[i] + (self.values[i + 1] - self.values[i]) * (s / self.dt_s)
    }

    /// The integral at `time_s`, clamped to the record.
    #[must_use]
    pub fn at(&self, time_s: f64) -> f64 {
        let (i, s) = self.cell(time_s);
        let slope = (self.values[i + 1] - self.values[i]) / self.dt_s;
        self.first[i] + s * (self.values[i] + 0.5 * slope * s)
    }

    /// The second integral at the samples, from zero: exact for the straight line.
    #[must_use]
    pub fn second_at_samples(&self) -> Vec<f64> {
        let mut second = Vec::with_capacity(self.values.len());
        let mut sum = 0.0;
        second.push(sum);
        for (i, pair) in self.values.windows(2).enumerate() {
            // x₁ = x₀ + v₀ h + h² (2 a₀ + a₁)/6
            sum += self.dt_s * (self.first[i] + self.dt_s * (2.0 * pair[0] + pair[1]) / 6.0);
            second.push(sum);
        }
        second
    }

    /// The second integral at `time_s`, given [`Self::second_at_samples`], clamped to the record; NaN for a list of
    /// another length.
    #[must_use]
    pub fn second_at(&self, second: &[f64], time_s: f64) -> f64 {
        let (i, s) = self.cell(time_s);
        if second.len() != self.values.len() {
            return f64::NAN;
        }
        let slope = (self.values[i + 1] - self.values[i]) / self.dt_s;
        second[i] + s * (self.first[i] + s * (0.5 * self.values[i] + slope * s / 6.0))
    }

    /// Interval index and time since its start, s.
    fn cell(&self, time_s: f64) -> (usize, f64) {
        let time_s = time_s.clamp(0.0, self.duration_s());
        let i = ((time_s / self.dt_s) as usize).min(self.values.len() - 2);
        (i, time_s - i as f64 * self.dt_s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_gives_its_parabola_and_cubic_between_samples() {
        let dt_s = 0.1;
        let ramp: Vec<f64> = (0..11).map(|i| 2.0 + 3.0 * i as f64 * dt_s).collect();
        let integral = CumulativeIntegral::new(&ramp, dt_s).unwrap();
        let second = integral.second_at_samples();
        for t in [0.0, 0.033, 0.5, 0.777, 1.0] {
            assert!((integral.at(t) - (2.0 * t + 1.5 * t * t)).abs() < 1e-14);
            assert!((integral.second_at(&second, t) - (t * t + 0.5 * t * t * t)).abs() < 1e-14);
            assert!((integral.value_at(t) - (2.0 + 3.0 * t)).abs() < 1e-14);
        }
        assert_eq!(integral.at(7.0), integral.at(1.0));
    }

    #[test]
    fn unusable_signals_are_named() {
        assert!(matches!(integrate(&[], 0.1, 0.0), Err(SignalError::TooShort { .. })));
        assert!(matches!(integrate(&[1.0], -0.1, 0.0), Err(SignalError::OutOfRange { .. })));
        let bad = integrate(&[1.0, f64::NAN], 0.1, 0.0).unwrap_err();
        assert!(bad.to_string().contains("sample 1 is NaN"));
    }
}

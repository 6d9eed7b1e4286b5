//! The checks every function of signals makes first.

use super::SignalError;

/// Largest magnitude accepted: no signal is larger, and powers and integrals of it stay finite.
const LARGEST: f64 = 1e100;
/// Range of accepted sample intervals, s.
const INTERVALS_S: std::ops::RangeInclusive<f64> = 1e-12..=1e6;

/// The interval of a uniform time vector, s.
///
/// Each time may lie off the grid by up to one millionth of the time span or one thousandth of the
/// interval, whichever is larger: times written with few digits pass, a missing sample does not.
///
/// # Errors
/// Fewer than two times, a time that is not finite, not increasing or off the grid.
pub fn uniform_interval(time_s: &[f64]) -> Result<f64, SignalError> {
    require_finite("time", time_s, 2)?;
    if let Some(i) = (1..time_s.len()).find(|&i| time_s[i] <= time_s[i - 1]) {
        return Err(SignalError::NotIncreasing { index: i, found_s: time_s[i], previous_s: time_s[i - 1] });
    }
    let span_s = time_s[time_s.len() - 1] - time_s[0];
    let dt_s = span_s / (time_s.len() - 1) as f64;
    let tolerance_s = (1e-3 * dt_s).max(1e-6 * span_s).min(0.2 * dt_s);
    for (index, &found_s) in time_s.iter().enumerate() {
        let expected_s = time_s[0] + index as f64 * dt_s;
        if (found_s - expected_s).abs() > tolerance_s {
            return Err(SignalError::NotUniform { index, found_s, expected_s });
        }
    }
    Ok(dt_s)
}

/// Number of whole intervals `dt_s` in `duration_s`, with a tolerance of 1e−9 intervals.
///
/// Zero where either is not a positive number.
#[must_use]
pub fn whole_steps(duration_s: f64, dt_s: f64) -> usize {
    let steps = (duration_s / dt_s + 1e-9).floor();
    if steps.is_finite() && steps > 0.0 { steps as usize } else { 0 }
}

/// Checks a signal: at least `needed` samples, all finite and within 1e100, and a sound interval.
pub(crate) fn require_samples(what: &'static str, values: &[f64], dt_s: f64, needed: usize) -> Result<(), SignalError> {
    if !INTERVALS_S.contains(&dt_s) {
        let expected = "between 1e-12 s and 1e6 s";
        return Err(SignalError::OutOfRange { what: "sample interval (s)", found: dt_s, expected });
    }
    require_finite(what, values, needed)
}

/// Checks that a companion signal is as long as the first.
pub(crate) fn require_same_length(what: &'static str, found: &[f64], first: &[f64]) -> Result<(), SignalError> {
    if found.len() == first.len() {
        return Ok(());
    }
    Err(SignalError::LengthMismatch { what, found: found.len(), expected: first.len() })
}

/// Checks that a parameter is a positive finite number.
pub(crate) fn require_positive(what: &'static str, found: f64) -> Result<(), SignalError> {
    if found.is_finite() && found > 0.0 {
        return Ok(());
    }
    Err(SignalError::OutOfRange { what, found, expected: "a positive number" })
}

fn require_finite(what: &'static str, values: &[f64], needed: usize) -> Result<(), SignalError> {
    if values.len() < needed {
        return Err(SignalError::TooShort { what, found: values.len(), needed });
    }
    match values.iter().position(|v| v.is_nan() || v.abs() > LARGEST) {
        Some(index) => Err(SignalError::NotFinite { what, index, found: values[index] }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_with_few_digits_are_uniform_and_a_gap_is_not() {
        let mut time_s: Vec<f64> = (0..300).map(|i| (i as f64 * 1e-3 * 1e4).round() / 1e4).collect();
        assert!((uniform_interval(&time_s).unwrap() - 1e-3).abs() < 1e-12);
        time_s.remove(100);
        assert!(matches!(uniform_interval(&time_s), Err(SignalError::NotUniform { .. })));
        time_s[50] = time_s[49];
        assert!(matches!(uniform_interval(&time_s), Err(SignalError::NotIncreasing { index: 50, .. })));
    }

    #[test]
    fn whole_steps_forgives_rounding_only() {
        assert_eq!(whole_steps(0.015, 1e-3), 15);
        assert_eq!(whole_steps(0.036, 1e-4), 360);
        assert_eq!(whole_steps(0.0149, 1e-3), 14);
        assert_eq!(whole_steps(f64::NAN, 1e-3), 0);
        assert_eq!(whole_steps(1.0, 0.0), 0);
    }
}

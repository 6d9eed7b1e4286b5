//! Largest and smallest sample, with its time.

use crate::signal::{SignalError, require_samples};

/// A sample and its time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// The value with its sign, in the unit of the signal.
    pub value: f64,
    /// Its time, s.
    pub time_s: f64,
}

/// The largest sample (the first of equals).
///
/// # Errors
/// No sample, a sample that is not finite, an interval that is not positive.
pub fn maximum(values: &[f64], dt_s: f64) -> Result<Peak, SignalError> {
    extreme(values, dt_s, |v| v)
}

/// The smallest sample (the first of equals).
///
/// # Errors
/// As [`maximum`].
pub fn minimum(values: &[f64], dt_s: f64) -> Result<Peak, SignalError> {
    extreme(values, dt_s, |v| -v)
}

/// The sample of largest magnitude, with its sign (the first of equals).
///
/// # Errors
/// As [`maximum`].
pub fn largest_magnitude(values: &[f64], dt_s: f64) -> Result<Peak, SignalError> {
    extreme(values, dt_s, f64::abs)
}

/// The largest sample in the direction of `sign`, as a positive number, such as a compression where tension is
/// positive; 0 if all samples have the other sign.
///
/// # Errors
/// As [`maximum`].
pub fn peak_towards(sign: f64, values: &[f64], dt_s: f64) -> Result<Peak, SignalError> {
    let peak = extreme(values, dt_s, |v| sign * v)?;
    Ok(Peak { value: (sign * peak.value).max(0.0), ..peak })
}

fn extreme(values: &[f64], dt_s: f64, rank: impl Fn(f64) -> f64) -> Result<Peak, SignalError> {
    require_samples("signal", values, dt_s, 1)?;
    let mut best = 0;
    for (i, &value) in values.iter().enumerate() {
        if rank(value) > rank(values[best]) {
            best = i;
        }
    }
    Ok(Peak { value: values[best], time_s: best as f64 * dt_s })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_peak_in_the_other_direction_counts_as_none() {
        let peak = |sign, values: &[f64]| peak_towards(sign, values, 0.1).unwrap().value;
        assert_eq!([1.0, -1.0].map(|sign| peak(sign, &[0.0, 300.0, -500.0])), [300.0, 500.0]);
        assert_eq!(peak(-1.0, &[1.0, 2.0]), 0.0);
    }

    #[test]
    fn extremes_keep_sign_and_time() {
        let values = [0.0, 3.0, -7.0, 3.0];
        assert_eq!(maximum(&values, 0.1).unwrap(), Peak { value: 3.0, time_s: 0.1 });
        assert_eq!(minimum(&values, 0.1).unwrap().value, -7.0);
        assert_eq!(largest_magnitude(&values, 0.1).unwrap(), Peak { value: -7.0, time_s: 0.2 });
        assert!(maximum(&[], 0.1).is_err());
    }
}

//! Gadd severity index and its chest counterpart.
//!
//! SI = ∫ a^2.5 dt with a in g and t in s. For the head it is the Gadd severity index (GSI), for the
//! chest resultant the chest severity index (CSI); the historical limit of both is 1000.

use crate::signal::{STANDARD_GRAVITY_MPS2, SignalError, require_samples};

/// Severity index of a resultant acceleration in m/s², g^2.5·s (by custom written without unit).
///
/// The power of the straight line is integrated by Simpson's rule in every interval. Negative values,
/// which a resultant does not have, count as zero.
///
/// # Errors
/// Fewer than two samples, a sample that is not finite, an interval that is not positive.
pub fn severity_index(resultant_mps2: &[f64], dt_s: f64) -> Result<f64, SignalError> {
    require_samples("resultant acceleration", resultant_mps2, dt_s, 2)?;
    let power = |a_mps2: f64| {
        let a_g = (a_mps2 / STANDARD_GRAVITY_MPS2).max(0.0);
        a_g * a_g * a_g.sqrt()
    };
    let sum: f64 =
        resultant_mps2.windows(2).map(|w| power(w[0]) + 4.0 * power(0.5 * (w[0] + w[1])) + power(w[1])).sum();
    Ok(sum * dt_s / 6.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    type Shape = fn(f64) -> f64;

    #[test]
    fn closed_forms_of_four_pulses() {
        let (a_g, length_s, dt_s) = (60.0, 0.04, 1e-5);
        let sampled = |shape: Shape| -> Vec<f64> {
            (0..=4000).map(|i| STANDARD_GRAVITY_MPS2 * a_g * shape(f64::from(i) / 4000.0)).collect()
        };
        let unit = f64::powf(a_g, 2.5) * length_s;
        let cases: [(Shape, f64); 4] = [
            (|_| 1.0, 1.0),
            (|x| (PI * x).sin(), 0.457_655_858_101_087_8),
            (|x| (PI * x).sin().powi(2), 16.0 / (15.0 * PI)),
            (|x| 1.0 - (2.0 * x - 1.0).abs(), 2.0 / 7.0),
        ];
        for (shape, factor) in cases {
            let error = (severity_index(&sampled(shape), dt_s).unwrap() / (factor * unit) - 1.0).abs();
            // measured 1.9e-7 (haversine)
            assert!(error < 1e-6, "{factor}: {error:e}");
        }
        // one interval up, one down: Simpson's (0 + 4·½^2.5 + 1)/6 each, 0.4 % below 2/7
        let coarse = severity_index(&[0.0, STANDARD_GRAVITY_MPS2, 0.0], 1.0).unwrap();
        assert!((coarse - (4.0 * 0.5f64.powf(2.5) + 1.0) / 3.0).abs() < 1e-14);
        assert_eq!(severity_index(&[-1.0, -2.0], 1.0).unwrap(), 0.0);
    }
}

//! Rebound velocity of the head, travel of the pelvis in the seat, and largest values up to a time.

use crate::measure::{Peak, peak::maximum, peak::peak_towards};
use crate::signal::{SignalError, require_same_length, require_samples};

/// The largest sample up to `end_s` (the first of equals), such as the acceleration of T1 until the head leaves its
/// restraint.
///
/// # Errors
/// No sample, a sample that is not finite, an interval that is not positive, an end before the record or no number.
pub fn greatest_until(values: &[f64], dt_s: f64, end_s: f64) -> Result<Peak, SignalError> {
    require_samples("signal", values, dt_s, 1)?;
    if end_s.is_nan() || end_s < 0.0 {
        return Err(SignalError::OutOfRange { what: "end of the window (s)", found: end_s, expected: "zero or more" });
    }
    let last = ((end_s / dt_s + 1e-6).floor() as usize).min(values.len() - 1);
    maximum(&values[..=last], dt_s)
}

/// Largest forward speed of the head relative to the vehicle after `from_s` (its contact with the restraint), m/s; 0 if
/// it does not rebound. Both speeds are along the vehicle's X.
///
/// # Errors
/// Different lengths, no sample, a sample that is not finite, an interval that is not positive, a start outside of the record.
pub fn rebound_speed(head_mps: &[f64], vehicle_mps: &[f64], dt_s: f64, from_s: f64) -> Result<Peak, SignalError> {
    let relative_mps = relative("speed of the vehicle", head_mps, vehicle_mps, dt_s)?;
    let first = (from_s / dt_s - 1e-6).ceil();
    if !(first < relative_mps.len() as f64 && from_s >= 0.0) {
        let expected = "a time within the record";
        return Err(SignalError::OutOfRange { what: "start of the window (s)", found: from_s, expected });
    }
    let first = first.max(0.0) as usize;
    let peak = peak_towards(1.0, &relative_mps[first..], dt_s)?;
    Ok(Peak { time_s: peak.time_s + first as f64 * dt_s, ..peak })
}

/// Largest displacement of one point relative to another, from their initial positions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Travel {
    /// Forward, m.
    pub ahead: Peak,
    /// Backward, as a positive number, m.
    pub back: Peak,
}

/// Displacement of the pelvis relative to the seat: both positions along one axis, positive forward, m.
///
/// # Errors
/// Different lengths, no sample, a sample that is not finite, an interval that is not positive.
pub fn relative_travel(pelvis_m: &[f64], seat_m: &[f64], dt_s: f64) -> Result<Travel, SignalError> {
    let place_m = relative("place of the seat", pelvis_m, seat_m, dt_s)?;
    let moved_m: Vec<f64> = place_m.iter().map(|x| x - place_m[0]).collect();
    Ok(Travel { ahead: peak_towards(1.0, &moved_m, dt_s)?, back: peak_towards(-1.0, &moved_m, dt_s)? })
}

fn relative(what: &'static str, own: &[f64], other: &[f64], dt_s: f64) -> Result<Vec<f64>, SignalError> {
    require_samples("signal of the body", own, dt_s, 1)?;
    require_samples(what, other, dt_s, 1)?;
    require_same_length(what, other, own)?;
    Ok(own.iter().zip(other).map(|(a, b)| a - b).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn the_head_comes_back_at_its_greatest_speed_after_contact() {
        // against a vehicle at 5 m/s: back at 6 m/s at 50 ms, ahead at 6 m/s at 150 ms
        let vehicle = vec![5.0; 2001];
        let head: Vec<f64> = (0..=2000).map(|i| 5.0 - 6.0 * (PI * f64::from(i) * 1e-4 / 0.1).sin()).collect();
        let found = rebound_speed(&head, &vehicle, 1e-4, 0.06).unwrap();
        assert!((found.value - 6.0).abs() < 1e-12 && (found.time_s - 0.15).abs() < 1e-12, "{found:?}");
        // what was before does not count; who never comes back has none
        assert_eq!(rebound_speed(&[9.0, 1.0, 1.0], &[0.0; 3], 1e-3, 1e-3).unwrap().value, 1.0);
        assert_eq!(rebound_speed(&[0.0; 3], &[1.0; 3], 1e-3, 0.0).unwrap().value, 0.0);
        for from_s in [-1e-3, 3e-3, f64::NAN, f64::INFINITY] {
            assert!(matches!(rebound_speed(&[0.0; 3], &[0.0; 3], 1e-3, from_s), Err(SignalError::OutOfRange { .. })));
        }
    }

    #[test]
    fn travel_counts_from_the_start_both_ways() {
        let found = relative_travel(&[1.0, 1.15, 0.98], &[0.2, 0.25, 0.28], 1e-3).unwrap();
        assert!((found.ahead.value - 0.10).abs() < 1e-12 && (found.back.value - 0.10).abs() < 1e-12, "{found:?}");
        assert_eq!((found.ahead.time_s, found.back.time_s), (1e-3, 2e-3));
        assert!(relative_travel(&[1.0], &[1.0, 2.0], 1e-3).is_err() && relative_travel(&[], &[], 1e-3).is_err());
    }

    #[test]
    fn a_window_ends_with_the_sample_at_its_end() {
        let values = [1.0, 2.0, 3.0, 4.0];
        assert_eq!(greatest_until(&values, 1e-3, 2e-3).unwrap(), Peak { value: 3.0, time_s: 2e-3 });
        assert_eq!(greatest_until(&values, 1e-3, 1.9e-3).unwrap().value, 2.0);
        assert_eq!(greatest_until(&values, 1e-3, 1e9).unwrap().value, 4.0);
        assert!(greatest_until(&values, 1e-3, f64::NAN).is_err() && greatest_until(&[], 1e-3, 1.0).is_err());
    }
}

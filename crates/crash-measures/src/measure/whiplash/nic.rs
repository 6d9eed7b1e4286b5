//! Neck injury criterion of Boström et al. (1996).
//!
//! NIC(t) = 0.2 m · a_rel + v_rel², with a_rel = a_T1 − a_head along X and v_rel its integral from rest; m²/s². The length
//! stands for that of the neck. Euro NCAP takes the largest value up to the end of the head's contact with its restraint.

use super::contact::HeadContact;
use super::travel::greatest_until;
use crate::measure::Peak;
use crate::signal::{SignalError, integrate, require_same_length, require_samples};

/// Length of the neck in the criterion, m.
const NECK_M: f64 = 0.2;

/// The criterion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nic {
    /// NIC_max, m²/s²: the maximum up to the end of contact, or of the whole record without contact.
    pub greatest: Peak,
    /// The value at the start of head contact, m²/s²; none without contact.
    pub at_contact: Option<f64>,
}

/// NIC at every sample, m²/s², from forward accelerations of T1 and of the head's c.g., m/s².
///
/// # Errors
/// No sample, different lengths, a sample that is not finite, an interval that is not positive.
pub fn nic_history(t1_mps2: &[f64], head_mps2: &[f64], dt_s: f64) -> Result<Vec<f64>, SignalError> {
    require_samples("acceleration of T1", t1_mps2, dt_s, 1)?;
    require_samples("acceleration of the head", head_mps2, dt_s, 1)?;
    require_same_length("acceleration of the head", head_mps2, t1_mps2)?;
    let relative_mps2: Vec<f64> = t1_mps2.iter().zip(head_mps2).map(|(t1, head)| t1 - head).collect();
    let relative_mps = integrate(&relative_mps2, dt_s, 0.0)?;
    Ok(relative_mps2.iter().zip(relative_mps).map(|(a, v)| NECK_M * a + v * v).collect())
}

/// The criterion with its largest value and that at the head's first contact.
///
/// # Errors
/// As [`nic_history`]; a contact that begins or ends outside of the record.
pub fn nic(t1_mps2: &[f64], head_mps2: &[f64], dt_s: f64, contact: Option<&HeadContact>) -> Result<Nic, SignalError> {
    let values = nic_history(t1_mps2, head_mps2, dt_s)?;
    let record_s = (values.len() - 1) as f64 * dt_s;
    let Some(contact) = contact else {
        return Ok(Nic { greatest: greatest_until(&values, dt_s, record_s)?, at_contact: None });
    };
    let greatest = greatest_until(&values, dt_s, contact.end_s)?;
    let first = contact.start_s / dt_s;
    if !(first >= 0.0 && first <= (values.len() - 1) as f64) {
        let expected = "a time within the record";
        return Err(SignalError::OutOfRange { what: "start of contact (s)", found: contact.start_s, expected });
    }
    let (below, part) = (first.floor() as usize, first.fract());
    let above = values[(below + 1).min(values.len() - 1)];
    Ok(Nic { greatest, at_contact: Some(values[below] + part * (above - values[below])) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const DT_S: f64 = 1e-4;

    #[test]
    fn constant_relative_acceleration_gives_its_parabola() {
        // a_rel = 40 m/s²: NIC = 8 + (40 t)²
        let t1 = vec![50.0; 1001];
        let head = vec![10.0; 1001];
        let history = nic_history(&t1, &head, DT_S).unwrap();
        for (i, value) in history.iter().enumerate() {
            let t = i as f64 * DT_S;
            assert!((value - (8.0 + 1600.0 * t * t)).abs() < 1e-10, "{t}: {value}");
        }
        let contact = HeadContact { start_s: 0.050, end_s: 0.080 };
        let found = nic(&t1, &head, DT_S, Some(&contact)).unwrap();
        assert!((found.at_contact.unwrap() - 12.0).abs() < 1e-10);
        assert!((found.greatest.value - 18.24).abs() < 1e-10 && (found.greatest.time_s - 0.08).abs() < 1e-12);
        let whole = nic(&t1, &head, DT_S, None).unwrap();
        assert!((whole.greatest.value - 24.0).abs() < 1e-10 && whole.at_contact.is_none());
    }

    #[test]
    fn half_a_sine_of_relative_acceleration() {
        // a = A sin(πt/T), v = (A T/π)(1 − cos): largest where 0.2 A (π/T) cos + 2 v A sin = 0, here by a fine scan
        let (a, t) = (60.0, 0.080);
        let closed = |time: f64| {
            let x = PI * time / t;
            let v = a * t / PI * (1.0 - x.cos());
            0.2 * a * x.sin() + v * v
        };
        let t1: Vec<f64> = (0..=800).map(|i| a * (PI * f64::from(i) * DT_S / t).sin()).collect();
        let found = nic(&t1, &vec![0.0; 801], DT_S, None).unwrap();
        let expected = (0..=80_000).map(|i| closed(f64::from(i) * 1e-6)).fold(0.0, f64::max);
        // measured 1.6e-6: trapezoids at 10 kHz
        assert!((found.greatest.value / expected - 1.0).abs() < 5e-6, "{} {expected}", found.greatest.value);
    }

    #[test]
    fn both_directions_of_relative_speed_count_alike_and_of_acceleration_not() {
        let (still, pull) = (vec![0.0; 101], vec![-30.0; 101]);
        let found = nic(&pull, &still, 1e-3, None).unwrap();
        // −6 + 9 at the end
        assert!((found.greatest.value - 3.0).abs() < 1e-10, "{found:?}");
    }

    #[test]
    fn unusable_signals_and_contacts_are_named() {
        let still = [0.0; 10];
        assert!(matches!(nic(&[], &[], DT_S, None), Err(SignalError::TooShort { .. })));
        assert!(matches!(nic(&still, &still[1..], DT_S, None), Err(SignalError::LengthMismatch { .. })));
        assert!(matches!(nic(&still, &[f64::NAN; 10], DT_S, None), Err(SignalError::NotFinite { .. })));
        for (start_s, end_s) in [(-1.0, 0.0005), (1.0, 0.0005), (f64::NAN, 0.0005), (0.0, -1.0), (0.0, f64::NAN)] {
            let found = nic(&still, &still, DT_S, Some(&HeadContact { start_s, end_s }));
            assert!(matches!(found, Err(SignalError::OutOfRange { .. })), "{start_s} {end_s}: {found:?}");
        }
    }
}

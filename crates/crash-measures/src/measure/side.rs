//! Forces of a side impact: abdomen, shoulder, pubic symphysis, pelvis.
//!
//! Ribs are those of [`super::thorax`], the head's criterion (HPC of UN R95) is HIC36, the lower spine's level the 3 ms level
//! of its resultant. All forces are class 600 of SAE J211.

use super::{Peak, peak::maximum};
use crate::signal::{SignalError, require_same_length, require_samples};

/// Largest sum, at one time, of the amounts of forces that several load cells read, N: abdomen of the ES-2 and ES-2re (front,
/// middle and rear cell), pelvis of the SID-IIs (acetabulum and ilium). One cell alone gives a pubic or shoulder force.
///
/// The rules prescribe no sign; amounts are added, which is never the milder reading.
///
/// # Errors
/// No cell, cells of different length, no sample, a sample that is not finite, an interval that is not positive.
pub fn force_sum(cells_n: &[&[f64]], dt_s: f64) -> Result<Peak, SignalError> {
    let first = *cells_n.first().ok_or(SignalError::TooShort { what: "list of load cells", found: 0, needed: 1 })?;
    let mut sum_n = vec![0.0; first.len()];
    for own in cells_n {
        require_samples("load cell", own, dt_s, 1)?;
        require_same_length("load cell", own, first)?;
        sum_n.iter_mut().zip(*own).for_each(|(sum, force_n)| *sum += force_n.abs());
    }
    maximum(&sum_n, dt_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_added_at_one_time() {
        // peaks of 1000, 900 and 800 N that do not coincide
        let cells: [&[f64]; 3] = [&[0.0, 1000.0, 100.0], &[0.0, -500.0, -900.0], &[800.0, 300.0, 200.0]];
        assert_eq!(force_sum(&cells, 1e-3).unwrap(), Peak { value: 1800.0, time_s: 1e-3 });
        assert_eq!(force_sum(&[&[0.0, -2500.0]], 1e-3).unwrap().value, 2500.0);
    }

    #[test]
    fn unusable_cells_are_named() {
        assert!(matches!(force_sum(&[], 1e-3), Err(SignalError::TooShort { what: "list of load cells", .. })));
        assert!(matches!(force_sum(&[&[1.0], &[1.0, 2.0]], 1e-3), Err(SignalError::LengthMismatch { .. })));
        assert!(matches!(force_sum(&[&[1.0], &[f64::NAN]], 1e-3), Err(SignalError::NotFinite { .. })));
    }
}

//! Brain injury criterion of Takhounts et al. (2013).
//!
//! BrIC = √Σ (max|ω_i|/ω_ic)², the maximum of each axis taken on its own, whenever it occurs. The
//! angular velocity is in head axes and filtered CFC 60.

use super::{Peak, peak::largest_magnitude};
use crate::signal::SignalError;

/// Set of critical angular velocities.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum BricBasis {
    /// Average of the other two: the usual one.
    #[default]
    Average,
    /// From maximum principal strain.
    MaximumPrincipalStrain,
    /// From the cumulative strain damage measure.
    CumulativeStrainDamage,
}

impl BricBasis {
    /// Critical angular velocities about x, y, z, rad/s.
    #[must_use]
    pub fn critical_rps(self) -> [f64; 3] {
        match self {
            Self::Average => [66.25, 56.45, 42.87],
            Self::MaximumPrincipalStrain => [66.30, 53.80, 41.50],
            Self::CumulativeStrainDamage => [66.20, 59.10, 44.25],
        }
    }
}

/// Brain injury criterion with its peaks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bric {
    /// The criterion, without unit.
    pub value: f64,
    /// Peak angular velocity about x, y, z, rad/s.
    pub peaks_rps: [Peak; 3],
}

/// BrIC of angular velocities in rad/s, head axes.
///
/// # Errors
/// No sample, a sample that is not finite, an interval that is not positive.
pub fn bric(wx_rps: &[f64], wy_rps: &[f64], wz_rps: &[f64], dt_s: f64, basis: BricBasis) -> Result<Bric, SignalError> {
    let peaks_rps =
        [largest_magnitude(wx_rps, dt_s)?, largest_magnitude(wy_rps, dt_s)?, largest_magnitude(wz_rps, dt_s)?];
    let sum: f64 = peaks_rps.iter().zip(basis.critical_rps()).map(|(w, c)| (w.value / c) * (w.value / c)).sum();
    Ok(Bric { value: sum.sqrt(), peaks_rps })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn peaks_at_different_times_combine() {
        let (x, y, z) = ([0.0, -20.0, 0.0], [30.0, 0.0, 0.0], [0.0, 0.0, 10.0]);
        let of = |basis| bric(&x, &y, &z, 1e-3, basis).unwrap().value;
        assert!((of(BricBasis::Average) - 0.654_202).abs() < 5e-7);
        assert!((of(BricBasis::MaximumPrincipalStrain) - 0.678_235).abs() < 5e-7);
        assert!((of(BricBasis::CumulativeStrainDamage) - 0.632_469).abs() < 5e-7);
    }
}

//! Lower leg: the tibia index.
//!
//! TI(t) = √(M_x² + M_y²)/M_c + |F_z|/F_c at one load cell (SAE J1733 axes; CFC 600), upper or lower, left or right. The index
//! of Mertz (1993) with the critical values of each Hybrid III and THOR is that of UN R94 and Euro NCAP; the revised one of
//! Kuppa et al. (2001) is for legs with a straight tibia.

use super::{Dummy, Peak, peak::maximum};
use crate::signal::{SignalError, require_positive, require_same_length, require_samples};

/// Moment arm, m, of a tension in the bent tibia of a Hybrid III at the upper load cell (Zuby et al.): M_y of a
/// straight tibia is M_y − 28.32 mm·F_z.
pub const UPPER_OFFSET_M: f64 = 0.028_32;
/// The same at the lower load cell: M_y + 6.398 mm·F_z.
pub const LOWER_OFFSET_M: f64 = -0.006_398;

/// Bending moment and axial force that each alone give an index of 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TibiaCriticals {
    /// M_c, N·m.
    pub moment_nm: f64,
    /// F_c, N.
    pub force_n: f64,
}

impl TibiaCriticals {
    /// Revised index of a 50th percentile male (Kuppa et al. 2001).
    pub const REVISED_50M: Self = Self { moment_nm: 240.0, force_n: 12_000.0 };

    /// Critical values of a dummy; none if it has no such load cells. The values of the Hybrid III 95M are from memory,
    /// the others from a program that cites Euro NCAP TB-021.
    #[must_use]
    pub fn of(dummy: Dummy) -> Option<Self> {
        match dummy {
            Dummy::HybridIii50M | Dummy::Thor50M => Some(Self { moment_nm: 225.0, force_n: 35_900.0 }),
            Dummy::HybridIii5F => Some(Self { moment_nm: 115.0, force_n: 22_900.0 }),
            Dummy::HybridIii95M => Some(Self { moment_nm: 307.0, force_n: 44_200.0 }),
            _ => None,
        }
    }
}

/// Largest tibia index, without unit, of moments in N·m and axial force in N.
///
/// # Errors
/// No sample, different lengths, a sample that is not finite, an interval or critical value that is not positive.
pub fn tibia_index(
    moment_x_nm: &[f64],
    moment_y_nm: &[f64],
    force_z_n: &[f64],
    dt_s: f64,
    critical: &TibiaCriticals,
) -> Result<Peak, SignalError> {
    require_positive("critical moment (N·m)", critical.moment_nm)?;
    require_positive("critical force (N)", critical.force_n)?;
    for (what, own) in [("tibia moment", moment_x_nm), ("tibia moment", moment_y_nm), ("tibia axial force", force_z_n)]
    {
        require_samples(what, own, dt_s, 1)?;
        require_same_length(what, own, moment_x_nm)?;
    }
    let moments = moment_x_nm.iter().zip(moment_y_nm);
    let values: Vec<f64> = moments
        .zip(force_z_n)
        .map(|((x, y), force)| libm::hypot(*x, *y) / critical.moment_nm + force.abs() / critical.force_n)
        .collect();
    maximum(&values, dt_s)
}

/// Moment M_y of a straight tibia, N·m, from that of a bent one: M_y − d·F_z, with [`UPPER_OFFSET_M`] or
/// [`LOWER_OFFSET_M`].
///
/// # Errors
/// Signals of different length.
pub fn straight_moment(moment_y_nm: &[f64], force_z_n: &[f64], offset_m: f64) -> Result<Vec<f64>, SignalError> {
    super::condyle_moment(moment_y_nm, force_z_n, offset_m)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_add_at_one_time_and_any_sign() {
        let critical = TibiaCriticals::of(Dummy::HybridIii50M).unwrap();
        // (135, 0) N·m with 7.18 kN: 0.6 + 0.2; then (-90, 120): 150/225 + 3590/35900
        let found = tibia_index(&[135.0, -90.0], &[0.0, 120.0], &[-7180.0, 3590.0], 1e-3, &critical).unwrap();
        assert!((found.value - 0.8).abs() < 1e-12 && found.time_s == 0.0, "{found:?}");
        let revised = tibia_index(&[0.0], &[-120.0], &[6000.0], 1e-3, &TibiaCriticals::REVISED_50M).unwrap();
        assert_eq!(revised.value, 1.0);
    }

    #[test]
    fn a_moment_alone_at_its_critical_value_gives_one_for_each_dummy() {
        let with = Dummy::ALL.into_iter().filter_map(TibiaCriticals::of);
        assert_eq!(with.clone().count(), 4);
        for critical in with {
            let (moment, force) = ([critical.moment_nm, 0.0], [0.0, critical.force_n]);
            assert_eq!(tibia_index(&[0.0; 2], &moment, &[0.0; 2], 1e-3, &critical).unwrap().value, 1.0);
            assert_eq!(tibia_index(&[0.0; 2], &[0.0; 2], &force, 1e-3, &critical).unwrap().value, 1.0);
        }
    }

    #[test]
    fn a_straight_tibia_has_no_moment_of_its_shape() {
        // 1 kN of compression alone
        let force_n = [-1000.0];
        for (offset_m, moment_nm) in [(UPPER_OFFSET_M, -28.32), (LOWER_OFFSET_M, 6.398)] {
            let straight = straight_moment(&[moment_nm], &force_n, offset_m).unwrap();
            assert!(straight[0].abs() < 1e-12, "{straight:?}");
        }
        assert!(straight_moment(&[1.0], &[], UPPER_OFFSET_M).is_err());
    }

    #[test]
    fn unusable_legs_are_named() {
        let critical = TibiaCriticals::REVISED_50M;
        assert!(matches!(tibia_index(&[], &[], &[], 1e-3, &critical), Err(SignalError::TooShort { .. })));
        assert!(tibia_index(&[1.0], &[1.0, 2.0], &[1.0], 1e-3, &critical).is_err());
        let none = TibiaCriticals { force_n: 0.0, ..critical };
        assert!(matches!(tibia_index(&[1.0], &[1.0], &[1.0], 1e-3, &none), Err(SignalError::OutOfRange { .. })));
    }
}

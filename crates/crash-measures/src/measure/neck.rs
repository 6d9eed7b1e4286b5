//! Neck injury criterion and neck loads.
//!
//! Nij = F_z/F_zc + M_ocy/M_yc at every sample, with the intercepts of the quadrant the signs choose:
//! tension +, compression −, flexion +, extension − (SAE J1733 polarity). M_ocy is the moment about
//! the occipital condyles; an upper load cell a distance D below them measures M_y and
//! M_ocy = M_y − D·F_x. A joint reaction taken at the condyles needs no correction.
//!
//! Filters: [`crate::injury`] takes CFC 1000 for the force and CFC 600 for the moment, the classes of
//! SAE J211's table for a neck as a vendor of filters quotes it. Other programs take CFC 600 for both;
//! whoever needs that filters so and calls [`nij`]. The rules themselves were not at hand.

use super::Dummy;
use crate::signal::{SignalError, require_same_length, require_samples};

/// Distance from the upper load cell up to the condyles, Hybrid III 50M and 5F, m.
pub const HYBRID_III_CONDYLE_OFFSET_M: f64 = 0.017_78;

/// Loads at which each direction alone gives Nij = 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NeckIntercepts {
    /// Tension, N.
    pub tension_n: f64,
    /// Compression, as a positive number, N.
    pub compression_n: f64,
    /// Flexion, N·m.
    pub flexion_nm: f64,
    /// Extension, as a positive number, N·m.
    pub extension_nm: f64,
}

impl NeckIntercepts {
    /// Hybrid III 5F out of position.
    pub const HYBRID_III_5F_OUT_OF_POSITION: Self =
        Self { tension_n: 3880.0, compression_n: 3880.0, flexion_nm: 155.0, extension_nm: 61.0 };

    /// In-position intercepts of a dummy; none for a dummy of another direction, which has no Nij. Those of the Hybrid
    /// III 95M are from memory, the others from a program that cites the rules.
    #[must_use]
    pub fn of(dummy: Dummy) -> Option<Self> {
        let [tension_n, compression_n, flexion_nm, extension_nm] = match dummy {
            Dummy::HybridIii50M => [6806.0, 6160.0, 310.0, 135.0],
            Dummy::HybridIii5F => [4287.0, 3880.0, 155.0, 67.0],
            Dummy::Thor50M => [4200.0, 6400.0, 88.1, 117.0],
            Dummy::HybridIii95M => [8216.0, 7440.0, 415.0, 179.0],
            _ => return None,
        };
        Some(Self { tension_n, compression_n, flexion_nm, extension_nm })
    }
}

/// The four combinations of neck load.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum NeckMode {
    /// N_tf.
    TensionFlexion,
    /// N_te.
    TensionExtension,
    /// N_cf.
    CompressionFlexion,
    /// N_ce.
    CompressionExtension,
}

/// Neck injury criterion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nij {
    /// The largest value, without unit.
    pub value: f64,
    /// Its time, s.
    pub time_s: f64,
    /// The combination it belongs to.
    pub mode: NeckMode,
    /// Largest value of each combination in the order N_tf, N_te, N_cf, N_ce; zero if its signs never coincide.
    pub by_mode: [f64; 4],
}

/// Moment about the condyles, N·m: M_ocy = M_y − D·F_x.
///
/// # Errors
/// Signals of different length.
pub fn condyle_moment(moment_y_nm: &[f64], force_x_n: &[f64], offset_m: f64) -> Result<Vec<f64>, SignalError> {
    require_same_length("neck shear force", force_x_n, moment_y_nm)?;
    Ok(moment_y_nm.iter().zip(force_x_n).map(|(m, f)| m - offset_m * f).collect())
}

/// Nij of axial force (tension positive) and moment about the condyles (flexion positive).
///
/// # Errors
/// No sample, different lengths, a sample that is not finite, an interval that is not positive.
pub fn nij(force_z_n: &[f64], moment_y_nm: &[f64], dt_s: f64, intercepts: &NeckIntercepts) -> Result<Nij, SignalError> {
    require_samples("neck axial force", force_z_n, dt_s, 1)?;
    require_samples("neck moment", moment_y_nm, dt_s, 1)?;
    require_same_length("neck moment", moment_y_nm, force_z_n)?;
    let mut greatest = Nij { value: 0.0, time_s: 0.0, mode: NeckMode::TensionFlexion, by_mode: [0.0; 4] };
    for (i, (&force_n, &moment_nm)) in force_z_n.iter().zip(moment_y_nm).enumerate() {
        let (value, mode) = nij_of_sample(force_n, moment_nm, intercepts);
        let of_mode = &mut greatest.by_mode[mode as usize];
        *of_mode = of_mode.max(value);
        if value > greatest.value {
            (greatest.value, greatest.time_s, greatest.mode) = (value, i as f64 * dt_s, mode);
        }
    }
    Ok(greatest)
}

fn nij_of_sample(force_n: f64, moment_nm: f64, c: &NeckIntercepts) -> (f64, NeckMode) {
    let tension = force_n >= 0.0;
    let flexion = moment_nm >= 0.0;
    let force_part = force_n.abs() / if tension { c.tension_n } else { c.compression_n };
    let moment_part = moment_nm.abs() / if flexion { c.flexion_nm } else { c.extension_nm };
    let mode = match (tension, flexion) {
        (true, true) => NeckMode::TensionFlexion,
        (true, false) => NeckMode::TensionExtension,
        (false, true) => NeckMode::CompressionFlexion,
        (false, false) => NeckMode::CompressionExtension,
    };
    (force_part + moment_part, mode)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn half_sines_of_tension_and_extension() {
        let half_sine =
            |peak: f64| -> Vec<f64> { (0..=100).map(|i| peak * (PI * f64::from(i) / 100.0).sin()).collect() };
        let c = NeckIntercepts::of(Dummy::HybridIii50M).unwrap();
        let found = nij(&half_sine(2000.0), &half_sine(-50.0), 1e-3, &c).unwrap();
        assert!((found.value - 0.664_229).abs() < 5e-7);
        assert_eq!((found.mode, found.time_s), (NeckMode::TensionExtension, 0.05));
        assert_eq!(found.by_mode[1], found.value);
        // the end of the sine rounds to a tiny moment of the other sign
        assert!(found.by_mode[0] < 1e-12 && found.by_mode[2] < 1e-12 && found.by_mode[3] < 1e-12);
    }

    #[test]
    fn each_quadrant_uses_its_own_intercepts() {
        let c = NeckIntercepts { tension_n: 10.0, compression_n: 20.0, flexion_nm: 4.0, extension_nm: 8.0 };
        let found = nij(&[1.0, 1.0, -1.0, -1.0], &[1.0, -1.0, 1.0, -1.0], 1e-3, &c).unwrap();
        assert_eq!(found.by_mode, [0.1 + 0.25, 0.1 + 0.125, 0.05 + 0.25, 0.05 + 0.125]);
    }

    #[test]
    fn condyle_moment_is_less_by_the_shear_at_its_lever() {
        let moment = condyle_moment(&[10.0], &[100.0], HYBRID_III_CONDYLE_OFFSET_M).unwrap();
        assert!((moment[0] - 8.222).abs() < 1e-12);
        assert!(nij(&[1.0], &[1.0, 2.0], 1e-3, &NeckIntercepts::of(Dummy::Thor50M).unwrap()).is_err());
    }
}

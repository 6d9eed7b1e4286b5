//! N_km of Schmitt et al. (2001): shear and moment of the upper neck.
//!
//! N_km(t) = |F_x|/F_int + |M_y|/M_int, with the moment about the occipital condyles and the intercepts that the signs choose:
//! flexion or extension with anterior shear (F_x positive) or posterior shear.

use crate::measure::Dummy;
use crate::signal::{SignalError, require_positive, require_same_length, require_samples};

/// Loads that each alone give N_km = 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NkmIntercepts {
    /// Anterior shear, N.
    pub anterior_n: f64,
    /// Posterior shear, as a positive number, N.
    pub posterior_n: f64,
    /// Flexion, N·m.
    pub flexion_nm: f64,
    /// Extension, as a positive number, N·m.
    pub extension_nm: f64,
}

impl NkmIntercepts {
    /// Intercepts of a 50th percentile male: 845 N, 88.1 and 47.5 N·m, from memory. They are derived from human
    /// tolerance, and apply to the Hybrid III 50M and the BioRID-II.
    pub const MALE_50: Self = Self { anterior_n: 845.0, posterior_n: 845.0, flexion_nm: 88.1, extension_nm: 47.5 };

    /// The intercepts of a dummy, if known.
    #[must_use]
    pub fn of(dummy: Dummy) -> Option<Self> {
        matches!(dummy, Dummy::HybridIii50M | Dummy::BioRidIi).then_some(Self::MALE_50)
    }
}

/// The four combinations of load.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum NkmMode {
    /// N_fa.
    FlexionAnterior,
    /// N_ea.
    ExtensionAnterior,
    /// N_fp.
    FlexionPosterior,
    /// N_ep.
    ExtensionPosterior,
}

/// The criterion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nkm {
    /// The largest value, without unit.
    pub value: f64,
    /// Its time, s.
    pub time_s: f64,
    /// The combination it belongs to.
    pub mode: NkmMode,
    /// Largest value of each combination in the order N_fa, N_ea, N_fp, N_ep; zero if its signs never coincide.
    pub by_mode: [f64; 4],
}

/// N_km of the shear force of the upper neck (N, anterior positive) and the moment about the condyles (N·m, flexion positive).
///
/// # Errors
/// No sample, different lengths, a sample that is not finite, an interval or intercept that is not positive.
pub fn nkm(shear_x_n: &[f64], moment_y_nm: &[f64], dt_s: f64, intercepts: &NkmIntercepts) -> Result<Nkm, SignalError> {
    let NkmIntercepts { anterior_n, posterior_n, flexion_nm, extension_nm } = *intercepts;
    for own in [anterior_n, posterior_n, flexion_nm, extension_nm] {
        require_positive("intercept of Nkm", own)?;
    }
    require_samples("neck shear force", shear_x_n, dt_s, 1)?;
    require_samples("neck moment", moment_y_nm, dt_s, 1)?;
    require_same_length("neck moment", moment_y_nm, shear_x_n)?;
    let mut greatest = Nkm { value: 0.0, time_s: 0.0, mode: NkmMode::FlexionAnterior, by_mode: [0.0; 4] };
    for (i, (&shear_n, &moment_nm)) in shear_x_n.iter().zip(moment_y_nm).enumerate() {
        let (mode, of_shear, of_moment) = match (shear_n >= 0.0, moment_nm >= 0.0) {
            (true, true) => (NkmMode::FlexionAnterior, anterior_n, flexion_nm),
            (true, false) => (NkmMode::ExtensionAnterior, anterior_n, extension_nm),
            (false, true) => (NkmMode::FlexionPosterior, posterior_n, flexion_nm),
            (false, false) => (NkmMode::ExtensionPosterior, posterior_n, extension_nm),
        };
        let value = shear_n.abs() / of_shear + moment_nm.abs() / of_moment;
        let of_mode = &mut greatest.by_mode[mode as usize];
        *of_mode = of_mode.max(value);
        if value > greatest.value {
            (greatest.value, greatest.time_s, greatest.mode) = (value, i as f64 * dt_s, mode);
        }
    }
    Ok(greatest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn each_quadrant_uses_its_own_intercepts() {
        let own = NkmIntercepts { anterior_n: 10.0, posterior_n: 20.0, flexion_nm: 4.0, extension_nm: 8.0 };
        let found = nkm(&[1.0, 1.0, -1.0, -1.0], &[1.0, -1.0, 1.0, -1.0], 1e-3, &own).unwrap();
        assert_eq!(found.by_mode, [0.1 + 0.25, 0.1 + 0.125, 0.05 + 0.25, 0.05 + 0.125]);
        assert_eq!((found.value, found.mode, found.time_s), (0.35, NkmMode::FlexionAnterior, 0.0));
    }

    #[test]
    fn half_sines_of_shear_and_extension() {
        let half_sine =
            |peak: f64| -> Vec<f64> { (0..=100).map(|i| peak * (PI * f64::from(i) / 100.0).sin()).collect() };
        let found = nkm(&half_sine(169.0), &half_sine(-9.5), 1e-3, &NkmIntercepts::MALE_50).unwrap();
        // 169/845 + 9.5/47.5 = 0.4 in the middle
        assert!((found.value - 0.4).abs() < 1e-12 && found.time_s == 0.05);
        assert_eq!((found.mode, found.by_mode[1]), (NkmMode::ExtensionAnterior, found.value));
    }

    #[test]
    fn unusable_signals_and_intercepts_are_named() {
        let own = NkmIntercepts::MALE_50;
        assert!(matches!(nkm(&[], &[], 1e-3, &own), Err(SignalError::TooShort { .. })));
        assert!(matches!(nkm(&[1.0], &[1.0, 2.0], 1e-3, &own), Err(SignalError::LengthMismatch { .. })));
        let none = NkmIntercepts { posterior_n: 0.0, ..own };
        assert!(matches!(nkm(&[1.0], &[1.0], 1e-3, &none), Err(SignalError::OutOfRange { .. })));
        assert_eq!(Dummy::ALL.into_iter().filter_map(NkmIntercepts::of).count(), 2);
    }
}

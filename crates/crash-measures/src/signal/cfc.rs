//! Channel frequency classes of SAE J211 and ISO 6487.
//!
//! A class is a four-pole phaseless low-pass: 0.45 dB down at the class number and 3 dB down at
//! about 1.667 times it. The two families differ in the corner of a pass: 2.0775·CFC (SAE J211, as
//! the Crash Analysis Criteria give it) or CFC/0.6·1.25 = 2.08333·CFC (ISO 6487). Records are
//! continued by point reflection over 10 ms or 100 samples, whichever is more, and each pass starts
//! from the mean of its first ten values; SAE J211 leaves the start to the user. Read in secondary
//! sources, not in the standards.
//!
//! J211 asks for at least ten samples per period of the class; a class whose corner reaches half the
//! sample rate is refused (CFC 1000 needs more than 4.2 kHz, CFC 600 2.5 kHz, CFC 180 750 Hz).

use super::SignalError;
use super::low_pass::{Continuation, LowPass, padding_samples};

/// Channel frequency class.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ChannelClass {
    /// CFC 60: vehicle pulse, belt force.
    Cfc60,
    /// CFC 180: chest and spine acceleration, vehicle motion for integration.
    Cfc180,
    /// CFC 600: neck, femur loads.
    Cfc600,
    /// CFC 1000: head acceleration.
    Cfc1000,
}

impl ChannelClass {
    /// Every class, from the lowest.
    pub const ALL: [Self; 4] = [Self::Cfc60, Self::Cfc180, Self::Cfc600, Self::Cfc1000];

    /// The class number, Hz.
    #[must_use]
    pub fn hertz(self) -> f64 {
        [60.0, 180.0, 600.0, 1000.0][self as usize]
    }

    /// The class with this number, if there is one.
    #[must_use]
    pub fn from_number(number: u32) -> Option<Self> {
        Self::ALL.into_iter().find(|class| class.hertz() == f64::from(number))
    }

    /// Its letter in ISO-MME channel codes.
    #[must_use]
    pub fn mme_letter(self) -> char {
        ['D', 'C', 'B', 'A'][self as usize]
    }
}

/// Family of filter coefficients.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum CfcFamily {
    /// Corner 2.08333·CFC.
    #[default]
    Iso6487,
    /// Corner 2.0775·CFC.
    SaeJ211,
}

/// One filter pass of a class for samples `dt_s` apart.
///
/// # Errors
/// An interval that is not positive, or too long for the class.
pub fn cfc_coefficients(class: ChannelClass, family: CfcFamily, dt_s: f64) -> Result<LowPass, SignalError> {
    let corner_hz = match family {
        CfcFamily::Iso6487 => class.hertz() / 0.6 * 1.25,
        CfcFamily::SaeJ211 => class.hertz() * 2.0775,
    };
    LowPass::with_corner(corner_hz, dt_s)
}

/// Filters a channel; the result has its length and unit.
///
/// # Errors
/// Fewer than two samples, a sample that is not finite, an interval that is not positive or too long
/// for the class.
pub fn filter_cfc(values: &[f64], dt_s: f64, class: ChannelClass, family: CfcFamily) -> Result<Vec<f64>, SignalError> {
    let samples = padding_samples(0.010, dt_s, 100);
    cfc_coefficients(class, family, dt_s)?.filter_phaseless(values, Continuation::PointReflection { samples })
}

#[cfg(test)]
mod tests {
    use super::*;
    use CfcFamily::{Iso6487, SaeJ211};
    use ChannelClass::{Cfc60, Cfc180, Cfc600, Cfc1000};
    use std::f64::consts::PI;

    #[test]
    fn coefficients_at_10_khz() {
        let expected = [
            (SaeJ211, Cfc60, 0.001_452_367_473_55, 1.889_343_224_22, -0.895_152_694_116),
            (SaeJ211, Cfc180, 0.011_796_271_099_8, 1.670_117_463_27, -0.717_302_547_667),
            (SaeJ211, Cfc600, 0.097_184_625_279_4, 0.945_574_009_062, -0.334_312_510_179),
            (SaeJ211, Cfc1000, 0.219_231_417_219, 0.311_896_544_996, -0.188_822_213_872),
            (Iso6487, Cfc60, 0.001_460_316_305_53, 1.889_033_079_39, -0.894_874_344_617),
            (Iso6487, Cfc180, 0.011_857_682_643_2, 1.669_203_142_93, -0.716_633_873_504),
            (Iso6487, Cfc600, 0.097_631_072_937_8, 0.942_809_041_582, -1.0 / 3.0),
            (Iso6487, Cfc1000, 0.220_194_700_273, 0.307_566_359_792, -0.188_345_160_884),
        ];
        for (family, class, a0, b1, b2) in expected {
            let found = cfc_coefficients(class, family, 1e-4).unwrap();
            assert!((found.a0 - a0).abs() < 1e-11 && (found.a1 - 2.0 * a0).abs() < 1e-11 && found.a2 == found.a0);
            assert!((found.b1 - b1).abs() < 1e-11 && (found.b2 - b2).abs() < 1e-11, "{family:?} {class:?}");
        }
    }

    /// Amplitude of a filtered tone, dB.
    fn two_pass_db(class: ChannelClass, frequency_hz: f64) -> f64 {
        let tone: Vec<f64> = (0..20_000).map(|i| (2.0 * PI * frequency_hz * f64::from(i) * 1e-4).sin()).collect();
        let out = filter_cfc(&tone, 1e-4, class, SaeJ211).unwrap();
        // 1 s of whole periods: amplitude from the mean square
        let mean_square = out[5000..15_000].iter().map(|y| y * y).sum::<f64>() / 10_000.0;
        10.0 * (2.0 * mean_square).log10()
    }

    #[test]
    fn response_to_tones() {
        assert!((two_pass_db(Cfc60, 60.0) + 0.45).abs() < 0.01);
        assert!((two_pass_db(Cfc180, 180.0) + 0.45).abs() < 0.01);
        assert!((two_pass_db(Cfc60, 100.0) + 3.0).abs() < 0.02);
        assert!((two_pass_db(Cfc180, 300.0) + 3.0).abs() < 0.02);
        assert!((two_pass_db(Cfc600, 1000.0) + 2.82).abs() < 0.01);
        assert!((two_pass_db(Cfc1000, 1667.0) + 2.45).abs() < 0.01);
    }

    #[test]
    fn peak_of_a_filtered_half_sine() {
        // 100 g, 10 ms, 50 ms of zeros on both sides, 10 kHz
        let signal: Vec<f64> = (0..=1100)
            .map(|i| if (500..=600).contains(&i) { 100.0 * (PI * f64::from(i - 500) / 100.0).sin() } else { 0.0 })
            .collect();
        let peak = |class, family| filter_cfc(&signal, 1e-4, class, family).unwrap().into_iter().fold(0.0, f64::max);
        for (class, family, expected) in [
            (Cfc60, SaeJ211, 95.0788),
            (Cfc180, SaeJ211, 99.9655),
            (Cfc600, SaeJ211, 99.9998),
            (Cfc1000, SaeJ211, 100.0000),
            (Cfc60, Iso6487, 95.1366),
        ] {
            let found = peak(class, family);
            assert!((found - expected).abs() < 6e-5, "{class:?} {family:?}: {found}");
        }
    }

    #[test]
    fn a_level_that_starts_abruptly_is_kept_by_the_reflection() {
        let held = filter_cfc(&[9.81; 300], 1e-3, Cfc60, Iso6487).unwrap();
        assert!(held.iter().all(|y| (y - 9.81).abs() < 1e-12));
        assert_eq!(filter_cfc(&[1.0, 2.0, 3.0], 1e-4, Cfc60, Iso6487).unwrap().len(), 3);
        assert!(filter_cfc(&[1.0; 300], 1e-3, Cfc1000, Iso6487).is_err());
        assert!(filter_cfc(&[1.0], 1e-4, Cfc60, Iso6487).is_err());
    }
}

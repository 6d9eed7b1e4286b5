//! Sprague–Geers magnitude, phase and combined error (as RSVVP and NCHRP W179 use them).
//!
//! With m measured and c computed: M = √(Σc²/Σm²) − 1, P = acos(Σcm/√(Σc²·Σm²))/π, C = √(M² + P²).
//! Zero is perfect. M is signed: positive where the computed signal is larger. W179's acceptance,
//! all three within 40 %, is quoted from general knowledge, not read.

use super::require_pair;
use crate::signal::SignalError;
use occupant_units::trig;

/// Largest magnitude of each error accepted by W179, from memory.
pub const W179_LARGEST_ERROR: f64 = 0.40;

/// Sprague–Geers errors as fractions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpragueGeers {
    /// Magnitude error M, signed.
    pub magnitude: f64,
    /// Phase error P, 0 to 1.
    pub phase: f64,
    /// Combined error C.
    pub combined: f64,
}

impl SpragueGeers {
    /// Whether all three errors are within [`W179_LARGEST_ERROR`].
    #[must_use]
    pub fn accepted(&self) -> bool {
        [self.magnitude, self.phase, self.combined].iter().all(|error| error.abs() <= W179_LARGEST_ERROR)
    }
}

/// Errors of a computed signal against the measured one, equally sampled.
///
/// # Errors
/// No sample, different lengths, a sample that is not finite, a signal that is zero throughout.
pub fn sprague_geers(measured: &[f64], computed: &[f64]) -> Result<SpragueGeers, SignalError> {
    require_pair(measured, computed, 1.0, 1)?;
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (mm, cc, cm) = (dot(measured, measured), dot(computed, computed), dot(computed, measured));
    if cc == 0.0 {
        return Err(SignalError::NoContent { what: "computed signal" });
    }
    let magnitude = (cc / mm).sqrt() - 1.0;
    // rounding may carry the cosine just past one
    let cosine = (cm / (cc.sqrt() * mm.sqrt())).clamp(-1.0, 1.0);
    let phase = trig::acos(cosine) / std::f64::consts::PI;
    Ok(SpragueGeers { magnitude, phase, combined: (magnitude * magnitude + phase * phase).sqrt() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Two full periods in 1 s at 1 kHz, later by `lag` periods.
    fn sine(scale: f64, lag: f64) -> Vec<f64> {
        (0..1000).map(|i| scale * (2.0 * PI * (2.0 * f64::from(i) / 1000.0 - lag)).sin()).collect()
    }

    #[test]
    fn closed_forms() {
        for (scale, lag, m, p, c) in
            [(1.3, 0.0, 0.3, 0.0, 0.3), (1.0, 0.1, 0.0, 0.2, 0.2), (1.2, 0.1, 0.2, 0.2, 0.08f64.sqrt())]
        {
            let found = sprague_geers(&sine(1.0, 0.0), &sine(scale, lag)).unwrap();
            // acos near one turns a rounding of 1e−16 into 1e−8 (measured 1.6e−8)
            assert!((found.magnitude - m).abs() < 1e-12 && (found.phase - p).abs() < 5e-8, "{found:?}");
            assert!((found.combined - c).abs() < 1e-12);
            assert!(found.accepted());
        }
        let opposite = sprague_geers(&sine(1.0, 0.0), &sine(-1.0, 0.0)).unwrap();
        assert!((opposite.phase - 1.0).abs() < 1e-7 && !opposite.accepted());
    }

    #[test]
    fn silence_is_an_error() {
        assert!(matches!(sprague_geers(&[0.0; 5], &[1.0; 5]), Err(SignalError::NoContent { .. })));
        assert!(matches!(sprague_geers(&[1.0; 5], &[0.0; 5]), Err(SignalError::NoContent { .. })));
    }
}

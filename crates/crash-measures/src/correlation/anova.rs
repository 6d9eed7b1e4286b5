//! Residual statistics of RSVVP and NCHRP W179 ("ANOVA metrics").
//!
//! eᵢ = (mᵢ − cᵢ)/max|m|, its mean and its standard deviation (over n − 1). W179's acceptance, mean
//! within 5 % and deviation within 35 %, is quoted from general knowledge, not read.

use super::require_pair;
use crate::signal::SignalError;

/// Largest magnitude of the mean residual accepted by W179, from memory.
pub const W179_LARGEST_MEAN: f64 = 0.05;
/// Largest standard deviation accepted by W179, from memory.
pub const W179_LARGEST_DEVIATION: f64 = 0.35;

/// Statistics of the residuals as fractions of the measured peak.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Anova {
    /// Mean residual, positive where the measured signal is larger.
    pub mean: f64,
    /// Standard deviation of the residuals.
    pub standard_deviation: f64,
}

impl Anova {
    /// Whether both are within the limits of W179.
    #[must_use]
    pub fn accepted(&self) -> bool {
        self.mean.abs() <= W179_LARGEST_MEAN && self.standard_deviation <= W179_LARGEST_DEVIATION
    }
}

/// Residual statistics of a computed signal against the measured one, equally sampled.
///
/// # Errors
/// Fewer than two samples, different lengths, a sample that is not finite, a measured signal that is
/// zero throughout.
pub fn anova(measured: &[f64], computed: &[f64]) -> Result<Anova, SignalError> {
    require_pair(measured, computed, 1.0, 2)?;
    let peak = measured.iter().fold(0.0f64, |most, m| most.max(m.abs()));
    let residuals: Vec<f64> = measured.iter().zip(computed).map(|(m, c)| (m - c) / peak).collect();
    let n = residuals.len() as f64;
    let mean = residuals.iter().sum::<f64>() / n;
    let squares: f64 = residuals.iter().map(|e| (e - mean) * (e - mean)).sum();
    Ok(Anova { mean, standard_deviation: (squares / (n - 1.0)).sqrt() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn closed_forms() {
        // a constant offset of −2 on a peak of 10
        let measured: Vec<f64> = (0..100).map(|i| 10.0 * (2.0 * PI * f64::from(i) / 100.0).sin()).collect();
        let offset: Vec<f64> = measured.iter().map(|m| m - 2.0).collect();
        let found = anova(&measured, &offset).unwrap();
        assert!((found.mean - 0.2).abs() < 1e-12 && found.standard_deviation < 1e-12 && !found.accepted());
        // 1.3 times: residual −0.3 sin, mean 0, variance 0.09/2·n/(n − 1)
        let scaled: Vec<f64> = measured.iter().map(|m| 1.3 * m).collect();
        let found = anova(&measured, &scaled).unwrap();
        let expected = (0.045f64 * 100.0 / 99.0).sqrt();
        assert!(found.mean.abs() < 1e-12 && (found.standard_deviation - expected).abs() < 1e-12 && found.accepted());
        assert!(anova(&[0.0, 0.0], &[1.0, 1.0]).is_err());
    }
}

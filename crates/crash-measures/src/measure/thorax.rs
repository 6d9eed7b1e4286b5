//! Chest measures that need more than an acceleration.
//!
//! Deflection and the viscous criterion belong to a thorax that deforms. The simulator's thorax is
//! rigid and gives neither; these functions serve measured deflections only. The depth to which a
//! contact sphere sinks into a belt or panel is a contact penetration, not a deflection.

use super::Peak;
use crate::signal::{STANDARD_GRAVITY_MPS2, SignalError, require_positive, require_samples};

/// Scale and depth of a dummy's chest for the viscous criterion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChestSize {
    /// Scale factor s, without unit.
    pub scale: f64,
    /// Chest depth D_c, m.
    pub depth_m: f64,
}

impl ChestSize {
    /// Hybrid III 50M.
    pub const HYBRID_III_50M: Self = Self { scale: 1.3, depth_m: 0.229 };
    /// Hybrid III 5F.
    pub const HYBRID_III_5F: Self = Self { scale: 1.3, depth_m: 0.187 };
    /// Hybrid III 95M.
    pub const HYBRID_III_95M: Self = Self { scale: 1.3, depth_m: 0.254 };
}

/// Viscous criterion VC = s·Ḋ·D/D_c, m/s, of a measured compression D in m (positive inward).
///
/// Ḋ = [8(D₊₁ − D₋₁) − (D₊₂ − D₋₂)]/(12 dt); the two samples at each end count as zero. The largest
/// value is returned; the limit of UN R94 and R137 is 1.0 m/s.
///
/// # Errors
/// Fewer than five samples, a sample that is not finite, an interval or depth that is not positive.
pub fn viscous_criterion(compression_m: &[f64], dt_s: f64, chest: ChestSize) -> Result<Peak, SignalError> {
    require_samples("chest compression", compression_m, dt_s, 5)?;
    require_positive("chest depth (m)", chest.depth_m)?;
    let d = compression_m;
    let mut worst = Peak { value: 0.0, time_s: 0.0 };
    for i in 2..d.len() - 2 {
        let rate_mps = (8.0 * (d[i + 1] - d[i - 1]) - (d[i + 2] - d[i - 2])) / (12.0 * dt_s);
        let value = chest.scale * rate_mps * d[i] / chest.depth_m;
        if value > worst.value {
            worst = Peak { value, time_s: i as f64 * dt_s };
        }
    }
    Ok(worst)
}

/// Combined thoracic index of the Hybrid III 50M: CTI = A_3ms/90 g + D/103 mm.
#[must_use]
pub fn combined_thoracic_index(three_ms_mps2: f64, deflection_m: f64) -> f64 {
    three_ms_mps2 / (90.0 * STANDARD_GRAVITY_MPS2) + deflection_m / 0.103
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn viscous_criterion_of_a_haversine_of_compression() {
        let compression_m: Vec<f64> =
            (0..=100).map(|i| 0.040 * (std::f64::consts::PI * f64::from(i) / 100.0).sin().powi(2)).collect();
        let found = viscous_criterion(&compression_m, 1e-3, ChestSize::HYBRID_III_50M).unwrap();
        // analytic: s A²ω/D_c · max sin²x·sin 2x = s A² π/(T D_c) · 3√3/8
        assert!((found.value - 0.185_259).abs() < 5e-7, "{}", found.value);
        assert!(viscous_criterion(&compression_m[..4], 1e-3, ChestSize::HYBRID_III_5F).is_err());
    }

    #[test]
    fn combined_index_adds_its_parts() {
        assert!((combined_thoracic_index(45.0 * STANDARD_GRAVITY_MPS2, 0.0515) - 1.0).abs() < 1e-12);
    }
}

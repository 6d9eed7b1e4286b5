//! Chest and ribs: measures of a deflection, and of its rate.
//!
//! A deflection is that of the sternum (or of a rib) against the spine, positive inward, in m; of a dummy without its
//! skin. SAE J211 gives it class 180 as regulations use it, SAE J1727 class 600. A contact penetration (how deep a sphere
//! sinks into a belt) is no deflection.
//!
//! Constants of dummies are those that SAE J1727 and Euro NCAP TB-021 give, read in an open program that cites them.

use super::{Dummy, Peak, peak::peak_towards};
use crate::signal::{STANDARD_GRAVITY_MPS2, SignalError, require_positive, require_same_length, require_samples};

/// Scaling factor and deformation constant of a chest for the viscous criterion; the constant is the chest's depth in
/// frontal impact, half of its breadth in side impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChestSize {
    /// Scaling factor s, without unit.
    pub scale: f64,
    /// Deformation constant D_c, m.
    pub depth_m: f64,
}

impl ChestSize {
    /// Hybrid III 50M.
    pub const HYBRID_III_50M: Self = Self { scale: 1.3, depth_m: 0.229 };
    /// Hybrid III 5F.
    pub const HYBRID_III_5F: Self = Self { scale: 1.3, depth_m: 0.187 };
    /// Hybrid III 95M.
    pub const HYBRID_III_95M: Self = Self { scale: 1.3, depth_m: 0.254 };

    /// The constants of a dummy; none if unknown (THOR and BioRID have no viscous criterion).
    #[must_use]
    pub fn of(dummy: Dummy) -> Option<Self> {
        let of_ribs = |depth_m| Some(Self { scale: 1.0, depth_m });
        match dummy {
            Dummy::HybridIii50M => Some(Self::HYBRID_III_50M),
            Dummy::HybridIii5F => Some(Self::HYBRID_III_5F),
            Dummy::HybridIii95M => Some(Self::HYBRID_III_95M),
            Dummy::EuroSid1 | Dummy::Es2 | Dummy::Es2Re => of_ribs(0.140),
            Dummy::SidIis | Dummy::WorldSid5F => of_ribs(0.138),
            Dummy::WorldSid50M => of_ribs(0.170),
            Dummy::Thor50M | Dummy::BioRidIi => None,
        }
    }

    /// The constants of a person: scale 1 and his own depth, m, as in the derivation of the criterion (Lau and Viano
    /// 1986).
    #[must_use]
    pub fn of_person(depth_m: f64) -> Self {
        Self { scale: 1.0, depth_m }
    }
}

/// A largest deflection, in metres and as a fraction of the depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Compression {
    /// Largest deflection inward, m; 0 if the chest only bulges.
    pub deflection: Peak,
    /// Deflection over depth, without unit.
    pub share: f64,
}

/// Largest deflection of a chest of `depth_m`: C = D/depth.
///
/// # Errors
/// No sample, a sample that is not finite, an interval or depth that is not positive.
pub fn compression(deflection_m: &[f64], dt_s: f64, depth_m: f64) -> Result<Compression, SignalError> {
    require_samples("chest deflection", deflection_m, dt_s, 1)?;
    require_positive("chest depth (m)", depth_m)?;
    let deflection = peak_towards(1.0, deflection_m, dt_s)?;
    Ok(Compression { deflection, share: deflection.value / depth_m })
}

/// The most deflected rib, and its deflection.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DeepestRib {
    /// Index in the list.
    pub rib: usize,
    /// Largest deflection inward, m.
    pub deflection: Peak,
}

/// The deepest of several ribs, or of several points of a chest (the first of equals).
///
/// # Errors
/// No rib, ribs of different length, no sample, a sample that is not finite, an interval that is not positive.
pub fn deepest_rib(deflections_m: &[&[f64]], dt_s: f64) -> Result<DeepestRib, SignalError> {
    let first = *deflections_m.first().ok_or(SignalError::TooShort { what: "list of ribs", found: 0, needed: 1 })?;
    let mut deepest = None::<DeepestRib>;
    for (rib, own) in deflections_m.iter().enumerate() {
        require_samples("rib deflection", own, dt_s, 1)?;
        require_same_length("rib deflection", own, first)?;
        let deflection = peak_towards(1.0, own, dt_s)?;
        if deepest.is_none_or(|known| deflection.value > known.deflection.value) {
            deepest = Some(DeepestRib { rib, deflection });
        }
    }
    deepest.ok_or(SignalError::TooShort { what: "list of ribs", found: 0, needed: 1 })
}

/// Ḋ = [8(D₊₁ − D₋₁) − (D₊₂ − D₋₂)]/(12 dt) by sample, m/s (SAE J1727); the two samples at each end have none.
fn rates(d: &[f64], dt_s: f64) -> impl Iterator<Item = (usize, f64)> {
    (2..d.len() - 2).map(move |i| (i, (8.0 * (d[i + 1] - d[i - 1]) - (d[i + 2] - d[i - 2])) / (12.0 * dt_s)))
}

/// Largest rate of deflection inward, m/s; 0 if the chest only moves outward.
///
/// # Errors
/// Fewer than five samples, a sample that is not finite, an interval that is not positive.
pub fn deflection_rate(deflection_m: &[f64], dt_s: f64) -> Result<Peak, SignalError> {
    require_samples("chest deflection", deflection_m, dt_s, 5)?;
    Ok(greatest(rates(deflection_m, dt_s), dt_s))
}

/// Viscous criterion VC = s·Ḋ·D/D_c, m/s, of a compression D in m (positive inward).
///
/// Ḋ = [8(D₊₁ − D₋₁) − (D₊₂ − D₋₂)]/(12 dt); the two samples at each end count as zero. The largest value while the chest
/// is pressed in is returned: a chest that bulges out ever faster has none. The limit of UN R94 and R137 is 1.0 m/s.
///
/// # Errors
/// Fewer than five samples, a sample that is not finite, an interval, scale or depth that is not positive.
pub fn viscous_criterion(compression_m: &[f64], dt_s: f64, chest: ChestSize) -> Result<Peak, SignalError> {
    require_samples("chest compression", compression_m, dt_s, 5)?;
    require_positive("chest depth (m)", chest.depth_m)?;
    require_positive("scaling factor of the chest", chest.scale)?;
    let values = rates(compression_m, dt_s)
        .map(|(i, rate_mps)| (i, chest.scale * rate_mps * compression_m[i].max(0.0) / chest.depth_m));
    Ok(greatest(values, dt_s))
}

fn greatest(values: impl Iterator<Item = (usize, f64)>, dt_s: f64) -> Peak {
    values.fold(Peak { value: 0.0, time_s: 0.0 }, |worst, (i, value)| {
        if value > worst.value { Peak { value, time_s: i as f64 * dt_s } } else { worst }
    })
}

/// Acceleration and deflection that each alone give a combined thoracic index of 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThoracicIntercepts {
    /// A_int, m/s².
    pub acceleration_mps2: f64,
    /// D_int, m.
    pub deflection_m: f64,
}

impl ThoracicIntercepts {
    /// Hybrid III 50M: 90 g and 103 mm. Those of other dummies were not found.
    pub const HYBRID_III_50M: Self = Self { acceleration_mps2: 90.0 * STANDARD_GRAVITY_MPS2, deflection_m: 0.103 };

    /// The intercepts of a dummy, if known.
    #[must_use]
    pub fn of(dummy: Dummy) -> Option<Self> {
        (dummy == Dummy::HybridIii50M).then_some(Self::HYBRID_III_50M)
    }
}

/// Combined thoracic index CTI = A_3ms/A_int + D/D_int, without unit, of the 3 ms level of the chest in m/s² and the largest
/// deflection in m (Kleinberger et al., NHTSA, 1998).
///
/// # Errors
/// A level or deflection that is not finite, an intercept that is not positive.
pub fn combined_thoracic_index(
    three_ms_mps2: f64,
    deflection_m: f64,
    intercepts: &ThoracicIntercepts,
) -> Result<f64, SignalError> {
    require_positive("intercept of acceleration (m/s²)", intercepts.acceleration_mps2)?;
    require_positive("intercept of deflection (m)", intercepts.deflection_m)?;
    for (what, found) in [("chest level (m/s²)", three_ms_mps2), ("chest deflection (m)", deflection_m)] {
        if !found.is_finite() {
            return Err(SignalError::OutOfRange { what, found, expected: "a finite number" });
        }
    }
    Ok(three_ms_mps2 / intercepts.acceleration_mps2 + deflection_m / intercepts.deflection_m)
}

/// Deflections of the four points of a THOR's chest, m, positive inward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FourPoints<'a> {
    /// Upper left.
    pub upper_left_m: &'a [f64],
    /// Upper right.
    pub upper_right_m: &'a [f64],
    /// Lower left.
    pub lower_left_m: &'a [f64],
    /// Lower right.
    pub lower_right_m: &'a [f64],
}

/// PC score of a THOR's chest (Poplin et al. 2017), without unit: the largest, over time, of
/// 0.486 U/17.439 + 0.492 L/14.735 + 0.496 |ΔU|/9.672 + 0.526 |ΔL|/12.384 in mm, with sum and difference of left and right.
///
/// Read in an open program that cites the paper. A point that bulges out counts with its sign there; whether the paper takes
/// amounts is not known. Its risk curve was not found. Of a person it is a number to compare runs by and nothing else.
///
/// # Errors
/// No sample, points of different length, a sample that is not finite, an interval that is not positive.
pub fn pc_score(points: &FourPoints, dt_s: f64) -> Result<Peak, SignalError> {
    let FourPoints { upper_left_m, upper_right_m, lower_left_m, lower_right_m } = *points;
    for own in [upper_left_m, upper_right_m, lower_left_m, lower_right_m] {
        require_samples("chest deflection", own, dt_s, 1)?;
        require_same_length("chest deflection", own, upper_left_m)?;
    }
    let pair = |a: f64, b: f64, [sum, difference]: [f64; 2]| 1e3 * (sum * (a + b) + difference * (a - b).abs());
    let at = |i: usize| {
        pair(upper_left_m[i], upper_right_m[i], [0.486 / 17.439, 0.496 / 9.672])
            + pair(lower_left_m[i], lower_right_m[i], [0.492 / 14.735, 0.526 / 12.384])
    };
    Ok(greatest((0..upper_left_m.len()).map(|i| (i, at(i))), dt_s))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const DT_S: f64 = 1e-4;

    fn sampled(length_s: f64, of: impl Fn(f64) -> f64) -> Vec<f64> {
        (0..=(length_s / DT_S).round() as usize).map(|i| of(i as f64 * DT_S)).collect()
    }

    #[test]
    fn viscous_criterion_of_a_haversine_of_compression() {
        let compression_m: Vec<f64> = (0..=100).map(|i| 0.040 * (PI * f64::from(i) / 100.0).sin().powi(2)).collect();
        let found = viscous_criterion(&compression_m, 1e-3, ChestSize::HYBRID_III_50M).unwrap();
        // analytic: s A²ω/D_c · max sin²x·sin 2x = s A² π/(T D_c) · 3√3/8
        assert!((found.value - 0.185_259).abs() < 5e-7, "{}", found.value);
        assert!(viscous_criterion(&compression_m[..4], 1e-3, ChestSize::HYBRID_III_5F).is_err());
    }

    #[test]
    fn viscous_criterion_and_rate_of_half_a_sine_for_every_dummy() {
        // D = A sin(πt/T): VC = s A² π/(2 T D_c) at T/4, rate A π/T at the start
        let (a, t) = (0.050, 0.060);
        let half_sine = sampled(t, |time| a * (PI * time / t).sin());
        for dummy in Dummy::ALL {
            let Some(chest) = ChestSize::of(dummy) else {
                assert!([Dummy::Thor50M, Dummy::BioRidIi].contains(&dummy));
                continue;
            };
            let found = viscous_criterion(&half_sine, DT_S, chest).unwrap();
            let expected = chest.scale * a * a * PI / (2.0 * t * chest.depth_m);
            // measured 3e-11
            assert!((found.value / expected - 1.0).abs() < 1e-9, "{dummy:?}: {} {expected}", found.value);
            assert!((found.time_s - t / 4.0).abs() < 1e-12);
        }
        let rate = deflection_rate(&half_sine, DT_S).unwrap();
        let expected = a * PI / t * (PI * 2.0 * DT_S / t).cos(); // the first sample that has a rate is the third
        assert!((rate.value / expected - 1.0).abs() < 1e-9 && rate.time_s == 2.0 * DT_S);
    }

    #[test]
    fn a_chest_that_bulges_has_neither_deflection_nor_viscous_criterion() {
        let out = sampled(0.05, |t| -20.0 * t * t);
        assert_eq!(viscous_criterion(&out, DT_S, ChestSize::of_person(0.25)).unwrap().value, 0.0);
        assert_eq!(compression(&out, DT_S, 0.25).unwrap().share, 0.0);
        assert_eq!(deflection_rate(&out, DT_S).unwrap().value, 0.0);
        // the way back does not count: it only goes out there
        let back = sampled(0.05, |t| 0.05 - t);
        assert_eq!(viscous_criterion(&back, DT_S, ChestSize::of_person(0.25)).unwrap().value, 0.0);
    }

    #[test]
    fn deflection_is_told_in_metres_and_as_a_share() {
        let found = compression(&[0.0, 0.0458, 0.02], DT_S, 0.229).unwrap();
        assert_eq!((found.deflection.value, found.deflection.time_s), (0.0458, DT_S));
        assert!((found.share - 0.2).abs() < 1e-15);
        assert!(compression(&[0.01], DT_S, 0.0).is_err() && compression(&[0.01], DT_S, f64::NAN).is_err());
    }

    #[test]
    fn the_deepest_rib_is_found_and_named() {
        let ribs: [&[f64]; 3] = [&[0.0, 0.01, 0.02], &[0.0, 0.03, 0.01], &[0.03, 0.0, 0.0]];
        let found = deepest_rib(&ribs, DT_S).unwrap();
        assert_eq!((found.rib, found.deflection.value, found.deflection.time_s), (1, 0.03, DT_S));
        assert!(matches!(deepest_rib(&[], DT_S), Err(SignalError::TooShort { .. })));
        assert!(matches!(deepest_rib(&[&[0.0], &[]], DT_S), Err(SignalError::TooShort { .. })));
        assert!(matches!(deepest_rib(&[&[0.0], &[0.0; 2]], DT_S), Err(SignalError::LengthMismatch { .. })));
    }

    #[test]
    fn combined_index_adds_its_parts() {
        let own = ThoracicIntercepts::HYBRID_III_50M;
        let of = |level_g: f64, d_m| combined_thoracic_index(level_g * STANDARD_GRAVITY_MPS2, d_m, &own);
        assert!((of(45.0, 0.0515).unwrap() - 1.0).abs() < 1e-12);
        assert!(of(f64::NAN, 0.0).is_err() && of(0.0, f64::INFINITY).is_err());
        assert!(combined_thoracic_index(1.0, 1.0, &ThoracicIntercepts { deflection_m: 0.0, ..own }).is_err());
    }

    #[test]
    fn pc_score_of_four_known_points() {
        let mm = [45.0, 36.0, 49.0, -34.0].map(|mm: f64| [0.0, 1e-3 * mm, 0.0]);
        let points =
            FourPoints { upper_left_m: &mm[0], upper_right_m: &mm[1], lower_left_m: &mm[2], lower_right_m: &mm[3] };
        // U 81, L 15, ΔU 9, ΔL 83 mm
        let found = pc_score(&points, DT_S).unwrap();
        assert!((found.value - 6.745_096).abs() < 5e-7 && found.time_s == DT_S, "{found:?}");
        assert!(pc_score(&FourPoints { lower_right_m: &mm[0][..2], ..points }, DT_S).is_err());
    }
}

//! Injury risk curves: probability of an injury of a severity or worse.
//!
//! Collected from open-source programs that cite the SafetyCompanion 2023/24, NHTSA 1999/2004/2008,
//! Prasad and Mertz, and Takhounts et al.; not read in the originals. A risk is that of the
//! population the curve was fitted to, loaded like the dummy; the logistic ones do not vanish at zero
//! load (Nij: 3.8 %, criticised in SAE 2010-22-0004).

mod people;
mod side;

use super::Dummy;
use crate::signal::STANDARD_GRAVITY_MPS2;
use occupant_units::trig;

/// Severity of injury, on the abbreviated injury scale: this level or worse.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// AIS 1+.
    Ais1,
    /// AIS 2+.
    Ais2,
    /// AIS 3+.
    Ais3,
    /// AIS 4+.
    Ais4,
    /// AIS 5+.
    Ais5,
    /// Fatal.
    Fatal,
}

pub use people::{BrokenRibs, even_odds_compression};
pub use side::{abdomen_force_risk, pelvis_force_risk, rib_deflection_risk};

use Dummy::{HybridIii5F, HybridIii50M, HybridIii95M, Thor50M};
use Severity::{Ais2, Ais3, Ais4, Ais5};

/// Head risk from HIC15 (the same curve is used with HIC36), P = Φ((ln H − μ)/σ); AIS 2+, 3+, 4+.
#[must_use]
pub fn hic_risk(hic: f64, severity: Severity) -> Option<f64> {
    let of = [(Ais2, (6.963_52, 0.846_64)), (Ais3, (7.452_31, 0.739_98)), (Ais4, (7.656_05, 0.605_80))];
    let (mu, sigma) = beside(&of, severity)?;
    Some(if hic > 0.0 { normal_cdf((libm::log(hic) - mu) / sigma) } else { 0.0 })
}

/// Head risk from HIC, expanded Prasad–Mertz curves: 1/(1 + exp(a + 200/H − bH)).
#[must_use]
pub fn hic_risk_prasad_mertz(hic: f64, severity: Severity) -> f64 {
    let (a, b) = match severity {
        Severity::Ais1 => (1.54, 0.0065),
        Ais2 => (2.49, 0.004_83),
        Ais3 => (3.39, 0.003_72),
        Ais4 => (4.90, 0.003_51),
        Ais5 => (7.82, 0.004_29),
        Severity::Fatal => (12.24, 0.005_65),
    };
    if hic > 0.0 { logistic(a + 200.0 / hic, b * hic) } else { 0.0 }
}

/// Neck risk from Nij: AIS 2+ to 5+ of a Hybrid III, AIS 2+ and 3+ of a THOR, whose Nij has other intercepts.
#[must_use]
pub fn nij_risk(nij: f64, severity: Severity, dummy: Dummy) -> Option<f64> {
    let of_hybrid = [(Ais2, (2.054, 1.195)), (Ais3, (3.2269, 1.9688)), (Ais4, (2.693, 1.195)), (Ais5, (3.817, 1.195))];
    let of_thor = [(Ais2, (5.819, 5.681)), (Ais3, (6.047, 5.44))];
    let (a, b) = match dummy {
        HybridIii50M | HybridIii5F | HybridIii95M => beside(&of_hybrid, severity)?,
        Thor50M => beside(&of_thor, severity)?,
        _ => return None,
    };
    Some(logistic(a, b * nij))
}

/// Neck AIS 3+ risk from tension or compression (positive), N; Hybrid III dummies.
#[must_use]
pub fn neck_axial_risk(force_n: f64, dummy: Dummy) -> Option<f64> {
    let (a, b) = beside(&[(HybridIii50M, (10.9745, 2.375)), (HybridIii5F, (10.958, 3.770))], dummy)?;
    Some(logistic(a, b * force_n / 1000.0))
}

/// Chest AIS 3+ risk from a deflection, m: of the sternum of a Hybrid III, of the deepest point of a THOR (its resultant).
#[must_use]
pub fn chest_deflection_risk(deflection_m: f64, dummy: Dummy) -> Option<f64> {
    if dummy == Thor50M {
        return Some(1.0 - trig::exp(-libm::pow(1000.0 * deflection_m.max(0.0) / 58.183, 2.997)));
    }
    let b = beside(&[(HybridIii50M, 1.568), (HybridIii5F, 1.7212)], dummy)?;
    Some(logistic(10.5456, b * libm::pow(1000.0 * deflection_m.max(0.0), 0.4612)))
}

/// Chest AIS 3+ risk from a measured deflection, m, and age in years; Hybrid III 50M.
#[must_use]
pub fn chest_deflection_risk_at_age(deflection_m: f64, age_years: f64) -> f64 {
    logistic(12.597 - 0.058_61 * age_years, 1.568 * libm::pow(1000.0 * deflection_m.max(0.0), 0.4612))
}

/// Chest risk from the deflection of a Hybrid III's sternum, m, as published by NHTSA in 1999; AIS 2+ to 5+. It does
/// not vanish without deflection (AIS 3+: 2.4 %).
#[must_use]
pub fn chest_deflection_risk_1999(deflection_m: f64, severity: Severity) -> Option<f64> {
    let of = [(Ais2, (1.8706, 0.044_39)), (Ais3, (3.7124, 0.0475)), (Ais4, (5.0952, 0.0475)), (Ais5, (8.8274, 0.0459))];
    let (a, b) = beside(&of, severity)?;
    Some(logistic(a, b * 1000.0 * deflection_m.max(0.0)))
}

/// Lower leg AIS 2+ risk from the revised tibia index (Kuppa et al. 2001): 1 − exp(−exp((ln RTI − 0.2468)/0.2728)).
#[must_use]
pub fn tibia_risk(revised_index: f64) -> f64 {
    if revised_index > 0.0 { 1.0 - trig::exp(-trig::exp((libm::log(revised_index) - 0.2468) / 0.2728)) } else { 0.0 }
}

/// Ankle AIS 2+ risk from the axial compression of the lower tibia (positive), N (Kuppa et al. 2001). It does not vanish
/// without load (1.0 %).
#[must_use]
pub fn ankle_risk(force_n: f64) -> f64 {
    logistic(4.572, 0.670 * force_n / 1000.0)
}

/// Chest AIS 3+ risk from the 3 ms level of the chest resultant, m/s².
#[must_use]
pub fn chest_three_ms_risk(three_ms_mps2: f64) -> f64 {
    logistic(3.1493, 0.0630 * three_ms_mps2 / STANDARD_GRAVITY_MPS2)
}

/// Chest AIS 3+ risk from the combined thoracic index.
#[must_use]
pub fn combined_thoracic_risk(cti: f64) -> f64 {
    logistic(8.224, 7.125 * cti)
}

/// Femur AIS 2+ risk from axial compression (positive), N; Hybrid III dummies.
#[must_use]
pub fn femur_risk(force_n: f64, dummy: Dummy) -> Option<f64> {
    let (a, b) = beside(&[(HybridIii50M, (5.795, 0.5196)), (HybridIii5F, (5.7949, 0.7619))], dummy)?;
    Some(logistic(a, b * force_n / 1000.0))
}

/// Brain risk from BrIC: 1 − exp(−((B − 0.523)/λ)^1.8), zero below 0.523; AIS 3+ and 4+.
#[must_use]
pub fn bric_risk(bric: f64, severity: Severity) -> Option<f64> {
    let scale = beside(&[(Ais3, 0.531), (Ais4, 0.647)], severity)?;
    Some(if bric > 0.523 { 1.0 - trig::exp(-libm::pow((bric - 0.523) / scale, 1.8)) } else { 0.0 })
}

/// Probability of at least one of several independent injuries: 1 − Π(1 − Pᵢ).
#[must_use]
pub fn joint_risk(risks: &[f64]) -> f64 {
    1.0 - risks.iter().map(|p| 1.0 - p).product::<f64>()
}

/// Stars of the US frontal rating from the joint risk of head, neck, chest and femur; the bounds of the side rating are the
/// same, of head, chest, abdomen and pelvis.
///
/// The relative risk is the joint risk over 0.15; five stars below 0.67, four below 1.00, three below
/// 1.33, two below 2.67. None if the risk is not a probability.
#[must_use]
pub fn us_ncap_frontal_stars(joint_risk: f64) -> Option<u8> {
    if !(0.0..=1.0).contains(&joint_risk) {
        return None;
    }
    let relative = joint_risk / 0.15;
    Some([2.67, 1.33, 1.00, 0.67].iter().fold(1, |stars, &bound| if relative < bound { stars + 1 } else { stars }))
}

/// The value for `key`, if the table has it.
fn beside<K: PartialEq, V: Copy>(table: &[(K, V)], key: K) -> Option<V> {
    table.iter().find(|(known, _)| *known == key).map(|(_, value)| *value)
}

/// 1/(1 + exp(a − x))
fn logistic(a: f64, x: f64) -> f64 {
    1.0 / (1.0 + trig::exp(a - x))
}

/// Φ(x) = ½ erfc(−x/√2)
fn normal_cdf(x: f64) -> f64 {
    0.5 * libm::erfc(-x * std::f64::consts::FRAC_1_SQRT_2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(found: f64, expected: f64) {
        assert!((found - expected).abs() < 5.1e-7, "{found} {expected}");
    }

    #[test]
    fn check_values() {
        close(hic_risk(700.0, Ais3).unwrap(), 0.111_629);
        close(hic_risk(1000.0, Ais3).unwrap(), 0.230_894);
        close(hic_risk_prasad_mertz(1000.0, Ais3), 0.532_454);
        close(hic_risk_prasad_mertz(1000.0, Ais4), 0.169_384);
        close(nij_risk(0.5, Ais3, HybridIii50M).unwrap(), 0.095_998);
        close(nij_risk(1.0, Ais3, HybridIii5F).unwrap(), 0.221_301);
        // of a THOR: one half at 6.047/5.44
        close(nij_risk(6.047 / 5.44, Ais3, Thor50M).unwrap(), 0.5);
        assert_eq!((nij_risk(1.0, Ais4, Thor50M), nij_risk(1.0, Ais3, Dummy::SidIis)), (None, None));
        close(chest_three_ms_risk(40.0 * STANDARD_GRAVITY_MPS2), 0.347_669);
        close(chest_three_ms_risk(60.0 * STANDARD_GRAVITY_MPS2), 0.652_648);
        close(chest_deflection_risk(0.040, HybridIii50M).unwrap(), 0.124_424);
        close(chest_deflection_risk(0.040, HybridIii5F).unwrap(), 0.247_595);
        close(chest_deflection_risk(0.040, Thor50M).unwrap(), 0.277_687);
        for (severity, risk) in [(Ais2, 0.476_268), (Ais3, 0.140_348), (Ais4, 0.039_347), (Ais5, 0.000_919)] {
            close(chest_deflection_risk_1999(0.040, severity).unwrap(), risk);
        }
        // half at ln RTI = 0.2468 + 0.2728 ln ln 2
        close(tibia_risk((0.2468 + 0.2728 * 2f64.ln().ln()).exp()), 0.5);
        close(ankle_risk(4572.0 / 0.670), 0.5);
        close(femur_risk(6000.0, HybridIii50M).unwrap(), 0.064_320);
        close(femur_risk(10_000.0, HybridIii50M).unwrap(), 0.354_573);
    }

    #[test]
    fn curves_rise_from_low_to_high_and_order_by_severity() {
        use Severity::{Ais1, Ais2, Ais3, Ais4, Ais5, Fatal};
        for load in [100.0, 500.0, 1000.0, 2000.0] {
            let risks = [Ais1, Ais2, Ais3, Ais4, Ais5, Fatal].map(|s| hic_risk_prasad_mertz(load, s));
            assert!(risks.windows(2).all(|w| w[1] < w[0]), "{load}: {risks:?}");
            assert!(hic_risk(load, Ais4) < hic_risk(load, Ais3) && hic_risk(load, Ais3) < hic_risk(load, Ais2));
            assert!(hic_risk(2.0 * load, Ais3) > hic_risk(load, Ais3));
        }
        assert_eq!(hic_risk(0.0, Ais3), Some(0.0));
        assert_eq!(hic_risk_prasad_mertz(0.0, Ais1), 0.0);
        assert_eq!(hic_risk(700.0, Fatal), None);
        close(nij_risk(0.0, Ais3, HybridIii50M).unwrap(), 0.038_166); // does not vanish
        // age 35 is the curve without age
        let at_35 = chest_deflection_risk_at_age(0.040, 35.0);
        assert!((at_35 - chest_deflection_risk(0.040, HybridIii50M).unwrap()).abs() < 1e-5);
        assert_eq!((tibia_risk(0.0), tibia_risk(f64::NAN)), (0.0, 0.0));
        assert_eq!(
            (chest_deflection_risk(-0.01, Thor50M), chest_deflection_risk(0.04, Dummy::SidIis)),
            (Some(0.0), None)
        );
        assert_eq!(chest_deflection_risk_1999(0.04, Fatal), None);
        assert_eq!(bric_risk(0.5, Ais3), Some(0.0));
        close(bric_risk(0.523 + 0.531, Ais3).unwrap(), 1.0 - (-1.0f64).exp());
    }

    #[test]
    fn normal_distribution_against_tables() {
        for (x, p) in [
            (0.0, 0.5),
            (1.0, 0.841_344_746_068_542_9),
            (-2.0, 0.022_750_131_948_179_2),
            (3.5, 0.999_767_370_920_964_5),
            (-6.0, 9.865_876_450_377e-10),
        ] {
            assert!((normal_cdf(x) - p).abs() < 1e-15, "{x}: {:e}", normal_cdf(x) - p);
        }
        assert_eq!((normal_cdf(40.0), normal_cdf(-40.0)), (1.0, 0.0));
    }

    #[test]
    fn joint_risk_and_stars() {
        assert!((joint_risk(&[0.1, 0.2, 0.0]) - 0.28).abs() < 1e-15);
        assert_eq!([0.05, 0.12, 0.18, 0.30, 0.60].map(us_ncap_frontal_stars), [5, 4, 3, 2, 1].map(Some));
        assert_eq!(us_ncap_frontal_stars(f64::NAN), None);
    }
}

//! Risks of a side impact. The curves were read in an open program that cites the SafetyCompanion 2024; US NCAP rates with
//! them. Logistic curves do not vanish without load (ribs: 0.5 %).

use super::{Severity, logistic};
use crate::measure::Dummy;

/// Chest AIS 3+ risk from the deflection of the deepest rib, m; ES-2re.
#[must_use]
pub fn rib_deflection_risk(deflection_m: f64, dummy: Dummy) -> Option<f64> {
    (dummy == Dummy::Es2Re).then(|| logistic(5.3895, 0.0919 * 1000.0 * deflection_m))
}

/// Abdomen AIS 3+ risk from the sum of the abdomen's forces, N; ES-2re.
#[must_use]
pub fn abdomen_force_risk(force_n: f64, dummy: Dummy) -> Option<f64> {
    (dummy == Dummy::Es2Re).then(|| logistic(6.040_44, 0.002_133 * force_n))
}

/// Pelvis risk from a force, N: AIS 3+ of the pubic symphysis of an ES-2re, AIS 2+ of acetabulum and ilium of a SID-IIs.
#[must_use]
pub fn pelvis_force_risk(force_n: f64, severity: Severity, dummy: Dummy) -> Option<f64> {
    match (dummy, severity) {
        (Dummy::Es2Re, Severity::Ais3) => Some(logistic(7.5969, 0.0011 * force_n)),
        (Dummy::SidIis, Severity::Ais2) => Some(logistic(6.3055, 0.000_94 * force_n)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_odds_stand_where_the_curves_say() {
        let close = |found: Option<f64>| (found.unwrap() - 0.5).abs() < 1e-12;
        assert!(close(rib_deflection_risk(5.3895 / 91.9, Dummy::Es2Re)));
        assert!(close(abdomen_force_risk(6.040_44 / 0.002_133, Dummy::Es2Re)));
        assert!(close(pelvis_force_risk(7.5969 / 0.0011, Severity::Ais3, Dummy::Es2Re)));
        assert!(close(pelvis_force_risk(6.3055 / 0.000_94, Severity::Ais2, Dummy::SidIis)));
        // 44 mm, the limit of FMVSS 214: 1/(1 + e^(5.3895 − 4.0436))
        assert!((rib_deflection_risk(0.044, Dummy::Es2Re).unwrap() - 0.206_541).abs() < 5e-7);
    }

    #[test]
    fn a_curve_holds_for_its_own_dummy_alone() {
        for dummy in Dummy::ALL {
            let is_es2re = dummy == Dummy::Es2Re;
            assert_eq!(rib_deflection_risk(0.04, dummy).is_some(), is_es2re);
            assert_eq!(abdomen_force_risk(2500.0, dummy).is_some(), is_es2re);
            assert_eq!(pelvis_force_risk(6000.0, Severity::Ais2, dummy).is_some(), dummy == Dummy::SidIis);
        }
    }
}

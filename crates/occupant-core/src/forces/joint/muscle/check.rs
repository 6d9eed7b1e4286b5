//! Checks of a muscle.

use super::{Joints, Muscle};
use placed_text::Problems;

/// Shortest delay of a reflex, s: shorter ones make the equations stiff without effect.
const LEAST_DELAY_S: f64 = 1e-3;

pub(super) fn check(joints: &Joints, muscle: &Muscle, problems: &mut Problems) {
    let path = format!("muscles.{}", joints.tree()[muscle.joint].name);
    problems.check_at_least_zero(&format!("{path}.stiffness"), muscle.stiffness_n_m, "N·m");
    problems.check_at_least_zero(&format!("{path}.damping"), muscle.damping_n_m_s, "N·m·s");
    if let Some(reflex) = muscle.reflex {
        let path = format!("{path}.reflex");
        problems.check_at_least_zero(&format!("{path}.stiffness"), reflex.stiffness_n_m, "N·m");
        problems.check_at_least_zero(&format!("{path}.damping"), reflex.damping_n_m_s, "N·m·s");
        if reflex.delay_s.is_nan() || reflex.delay_s < LEAST_DELAY_S {
            let expected =
                format!("at least {LEAST_DELAY_S} s; for immediate action use the muscle's own stiffness and damping");
            problems.error(format!("{path}.delay"), format!("{} s", reflex.delay_s), expected);
        }
    }
    problems.check_positive(&format!("{path}.limit"), muscle.most_n_m, "N·m");
    problems.check_positive(&format!("{path}.rise"), muscle.rise_s, "s");
    let [on, off] = muscle.times_s;
    if off < on {
        let found = format!("a muscle that relaxes at {off} s and begins to act at {on} s");
        problems.error(format!("{path}.until"), found, "an end after its trigger and reaction time");
    }
    let gains = [muscle.stiffness_n_m, muscle.damping_n_m_s, muscle.torque_n_m.norm()];
    let late = muscle.reflex.map_or([0.0; 2], |reflex| [reflex.stiffness_n_m, reflex.damping_n_m_s]);
    if gains.iter().chain(&late).all(|gain| *gain == 0.0) {
        problems.warning(path, "a muscle without stiffness, damping and torque", "one of them: it does nothing");
    }
}

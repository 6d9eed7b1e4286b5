//! What can be wrong with a muscle.

use super::{Joints, Muscle};
use placed_text::Problems;

pub(super) fn check(joints: &Joints, muscle: &Muscle, problems: &mut Problems) {
    let path = format!("muscles.{}", joints.tree()[muscle.joint].name);
    problems.check_at_least_zero(&format!("{path}.stiffness"), muscle.stiffness_n_m, "N·m");
    problems.check_at_least_zero(&format!("{path}.damping"), muscle.damping_n_m_s, "N·m·s");
    problems.check_positive(&format!("{path}.limit"), muscle.most_n_m, "N·m");
    problems.check_positive(&format!("{path}.rise"), muscle.rise_s, "s");
    let [on, off] = muscle.times_s;
    if off < on {
        let found = format!("a muscle that relaxes at {off} s and begins to act at {on} s");
        problems.error(format!("{path}.until"), found, "an end after its trigger and reaction time");
    }
    if muscle.stiffness_n_m == 0.0 && muscle.damping_n_m_s == 0.0 && muscle.torque_n_m.norm() == 0.0 {
        problems.warning(path, "a muscle without stiffness, damping and torque", "one of them: it does nothing");
    }
}

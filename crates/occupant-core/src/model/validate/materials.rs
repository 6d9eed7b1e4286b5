//! Springs and friction of materials and webbing.

use super::{at_least_zero, positive};
use crate::forces::material::{BilinearSpring, Material};
use crate::forces::spring::LEAST_FRACTION;
use crate::problem::Problems;

pub(super) fn check_materials(materials: &[Material], problems: &mut Problems) {
    for m in materials {
        let path = format!("materials.{}", m.name);
        check_spring(&m.spring, &path, problems);
        at_least_zero(problems, &format!("{path}.friction"), m.friction, "");
        positive(problems, &format!("{path}.friction_speed"), m.friction_speed_m_s, "m/s");
    }
}

pub(super) fn check_spring(s: &BilinearSpring, path: &str, problems: &mut Problems) {
    at_least_zero(problems, &format!("{path}.k1"), s.k1_n_per_m, "N/m");
    at_least_zero(problems, &format!("{path}.k2"), s.k2_n_per_m, "N/m");
    at_least_zero(problems, &format!("{path}.break_at"), s.break_m, "m");
    for (key, value) in [("mu1", s.returned_1), ("mu2", s.returned_2)] {
        if !(0.0..=1.0).contains(&value) {
            problems.error(format!("{path}.{key}"), format!("{value}"), "a fraction of returned energy, from 0 to 1");
        } else if value < LEAST_FRACTION {
            problems.warning(
                format!("{path}.{key}"),
                format!("{value}, which counts as {}", LEAST_FRACTION),
                "at least 0.01: unloading needs some slope",
            );
        }
    }
}

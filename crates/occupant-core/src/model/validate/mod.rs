//! Checks of a [`Setup`] that need no geometry: every number finite and in its admissible range, every reference good.

mod body;
mod joints;
mod materials;
mod references;
mod time;

use crate::model::setup::Setup;
use crate::problem::Problems;

/// Reports every problem of the numbers of `setup`.
pub fn check(setup: &Setup, problems: &mut Problems) {
    body::check_body(&setup.body, problems);
    joints::check_joints(&setup.joints, problems);
    materials::check_materials(&setup.materials, problems);
    references::check_references(setup, problems);
    time::check_time(&setup.time, &setup.integrator, problems);
    if !(setup.gravity_m_s2 >= 0.0 && setup.gravity_m_s2.is_finite()) {
        problems.error(
            "gravity",
            format!("{} m/s²", setup.gravity_m_s2),
            "zero or a positive acceleration (it acts downwards)",
        );
    }
}

fn positive(problems: &mut Problems, path: &str, value: f64, unit: &str) -> bool {
    let good = value > 0.0 && value.is_finite();
    if !good {
        problems.error(path, format!("{value} {unit}").trim_end().to_owned(), "a positive number");
    }
    good
}

fn at_least_zero(problems: &mut Problems, path: &str, value: f64, unit: &str) {
    if !(value >= 0.0 && value.is_finite()) {
        problems.error(path, format!("{value} {unit}").trim_end().to_owned(), "zero or a positive number");
    }
}

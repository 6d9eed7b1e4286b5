//! Checks of a [`Setup`] that need no geometry: every number finite and in its admissible range, every reference good.

mod body;
mod time;

use crate::model::setup::Setup;
use placed_text::Problems;

/// Reports every problem of the numbers of `setup`.
pub(crate) fn check(setup: &Setup, problems: &mut Problems) {
    body::check_body(&setup.body, problems);
    setup.forces(&[]).check(&setup.body, problems);
    time::check_time(&setup.time, &setup.integrator, problems);
    if !(setup.gravity_m_s2 >= 0.0 && setup.gravity_m_s2.is_finite()) {
        problems.error(
            "gravity",
            format!("{} m/s²", setup.gravity_m_s2),
            "zero or a positive acceleration (it acts downwards)",
        );
    }
}

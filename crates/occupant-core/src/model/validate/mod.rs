//! Checks of a [`Setup`] that need no geometry: every number finite and in its admissible range, every reference good.

mod body;
mod path;
mod time;

use std::f64::consts::PI;

use crate::body::tti12::TTI12;
use crate::model::seating::InitialPosture;
use crate::model::setup::Setup;
pub(super) use path::check_path;
use placed_text::{Problems, number};

/// Reports every problem of the numbers of `setup`.
pub(crate) fn check(setup: &Setup, problems: &mut Problems) {
    if !body::check_count(&setup.body, problems) {
        return;
    }
    body::check_body(&setup.body, problems);
    setup.forces(&[]).check(&setup.body, problems);
    time::check_time(&setup.time, &setup.integrator, problems);
    check_posture(&setup.posture, problems);
    check_coordinates(setup, problems);
    if !(setup.gravity_m_s2 >= 0.0 && setup.gravity_m_s2.is_finite()) {
        problems.error(
            "gravity",
            format!("{} m/s²", number(setup.gravity_m_s2)),
            "zero or a positive acceleration (it acts downwards)",
        );
    }
}

/// The report's coordinates are those of its own body.
fn check_coordinates(setup: &Setup, problems: &mut Problems) {
    if *setup.body.tree == TTI12 {
        return;
    }
    let found = format!("the report's coordinates of a body of {} segments", setup.body.segments.len());
    if !matches!(setup.posture, InitialPosture::Seated(_) | InitialPosture::Mounted(_)) {
        problems.error("initial_state", found.clone(), "`posture`, or the report's 12 segments");
    }
    if setup.output.report_coordinates {
        problems.error("output.report_coordinates", found, "false, or the report's 12 segments");
    }
}

/// Angles of more than half a turn, which a slip of the pen makes.
fn check_posture(posture: &InitialPosture, problems: &mut Problems) {
    let (path, angles_rad) = match posture {
        InitialPosture::Seated(seating) => ("posture", &seating.angles_rad),
        InitialPosture::Mounted(mounting) => ("mount.posture", &mounting.angles_rad),
        InitialPosture::Coordinates(_) | InitialPosture::Continued { .. } => return,
    };
    for (key, angle_rad) in angles_rad.iter().filter(|(_, angle)| angle.is_nan() || angle.abs() > PI) {
        problems.error(
            format!("{path}.{key}"),
            format!("{}°", number(angle_rad.to_degrees())),
            "an angle from −180° to 180°",
        );
    }
}

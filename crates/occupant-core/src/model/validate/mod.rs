//! Checks of a [`Setup`] that need no geometry: every number finite and in its admissible range, every reference good.

mod body;
mod columns;
mod path;
mod references;
mod time;

use std::f64::consts::PI;

use crate::body::tti12::TTI12;
use crate::forces::contact::FASTEST_M_S;
use crate::model::seating::{InitialPosture, InitialVelocity, Seating, Settling};
use crate::model::setup::Setup;
use crate::motion::layout::{MOST_BODIES, MOST_HINGES, MOST_SEGMENTS};
pub(super) use path::check_path;
use placed_text::{Problems, number};
pub(super) use time::check_time;

/// Reports every problem of the values of `setup`.
pub(crate) fn check(setup: &Setup, problems: &mut Problems) {
    if !body::check_count(&setup.body, problems) {
        return;
    }
    references::check(setup, problems);
    if problems.has_errors() {
        return;
    }
    if !setup.members.is_empty() {
        return check_together(setup, problems);
    }
    body::check_body(&setup.body, problems);
    columns::check(setup, problems);
    setup.forces(&[]).check(&setup.body, problems);
    check_time(&setup.time, &setup.integrator, problems);
    time::check_readings(setup.output.readings_s, &setup.time, problems);
    check_posture(&setup.posture, problems);
    check_coordinates(setup, problems);
    check_gravity(setup, problems);
}

fn check_gravity(setup: &Setup, problems: &mut Problems) {
    if !(setup.gravity_m_s2 >= 0.0 && setup.gravity_m_s2.is_finite()) {
        problems.error(
            "gravity",
            format!("{} m/s²", number(setup.gravity_m_s2)),
            "zero or a positive acceleration (it acts downwards)",
        );
    }
}

/// Problems of the force elements of several bodies together, each of which is valid alone.
pub(super) fn check_whole(setup: &Setup, problems: &mut Problems) {
    let mut found = Problems::new();
    setup.forces(&[]).check(&setup.body, &mut found);
    if found.has_errors() {
        problems.extend(found);
    }
}

/// Total counts of several bodies; each body is checked by itself.
fn check_together(setup: &Setup, problems: &mut Problems) {
    check_gravity(setup, problems);
    check_time(&setup.time, &setup.integrator, problems);
    time::check_readings(setup.output.readings_s, &setup.time, problems);
    let hinges = setup.body.tree.joint_rows().iter().map(|row| body::axes_of(row.kind));
    let counts = [
        ("bodies", setup.members.len(), MOST_BODIES),
        ("segments", setup.body.segments.len(), MOST_SEGMENTS),
        ("axes of hinges", hinges.sum(), MOST_HINGES),
    ];
    for (what, found, most) in counts.into_iter().filter(|(_, found, most)| found > most) {
        problems.error("occupants", format!("{found} {what} in all"), format!("at most {most} {what} together"));
    }
    let is_letter = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    for (i, member) in setup.members.iter().enumerate() {
        let name = member.name.as_str();
        let is_plain = name.starts_with(|c: char| c.is_ascii_lowercase()) && name.chars().all(is_letter);
        let is_first = !setup.members[..i].iter().any(|other| other.name == name);
        // a body that stands at the top of a scenario has no name
        if !is_first || !(is_plain || i == 0 && name.is_empty()) {
            let found = format!("{} body named {name:?}", if is_first { "a" } else { "a second" });
            let expected = "a small letter, then small letters, digits and `_`; each name once, because results use it";
            problems.error(member.path(), found, expected);
        }
        if let InitialVelocity::Given(velocity) = &member.alone.velocity
            && velocity.norm() > FASTEST_M_S
        {
            let expected = format!("at most {FASTEST_M_S} m/s: contact of a faster body begins one step late");
            problems.warning(member.path(), format!("{:.0} m/s at the start", velocity.norm()), expected);
        }
    }
    let is_limp = |seating: &Seating| seating.settle == Settling::Limp;
    for member in &setup.members {
        if matches!(&member.alone.posture, InitialPosture::Seated(seating) if is_limp(seating)) {
            let expected = "one that settles as one piece: only a body alone can sink limp";
            problems.error(format!("{}.posture.limp", member.path()), "a limp body among several", expected);
        }
    }
}

/// Checks that the report's coordinates belong to the report's body.
fn check_coordinates(setup: &Setup, problems: &mut Problems) {
    if *setup.body.tree == TTI12 || !setup.members.is_empty() {
        return;
    }
    let found = format!("the report's coordinates of a body of {} segments", setup.body.segments.len());
    if matches!(setup.posture, InitialPosture::Coordinates(_) | InitialPosture::Continued { .. }) {
        problems.error("initial_state", found.clone(), "`posture`, or the report's 12 segments");
    }
    if setup.output.report_coordinates {
        problems.error("output.report_coordinates", found, "false, or the report's 12 segments");
    }
}

/// Warns of angles beyond half a turn, a likely typing error.
fn check_posture(posture: &InitialPosture, problems: &mut Problems) {
    let (path, angles_rad) = match posture {
        InitialPosture::Seated(seating) => ("posture", &seating.angles_rad),
        InitialPosture::Mounted(mounting) => ("mount.posture", &mounting.angles_rad),
        InitialPosture::Placed(placing) if placing.stands => ("stance.posture", &placing.at.angles_rad),
        InitialPosture::Placed(placing) => ("mount.posture", &placing.at.angles_rad),
        InitialPosture::Coordinates(_) | InitialPosture::Continued { .. } | InitialPosture::Together => return,
    };
    for (key, angle_rad) in angles_rad.iter().filter(|(_, angle)| angle.is_nan() || angle.abs() > PI) {
        problems.error(
            format!("{path}.{key}"),
            format!("{}°", number(angle_rad.to_degrees())),
            "an angle from −180° to 180°",
        );
    }
}

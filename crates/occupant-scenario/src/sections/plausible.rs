//! Warnings about possible numbers that look like a wrong unit: inches read as metres, radians as degrees, lbf/in as
//! N/m, milliseconds as seconds.

use std::ops::RangeInclusive;

use super::builder::Builder;
use super::joints::JointsSection;
use super::posture::PostureSection;
use super::{Angle, Scenario};
use occupant_core::body::Tree;
use occupant_core::model::setup::Setup;
use placed_text::{Problem, Step, child, follow, number, parse_path, targets, to_text};

/// The usual range of one kind of number, and the likely mistake of an unusual one.
struct Usual {
    /// Paths of such numbers in an explicit scenario, or of a representative of several; for a list its norm.
    paths: &'static [&'static str],
    values: RangeInclusive<f64>,
    unit: &'static str,
    in_words: &'static str,
    what: &'static str,
    slip: &'static str,
}

const LEAN: &str = "positive angles lean the top back; 0 is upright";
const METRES: &str = "bare numbers are metres unless units = \"in-lbf-s\" says inches";

/// For angles; SI has radians.
const DEGREES: &str = "°";

const fn usual(
    paths: &'static [&'static str],
    values: RangeInclusive<f64>,
    [unit, in_words, what, slip]: [&'static str; 4],
) -> Usual {
    Usual { paths, values, unit, in_words, what, slip }
}

/// Path, lower and upper bound, unit, name, and the likely mistake.
#[rustfmt::skip]
const USUAL: [Usual; 11] = [
    usual(&["gravity"], 9.5..=10.1, ["m/s²", "9.5 to 10.1 m/s²", "gravity on earth",
        "386.09 is standard gravity in in/s², 32.17 in ft/s²"]),
    usual(&["body.segments"], 3.0..=250.0, ["kg", "3 kg to 250 kg", "the mass of a person",
        "a bare mass is in kg, under units = \"in-lbf-s\" in lbf·s²/in; use \"11.5 lb\", or `weight`"]),
    usual(&["time.end"], 0.01..=20.0, ["s", "10 ms to 20 s", "the duration of a crash",
        "bare numbers are seconds; use \"200 ms\""]),
    usual(&["body.spheres.*.radius"], 0.005..=0.5, ["m", "5 mm to 0.5 m", "the radius of a sphere of the body", METRES]),
    usual(&["materials.*.k1", "belts.*.k1"], 500.0..=1e9, ["N/m", "500 N/m to 1 GN/m", "the stiffness of a part of a car",
        "bare numbers are N/m unless units = \"in-lbf-s\" says lbf/in; 1 lbf/in is 175 N/m"]),
    usual(&["materials.*.friction"], 0.0..=3.0, ["", "0 to 3", "a coefficient of friction",
        "it is tangential force over normal force"]),
    usual(&["belts.*.anchors[*]", "posture.heels[*]"], -10.0..=10.0, ["m", "within 10 m of the origin", "a position in a vehicle", METRES]),
    usual(&["posture.middle_torso", "posture.upper_torso", "posture.lower_torso"], -45.0..=90.0,
        [DEGREES, "−45° to 90°", "the lean of a person who sits", LEAN]),
    usual(&["posture.head"], -60.0..=90.0, [DEGREES, "−60° to 90°", "the lean of a head", LEAN]),
    usual(&["posture.upper_arms"], -90.0..=180.0, [DEGREES, "−90° to 180°", "the angle of upper arms",
        "positive angles move the elbows ahead of the shoulders"]),
    usual(&["posture.elbows"], -150.0..=10.0, [DEGREES, "−150° to 10°", "the angle of elbows",
        "negative angles move the hands forward"]),
];

/// Adds a warning for every kind of number that looks like a wrong unit.
pub(super) fn check(b: &mut Builder, setup: &Setup, scenario: &Scenario) {
    for usual in &USUAL {
        let factor = if usual.unit == DEGREES { 1f64.to_degrees() } else { 1.0 };
        let values = usual.paths.iter().flat_map(|path| values(b, setup, path)).map(|(at, x)| (at, x * factor));
        let unusual = values.filter(|(_, value)| !usual.values.contains(value)).collect();
        warn_of(b, unusual, usual);
    }
    if let Some(posture) = &scenario.posture {
        check_posture_angles(b, posture);
    }
    if let Some(joints) = &scenario.joints {
        check_stop_angles(b, joints, setup.body.tree);
    }
}

/// SI values and the steps of their paths, except zeros that switch something off and removed values.
fn values(b: &Builder, setup: &Setup, path: &str) -> Vec<(Vec<Step>, f64)> {
    let root = &b.document.root;
    let of_place = |steps: Vec<Step>| {
        let above = follow(root, &steps[..steps.len() - 1])?;
        let node = child(above, steps.last()?)?;
        let norm = || node.items().iter().filter_map(|n| n.si).map(|x| x * x).sum::<f64>().sqrt();
        let value = node.si.unwrap_or_else(norm);
        (value != 0.0 && !above.is_removed()).then_some((steps, value))
    };
    let steps = |path| parse_path(path).unwrap_or_default();
    match path {
        "body.segments" => vec![(steps(path), setup.body.mass_kg())],
        "time.end" => vec![(steps(path), setup.time.end_s - setup.time.start_s)],
        _ => targets(root, &steps(path)).into_iter().filter_map(of_place).collect(),
    }
}

/// One warning for all values of a kind outside the usual range, at the first of them.
fn warn_of(b: &mut Builder, unusual: Vec<(Vec<Step>, f64)>, usual: &Usual) {
    let Some(((first, value), others)) = unusual.split_first() else { return };
    let more = match others.len() {
        0 => String::new(),
        n => format!(", as are {n} more"),
    };
    let rounded = (value * 1e6).round() / 1e6;
    let value = number(if rounded == 0.0 { *value } else { rounded });
    let found = format!("{} is unusual for {}{more}", format!("{value} {}", usual.unit).trim_end(), usual.what);
    b.report(Problem::warning(to_text(first), found, usual.in_words).with_hint(Some(usual.slip)));
}

/// Bare angles that are all below π, and not all whole or nearly zero, were probably meant in radians. A text carries
/// its own unit.
fn look_like_radians(angles: &[&Angle]) -> bool {
    let degrees: Option<Vec<f64>> = angles.iter().map(|a| a.bare()).collect();
    degrees.is_some_and(|all| {
        all.iter().all(|a| a.abs() <= std::f64::consts::PI) && all.iter().any(|a| a.abs() > 0.05 && a.fract() != 0.0)
    })
}

fn check_posture_angles(b: &mut Builder, p: &PostureSection) {
    let angles: Vec<&Angle> = p.angles().map(|(_, angle)| angle).collect();
    if look_like_radians(&angles) {
        let found = "all angles of the posture are below 3.2°, as if in radians";
        let hint = "bare angles are degrees; write \"0.26 rad\" for radians";
        b.report(Problem::warning("posture", found, "degrees").with_hint(Some(hint)));
    }
}

fn check_stop_angles(b: &mut Builder, joints: &JointsSection, tree: &Tree) {
    for joint in tree.joint_rows() {
        let Some(section) = joints.named.get(joint.name) else { continue };
        let stops = [("stop", &section.stop), ("lower_stop", &section.lower_stop), ("upper_stop", &section.upper_stop)];
        for (key, stop) in stops {
            if stop.as_ref().is_some_and(|s| look_like_radians(&[&s.begin, &s.full])) {
                let found = "both angles of a stop are below 3.2°, as if in radians";
                let hint = "bare angles are degrees; write \"0.79 rad\" for radians";
                let path = format!("joints.{}.{key}", joint.name);
                b.report(Problem::warning(path, found, "degrees").with_hint(Some(hint)));
            }
        }
    }
}

//! Checks of belts: their data and their initial course.

use crate::body::Body;
use crate::forces::belt::law::BeltLaw;
use crate::forces::belt::{Belt, RestLength};
use crate::motion::vector::V3;
use nalgebra::Vector3;
use occupant_units::trig;
use placed_text::{Problem, Problems};

pub(super) fn data(belts: &[Belt], body: &Body, problems: &mut Problems) {
    problems.check_unique("belts", "belt", belts.iter().map(|b| b.name.as_str()));
    for belt in belts {
        let path = format!("belts.{}", belt.name);
        if belt.sphere >= body.spheres.len() {
            problems.error(format!("{path}.sphere"), "no such sphere", "a sphere of the body");
        }
        belt.webbing.check(&path, problems);
        if belt.anchors_m.iter().any(|a| a.iter().any(|c| !c.is_finite())) {
            problems.error(format!("{path}.anchors"), "not finite numbers", "two points");
        } else if (belt.anchors_m[0] - belt.anchors_m[1]).norm() < 1e-6 {
            problems.error(format!("{path}.anchors"), "two anchors in one place", "two points");
        }
    }
}

/// Checks a belt in its initial position, among the spheres of the body with these centres, vehicle axes.
pub(super) fn laid(law: &BeltLaw<f64>, belt: &Belt, body: &Body, centres: &[V3<f64>], problems: &mut Problems) {
    let path = format!("belts.{}", belt.name);
    for (i, anchor) in belt.anchors_m.iter().enumerate() {
        for (index, (sphere, centre)) in body.spheres.iter().zip(centres).enumerate() {
            let distance = (anchor.coords - centre.to_vector()).norm();
            if distance > sphere.radius_m {
                continue;
            }
            let found = format!(
                "anchor {} lies {distance:.4} m from the centre of the sphere {} of radius {:.4} m",
                i + 1,
                sphere.name,
                sphere.radius_m
            );
            let problem = if index == belt.sphere {
                let problem = Problem::error(&path, found, "an anchor outside the sphere that the belt goes round");
                problem
                    .with_hint(Some("move the anchor, or check the seat's lateral position and the anchor's sign of y"))
            } else {
                let hint = "check the anchor's height and its sign of y";
                Problem::warning(&path, found, "an anchor outside the body").with_hint(Some(hint))
            };
            problems.push(Problem { path: format!("{path}.anchors"), ..problem });
        }
    }
    if let Some(centre) = centres.get(belt.sphere) {
        holds(belt, body, centre.to_vector(), &path, problems);
        fits(law, belt, *centre, &path, problems);
    }
    let rest_length_m = law.rest_length;
    if !(rest_length_m.is_finite() && rest_length_m > 0.0) {
        problems.error(path, format!("an unstretched length of {rest_length_m} m"), "a positive length");
    }
}

/// Largest plausible slack, m.
const LOOSE_M: f64 = 0.2;
/// Largest plausible initial tension, N; retractors pull 5 to 20.
const TIGHT_N: f64 = 500.0;

/// Warns of a belt too long or too short for the body, such as one with a length for another body.
fn fits(law: &BeltLaw<f64>, belt: &Belt, centre: V3<f64>, path: &str, problems: &mut Problems) {
    let action = law.act(centre, &law.initial_history(centre));
    let key = if matches!(belt.rest, RestLength::Given { .. }) { "length" } else { "slack" };
    let found = if action.elongation < -LOOSE_M {
        format!("the belt has {:.2} m of slack round this body", -action.elongation)
    } else if action.loop_force > TIGHT_N {
        format!(
            "the belt is {:.0} mm too short for this body and pulls {:.0} N",
            1e3 * action.elongation,
            action.loop_force
        )
    } else {
        return;
    };
    let expected = "at most 0.2 m of slack and a pull of 500 N, unless the run begins within a crash";
    let hint = "`slack` in place of `length` lets a belt fit every body";
    problems.push(Problem::warning(format!("{path}.{key}"), found, expected).with_hint(Some(hint)));
}

/// Warns of a belt that does not cross the body, and of one around the pelvis that would not stay there: from the
/// pelvis to its anchors a lap belt runs back and down, at 20° to 80°.
fn holds(belt: &Belt, body: &Body, centre: Vector3<f64>, path: &str, problems: &mut Problems) {
    let to_anchors = belt.anchors_m.map(|anchor| anchor.coords - centre);
    let mut warn = |found: String, expected: &str, hint: &str| {
        let problem = Problem::warning(format!("{path}.anchors"), found, expected).with_hint(Some(hint));
        problems.push(problem);
    };
    let sphere = &body.spheres[belt.sphere];
    if to_anchors.iter().all(|to| to.y > 0.0) || to_anchors.iter().all(|to| to.y < 0.0) {
        let side = if to_anchors[0].y > 0.0 { "right" } else { "left" };
        warn(
            format!(
                "both anchors lie to the {side} of the {}'s centre: the belt does not go across the body",
                sphere.name
            ),
            "an anchor on either side",
            "check the seat's lateral position and the anchors' signs of y",
        );
    } else if Some(sphere.segment) == body.tree.landmarks().pelvis {
        let slopes = to_anchors.map(|to| trig::atan2(to.z, -to.x).to_degrees());
        if let Some(slope) = slopes.iter().find(|slope| !(20.0..=80.0).contains(*slope)) {
            warn(
                format!(
                    "the belt goes from the pelvis to an anchor at {slope:.0}° below the level, counted from straight back"
                ),
                "20° to 80°: a flatter belt slides up onto the abdomen, a steeper one lets the pelvis move forward",
                "move the anchor, or check the seat's position",
            );
        }
    }
}

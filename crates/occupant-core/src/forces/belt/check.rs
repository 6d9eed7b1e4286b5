//! What is wrong with belts: with their data, and with how they lie at the start.

use crate::body::Body;
use crate::forces::belt::Belt;
use crate::forces::belt::law::BeltLaw;
use crate::motion::vector::V3;
use crash_measures::trig;
use nalgebra::Vector3;
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

/// A belt as it lies at the start, among the spheres that belts go round and their centres, vehicle axes.
pub(super) fn laid(
    law: &BeltLaw<f64>,
    belt: &Belt,
    body: &Body,
    spheres: &[(usize, V3<f64>)],
    problems: &mut Problems,
) {
    let path = format!("belts.{}", belt.name);
    for (i, anchor) in belt.anchors_m.iter().enumerate() {
        for (index, centre) in spheres {
            let (sphere, distance) = (&body.spheres[*index], (anchor.coords - centre.to_vector()).norm());
            if distance > sphere.radius_m {
                continue;
            }
            let found = format!(
                "anchor {} lies {distance:.4} m from the centre of the sphere {} of radius {:.4} m",
                i + 1,
                sphere.name,
                sphere.radius_m
            );
            let problem = if *index == belt.sphere {
                let problem = Problem::error(&path, found, "an anchor outside the sphere that the belt goes round");
                problem.with_hint(Some("move the anchor, or check the seat's lateral place and the anchor's sign of y"))
            } else {
                let hint = "check the anchor's height and its sign of y";
                Problem::warning(&path, found, "an anchor outside the body").with_hint(Some(hint))
            };
            problems.push(Problem { path: format!("{path}.anchors"), ..problem });
        }
    }
    let own = spheres.iter().find(|(index, _)| *index == belt.sphere);
    if let Some((_, centre)) = own {
        holds(belt, body, centre.to_vector(), &path, problems);
    }
    let rest_length_m = law.rest_length;
    if !(rest_length_m.is_finite() && rest_length_m > 0.0) {
        problems.error(path, format!("an unstretched length of {rest_length_m} m"), "a positive length");
    }
}

/// Warns of a belt that does not go across the body, and of one round the pelvis that would not stay there: from the pelvis
/// to its anchors a lap belt goes back and down, 20° to 80° from the level.
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
            "check the seat's lateral place and the anchors' signs of y",
        );
    } else if Some(sphere.segment) == body.tree.landmarks().pelvis {
        let slopes = to_anchors.map(|to| trig::atan2(to.z, -to.x).to_degrees());
        if let Some(slope) = slopes.iter().find(|slope| !(20.0..=80.0).contains(*slope)) {
            warn(
                format!(
                    "the belt goes from the pelvis to an anchor at {slope:.0}° below the level, counted from straight back"
                ),
                "20° to 80°: a flatter belt slides up to the belly, a steeper one lets the pelvis go ahead",
                "move the anchor, or check the seat's place",
            );
        }
    }
}

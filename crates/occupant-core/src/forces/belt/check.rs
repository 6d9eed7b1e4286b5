//! What is wrong with belts: with their data, and with how they lie at the start.

use crate::body::Body;
use crate::forces::belt::Belt;
use crate::forces::belt::law::BeltLaw;
use crate::motion::vector::V3;
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
    let rest_length_m = law.rest_length;
    if !(rest_length_m.is_finite() && rest_length_m > 0.0) {
        problems.error(path, format!("an unstretched length of {rest_length_m} m"), "a positive length");
    }
}

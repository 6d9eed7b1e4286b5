//! What is wrong with belts: with their data, and with how they lie at the start.

use crate::body::Body;
use crate::forces::belt::Belt;
use crate::forces::belt::law::BeltLaw;
use crate::motion::vector::V3;
use placed_text::Problems;

pub(super) fn data(belts: &[Belt], body: &Body, problems: &mut Problems) {
    for (i, belt) in belts.iter().enumerate() {
        let path = format!("belts.{}", belt.name);
        if belts[..i].iter().any(|b| b.name == belt.name) {
            problems.error(&path, format!("a second belt named {}", belt.name), "unique names");
        }
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

/// A belt round a sphere whose centre is at `centre`, vehicle axes.
pub(super) fn laid(law: &BeltLaw<f64>, belt: &Belt, body: &Body, centre: V3<f64>, problems: &mut Problems) {
    let (path, sphere) = (format!("belts.{}", belt.name), &body.spheres[belt.sphere]);
    for (i, anchor) in belt.anchors_m.iter().enumerate() {
        let distance = (anchor.coords - centre.to_vector()).norm();
        if distance <= sphere.radius_m {
            problems.error_with_hint(
                format!("{path}.anchors"),
                format!(
                    "anchor {} lies {:.4} m from the centre of the sphere {} of radius {:.4} m",
                    i + 1,
                    distance,
                    sphere.name,
                    sphere.radius_m
                ),
                "an anchor outside the sphere that the belt goes round",
                "move the anchor, or check the seat's lateral place and the anchor's sign of y",
            );
        }
    }
    let rest_length_m = law.rest_length;
    if !(rest_length_m.is_finite() && rest_length_m > 0.0) {
        problems.error(path, format!("an unstretched length of {rest_length_m} m"), "a positive length");
    }
}

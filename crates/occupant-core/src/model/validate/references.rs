//! Names and indices that lead from one part of a setup to another.

use super::materials::check_spring;
use crate::model::setup::Setup;
use crate::problem::Problems;

pub(super) fn check_references(setup: &Setup, problems: &mut Problems) {
    let spheres = setup.body.spheres.len();
    for (i, surface) in setup.surfaces.iter().enumerate() {
        let path = format!("surfaces.{}", surface.name);
        if setup.surfaces[..i].iter().any(|s| s.name == surface.name) {
            problems.error(&path, format!("a second surface named {}", surface.name), "unique names");
        }
        if surface.material >= setup.materials.len() {
            problems.error(format!("{path}.material"), "no such material", "a named material");
        }
        if surface.spheres.iter().flatten().any(|&s| s >= spheres) {
            problems.error(format!("{path}.spheres"), "no such sphere", "spheres of the body");
        }
    }
    for (i, belt) in setup.belts.iter().enumerate() {
        let path = format!("belts.{}", belt.name);
        if setup.belts[..i].iter().any(|b| b.name == belt.name) {
            problems.error(&path, format!("a second belt named {}", belt.name), "unique names");
        }
        if belt.sphere >= spheres {
            problems.error(format!("{path}.sphere"), "no such sphere", "a sphere of the body");
        }
        check_spring(&belt.webbing, &path, problems);
        if belt.anchors_m.iter().any(|a| a.iter().any(|c| !c.is_finite())) {
            problems.error(format!("{path}.anchors"), "not finite numbers", "two points");
        } else if (belt.anchors_m[0] - belt.anchors_m[1]).norm() < 1e-6 {
            problems.error(format!("{path}.anchors"), "two anchors in one place", "two points");
        }
    }
}

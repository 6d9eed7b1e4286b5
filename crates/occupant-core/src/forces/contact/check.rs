//! What is wrong with materials and surfaces by themselves.

use crate::body::Body;
use crate::forces::contact::material::Material;
use crate::forces::contact::surface::Surface;
use placed_text::Problems;

pub(super) fn check(materials: &[Material], surfaces: &[Surface], body: &Body, problems: &mut Problems) {
    for m in materials {
        let path = format!("materials.{}", m.name);
        m.spring.check(&path, problems);
        problems.check_at_least_zero(&format!("{path}.friction"), m.friction, "");
        problems.check_positive(&format!("{path}.friction_speed"), m.friction_speed_m_s, "m/s");
    }
    for (i, surface) in surfaces.iter().enumerate() {
        let path = format!("surfaces.{}", surface.name);
        if surfaces[..i].iter().any(|s| s.name == surface.name) {
            problems.error(&path, format!("a second surface named {}", surface.name), "unique names");
        }
        if surface.material >= materials.len() {
            problems.error(format!("{path}.material"), "no such material", "a named material");
        }
        if surface.spheres.iter().flatten().any(|&s| s >= body.spheres.len()) {
            problems.error(format!("{path}.spheres"), "no such sphere", "spheres of the body");
        }
    }
}

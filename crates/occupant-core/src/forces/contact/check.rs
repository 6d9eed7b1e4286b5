//! What is wrong with materials and surfaces by themselves.

use crate::body::Body;
use crate::forces::contact::material::Material;
use crate::forces::contact::surface::Surface;
use placed_text::Problems;

/// More pairs of sphere and surface than this are a slip, or a mesh that should be made coarser.
const MOST_PAIRS: usize = 200_000;

pub(super) fn check(materials: &[Material], surfaces: &[Surface], body: &Body, problems: &mut Problems) {
    let pairs = surfaces.len() * body.spheres.len();
    if pairs > MOST_PAIRS {
        let found = format!("{} surfaces for {} spheres, which are {pairs} pairs", surfaces.len(), body.spheres.len());
        problems.error("surfaces", found, format!("at most {MOST_PAIRS} pairs"));
    }
    for m in materials {
        let path = format!("materials.{}", m.name);
        m.spring.check(&path, problems);
        problems.check_at_least_zero(&format!("{path}.friction"), m.friction, "");
        problems.check_positive(&format!("{path}.friction_speed"), m.friction_speed_m_s, "m/s");
    }
    problems.check_unique("surfaces", "surface", surfaces.iter().map(|s| s.name.as_str()));
    for surface in surfaces {
        let path = format!("surfaces.{}", surface.name);
        if surface.material >= materials.len() {
            problems.error(format!("{path}.material"), "no such material", "a named material");
        }
        if surface.spheres.iter().flatten().any(|&s| s >= body.spheres.len()) {
            problems.error(format!("{path}.spheres"), "no such sphere", "spheres of the body");
        }
    }
}

//! What is wrong with materials and surfaces by themselves.

use crate::body::Body;
use crate::forces::contact::solid::{Solid, build};
use crate::forces::contact::{ContactData, ContactSystem, OPEN};
use crate::forces::element::Instant;
use placed_text::{Problem, Problems};

/// More pairs of sphere and surface than this are a slip, or a mesh that should be made coarser.
const MOST_PAIRS: usize = 200_000;

pub(super) fn check(data: &ContactData<'_>, body: &Body, problems: &mut Problems) {
    let &ContactData { materials, surfaces, solids, .. } = data;
    let count = surfaces.len() + solids.len();
    let pairs = count * body.spheres.len();
    if pairs > MOST_PAIRS {
        let found = format!("{count} surfaces for {} spheres, which are {pairs} pairs", body.spheres.len());
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
    check_solids(data, body, problems);
}

fn check_solids(data: &ContactData<'_>, body: &Body, problems: &mut Problems) {
    let &ContactData { materials, surfaces, solids, .. } = data;
    problems.check_unique("solids", "solid", solids.iter().map(|s| s.name.as_str()));
    for (i, solid) in solids.iter().enumerate() {
        let path = format!("solids.{}", solid.name);
        if let Err((found, expected)) = build(&solid.shape) {
            problems.error(&path, found, expected);
        }
        if surfaces.iter().any(|surface| surface.name == solid.name) {
            problems.error(&path, "a surface has the same name", "a name of its own");
        }
        if solid.material >= materials.len() {
            problems.error(format!("{path}.material"), "no such material", "a named material");
        }
        if solid.spheres.iter().flatten().any(|&s| s >= body.spheres.len()) {
            problems.error(format!("{path}.spheres"), "no such sphere", "spheres of the body");
        }
        check_group(solid, &solids[..i], problems);
    }
}

/// A solid with the first of its group, which tells frame and material.
fn check_group(solid: &Solid, before: &[Solid], problems: &mut Problems) {
    let Some(group) = &solid.group else { return };
    let Some(first) = before.iter().find(|other| other.group.as_ref() == Some(group)) else { return };
    for (key, differs) in [("frame", first.frame != solid.frame), ("material", first.material != solid.material)] {
        if differs {
            let found = format!("another {key} than that of {}, which is of the group {group} too", first.name);
            let hint = "solids that overlap need not be of one group: their forces add";
            let path = format!("solids.{}.{key}", solid.name);
            problems.error_with_hint(path, found, format!("one {key} for a group, which is met as one body"), hint);
        }
    }
}

/// Solids press from above where their normal points down by more than this, and where a sphere is deeper than a graze, m.
const FROM_ABOVE: f64 = 0.7;
const GRAZE_M: f64 = 0.005;

/// Refuses spheres whose centre is inside a solid at the start, and warns of those that a solid presses down from above: a head
/// under the roof.
pub(super) fn centres(
    law: &ContactSystem<f64>,
    data: &ContactData<'_>,
    body: &Body,
    at: &Instant<'_, f64>,
    problems: &mut Problems,
) {
    for (group, member) in law.solids.met() {
        let (centre, sphere) = (at.centre_in(group.sphere, group.frame), &body.spheres[group.sphere]);
        let near = law.solids.shapes[member.solid].distance(centre, OPEN);
        let (path, name) = (format!("solids.{}", data.solids[member.solid].name), &sphere.name);
        if near.phi < 0.0 {
            let found = format!("the centre of {name} is {:.1} mm inside at the start", -1e3 * near.phi);
            let hint = format!("move the solid or the body, or leave {name} out of the solid's `spheres`");
            problems.error_with_hint(path, found, "a centre outside, from where the sphere is held off", hint);
        } else if near.phi < sphere.radius_m - GRAZE_M && near.normal.z > FROM_ABOVE {
            let deep_mm = 1e3 * (sphere.radius_m - near.phi);
            let found = format!("{name} starts {deep_mm:.1} mm deep in it from below: there is no room for this body");
            let hint = "move the solid, lower the seat or lean the body back";
            problems.push(Problem::warning(path, found, "room above the body").with_hint(Some(hint)));
        }
    }
}

//! Checks of materials and surfaces.

use std::collections::{BTreeMap, HashMap};

use crate::body::Body;
use crate::forces::contact::flat_face::FlatFace;
use crate::forces::contact::material::{Breaking, Force, Limit, Material};
use crate::forces::contact::near::{Bounds, near_pairs};
use crate::forces::contact::self_contact::is_skin;
use crate::forces::contact::solid::{CONCAVE_WITHIN_M, Solid, build, concave_rad};
use crate::forces::contact::surface::Outline;
use crate::forces::contact::{ContactData, ContactSystem, Group, OPEN, PASSED, PairHistory};
use crate::forces::element::Instant;
use crate::forces::function::steps::Steps;
use placed_text::{Problem, Problems, with_key};

/// Problem of a number of neighbours that grows with the square of the number of objects.
const CROWD: &str = "too many neighbours to compare";

/// Largest number of pairs of sphere and surface; more is a mistake, or a mesh that should be made coarser.
const MOST_PAIRS: usize = 200_000;

pub(super) fn check(data: &ContactData<'_>, body: &Body, problems: &mut Problems) {
    let &ContactData { materials, surfaces, solids, .. } = data;
    let count = surfaces.len() + solids.len();
    let pairs = count * body.spheres.len();
    if pairs > MOST_PAIRS {
        let found = format!("{count} surfaces for {} spheres, which are {pairs} pairs", body.spheres.len());
        problems.error("surfaces", found, format!("at most {MOST_PAIRS} pairs"));
    }
    materials.iter().for_each(|material| check_material(material, problems));
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
    check_skins(data, body, problems);
}

fn check_material(m: &Material, problems: &mut Problems) {
    let path = with_key("materials", &m.name);
    m.force.check(&path, problems);
    if let Some(breaks) = &m.breaks {
        check_breaking(m, breaks, &with_key(&path, "breaks"), problems);
    }
    problems.check_at_least_zero(&format!("{path}.friction"), m.friction, "");
    problems.check_positive(&format!("{path}.friction_speed"), m.friction_speed_m_s, "m/s");
    for (rows, key) in m.friction_factors.iter().zip(["friction_over_slip", "friction_over_force"]) {
        let rises = rows.windows(2).all(|rows| rows[1][0] > rows[0][0]);
        if !rises || !rows.iter().flatten().all(|x| x.is_finite() && *x >= 0.0) {
            problems.error(format!("{path}.{key}"), "another table", "numbers that rise, with factors of at least 0");
        }
    }
    let factor = Steps::new(&m.friction_factors[0]);
    let places = m.friction_factors[0].iter().map(|row| row[0]);
    if let Some(slip) = places.into_iter().find(|slip| factor.at(slip + m.friction_speed_m_s) < 0.5 * factor.at(*slip))
    {
        let found =
            format!("friction that falls by more than half within {} m/s from {slip} m/s", m.friction_speed_m_s);
        problems.warning(format!("{path}.friction_over_slip"), found, "less: such friction sticks and slips by itself");
    }
}

/// What a pane bears at least, N or J.
const LEAST_LIMIT: f64 = 1e-3;

/// A pane bears something, and its laws are known as deep as a sphere may go.
fn check_breaking(m: &Material, breaks: &Breaking, path: &str, problems: &mut Problems) {
    let (key, unit) = match breaks.limit {
        Limit::Force(_) => ("force", "N"),
        Limit::Energy(_) => ("energy", "J"),
    };
    let limit = breaks.limit.value();
    if !(LEAST_LIMIT..f64::INFINITY).contains(&limit) {
        problems.error(with_key(path, key), format!("{limit} {unit}"), format!("at least {LEAST_LIMIT} {unit}"));
    }
    if let Some(left) = &breaks.left {
        left.check(path, problems);
    }
    if [Some(&m.force), breaks.left.as_ref()].into_iter().flatten().any(Force::ends) {
        problems.error(path, "a law that ends, of a pane that breaks", "`beyond` = \"extends\" or \"holds\"");
    }
}

/// Skins deform in series, which needs a stiffness of each.
fn check_skins(data: &ContactData<'_>, body: &Body, problems: &mut Problems) {
    let Some(own) = data.self_contact else { return };
    let is_known = |sphere: &usize| *sphere < body.spheres.len();
    if own.skins.len() != body.spheres.len() || own.skins.iter().any(|skin| *skin >= data.materials.len()) {
        problems.error("self_contact.skin", "not a material for each sphere", "a named material for each sphere");
    } else if !own.pairs.iter().flatten().all(is_known) {
        problems.error("self_contact.pairs", "no such sphere", "spheres of the body");
    }
    let mut skins = own.skins.iter().filter_map(|skin| data.materials.get(*skin));
    if let Some(pane) = skins.clone().find(|m| m.breaks.is_some()) {
        problems.error("self_contact.skin", format!("the skin {} breaks", pane.name), "a material without `breaks`");
    }
    if let Some(soft) = skins.find(|m| !is_skin(&m.force) || m.friction_factors.iter().any(|rows| !rows.is_empty())) {
        let why = if soft.force.bilinear().is_some() { "has no stiffness" } else { "is not of lines that rise alone" };
        let found = format!("the skin {} {why}", soft.name);
        let expected = "positive k1 and k2, or forces that rise with `returned` alone: skins deform in series";
        problems.error("self_contact.skin", found, expected);
    }
}

fn check_solids(data: &ContactData<'_>, body: &Body, problems: &mut Problems) {
    let &ContactData { materials, surfaces, solids, .. } = data;
    problems.check_unique("solids", "solid", solids.iter().map(|s| s.name.as_str()));
    let mut groups = HashMap::new();
    for solid in solids {
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
        if let Some(group) = &solid.group {
            check_group(solid, group, groups.entry(group).or_insert(solid), problems);
        }
    }
    warn_of_concave(solids, problems);
}

/// A solid with the first of its group, which tells frame and material.
fn check_group(solid: &Solid, group: &str, first: &Solid, problems: &mut Problems) {
    for (key, differs) in [("frame", first.frame != solid.frame), ("material", first.material != solid.material)] {
        if differs {
            let found = format!("another {key} than that of {}, which is of the group {group} too", first.name);
            let hint = "solids that overlap need not be of one group: their forces add";
            let path = format!("solids.{}.{key}", solid.name);
            problems.error_with_hint(path, found, format!("one {key} for a group, which is met as one body"), hint);
        }
    }
}

/// Solids of one group that are near each other.
fn warn_of_concave(solids: &[Solid], problems: &mut Problems) {
    let boxes: Vec<Bounds> = solids.iter().map(|solid| solid.shape.bounds()).collect();
    let is_same = |i: usize, j: usize| solids[i].group.is_some() && solids[i].group == solids[j].group;
    let mut near = near_pairs(&boxes, CONCAVE_WITHIN_M, is_same);
    if !near.is_complete {
        let expected = "some tens beside each: solids of a group fill a room, they do not lie on each other";
        problems.error("solids", format!("{CROWD} among {} solids in groups", solids.len()), expected);
        return;
    }
    near.pairs.sort_by_key(|[first, second]| [*second, *first]);
    let pairs = near.pairs.iter().map(|pair| pair.map(|i| &solids[i]));
    for ([other, solid], angle_rad) in pairs.filter_map(|pair| Some((pair, concave_rad(pair[0], pair[1])?))) {
        let turn = angle_rad.to_degrees();
        let found =
            format!("a concave corner or a gap to {} of the same group; the sides differ by {turn:.0}°", other.name);
        let expected =
            "solids of a group that bend inwards by 30° at most: the nearest alone pushes; without `group` all do";
        problems.warning(format!("solids.{}.group", solid.name), found, expected);
    }
}

/// Refuses surfaces of one plane that lie on each other by thousands, whose seams are not looked for.
pub(super) fn crowds(faces: &[FlatFace], problems: &mut Problems) {
    if !FlatFace::neighbours(faces).is_complete {
        let expected = "some tens beside each: surfaces of one plane lie beside each other";
        problems.error("surfaces", format!("{CROWD} among {} surfaces", faces.len()), expected);
    }
}

/// Largest number of contacts at the start: with more, each millisecond of the run would take minutes.
const MOST_TOUCHING: usize = 2000;

/// Refuses a body that touches things by thousands: their springs and friction act together, so that the steps that bear them
/// are as short as there are many, and each looks at all.
pub(super) fn touching(start: &[PairHistory<f64>], problems: &mut Problems) {
    let count = start.iter().filter(|past| past.phase > OPEN && past.phase < PASSED).count();
    if count > MOST_TOUCHING {
        let expected =
            format!("at most {MOST_TOUCHING}: one surface or solid for each part of a car that the body touches");
        problems.error(
            "surfaces",
            format!("{count} contacts of spheres with surfaces and solids at the start"),
            expected,
        );
    }
}

/// Tells which parts of the body overlap at the start, and so do not feel each other until they come apart. Of two rows of
/// spheres, such as thighs, those that are apart still do: then nothing is said.
pub(super) fn overlaps(law: &ContactSystem<f64>, body: &Body, at: &Instant<'_, f64>, problems: &mut Problems) {
    let mut parts = BTreeMap::<[&str; 2], bool>::new();
    for (pair, past) in law.own.pairs.iter().zip(law.own.start(at)) {
        let mut names = pair.spheres.map(|sphere| body.spheres[sphere].part.as_str());
        names.sort_unstable();
        *parts.entry(names).or_insert(true) &= past.phase == PASSED;
    }
    let names: Vec<String> = parts.iter().filter(|(_, all)| **all).map(|(names, _)| names.join(" and ")).collect();
    if !names.is_empty() {
        let found = format!("parts of the body that overlap at the start: {}", names.join(", "));
        let expected = "parts that are apart; these do not feel each other until they have come apart";
        problems.warning("self_contact", found, expected);
    }
}

/// Solids press from above where their normal points down by more than this, and where a sphere is deeper than a graze, m.
const FROM_ABOVE: f64 = 0.7;
const GRAZE_M: f64 = 0.005;

/// Refuses bodies of which most begin behind a plane without bounds, such as the ground: they would not feel it and fall for
/// ever. Of a foot or two that do it warns.
pub(super) fn beneath(
    law: &ContactSystem<f64>,
    data: &ContactData<'_>,
    body: &Body,
    at: &Instant<'_, f64>,
    problems: &mut Problems,
) {
    for (surface, face) in data.faces.iter().enumerate() {
        if !matches!(face.outline, Outline::Unbounded { .. }) {
            continue;
        }
        let met = |group: &&Group| group.pairs.clone().any(|i| law.pairs[i].parts[0].surface == surface);
        let behind = |group: &Group| {
            let centre = at.centre_in(group.sphere, group.by, group.frame).to_vector();
            (face.offset_m - face.normal.dot(&centre), group.sphere)
        };
        let all: Vec<(f64, usize)> = law.groups.iter().filter(met).map(behind).collect();
        let beneath = all.iter().filter(|(behind_m, _)| *behind_m > 0.0);
        let Some((behind_m, sphere)) = beneath.clone().max_by(|a, b| a.0.total_cmp(&b.0)) else { continue };
        let (count, name) = (beneath.count(), &body.spheres[*sphere].name);
        let more = if count > 1 { format!(", and {} more are behind it", count - 1) } else { String::new() };
        let found = format!("the centre of {name} is {:.1} mm behind it at the start{more}", 1e3 * behind_m);
        let (path, most) = (with_key("surfaces", &data.surfaces[surface].name), 2 * count > all.len());
        let expected = "a body in front of the plane, which does not push a body that begins behind it";
        let problem =
            if most { Problem::error(path, found, expected) } else { Problem::warning(path, found, expected) };
        problems.push(problem.with_hint(Some("move the body or the plane; of `space` z is up, of all else down")));
    }
}

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
        let (centre, sphere) = (at.centre_in(group.sphere, group.by, group.frame), &body.spheres[group.sphere]);
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

//! Materials and surfaces (series 8 and 9).

use occupant_core::body::tti12::TTI12;

use super::writer::{Writer, negated};
use crate::compartment::{CompartmentLayout, Corner, Face, LeftOut};
use crate::notes::{Kept, PAIR};

const FIELDS: [&str; 6] = ["STIF1", "STIF2", "DELB", "AMU1", "AMU2", "COFR"];

/// A surface of the scenario.
struct Written {
    number: u32,
    name: String,
    body: String,
}

pub(super) fn write(w: &mut Writer<'_>, layout: &CompartmentLayout) {
    let surfaces = surfaces(w, layout);
    let groups = materials(w, &surfaces);
    w.table("contact", "The report lets all of a contact force act at the point of contact");
    w.set("edge_force", "\"contact_point\"");
    w.table(
        "materials",
        "Series 9: surfaces with the same six numbers share a material, named after the first of them",
    );
    for (name, members) in &groups {
        let [k1, k2, delta_b, mu1, mu2, friction] = FIELDS.map(|field| w.quantity(&format!("{field}({})", members[0])));
        let numbers: Vec<String> = members.iter().map(u32::to_string).collect();
        w.comment(&format!("Cards 9b, J = {}", numbers.join(", ")));
        let spring = format!("k1 = {k1}, delta_b = {delta_b}, k2 = {k2}, mu1 = {mu1}, mu2 = {mu2}");
        w.set(name, &format!("{{ {spring}, friction = {friction} }}"));
    }
    w.table("surfaces", "Series 8: points in vehicle axes, in; the open side is told by the order of the points");
    for surface in &surfaces {
        let material = groups.iter().find(|(_, members)| members.contains(&surface.number)).map_or("", |g| &g.0);
        w.comment(&surface.number.to_string());
        w.set(&surface.name, &format!("{{ material = \"{material}\", {}, facing = \"order\" }}", surface.body));
    }
    let wheel = &layout.wheel;
    w.report.assumptions.push(format!(
        "the steering wheel's centre stands {}, its plane tilted {} degrees: no card places it",
        wheel.words(),
        wheel.tilt_deg
    ));
    let unused = layout.unused_coordinates();
    if !unused.is_empty() {
        w.report.ignored.push(format!(
            "{} (series 8): no surface of this reconstruction ends there; the lost figures 13 and 14 would say what does",
            unused.join(", ")
        ));
    }
    w.report.assumptions.push(
        "which points bound which of the 25 surfaces is a reconstruction: the report's figures 13 and 14 are lost"
            .to_owned(),
    );
}

/// Surfaces that a scenario can have, by number.
fn surfaces(w: &mut Writer<'_>, layout: &CompartmentLayout) -> Vec<Written> {
    let left_out = layout.left_out(w.deck);
    let mut written = Vec::new();
    for face in layout.faces(w.deck).into_iter().filter(|face| !face.corners.is_empty()) {
        let body = match strip(&face) {
            Some(ends) => edge(w, ends),
            None => points(w, &face),
        };
        written.push(Written { number: face.number, name: face.name, body });
    }
    let body = disc(w, layout);
    written.push(Written { number: layout.wheel.number, name: layout.wheel.name.clone(), body });
    written.retain(|surface| left_out.iter().all(|l| l.number != surface.number));
    written
}

/// A passed pair of series 14 by the scenario's names; none if the scenario omits the surface, or if the occupant is
/// seated (NPOS = 0) and no run is extended.
pub(super) fn passed_pair(
    w: &mut Writer<'_>,
    layout: &CompartmentLayout,
    (sphere, surface): (u8, u8),
) -> Option<(&'static str, String)> {
    let surface = u32::from(surface);
    let left_out = layout.left_out(w.deck).iter().any(|l| l.number == surface);
    let name = layout.name_of(surface)?.to_owned();
    let sphere = TTI12.spheres().get(usize::from(sphere).checked_sub(1)?)?.name;
    (w.value("NPOS") == 1.0 && !left_out).then_some((sphere, name))
}

/// Keeps the numbers of omitted surfaces, and their passed pairs, for the conversion back.
pub(super) fn keep_left_out(w: &mut Writer<'_>, layout: &CompartmentLayout, kept: &mut Kept) {
    let left_out = layout.left_out(w.deck);
    keep_pairs(w, layout, &left_out, kept);
    for LeftOut { number, name, why } in left_out {
        let material = FIELDS.map(|field| format!("{field}({number})"));
        let points = layout.points_of(number).into_iter().flat_map(|n| [format!("XV({n})"), format!("ZV({n})")]);
        let widths: &[&str] =
            if number == layout.wheel.number { &["VCW", "VRW", "SWP", "DSW"] } else { &["VCW", "VRW"] };
        let widths = widths.iter().map(|name| (*name).to_owned());
        for field in material.into_iter().chain(points).chain(widths) {
            let digits = w.bare(&field);
            kept.insert(field, digits);
        }
        w.report.ignored.push(format!("surface {number} ({name}): it {why} and is left out"));
    }
}

/// Keeps the passed pairs that a scenario cannot name, and reports those whose surface it omits.
fn keep_pairs(w: &mut Writer<'_>, layout: &CompartmentLayout, left_out: &[LeftOut], kept: &mut Kept) {
    for (at, pair) in w.deck.passed_pairs().into_iter().enumerate() {
        if passed_pair(w, layout, pair).is_some() {
            continue;
        }
        let (sphere, surface) = pair;
        kept.insert(format!("{PAIR} {:03}", at + 1), format!("{sphere} {surface}"));
        if let Some(l) = left_out.iter().find(|l| l.number == u32::from(surface)) {
            w.report.ignored.push(format!(
                "series 14, pair of sphere {sphere} and surface {surface} ({}): the surface {}",
                l.name, l.why
            ));
        }
    }
}

/// Surfaces with equal numbers share a material, named after the first.
fn materials(w: &mut Writer<'_>, surfaces: &[Written]) -> Vec<(String, Vec<u32>)> {
    let mut groups: Vec<(Vec<u64>, String, Vec<u32>)> = Vec::new();
    for surface in surfaces {
        let numbers: Vec<u64> = FIELDS.map(|field| w.value(&format!("{field}({})", surface.number)).to_bits()).to_vec();
        match groups.iter_mut().find(|g| g.0 == numbers) {
            Some(group) => group.2.push(surface.number),
            None => groups.push((numbers, surface.name.clone(), vec![surface.number])),
        }
    }
    groups.into_iter().map(|(_, name, members)| (name, members)).collect()
}

/// The two ends of a face that spans the width at two points, ordered such that its corners, near end first and left
/// before right, are counter-clockwise seen from the open side.
fn strip(face: &Face) -> Option<[Corner; 2]> {
    let corners = &face.corners;
    let pair = |a: &Corner, b: &Corner| {
        let across = a.wall.half_width == b.wall.half_width && a.wall.is_left && !b.wall.is_left;
        across && a.x_of == b.x_of && a.z_of == b.z_of && a.x_of == a.z_of
    };
    if corners.len() != 4 {
        return None;
    }
    let at = (0..4).find(|i| pair(&corners[*i], &corners[(i + 1) % 4]))?;
    let (near, far) = (&corners[at], &corners[(at + 2) % 4]);
    pair(&corners[(at + 3) % 4], far).then(|| [near.clone(), far.clone()])
}

fn edge(w: &mut Writer<'_>, [near, far]: [Corner; 2]) -> String {
    let mut point =
        |c: &Corner| format!("[{}, {}]", w.bare(&format!("XV({})", c.x_of)), w.bare(&format!("ZV({})", c.z_of)));
    let (from, to) = (point(&near), point(&far));
    let (width, end_width) = (near.wall.half_width, far.wall.half_width);
    let mut text = format!("edge = [{from}, {to}], half_width = {}", w.bare(width));
    if width != end_width {
        text.push_str(&format!(", end_half_width = {}", w.bare(end_width)));
    }
    text
}

fn points(w: &mut Writer<'_>, face: &Face) -> String {
    let corners: Vec<String> = face.corners.iter().map(|corner| place(w, corner)).collect();
    format!("points = [{}]", corners.join(", "))
}

fn place(w: &mut Writer<'_>, corner: &Corner) -> String {
    let (x, z) = (w.bare(&format!("XV({})", corner.x_of)), w.bare(&format!("ZV({})", corner.z_of)));
    let y = w.bare(corner.wall.half_width);
    format!("[{x}, {}, {z}]", if corner.wall.is_left { negated(&y) } else { y })
}

fn disc(w: &mut Writer<'_>, layout: &CompartmentLayout) -> String {
    let wheel = &layout.wheel;
    let x = decimal(w.value(&format!("XV({})", wheel.point)) - wheel.behind_in);
    let z = match wheel.below_in {
        0.0 => w.bare(&format!("ZV({})", wheel.point)),
        below_in => decimal(w.value(&format!("ZV({})", wheel.point)) + below_in),
    };
    let y = negated(&w.bare("SWP"));
    let diameter = w.bare("DSW");
    format!("disc = {{ centre = [{x}, {y}, {z}], diameter = {diameter}, tilt = {} }}", wheel.tilt_deg)
}

/// Difference of card numbers, rounded to their decimals.
fn decimal(value: f64) -> String {
    let text = format!("{value:.9}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

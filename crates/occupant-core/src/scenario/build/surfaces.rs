//! `[materials]` and `[surfaces]` → [`Material`]s and [`Surface`]s.

use nalgebra::Vector3;

use super::builder::Builder;
use crate::body::Body;
use crate::forces::contact::material::{Material, Memory};
use crate::forces::contact::surface::{Facing, Frame, Outline, Surface};
use crate::forces::spring::BilinearSpring;
use crate::scenario::model::{
    DiscSection, FrameChoice, Length, MaterialSection, MemoryChoice, Ratio, Scenario, Stiffness, SurfaceSection,
};
use crate::scenario::path_text::with_key;

/// All materials, in the order written.
pub(super) fn materials(b: &mut Builder, scenario: &Scenario) -> Vec<Material> {
    let each = scenario.materials.iter();
    each.map(|(name, section)| material(b, name, section)).collect()
}

fn material(b: &mut Builder, name: &str, section: &MaterialSection) -> Material {
    let path = with_key("materials", name);
    let returned_1 = b.si(&with_key(&path, "mu1"), &section.mu1);
    let spring = spring(b, &path, (&section.k1, &section.k2, &section.delta_b), (returned_1, &section.mu2));
    let friction = b.si(&with_key(&path, "friction"), &section.friction);
    let plain = Material::new(name, spring, friction);
    Material {
        friction_speed_m_s: b.optional(
            &with_key(&path, "friction_speed"),
            &section.friction_speed,
            plain.friction_speed_m_s,
        ),
        memory: match section.memory {
            Some(MemoryChoice::Retain) => Memory::Retain,
            Some(MemoryChoice::Reset) => Memory::Reset,
            None => plain.memory,
        },
        ..plain
    }
}

/// A bilinear spring; linear where no break is given.
pub(super) fn spring(
    b: &mut Builder,
    path: &str,
    (k1, k2, delta_b): (&Stiffness, &Option<Stiffness>, &Option<Length>),
    (returned_1, mu2): (f64, &Option<Ratio>),
) -> BilinearSpring {
    let k1_n_per_m = b.si(&with_key(path, "k1"), k1);
    let line = BilinearSpring::linear(k1_n_per_m, returned_1);
    BilinearSpring {
        k2_n_per_m: b.optional(&with_key(path, "k2"), k2, line.k2_n_per_m),
        break_m: b.optional(&with_key(path, "delta_b"), delta_b, line.break_m),
        returned_2: b.optional(&with_key(path, "mu2"), mu2, line.returned_2),
        ..line
    }
}

/// All surfaces, in the order written.
pub(super) fn surfaces(b: &mut Builder, scenario: &Scenario, body: &Body) -> Vec<Surface> {
    let mut undecided = Vec::new();
    let each = scenario.surfaces.iter();
    let surfaces = each.map(|(name, section)| surface(b, scenario, body, (name, section), &mut undecided)).collect();
    report_undecided(b, &undecided);
    surfaces
}

fn surface(
    b: &mut Builder,
    scenario: &Scenario,
    body: &Body,
    (name, section): (&str, &SurfaceSection),
    undecided: &mut Vec<String>,
) -> Surface {
    let path = with_key("surfaces", name);
    let names = scenario.materials.keys().map(String::as_str);
    let material = b.index_of(&with_key(&path, "material"), "material", &section.material, names);
    let frame = match section.frame {
        Some(FrameChoice::Space) => Frame::Space,
        Some(FrameChoice::Vehicle) => Frame::Vehicle,
        None => Frame::default(),
    };
    let outline = outline(b, &path, section, frame);
    let facing = facing(b, scenario, (&path, section), frame, undecided);
    let spheres = section.spheres.as_ref().map(|names| {
        let known = body.spheres.iter().map(|s| s.name.as_str());
        let each = names.iter().enumerate();
        each.map(|(i, n)| b.index_of(&format!("{path}.spheres[{i}]"), "sphere", n, known.clone())).collect()
    });
    Surface { name: name.to_owned(), frame, outline, facing, material, spheres }
}

fn outline(b: &mut Builder, path: &str, section: &SurfaceSection, frame: Frame) -> Outline {
    let for_edges = [
        ("half_width", section.half_width.is_some()),
        ("end_half_width", section.end_half_width.is_some()),
        ("y", section.y.is_some()),
    ];
    for (key, there) in for_edges {
        if there && section.edge.is_none() {
            b.error(&with_key(path, key), format!("`{key}` without `edge`"), "`edge`, which it belongs to");
        }
    }
    if let Some(plane) = &section.plane {
        return Outline::Unbounded {
            point_m: b.point(&with_key(path, "plane.point"), &plane.point),
            axis: Vector3::from(b.triple(&with_key(path, "plane.normal"), &plane.normal)),
        };
    }
    if let Some(section) = &section.disc {
        return disc(b, &with_key(path, "disc"), section, frame);
    }
    if let Some([from, to]) = &section.edge {
        return strip(b, path, section, [from, to]);
    }
    let points = section.points.iter().flatten().enumerate();
    Outline::Polygon(points.map(|(i, point)| b.point(&format!("{path}.points[{i}]"), point)).collect())
}

/// A surface that looks like an edge from the side.
fn strip(b: &mut Builder, path: &str, section: &SurfaceSection, edge: [&[Length; 2]; 2]) -> Outline {
    let y = b.optional(&with_key(path, "y"), &section.y, 0.0);
    let near = b.needed(path, "half_width", &section.half_width);
    let far = b.optional(&with_key(path, "end_half_width"), &section.end_half_width, near);
    let edge = [0, 1].map(|i| [0, 1].map(|axis| b.si(&format!("{path}.edge[{i}][{axis}]"), &edge[i][axis])));
    Outline::strip(edge, y, near, far)
}

fn disc(b: &mut Builder, path: &str, section: &DiscSection, frame: Frame) -> Outline {
    let centre_m = b.point(&with_key(path, "centre"), &section.centre);
    let diameter_m = b.si(&with_key(path, "diameter"), &section.diameter);
    match (&section.tilt, &section.normal) {
        (Some(tilt), None) => Outline::wheel(frame, centre_m, diameter_m, b.si(&with_key(path, "tilt"), tilt)),
        (_, normal) => Outline::Disc {
            centre_m,
            radius_m: 0.5 * diameter_m,
            axis: match normal {
                Some(normal) => Vector3::from(b.triple(&with_key(path, "normal"), normal)),
                None => Vector3::zeros(),
            },
        },
    }
}

/// The open side: the surface's own word, else the scenario's `inside`, else a given normal.
fn facing(
    b: &mut Builder,
    scenario: &Scenario,
    (path, section): (&str, &SurfaceSection),
    frame: Frame,
    undecided: &mut Vec<String>,
) -> Facing {
    if let Some(inside) = &section.inside {
        if section.facing.is_some() {
            b.error(&with_key(path, "facing"), "`facing` and `inside` together", "one of them only");
        }
        return Facing::Towards(b.point(&with_key(path, "inside"), inside));
    }
    match (&section.facing, &scenario.inside, frame) {
        (Some(_), ..) => Facing::Order,
        (None, Some(inside), Frame::Vehicle) => Facing::Towards(b.point("inside", inside)),
        _ if section.disc.is_some() || section.plane.is_some() => Facing::Order,
        _ => {
            undecided.push(path.to_owned());
            Facing::Order
        }
    }
}

/// One message for all surfaces whose open side is not told.
fn report_undecided(b: &mut Builder, paths: &[String]) {
    let Some((first, others)) = paths.split_first() else {
        return;
    };
    let found = match others.len() {
        0 => format!("`{first}` does not say which side is open"),
        n => format!("`{first}` and {n} more do not say which side is open"),
    };
    b.error_with_hint(
        first,
        found,
        "inside = [x, y, z], a point on the open side, or facing = \"order\"",
        "a key `inside` at the top of the scenario serves all surfaces of the vehicle",
    );
}

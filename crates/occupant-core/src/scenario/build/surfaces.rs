//! `[materials]` and `[surfaces]` → [`Material`]s and [`Surface`]s.

use nalgebra::{Point3, Vector3};

use super::builder::Builder;
use crate::body::Body;
use crate::forces::contact::material::{DEFAULT_FRICTION_SPEED_M_S, Material, Memory};
use crate::forces::contact::surface::{Facing, Frame, Outline, Surface};
use crate::forces::spring::BilinearSpring;
use crate::scenario::model::{
    DiscSection, FrameChoice, Length, MaterialSection, MemoryChoice, Ratio, Scenario, Stiffness, SurfaceSection,
};
use crate::scenario::path_text::with_key;
use crash_measures::trig;

/// All materials, in the order written.
pub(super) fn materials(b: &mut Builder, scenario: &Scenario) -> Vec<Material> {
    let each = scenario.materials.iter();
    each.map(|(name, section)| material(b, name, section)).collect()
}

fn material(b: &mut Builder, name: &str, section: &MaterialSection) -> Material {
    let path = with_key("materials", name);
    let returned_1 = b.si(&with_key(&path, "mu1"), &section.mu1);
    Material {
        name: name.to_owned(),
        spring: spring(b, &path, (&section.k1, &section.k2, &section.delta_b), (returned_1, &section.mu2)),
        friction: b.si(&with_key(&path, "friction"), &section.friction),
        friction_speed_m_s: b.optional(
            &with_key(&path, "friction_speed"),
            &section.friction_speed,
            DEFAULT_FRICTION_SPEED_M_S,
        ),
        memory: match section.memory {
            Some(MemoryChoice::Retain) => Memory::Retain,
            Some(MemoryChoice::Reset) | None => Memory::Reset,
        },
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
    BilinearSpring {
        k1_n_per_m,
        k2_n_per_m: b.optional(&with_key(path, "k2"), k2, k1_n_per_m),
        break_m: b.optional(&with_key(path, "delta_b"), delta_b, 0.0),
        returned_1,
        returned_2: b.optional(&with_key(path, "mu2"), mu2, returned_1),
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
        Some(FrameChoice::Vehicle) | None => Frame::Vehicle,
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
        return Outline::Polygon(strip(b, path, section, [from, to]));
    }
    let points = section.points.iter().flatten().enumerate();
    Outline::Polygon(points.map(|(i, point)| b.point(&format!("{path}.points[{i}]"), point)).collect())
}

/// The corners of a rectangle, trapezoid or triangle that looks like an edge from the side.
fn strip(b: &mut Builder, path: &str, section: &SurfaceSection, edge: [&[Length; 2]; 2]) -> Vec<Point3<f64>> {
    let y = b.optional(&with_key(path, "y"), &section.y, 0.0);
    let near = b.needed(path, "half_width", &section.half_width);
    let far = b.optional(&with_key(path, "end_half_width"), &section.end_half_width, near);
    let mut ends = edge.iter().enumerate().map(|(i, end)| {
        let x = b.si(&format!("{path}.edge[{i}][0]"), &end[0]);
        (x, b.si(&format!("{path}.edge[{i}][1]"), &end[1]))
    });
    let (Some((x1, z1)), Some((x2, z2))) = (ends.next(), ends.next()) else {
        return Vec::new();
    };
    let mut corners = vec![Point3::new(x1, y - near, z1), Point3::new(x1, y + near, z1)];
    match far == 0.0 {
        true => corners.push(Point3::new(x2, y, z2)),
        false => corners.extend([Point3::new(x2, y + far, z2), Point3::new(x2, y - far, z2)]),
    }
    corners
}

fn disc(b: &mut Builder, path: &str, section: &DiscSection, frame: Frame) -> Outline {
    let axis = match (&section.tilt, &section.normal) {
        (_, Some(normal)) => Vector3::from(b.triple(&with_key(path, "normal"), normal)),
        (Some(tilt), None) => {
            // Rearward and up: N̂ = (−cos τ, 0, −sin τ) in vehicle axes, z down; z is up in space.
            let (sin, cos) = trig::sin_cos(b.si(&with_key(path, "tilt"), tilt));
            match frame {
                Frame::Vehicle => Vector3::new(-cos, 0.0, -sin),
                Frame::Space => Vector3::new(-cos, 0.0, sin),
            }
        }
        (None, None) => Vector3::zeros(),
    };
    Outline::Disc {
        centre_m: b.point(&with_key(path, "centre"), &section.centre),
        radius_m: 0.5 * b.si(&with_key(path, "diameter"), &section.diameter),
        axis,
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

//! Materials, surfaces and solids.

use nalgebra::{Point3, Vector3};
use occupant_core::forces::contact::flat_face::FlatFace;
use occupant_core::forces::contact::material::Memory;
use occupant_core::forces::contact::solid::Shape;
use occupant_core::forces::contact::surface::{Frame, Outline};
use occupant_units::unit::Unit::{Metre, MetrePerSecond, NewtonPerMetre, One};

use crate::print::unit::ratio;
use crate::print::{Case, Pages, Table, Units};

/// Writes materials, surfaces and, if any, solids.
pub(crate) fn write(pages: &mut Pages, case: &Case, units: Units) {
    materials(case, units).write(pages);
    surfaces(case).write(pages);
    outlines(case, units).write(pages);
    if !case.model.setup().solids.is_empty() {
        solids(case, units).write(pages);
    }
}

fn materials(case: &Case, units: Units) -> Table {
    let (k, l, v, r) = (units.of(NewtonPerMetre), units.of(Metre), units.of(MetrePerSecond), units.of(One));
    let mut table = Table::new(
        units.heading("MATERIALS ({}, {}, {})", &[NewtonPerMetre, Metre, MetrePerSecond]),
        "<MATERIAL|K1|K2|BREAK AT|RETURNED 1|RETURNED 2|FRICTION|FULL FROM|<AFTER OPENING",
    );
    for material in &case.model.setup().materials {
        let memory = match material.memory {
            Memory::Reset => "RECOVERS",
            Memory::Retain => "STAYS CRUSHED",
        };
        let spring = material.force.bilinear();
        let slopes = spring.map_or(["FUNCTION".to_owned(), "-".to_owned(), "-".to_owned()], |s| {
            [k.show(s.k1_n_per_m), k.show(s.k2_n_per_m), l.show(s.break_m)]
        });
        let shares =
            spring.map_or(["-".to_owned(), "-".to_owned()], |s| [s.returned_1, s.returned_2].map(|mu| r.show(mu)));
        let rubs = [r.show(material.friction), v.show(material.friction_speed_m_s), memory.to_owned()];
        table.row_of(&[std::slice::from_ref(&material.name), &slopes, &shares, &rubs]);
    }
    table
}

fn surfaces(case: &Case) -> Table {
    let numbers = if case.numbers_of_report { "NUMBERS OF THE CARDS" } else { "NUMBERED IN THE ORDER OF THE SCENARIO" };
    let mut table = Table::new(
        format!("SURFACES ({numbers}); NORMALS TOWARDS THE OPEN SIDE"),
        "<NO SURFACE|<FIXED TO|<MATERIAL|NORMAL X|Y|Z|<SPHERES",
    );
    let setup = case.model.setup();
    for (i, (surface, face)) in setup.surfaces.iter().zip(case.model.faces()).enumerate() {
        let first = first_cells(case, i, surface.frame);
        table.row_of(&[&first, &ratio().vector(face.normal), &[spheres(surface.spheres.as_deref())]]);
    }
    table
}

/// Name, frame and material of a surface or solid.
fn first_cells(case: &Case, index: usize, frame: Frame) -> [String; 3] {
    let frame = match frame {
        Frame::Vehicle => "VEHICLE",
        Frame::Space => "SPACE",
        Frame::Other(_) => "ANOTHER FRAME",
        Frame::Segment(_) => "A BODY",
    };
    let setup = case.model.setup();
    let material = setup.materials.get(setup.surface_material(index)).map(|m| m.name.clone());
    [case.surface(index), frame.to_owned(), material.unwrap_or_default()]
}

fn spheres(own: Option<&[usize]>) -> String {
    let all = || "ALL".to_owned();
    own.map_or_else(all, |list| list.iter().map(|s| (s + 1).to_string()).collect::<Vec<_>>().join(" "))
}

/// Shapes of the solids, with a line for each point.
fn solids(case: &Case, units: Units) -> Table {
    let title =
        "SOLIDS ({}): CORNERS, ENDS OR CENTER; DISC: RADIUS X THICKNESS X ROUNDING, RIM: RADIUS X RADIUS OF THE TUBE";
    let title = units.heading(title, &[Metre]);
    let mut table = Table::new(title, "<NO SOLID|<FIXED TO|<MATERIAL|<SHAPE|X|Y|Z|<SPHERES|<GROUP");
    for (i, solid) in (case.model.faces().len()..).zip(&case.model.setup().solids) {
        let (shape, points_m) = shape(&solid.shape, units);
        let last = [spheres(solid.spheres.as_deref()), solid.group.clone().unwrap_or_default()];
        for (k, point) in points_m.iter().enumerate() {
            let place = units.of(Metre).vector(point.coords);
            match k {
                0 => table.row_of(&[&first_cells(case, i, solid.frame), std::slice::from_ref(&shape), &place, &last]),
                _ => table.row_of(&[&[const { String::new() }; 4], &place]),
            }
        }
    }
    table
}

/// A shape as text, and its points.
fn shape(shape: &Shape, units: Units) -> (String, Vec<Point3<f64>>) {
    let (show, axis) = (|x: f64| units.of(Metre).show(x), |axis: Vector3<f64>| ratio().vector(axis).join(" "));
    match shape {
        Shape::Prism { corners_m, half_width_m, rounding_m } => {
            let words = format!("PRISM, HALF WIDTH {}, ROUNDED {}", show(*half_width_m), show(*rounding_m));
            (words, corners_m.clone())
        }
        &Shape::Disc { centre_m, axis: along, radius_m, thickness_m, rounding_m } => {
            let sizes = [radius_m, thickness_m, rounding_m].map(show).join(" X ");
            (format!("DISC {sizes}, AXIS {}", axis(along)), vec![centre_m])
        }
        Shape::Capsule { ends_m, radius_m } => (format!("CAPSULE, RADIUS {}", show(*radius_m)), ends_m.to_vec()),
        &Shape::Rim { centre_m, axis: along, ring_radius_m, tube_radius_m } => {
            let sizes = [ring_radius_m, tube_radius_m].map(show).join(" X ");
            (format!("RIM {sizes}, AXIS {}", axis(along)), vec![centre_m])
        }
        &Shape::HalfSpace { point_m, normal } => (format!("HALF SPACE, NORMAL {}", axis(normal)), vec![point_m]),
    }
}

/// Corners, one line each.
fn outlines(case: &Case, units: Units) -> Table {
    let title = "OUTLINES OF THE SURFACES ({}), CORNERS COUNTER-CLOCKWISE SEEN FROM THE OPEN SIDE";
    let mut table = Table::new(units.heading(title, &[Metre]), "<NO SURFACE|<|X|Y|Z");
    for (i, face) in case.model.faces().iter().enumerate() {
        for (k, (what, point)) in points(face, units).into_iter().enumerate() {
            let name = if k == 0 { case.surface(i) } else { String::new() };
            table.row_of(&[&[name, what], &units.of(Metre).vector(point.coords)]);
        }
    }
    table
}

fn points(face: &FlatFace, units: Units) -> Vec<(String, Point3<f64>)> {
    match &face.outline {
        Outline::Polygon(corners) => (1..).zip(corners).map(|(n, corner)| (format!("CORNER {n}"), *corner)).collect(),
        Outline::Disc { centre_m, radius_m, .. } => {
            vec![(format!("DISC OF RADIUS {}, CENTER", units.of(Metre).show(*radius_m)), *centre_m)]
        }
        Outline::Unbounded { point_m, .. } => vec![("UNBOUNDED PLANE THROUGH".to_owned(), *point_m)],
    }
}

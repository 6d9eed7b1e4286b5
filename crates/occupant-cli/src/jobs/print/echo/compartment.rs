//! Materials and surfaces.

use crash_measures::unit::Unit::{Metre, MetrePerSecond, NewtonPerMetre, One};
use nalgebra::Point3;
use occupant_core::forces::contact::flat_face::FlatFace;
use occupant_core::forces::contact::material::Memory;
use occupant_core::forces::contact::surface::{Frame, Outline};

use crate::jobs::print::unit::ratio;
use crate::jobs::print::{Case, Pages, Table, Units};

/// Writes materials and surfaces.
pub(crate) fn write(pages: &mut Pages, case: &Case, units: Units) {
    materials(case, units).write(pages);
    surfaces(case).write(pages);
    outlines(case, units).write(pages);
}

fn materials(case: &Case, units: Units) -> Table {
    let (k, l, v) = (units.of(NewtonPerMetre), units.of(Metre), units.of(MetrePerSecond));
    let mut table = Table::new(
        units.heading("MATERIALS ({}, {}, {})", &[NewtonPerMetre, Metre, MetrePerSecond]),
        "<MATERIAL|K1|K2|BREAK AT|RETURNED 1|RETURNED 2|FRICTION|FULL FROM|<AFTER OPENING",
    );
    for material in &case.model.setup().materials {
        let s = &material.spring;
        let memory = match material.memory {
            Memory::Reset => "RECOVERS",
            Memory::Retain => "STAYS CRUSHED",
        };
        table.row_of(&[
            &[material.name.clone(), k.show(s.k1_n_per_m), k.show(s.k2_n_per_m), l.show(s.break_m)],
            &units.of(One).vector([s.returned_1, s.returned_2, material.friction]),
            &[v.show(material.friction_speed_m_s), memory.to_owned()],
        ]);
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
        let frame = match surface.frame {
            Frame::Vehicle => "VEHICLE",
            Frame::Space => "SPACE",
        };
        let material = setup.materials.get(surface.material).map(|m| m.name.clone());
        let spheres = match &surface.spheres {
            None => "ALL".to_owned(),
            Some(list) => list.iter().map(|s| (s + 1).to_string()).collect::<Vec<_>>().join(" "),
        };
        let first = [case.surface(i), frame.to_owned(), material.unwrap_or_default()];
        table.row_of(&[&first, &ratio().vector(face.normal), &[spheres]]);
    }
    table
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

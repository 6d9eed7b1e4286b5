//! Segments and contact spheres.

use crate::jobs::print::case::Case;
use crate::jobs::print::page::Pages;
use crate::jobs::print::segments::label;
use crate::jobs::print::table::Table;
use crate::jobs::print::unit::Units;

/// Writes the body.
pub(crate) fn write(pages: &mut Pages, case: &Case, units: &Units) {
    let body = case.model.body();
    // the resolved scenario writes a preset out, and calls it the scenario's own
    let name = case.file.run.get("body").unwrap_or(&body.name);
    let (l, m, i) = (units.length, units.mass, units.inertia);
    let mut table = Table::new(
        format!("BODY {name}: SEGMENTS ({}, {}, {})", l.name, m.name, i.name),
        "NO | <SEGMENT | LENGTH | MASS | C.G. FROM LOWER END | IX | IY | IZ",
    );
    for segment in body.tree.segments() {
        let p = body.segment(segment);
        let own = [l.show(p.length_m), m.show(p.mass_kg), l.show(p.cg_from_lower_end_m)];
        let inertia = i.vector(p.inertia_kg_m2);
        table.row(label(body, segment).into_iter().chain(own).chain(inertia));
    }
    table.write(pages);
    pages.say(&format!(
        "TOTAL MASS {} {}; SHOULDER JOINTS {} {} AND HIP JOINTS {} {} FROM THE MIDDLE",
        m.show(body.mass_kg()),
        m.name,
        l.show(body.shoulder_half_width_m),
        l.name,
        l.show(body.hip_half_width_m),
        l.name
    ));
    spheres(case, units).write(pages);
}

fn spheres(case: &Case, units: &Units) -> Table {
    let l = units.length;
    let mut table = Table::new(
        format!("CONTACT SPHERES ({}); CENTERS IN SEGMENT COORDINATES FROM THE SEGMENT'S LOWER END", l.name),
        "NO | <SPHERE | <ON SEGMENT | RADIUS | X | Y | Z",
    );
    for (i, sphere) in case.model.body().spheres.iter().enumerate() {
        let first = [
            (i + 1).to_string(),
            sphere.name.clone(),
            case.model.body().tree[sphere.segment].name.to_owned(),
            l.show(sphere.radius_m),
        ];
        let centre = l.vector(sphere.centre_from_lower_end_m.coords);
        table.row(first.into_iter().chain(centre));
    }
    table
}

//! Segments and contact spheres.

use occupant_units::unit::Unit::{Kilogram, KilogramMetreSquared, Metre};

use crate::print::segments::label;
use crate::print::{Case, Pages, Table, Units};

/// Writes the body.
pub(crate) fn write(pages: &mut Pages, case: &Case, units: Units) {
    let body = case.model.body();
    // the resolved scenario writes a preset out, and calls it the scenario's own
    let name = case.file.run.get("body").unwrap_or(&body.name);
    let (l, m) = (units.of(Metre), units.of(Kilogram));
    let mut table = Table::new(
        format!("BODY {name}: {}", units.heading("SEGMENTS ({}, {}, {})", &[Metre, Kilogram, KilogramMetreSquared])),
        "NO|<SEGMENT|LENGTH|MASS|C.G. FROM LOWER END|IX|IY|IZ",
    );
    for segment in body.tree.segments() {
        let p = body.segment(segment);
        let own = [l.show(p.length_m), m.show(p.mass_kg), l.show(p.cg_from_lower_end_m)];
        let inertia = units.of(KilogramMetreSquared).vector(p.inertia_kg_m2);
        table.row_of(&[&label(body, segment), &own, &inertia]);
    }
    table.write(pages);
    let bodies = body.tree.bodies();
    if bodies.len() > 1 {
        for (of, row) in bodies.iter().enumerate() {
            let own = body.tree.segments().filter(|segment| body.tree.body_of(*segment) == of);
            let mass_kg = own.map(|segment| body.segment(segment).mass_kg).sum();
            pages.fact("TOTAL MASS", format!("{}: {}", row.name, m.say(mass_kg)));
        }
        return spheres(case, units).write(pages);
    }
    pages.say(&format!(
        "TOTAL MASS {}; SHOULDER JOINTS {} AND HIP JOINTS {} FROM THE MIDDLE; NECK {} ABOVE THE SHOULDERS",
        m.say(body.mass_kg()),
        l.say(body.shoulder_half_width_m),
        l.say(body.hip_half_width_m),
        l.say(body.neck_height_m)
    ));
    spheres(case, units).write(pages);
}

fn spheres(case: &Case, units: Units) -> Table {
    let (l, body) = (units.of(Metre), case.model.body());
    let title = "CONTACT SPHERES ({}); CENTERS IN SEGMENT COORDINATES FROM THE SEGMENT'S LOWER END";
    let mut table = Table::new(units.heading(title, &[Metre]), "NO|<SPHERE|<ON SEGMENT|RADIUS|X|Y|Z");
    for (i, sphere) in body.spheres.iter().enumerate() {
        let segment = body.tree[sphere.segment].name.to_owned();
        let first = [(i + 1).to_string(), sphere.name.clone(), segment, l.show(sphere.radius_m)];
        table.row_of(&[&first, &l.vector(sphere.centre_from_lower_end_m.coords)]);
    }
    table
}

//! Items 5 to 7: forces on the contact spheres and the surfaces hit, points of application, what the elements add; joint
//! angles and the energy balance.

use occupant_core::results::channel::matching;
use occupant_core::results::sample::Sample;
use occupant_units::unit::Unit::{Joule, Metre, MetrePerSecond, Newton};

use super::unit::degree;
use super::{Case, ELEMENTS, Pages, Table, Units, headings};

/// Spheres whose point of application the report prints.
const APPLICATION: [&str; 3] = ["head", "chest", "pelvis"];

/// Writes the loads' tables.
pub(crate) fn write(pages: &mut Pages, case: &Case, units: Units, sample: &Sample<'_>) {
    forces(case, units, sample).write(pages);
    application_points(units, sample).write_or(pages, &["6. NO SPHERE OF HEAD, CHEST OR PELVIS"]);
    ELEMENTS.iter().for_each(|element| (element.output)(pages, units, sample));
    for (of, title) in [("strap", "STRAP"), ("bag", "AIR BAG"), ("column", "COLUMN")] {
        named(pages, units, sample, of, title);
    }
    joints(pages, sample);
    energy(pages, units, sample);
}

/// Force on every sphere, with one line per surface.
fn forces(case: &Case, units: Units, s: &Sample<'_>) -> Table {
    let (f, l, v) = (units.of(Newton), units.of(Metre), units.of(MetrePerSecond));
    let mut table = Table::new(
        format!(
            "5. FORCE ON EACH CONTACT SPHERE, VEHICLE COORDINATES, {} APART, AND SURFACES HIT {}",
            headings(),
            units.heading("({}, {}, {})", &[Newton, Metre, MetrePerSecond])
        ),
        "NO|<SPHERE|FORCE X|FORCE Y|FORCE Z|RESULTANT|<SURFACE HIT|DEPTH|NORMAL|FRICTION|SLIP",
    );
    for (i, sphere) in s.model.body().spheres.iter().enumerate() {
        let force_n = s.sphere_force_n(i);
        let mut first =
            [&[(i + 1).to_string(), sphere.name.clone()][..], &f.vector(force_n), &[f.show(force_n.norm())]].concat();
        let mut touches = s.contacts().filter(|c| c.sphere == i).peekable();
        if touches.peek().is_none() {
            table.row_of(&[&first, &["-".to_owned()]]);
        }
        for touch in touches {
            let hit = [
                case.surface(touch.surface),
                l.show(touch.depth_m),
                f.show(touch.normal_force_n),
                f.show(touch.friction_n.norm()),
                v.show(touch.slip_m_s),
            ];
            table.row_of(&[&first, &hit]);
            first.fill(String::new());
        }
    }
    table
}

fn application_points(units: Units, s: &Sample<'_>) -> Table {
    let mut table = Table::new(
        units.heading(
            "6. POINT OF APPLICATION OF THE CONTACT FORCE FROM THE CENTER OF THE SPHERE, SEGMENT COORDINATES ({})",
            &[Metre],
        ),
        "NO|<SPHERE|X|Y|Z",
    );
    let spheres = s.model.body().spheres.iter().enumerate();
    // behind the name of one of several bodies
    let is_asked = |name: &str| name.rsplit('.').next().is_some_and(|own| APPLICATION.contains(&own));
    for (i, sphere) in spheres.filter(|(_, sphere)| is_asked(&sphere.name)) {
        let point = s.application_point_m(i).map_or(["-"; 3].map(str::to_owned), |p| units.of(Metre).vector(p));
        table.row_of(&[&[(i + 1).to_string(), sphere.name.clone()], &point]);
    }
    table
}

/// Actions of all elements of the kind `of`, if there are any.
fn named(pages: &mut Pages, units: Units, s: &Sample<'_>, of: &str, title: &str) {
    for one in s.model.named(of) {
        let all = matching(s.model, &format!("{of}.{}.*", one.name));
        let head = |name: &str| energy_head(name.rsplit(&format!("{}.", one.name)).next().unwrap_or(name));
        let heads: Vec<String> = all.iter().map(|channel| head(&channel.name)).collect();
        let mut names: Vec<String> = all.iter().map(|channel| units.of(channel.unit).name()).collect();
        names.dedup();
        let mut table = Table::new(format!("{title} {} ({})", one.name, names.join(", ")), &heads.join("|"));
        table.row(all.iter().map(|channel| units.of(channel.unit).show(channel.value(s))));
        table.write(pages);
    }
}

fn joints(pages: &mut Pages, s: &Sample<'_>) {
    let tree = s.model.body().tree;
    let heads: Vec<String> = tree.joint_rows().iter().map(|row| joint_head(row.name)).collect();
    if heads.is_empty() {
        return;
    }
    let title = "JOINT ANGLES (DEG): BETA OF BALL JOINTS, ALPHA OF ELBOWS AND KNEES";
    let mut table = Table::new(title, &heads.join("|"));
    table.row(tree.joints().map(|j| degree().show(s.joint_angle_rad(j))));
    table.write(pages);
}

/// A joint's name within the width of a number: `R SHOULDER`.
fn joint_head(name: &str) -> String {
    let name = name.to_uppercase().replace('_', " ");
    name.replace("RIGHT ", "R ").replace("LEFT ", "L ")
}

/// The whole ledger.
fn energy(pages: &mut Pages, units: Units, s: &Sample<'_>) {
    let all = matching(s.model, "energy.*");
    let heads: Vec<String> = all.iter().map(|c| energy_head(c.name.trim_start_matches("energy."))).collect();
    let title =
        units.heading("ENERGY ({}), SPINE, CONT AND BELTS STORED; BALANCE 0 FOR AN EXACT INTEGRATION;", &[Joule]);
    let mut table = Table::new(format!("{title} {} STEPS SO FAR", s.effort.steps), &heads.join("|"));
    table.row(all.iter().map(|channel| units.of(Joule).show(channel.value(s))));
    table.write(pages);
}

/// An energy's name within the width of a number: `LOST CONT`.
fn energy_head(name: &str) -> String {
    let name = name.to_uppercase().replace('_', " ");
    let short = [("KINETIC RELATIVE", "KIN REL VEH"), ("CONTACTS", "CONT"), ("FRICTION", "FRICT"), ("VEHICLE", "VEH")];
    short.iter().fold(name, |name, (long, short)| name.replace(long, short))
}

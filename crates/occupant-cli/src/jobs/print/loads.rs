//! Items 5 to 7: forces on the contact spheres and the surfaces hit, points of application, belts; joint angles and the
//! energy balance.

use occupant_core::results::channel::matching;
use occupant_core::results::sample::Sample;

use super::case::Case;
use super::page::Pages;
use super::table::Table;
use super::unit::{DEGREE, Units};

/// The spheres whose point of application the report prints.
const APPLICATION: [&str; 3] = ["head", "chest", "pelvis"];

/// Writes the loads' tables.
pub(crate) fn write(pages: &mut Pages, case: &Case, units: &Units, sample: &Sample<'_>) {
    forces(case, units, sample).write(pages);
    application_points(units, sample).write(pages);
    belts(pages, units, sample);
    joints(pages, sample);
    energy(pages, units, sample);
}

/// Every sphere's force; one line for each surface hit.
fn forces(case: &Case, units: &Units, s: &Sample<'_>) -> Table {
    let mut table = Table::new(
        format!(
            "5. FORCE ON EACH CONTACT SPHERE, VEHICLE COORDINATES, BELTS APART, AND SURFACES HIT ({}, {}, {})",
            units.force.name, units.length.name, units.speed.name
        ),
        "NO | <SPHERE | FORCE X | FORCE Y | FORCE Z | RESULTANT | <SURFACE HIT | DEPTH | NORMAL | FRICTION | SLIP",
    );
    for (i, sphere) in s.model.body().spheres.iter().enumerate() {
        let force_n = s.sphere_force_n(i);
        let mut cells = vec![(i + 1).to_string(), sphere.name.clone()];
        cells.extend(units.force.vector(force_n));
        cells.push(units.force.show(force_n.norm()));
        let mut touches = s.contacts().filter(|c| c.sphere == i).peekable();
        if touches.peek().is_none() {
            cells.push("-".to_owned());
            table.row(std::mem::take(&mut cells));
        }
        for touch in touches {
            cells.resize(6, String::new());
            cells.extend([
                case.surface(touch.surface),
                units.length.show(touch.depth_m),
                units.force.show(touch.normal_force_n),
                units.force.show(touch.friction_n.norm()),
                units.speed.show(touch.slip_m_s),
            ]);
            table.row(std::mem::take(&mut cells));
        }
    }
    table
}

fn application_points(units: &Units, s: &Sample<'_>) -> Table {
    let mut table = Table::new(
        format!(
            "6. POINT OF APPLICATION OF THE CONTACT FORCE FROM THE CENTER OF THE SPHERE, SEGMENT COORDINATES ({})",
            units.length.name
        ),
        "NO | <SPHERE | X | Y | Z",
    );
    for name in APPLICATION {
        let Some(i) = s.model.body().sphere(name) else {
            continue;
        };
        let cells = match s.application_point_m(i) {
            Some(point) => units.length.vector(point),
            None => ["-", "-", "-"].map(str::to_owned),
        };
        let first = [(i + 1).to_string(), name.to_owned()];
        table.row(first.into_iter().chain(cells));
    }
    table
}

fn belts(pages: &mut Pages, units: &Units, s: &Sample<'_>) {
    let mut table = Table::new(
        format!(
            "7. RESTRAINING FORCES OF BELTS, VEHICLE COORDINATES ({}, {}); WRAP (DEG) 0 OR LESS: OFF THE BODY",
            units.force.name, units.length.name
        ),
        "<BELT | <ROUND | LOOP FORCE | FORCE X | FORCE Y | FORCE Z | RESULTANT | ELONGATION | LENGTH | WRAP",
    );
    for (belt, action) in s.model.setup().belts.iter().zip(&s.actions.belts) {
        let round = s.model.body().spheres.get(belt.sphere);
        let force = action.force.to_vector();
        let first = [
            belt.name.clone(),
            round.map_or_else(String::new, |s| s.name.clone()),
            units.force.show(action.loop_force),
        ];
        let last = [
            units.force.show(force.norm()),
            units.length.show(action.elongation),
            units.length.show(action.length),
            DEGREE.show(action.wrap),
        ];
        let force = units.force.vector(force);
        table.row(first.into_iter().chain(force).chain(last));
    }
    if table.is_empty() {
        pages.block(&["7. NO BELTS".to_owned()], 0);
    } else {
        table.write(pages);
    }
}

fn joints(pages: &mut Pages, s: &Sample<'_>) {
    let tree = s.model.body().tree;
    let heads: Vec<String> = tree.joint_rows().iter().map(|row| joint_head(row.name)).collect();
    let title = "JOINT ANGLES (DEG): BETA OF BALL JOINTS, ALPHA OF ELBOWS AND KNEES";
    let mut table = Table::new(title, &heads.join("|"));
    table.row(tree.joints().map(|j| DEGREE.show(s.joint_angle_rad(j))));
    table.write(pages);
}

/// A joint's name in the room of a number: `R SHOULDER`.
fn joint_head(name: &str) -> String {
    let name = name.to_uppercase().replace('_', " ");
    name.replace("RIGHT ", "R ").replace("LEFT ", "L ")
}

fn energy(pages: &mut Pages, units: &Units, s: &Sample<'_>) {
    let columns = [
        ("KINETIC", "energy.kinetic"),
        ("KIN REL VEH", "energy.kinetic_relative"),
        ("GRAVITY", "energy.gravity"),
        ("SPINE", "energy.spine"),
        ("LOST CONT", "energy.lost_contacts"),
        ("LOST FRICT", "energy.lost_friction"),
        ("LOST JOINTS", "energy.lost_joints"),
        ("LOST BELTS", "energy.lost_belts"),
        ("VEH WORK", "energy.vehicle_work"),
        ("BALANCE", "energy.balance"),
    ];
    let energies = matching(s.model, "energy.*");
    let energy_j = |name: &str| energies.iter().find(|c| c.name == name).map_or(f64::NAN, |c| c.value(s));
    let title = format!(
        "ENERGY ({}); THE BALANCE IS 0 FOR AN EXACT INTEGRATION; {} STEPS SO FAR",
        units.energy.name, s.effort.steps
    );
    let mut table = Table::new(title, &columns.map(|(head, _)| head).join("|"));
    table.row(columns.map(|(_, name)| units.energy.show(energy_j(name))));
    table.write(pages);
}

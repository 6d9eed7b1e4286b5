//! Items 5 to 7: forces on the contact spheres and the surfaces hit, points of application, belts; joint angles and the
//! energy balance.

use occupant_core::body::joint::Joint;

use super::case::Case;
use super::message::Message;
use super::page::Pages;
use super::segments::magnitude;
use super::table::Table;
use super::unit::{DEGREE, Units};
use crate::files::mcap::groups::{BELT, ENERGY, JOINTS, SOLVER, SPHERE};
use crate::files::mcap::topics;

/// The spheres whose point of application the report prints.
const APPLICATION: [&str; 3] = ["head", "chest", "pelvis"];

/// Writes the loads' tables.
pub(crate) fn write(pages: &mut Pages, case: &Case, units: &Units, output: usize) -> Result<(), String> {
    let mut spheres = Vec::new();
    for topic in &case.spheres {
        spheres.push(case.message(topic, &SPHERE, output)?);
    }
    forces(case, units, &spheres)?.write(pages);
    application_points(case, units, &spheres).write(pages);
    belts(pages, case, units, output)?;
    joints(pages, case, output)?;
    energy(pages, case, units, output)
}

/// Every sphere's force; one line for each surface hit.
fn forces(case: &Case, units: &Units, spheres: &[Message<'_>]) -> Result<Table, String> {
    let mut table = Table::new(
        format!(
            "5. FORCE ON EACH CONTACT SPHERE, VEHICLE COORDINATES, BELTS APART, AND SURFACES HIT ({}, {}, {})",
            units.force.name, units.length.name, units.speed.name
        ),
        &[
            "NO",
            "<SPHERE",
            "FORCE X",
            "FORCE Y",
            "FORCE Z",
            "RESULTANT",
            "<SURFACE HIT",
            "DEPTH",
            "NORMAL",
            "FRICTION",
            "SLIP",
        ],
    );
    let surfaces = &case.model.setup().surfaces;
    for (i, m) in spheres.iter().enumerate() {
        let force = m.components("contact_force_vehicle_n");
        let mut cells = vec![(i + 1).to_string(), case.model.body().spheres[i].name.clone()];
        cells.extend(units.force.vector(force));
        cells.push(units.force.show(m.number("contact_force_resultant_n")));
        let touches = m.touches().ok_or_else(|| format!("the contacts of {} cannot be read", case.spheres[i]))?;
        if touches.is_empty() {
            cells.push("-".to_owned());
            table.row(std::mem::take(&mut cells));
        }
        for touch in touches {
            let index = surfaces.iter().position(|s| s.name == touch.surface);
            cells.resize(6, String::new());
            cells.extend([
                index.map_or(touch.surface, |index| case.surface(index)),
                units.length.show(touch.depth_m),
                units.force.show(touch.normal_force_n),
                units.force.show(magnitude(touch.friction_n)),
                units.speed.show(touch.slip_m_s),
            ]);
            table.row(std::mem::take(&mut cells));
        }
    }
    Ok(table)
}

fn application_points(case: &Case, units: &Units, spheres: &[Message<'_>]) -> Table {
    let mut table = Table::new(
        format!(
            "6. POINT OF APPLICATION OF THE CONTACT FORCE FROM THE CENTER OF THE SPHERE, SEGMENT COORDINATES ({})",
            units.length.name
        ),
        &["NO", "<SPHERE", "X", "Y", "Z"],
    );
    for name in APPLICATION {
        let Some(i) = case.model.body().sphere(name) else {
            continue;
        };
        let point = spheres[i].vector("application_point_segment_m");
        let cells = match point {
            Some(point) => units.length.vector(point),
            None => ["-", "-", "-"].map(str::to_owned),
        };
        let first = [(i + 1).to_string(), name.to_owned()];
        table.row(first.into_iter().chain(cells));
    }
    table
}

fn belts(pages: &mut Pages, case: &Case, units: &Units, output: usize) -> Result<(), String> {
    let mut table = Table::new(
        format!(
            "7. RESTRAINING FORCES OF BELTS, VEHICLE COORDINATES ({}, {}); WRAP (DEG) 0 OR LESS: OFF THE BODY",
            units.force.name, units.length.name
        ),
        &[
            "<BELT",
            "<ROUND",
            "LOOP FORCE",
            "FORCE X",
            "FORCE Y",
            "FORCE Z",
            "RESULTANT",
            "ELONGATION",
            "LENGTH",
            "WRAP",
        ],
    );
    for (belt, topic) in case.model.setup().belts.iter().zip(&case.belts) {
        let m = case.message(topic, &BELT, output)?;
        let round = case.model.body().spheres.get(belt.sphere);
        let force = m.components("restraining_force_vehicle_n");
        let first = [
            belt.name.clone(),
            round.map_or_else(String::new, |s| s.name.clone()),
            units.force.show(m.number("loop_force_n")),
        ];
        let last = [
            units.force.show(m.number("restraining_force_resultant_n")),
            units.length.show(m.number("elongation_m")),
            units.length.show(m.number("length_m")),
            DEGREE.show(m.number("wrap_rad")),
        ];
        let force = units.force.vector(force);
        table.row(first.into_iter().chain(force).chain(last));
    }
    match table.is_empty() {
        true => pages.block(&["7. NO BELTS".to_owned()], 0),
        false => table.write(pages),
    }
    Ok(())
}

fn joints(pages: &mut Pages, case: &Case, output: usize) -> Result<(), String> {
    let m = case.message(topics::JOINTS, &JOINTS, output)?;
    let heads: Vec<String> = Joint::ALL.iter().map(|j| joint_head(*j)).collect();
    let heads: Vec<&str> = heads.iter().map(String::as_str).collect();
    let title = "JOINT ANGLES (DEG): BETA OF BALL JOINTS, ALPHA OF ELBOWS AND KNEES";
    let mut table = Table::new(title, &heads);
    table.row(Joint::ALL.map(|j| DEGREE.show(m.number(&format!("{}_rad", j.name())))));
    table.write(pages);
    Ok(())
}

/// A joint's name in the room of a number: `R SHOULDER`.
fn joint_head(joint: Joint) -> String {
    let name = joint.name().to_uppercase().replace('_', " ");
    name.replace("RIGHT ", "R ").replace("LEFT ", "L ")
}

fn energy(pages: &mut Pages, case: &Case, units: &Units, output: usize) -> Result<(), String> {
    let m = case.message(topics::ENERGY, &ENERGY, output)?;
    let solver = case.message(topics::SOLVER, &SOLVER, output)?;
    let columns = [
        ("KINETIC", "kinetic_j"),
        ("KIN REL VEH", "kinetic_relative_j"),
        ("GRAVITY", "gravity_j"),
        ("SPINE", "spine_j"),
        ("LOST CONT", "lost_contacts_j"),
        ("LOST FRICT", "lost_friction_j"),
        ("LOST JOINTS", "lost_joints_j"),
        ("LOST BELTS", "lost_belts_j"),
        ("VEH WORK", "vehicle_work_j"),
        ("BALANCE", "balance_j"),
    ];
    let title = format!(
        "ENERGY ({}); THE BALANCE IS 0 FOR AN EXACT INTEGRATION; {} STEPS SO FAR",
        units.energy.name,
        solver.number("steps")
    );
    let mut table = Table::new(title, &columns.map(|(head, _)| head));
    table.row(columns.map(|(_, name)| units.energy.show(m.number(name))));
    table.write(pages);
    Ok(())
}

//! Place, attitude and motion of the vehicle at one output.

use super::case::Case;
use super::page::Pages;
use super::table::Table;
use super::unit::{DEGREE, G, RAD_S, RAD_S2, Units};
use crate::files::mcap::groups::VEHICLE;
use crate::files::mcap::topics;

/// Writes the vehicle's lines.
pub(crate) fn write(pages: &mut Pages, case: &Case, units: &Units, output: usize) -> Result<(), String> {
    let m = case.message(topics::VEHICLE, &VEHICLE, output)?;
    let title = format!(
        "VEHICLE: POSITION ({}) FORWARD, RIGHT, DOWN; ATTITUDE (DEG) ROLL, PITCH, YAW; THE REST IN VEHICLE COORDINATES",
        units.length.name
    );
    let mut table = Table::new(title, &["<", "X", "Y", "Z", "<", "X", "Y", "Z"]);
    let angles = ["roll_rad", "pitch_rad", "yaw_rad"].map(|name| DEGREE.show(m.number(name)));
    let motion = |name, unit: &super::unit::Unit| unit.vector(m.components(name));
    let speed = format!("VELOCITY ({})", units.speed.name);
    let rows = [
        ("POSITION", motion("position_path_m", &units.length), "ROLL, PITCH, YAW (DEG)", angles),
        (
            speed.as_str(),
            motion("velocity_vehicle_m_s", &units.speed),
            "ANGULAR VELOCITY (RAD/S)",
            motion("angular_velocity_vehicle_rad_s", &RAD_S),
        ),
        (
            "ACCELERATION (G)",
            motion("acceleration_vehicle_m_s2", &G),
            "ANGULAR ACCELERATION (RAD/S2)",
            motion("angular_acceleration_vehicle_rad_s2", &RAD_S2),
        ),
    ];
    for (left, place, right, turn) in rows {
        let (left, right) = ([left.to_owned()], [right.to_owned()]);
        table.row(left.into_iter().chain(place).chain(right).chain(turn));
    }
    table.write(pages);
    Ok(())
}

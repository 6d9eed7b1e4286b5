//! Place, attitude and motion of the vehicle at one output.

use occupant_core::results::sample::Sample;

use super::page::Pages;
use super::table::Table;
use super::unit::{DEGREE, G, RAD_S, RAD_S2, Units};

/// Writes the vehicle's lines.
pub(crate) fn write(pages: &mut Pages, units: &Units, s: &Sample<'_>) {
    let title = format!(
        "VEHICLE: POSITION ({}) FORWARD, RIGHT, DOWN; ATTITUDE (DEG) ROLL, PITCH, YAW; THE REST IN VEHICLE COORDINATES",
        units.length.name
    );
    let mut table = Table::new(title, "< | X | Y | Z | < | X | Y | Z");
    let attitude = &s.vehicle_pose.attitude;
    let angles = DEGREE.vector([attitude.roll_rad, attitude.pitch_rad, attitude.yaw_rad]);
    let along = |v| s.vehicle.vector_to_frame(v);
    let speed = format!("VELOCITY ({})", units.speed.name);
    let rows = [
        ("POSITION", units.length.vector(s.vehicle_pose.position_m), "ROLL, PITCH, YAW (DEG)", angles),
        (
            speed.as_str(),
            units.speed.vector(along(s.vehicle.velocity_m_s)),
            "ANGULAR VELOCITY (RAD/S)",
            RAD_S.vector(along(s.vehicle.angular_velocity_rad_s)),
        ),
        (
            "ACCELERATION (G)",
            G.vector(along(s.vehicle.acceleration_m_s2)),
            "ANGULAR ACCELERATION (RAD/S2)",
            RAD_S2.vector(along(s.vehicle.angular_acceleration_rad_s2)),
        ),
    ];
    for (left, place, right, turn) in rows {
        let (left, right) = ([left.to_owned()], [right.to_owned()]);
        table.row(left.into_iter().chain(place).chain(right).chain(turn));
    }
    table.write(pages);
}

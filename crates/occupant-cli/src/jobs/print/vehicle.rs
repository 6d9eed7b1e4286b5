//! Place, attitude and motion of the vehicle at one output.

use crash_measures::unit::Unit::{Metre, MetrePerSecond, RadianPerSecond, RadianPerSecondSquared};
use occupant_core::results::sample::Sample;

use super::unit::{degree, g};
use super::{Pages, Table, Units};

/// Writes the vehicle's lines.
pub(crate) fn write(pages: &mut Pages, units: Units, s: &Sample<'_>) {
    let title = units.heading(
        "VEHICLE: POSITION ({}) FORWARD, RIGHT, DOWN; ATTITUDE (DEG) ROLL, PITCH, YAW; THE REST IN VEHICLE COORDINATES",
        &[Metre],
    );
    let mut table = Table::new(title, "<|X|Y|Z|<|X|Y|Z");
    let attitude = &s.vehicle_pose.attitude;
    let angles = degree().vector([attitude.roll_rad, attitude.pitch_rad, attitude.yaw_rad]);
    let along = |v| s.vehicle.vector_to_frame(v);
    let speed = units.of(MetrePerSecond).vector(along(s.vehicle.velocity_m_s));
    let turning = units.of(RadianPerSecond).vector(along(s.vehicle.angular_velocity_rad_s));
    let turning_faster = units.of(RadianPerSecondSquared).vector(along(s.vehicle.angular_acceleration_rad_s2));
    let rows = [
        ("POSITION", units.of(Metre).vector(s.vehicle_pose.position_m), "ROLL, PITCH, YAW (DEG)", angles),
        (&units.heading("VELOCITY ({})", &[MetrePerSecond]), speed, "ANGULAR VELOCITY (RAD/S)", turning),
        (
            "ACCELERATION (G)",
            g().vector(along(s.vehicle.acceleration_m_s2)),
            "ANGULAR ACCELERATION (RAD/S2)",
            turning_faster,
        ),
    ];
    for (left, place, right, turn) in rows {
        table.row_of(&[&[left.to_owned()], &place, &[right.to_owned()], &turn]);
    }
    table.write(pages);
}

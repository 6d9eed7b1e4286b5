//! Motion of the vehicle.

use crate::files::mcap::column::{Group, TIME, Value, column};
use Value::{Number, Vector};

/// Message `occupant.VehicleMotion`.
pub(crate) const VEHICLE: Group = Group {
    message: "VehicleMotion",
    columns: &[
        TIME,
        column(
            2,
            "position_path_m",
            Vector(|s, _| s.vehicle_pose.position_m),
            "centre of gravity as the path gives it: forward, right, down",
        ),
        column(3, "roll_rad", Number(|s, _| s.vehicle_pose.attitude.roll_rad), "roll, right side down positive"),
        column(4, "pitch_rad", Number(|s, _| s.vehicle_pose.attitude.pitch_rad), "pitch, nose up positive"),
        column(5, "yaw_rad", Number(|s, _| s.vehicle_pose.attitude.yaw_rad), "yaw, nose to the right positive"),
        column(6, "velocity_space_m_s", Vector(|s, _| s.vehicle.velocity_m_s), "velocity of the centre of gravity"),
        column(
            7,
            "velocity_vehicle_m_s",
            Vector(|s, _| s.vehicle.vector_to_frame(s.vehicle.velocity_m_s)),
            "the same along the vehicle's axes",
        ),
        column(
            8,
            "acceleration_space_m_s2",
            Vector(|s, _| s.vehicle.acceleration_m_s2),
            "acceleration of the centre of gravity",
        ),
        column(
            9,
            "acceleration_vehicle_m_s2",
            Vector(|s, _| s.vehicle.vector_to_frame(s.vehicle.acceleration_m_s2)),
            "the same along the vehicle's axes",
        ),
        column(
            10,
            "angular_velocity_vehicle_rad_s",
            Vector(|s, _| s.vehicle.vector_to_frame(s.vehicle.angular_velocity_rad_s)),
            "angular velocity along the vehicle's axes",
        ),
        column(
            11,
            "angular_acceleration_vehicle_rad_s2",
            Vector(|s, _| s.vehicle.vector_to_frame(s.vehicle.angular_acceleration_rad_s2)),
            "angular acceleration along the vehicle's axes",
        ),
    ],
};

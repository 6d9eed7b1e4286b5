//! Motion of the vehicle.

use crash_measures::unit::Unit::{
    Metre, MetrePerSecond, MetrePerSecondSquared, Radian, RadianPerSecond, RadianPerSecondSquared,
};

use super::Run;
use crate::quantity::{Axes, Quantity};

type Of = Quantity<Run>;

/// Message `VehicleMotion`.
pub(super) const QUANTITIES: &[Of] = &[
    Of::vector(MetrePerSecondSquared, Axes::Vehicle, |s| s.vehicle.vector_to_frame(s.vehicle.acceleration_m_s2))
        .channel("acceleration", "kinematic acceleration of the vehicle's centre of gravity")
        .field(9, "acceleration", "the same along the vehicle's axes"),
    Of::vector(MetrePerSecond, Axes::Vehicle, |s| s.vehicle.vector_to_frame(s.vehicle.velocity_m_s))
        .channel("velocity", "velocity of the vehicle's centre of gravity")
        .field(7, "velocity", "the same along the vehicle's axes"),
    Of::vector(RadianPerSecond, Axes::Vehicle, |s| s.vehicle.vector_to_frame(s.vehicle.angular_velocity_rad_s))
        .channel("angular_velocity", "angular velocity of the vehicle")
        .field(10, "angular_velocity", "angular velocity along the vehicle's axes"),
    Of::vector(Metre, Axes::VehicleSpace, |s| s.vehicle_pose.position_m)
        .channel("position", "place of the vehicle's centre of gravity")
        .field(2, "position", "centre of gravity as the path gives it: forward, right, down"),
    Of::number(Radian, |s| s.vehicle_pose.attitude.roll_rad).channel("roll", "roll of the vehicle").field(
        3,
        "roll",
        "roll, right side down positive",
    ),
    Of::number(Radian, |s| s.vehicle_pose.attitude.pitch_rad).channel("pitch", "pitch of the vehicle").field(
        4,
        "pitch",
        "pitch, nose up positive",
    ),
    Of::number(Radian, |s| s.vehicle_pose.attitude.yaw_rad).channel("yaw", "yaw of the vehicle").field(
        5,
        "yaw",
        "yaw, nose to the right positive",
    ),
    Of::vector(MetrePerSecond, Axes::Space, |s| s.vehicle.velocity_m_s).field(
        6,
        "velocity",
        "velocity of the centre of gravity",
    ),
    Of::vector(MetrePerSecondSquared, Axes::Space, |s| s.vehicle.acceleration_m_s2).field(
        8,
        "acceleration",
        "acceleration of the centre of gravity",
    ),
    Of::vector(RadianPerSecondSquared, Axes::Vehicle, |s| {
        s.vehicle.vector_to_frame(s.vehicle.angular_acceleration_rad_s2)
    })
    .field(11, "angular_acceleration", "angular acceleration along the vehicle's axes"),
];

//! Motion of the vehicles.

use occupant_units::unit::Unit::{
    Metre, MetrePerSecond, MetrePerSecondSquared, Radian, RadianPerSecond, RadianPerSecondSquared,
};

use crate::model::setup::{OtherFrame, Setup};
use crate::quantity::{Axes, Owner, Quantity};
use crate::results::sample::Sample;
use crate::vehicle::{FrameMotion, PathCursor, VehiclePath, VehiclePose};

/// A vehicle at one output.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfVehicle;

impl Owner for OfVehicle {
    type At<'a> = Vehicle;
}

/// Motion in space, and pose as given by the path.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vehicle {
    motion: FrameMotion,
    pose: VehiclePose,
}

/// The first vehicle.
pub(super) fn first(s: &Sample<'_>) -> Vehicle {
    Vehicle { motion: *s.vehicle, pose: s.vehicle_pose }
}

/// The vehicle of another frame (index).
pub(super) fn other(s: &Sample<'_>, frame: usize) -> Vehicle {
    let (path, cursor) = (&s.model.setup().frames[frame].path, &mut PathCursor::default());
    Vehicle { motion: path.shown_motion(s.time_s, cursor), pose: path.attitude(s.time_s, cursor) }
}

/// Other frames (indices) that are vehicles: without a parent, and not the ground, whose origin is fixed.
pub(super) fn others(setup: &Setup) -> impl Iterator<Item = (usize, &OtherFrame)> {
    let is_vehicle = |frame: &OtherFrame| frame.parent.is_none() && frame.path != VehiclePath::parked();
    setup.frames.iter().enumerate().filter(move |(_, frame)| is_vehicle(frame))
}

type Of = Quantity<OfVehicle>;

/// Message `VehicleMotion` of a vehicle that follows `path`.
pub(super) fn quantities(path: &VehiclePath) -> Vec<Of> {
    let [acceleration, field, angular, angular_words] =
        if path.has_accelerations() { FROM_PATH } else { FROM_DIFFERENCES };
    let own = [
        Of::vector(MetrePerSecondSquared, Axes::Vehicle, |v| v.motion.vector_to_frame(v.motion.acceleration_m_s2))
            .channel("acceleration", acceleration)
            .field(9, "acceleration", "the same along the vehicle's axes"),
        Of::vector(MetrePerSecondSquared, Axes::Space, |v| v.motion.acceleration_m_s2).field(8, "acceleration", field),
        Of::vector(RadianPerSecondSquared, Axes::Vehicle, |v| {
            v.motion.vector_to_frame(v.motion.angular_acceleration_rad_s2)
        })
        .channel("angular_acceleration", angular_words)
        .field(11, "angular_acceleration", angular),
    ];
    own.into_iter().chain(QUANTITIES).collect()
}

/// Meaning of accelerations: as channel, as field, and angular ones as both.
const FROM_PATH: [&str; 4] = [
    "kinematic acceleration of the {}'s centre of gravity",
    "acceleration of the centre of gravity",
    "angular acceleration along the vehicle's axes",
    "angular acceleration of the {}",
];
/// The same for a table with linear interpolation, whose velocity jumps.
const FROM_DIFFERENCES: [&str; 4] = [
    "kinematic acceleration of the {}'s centre of gravity, from second differences of the stations of its path",
    "acceleration of the centre of gravity, from second differences of the stations of the path",
    "angular acceleration along the vehicle's axes, from second differences of the stations of the path",
    "angular acceleration of the {}, from second differences of the stations of its path",
];

const QUANTITIES: [Of; 7] = [
    Of::vector(MetrePerSecond, Axes::Vehicle, |v| v.motion.vector_to_frame(v.motion.velocity_m_s))
        .channel("velocity", "velocity of the {}'s centre of gravity")
        .field(7, "velocity", "the same along the vehicle's axes"),
    Of::vector(RadianPerSecond, Axes::Vehicle, |v| v.motion.vector_to_frame(v.motion.angular_velocity_rad_s))
        .channel("angular_velocity", "angular velocity of the {}")
        .field(10, "angular_velocity", "angular velocity along the vehicle's axes"),
    Of::vector(Metre, Axes::VehicleSpace, |v| v.pose.position_m)
        .channel("position", "position of the {}'s centre of gravity")
        .field(2, "position", "centre of gravity as the path gives it: forward, right, down"),
    Of::number(Radian, |v| v.pose.attitude.roll_rad).channel("roll", "roll of the {}").field(
        3,
        "roll",
        "roll, right side down positive",
    ),
    Of::number(Radian, |v| v.pose.attitude.pitch_rad).channel("pitch", "pitch of the {}").field(
        4,
        "pitch",
        "pitch, nose up positive",
    ),
    Of::number(Radian, |v| v.pose.attitude.yaw_rad).channel("yaw", "yaw of the {}").field(
        5,
        "yaw",
        "yaw, nose to the right positive",
    ),
    Of::vector(MetrePerSecond, Axes::Space, |v| v.motion.velocity_m_s).field(
        6,
        "velocity",
        "velocity of the centre of gravity",
    ),
];

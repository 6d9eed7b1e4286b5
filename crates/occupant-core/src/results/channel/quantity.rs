//! What a channel measures.

use nalgebra::Vector3;

use crate::body::Segment;
use crate::body::joint::Joint;
use crate::results::energy::EnergyLedger;
use crate::results::reaction::{femur_axial_n, reaction};
use crate::results::sample::Sample;

/// What a channel takes from a sample.
#[derive(Clone, Copy, Debug)]
pub(super) enum Source {
    VehicleAcceleration,
    VehicleVelocity,
    VehicleAngularVelocity,
    VehiclePosition,
    /// Roll, pitch, yaw.
    VehicleAttitude,
    /// What an accelerometer at the centre of gravity reads.
    SpecificForce(Segment),
    /// Kinematic acceleration of the centre of gravity.
    Acceleration(Segment),
    AngularVelocity(Segment),
    AngularAcceleration(Segment),
    /// Velocity of the centre of gravity, vehicle axes.
    Velocity(Segment),
    /// Centre of gravity.
    Position(Segment),
    SpherePlace(usize),
    /// All contact forces on a sphere.
    SphereForce(usize),
    /// All belt forces on a sphere.
    SphereBeltForce(usize),
    /// Greatest Δ of a sphere.
    Penetration(usize),
    LoopForce(usize),
    Elongation(usize),
    BeltForce(usize),
    Angle(Joint),
    JointForce(Joint),
    JointMoment(Joint),
    /// The neck's force on the head in J211 axes.
    NeckForce(Joint),
    /// The neck's moment on the head in J211 axes.
    NeckMoment(Joint),
    Femur(Segment),
    Energy(fn(&EnergyLedger) -> f64),
}

/// A component of a vector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Component {
    X,
    Y,
    Z,
    Resultant,
}

impl Component {
    pub const ALL: [(Component, &'static str); 4] =
        [(Component::X, "x"), (Component::Y, "y"), (Component::Z, "z"), (Component::Resultant, "resultant")];

    pub fn of(self, v: &Vector3<f64>) -> f64 {
        match self {
            Component::X => v.x,
            Component::Y => v.y,
            Component::Z => v.z,
            Component::Resultant => v.norm(),
        }
    }
}

/// A scalar as a vector along X.
fn scalar(value: f64) -> Vector3<f64> {
    Vector3::new(value, 0.0, 0.0)
}

/// Segment axes (left, up) to J211 axes (right, down): a half turn about X.
fn to_j211(v: Vector3<f64>) -> Vector3<f64> {
    Vector3::new(v.x, -v.y, -v.z)
}

impl Source {
    /// Its value; a scalar stands in X.
    pub fn value(&self, s: &Sample<'_>) -> Vector3<f64> {
        let to_vehicle = |v| s.vehicle.vector_to_frame(v);
        let belt = |i: &usize| s.belts.get(*i);
        match self {
            Source::VehicleAcceleration => to_vehicle(s.vehicle.acceleration_m_s2),
            Source::VehicleVelocity => to_vehicle(s.vehicle.velocity_m_s),
            Source::VehicleAngularVelocity => to_vehicle(s.vehicle.angular_velocity_rad_s),
            Source::VehiclePosition => s.vehicle_pose.position_m,
            Source::VehicleAttitude => {
                let a = &s.vehicle_pose.attitude;
                Vector3::new(a.roll_rad, a.pitch_rad, a.yaw_rad)
            }
            Source::SpecificForce(n) => s.specific_force_m_s2(*n),
            Source::Acceleration(n) => s.cg_acceleration_m_s2(*n),
            Source::AngularVelocity(n) => s.angular_velocity_rad_s(*n),
            Source::AngularAcceleration(n) => s.angular_acceleration_rad_s2(*n),
            Source::Velocity(n) => to_vehicle(s.cg_velocity_m_s(*n)),
            Source::Position(n) => s.cg_m(*n).coords,
            Source::SpherePlace(i) => s.sphere_centre_m(*i).coords,
            Source::SphereForce(i) => s.sphere_force_n(*i),
            Source::SphereBeltForce(i) => s.sphere_belt_force_n(*i),
            Source::Penetration(i) => {
                let own = s.touches.iter().filter(|t| t.sphere == *i);
                scalar(own.map(|t| t.depth).fold(0.0, f64::max))
            }
            Source::LoopForce(i) => scalar(belt(i).map_or(f64::NAN, |b| b.loop_force)),
            Source::Elongation(i) => scalar(belt(i).map_or(f64::NAN, |b| b.elongation)),
            Source::BeltForce(i) => belt(i).map_or(scalar(f64::NAN), |b| b.force.to_vector()),
            Source::Angle(joint) => scalar(s.joint_angle_rad(*joint)),
            Source::JointForce(joint) => reaction(s, *joint).force_n,
            Source::JointMoment(joint) => reaction(s, *joint).moment_n_m,
            Source::NeckForce(neck) => to_j211(reaction(s, *neck).force_n),
            Source::NeckMoment(neck) => to_j211(reaction(s, *neck).moment_n_m),
            Source::Femur(thigh) => scalar(femur_axial_n(s, *thigh)),
            Source::Energy(of) => scalar(of(&s.energy)),
        }
    }
}

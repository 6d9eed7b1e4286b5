//! Initial state of the body: posture, position and velocity, as data.
//!
//! Report: "Initial Position of Passenger", Figs 19 and 20.

use nalgebra::{Matrix3, Vector3};

use crate::body::both_sides;
use crate::forces::contact::surface::Frame;
use crate::motion::frame::{SPACE, VEHICLE};
use crate::motion::report_coordinates::ReportCoordinates;
use crate::motion::skeleton::Mount;
use crate::motion::vector::{M3, V3};
use crate::vehicle::{Attitude, FrameMotion};

/// Seated position and posture. Angles as in Fig. 19: γ > 0 leans the top back.
#[derive(Clone, Debug, PartialEq)]
pub struct Seating {
    /// Index of the cushion: a surface, or a solid after all surfaces.
    pub cushion: usize,
    /// Index of the seat back, counted as `cushion`.
    pub back: usize,
    /// Lateral position of the body's midplane, Y_v (right positive).
    pub lateral_m: f64,
    /// Angles by names of segments (lean γ) and of hinges (rotation α): `head`, or `upper_arms` for both. Other
    /// segments are aligned with their parent; the heels determine the legs.
    pub angles_rad: Vec<(String, f64)>,
    /// X_VH, Z_VH: heel point in vehicle axes.
    pub heels_m: [f64; 2],
    /// X, Z of both hands in vehicle axes, elbows below; without it, the angles of the arms count.
    pub hands_m: Option<[f64; 2]>,
    /// What moves from there during settling.
    pub settle: Settling,
}

/// What of a seated body moves until contacts, belts and weight are in balance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Settling {
    /// Nothing: seating as in the report.
    Not,
    /// The whole body, with locked joints.
    #[default]
    Locked,
    /// All joints, as of a sleeping person.
    Limp,
}

impl Seating {
    /// Angles by name.
    pub fn angles(named_rad: &[(&str, f64)]) -> Vec<(String, f64)> {
        named_rad.iter().map(|(name, angle_rad)| ((*name).to_owned(), *angle_rad)).collect()
    }

    /// Angle with this name.
    pub fn angle_rad(&self, name: &str) -> Option<f64> {
        self.angles_rad.iter().find(|(own, _)| own == name).map(|(_, angle_rad)| *angle_rad)
    }
}

/// A body whose first segment is fixed to a frame: the vehicle, whose path is then that of a pendulum or a sled, or
/// space.
#[derive(Clone, Debug, PartialEq)]
pub struct Mounting {
    /// The frame.
    pub frame: Frame,
    /// Mounting point from the segment's lower end, segment axes, m.
    pub point_m: Vector3<f64>,
    /// Position of that point in the frame, m.
    pub place_m: Vector3<f64>,
    /// Rotation of the segment from upright, facing forward as in a vehicle.
    pub attitude: Attitude,
    /// Angles of the other segments and of hinges, named as in [`Seating::angles_rad`], in the plane that the mount
    /// faces.
    pub angles_rad: Vec<(String, f64)>,
}

impl Mounting {
    /// Motion of its frame, given the vehicle's.
    pub(crate) fn carrier(&self, vehicle: &FrameMotion) -> FrameMotion {
        if self.frame == Frame::Vehicle { *vehicle } else { FrameMotion::space() }
    }

    /// Rotation from forward-facing vehicle axes to axes of the frame, for a mount turned by `attitude`.
    pub(crate) fn facing(&self, attitude: &Attitude) -> Matrix3<f64> {
        // of a vehicle that stands in space: F·A
        let axes = if self.frame == Frame::Vehicle { Matrix3::identity() } else { upright() };
        axes * attitude.matrix()
    }

    /// Mount for the kernel, of a segment whose joint is at `joint_m` from its lower end.
    pub(crate) fn mount(&self, joint_m: Vector3<f64>) -> Mount<f64> {
        let frame = if self.frame == Frame::Vehicle { VEHICLE } else { SPACE };
        let axes = self.facing(&self.attitude) * upright();
        let place = self.place_m + axes * (joint_m - self.point_m);
        Mount { frame, place: V3::of(&place), axes: M3::of(&axes) }
    }
}

/// F: axes of an upright, forward-facing body (X forward, Y left, Z up) in vehicle axes, and vice versa.
pub(crate) fn upright() -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0))
}

/// Angle with a name, given for it alone or for both sides.
pub(crate) fn angle_of(angles_rad: &[(String, f64)], name: &str) -> Option<f64> {
    let said = |name: &str| angles_rad.iter().find(|(own, _)| own == name).map(|(_, angle_rad)| *angle_rad);
    said(name).or_else(|| said(&both_sides(name)?))
}

/// A body that is placed and released.
#[derive(Clone, Debug, PartialEq)]
pub struct Placing {
    /// Position and posture.
    pub at: Mounting,
    /// Whether it is lowered or raised until the ground carries its weight.
    pub stands: bool,
    /// Angular velocity of the whole body about its placing point, axes of the frame, rad/s.
    pub spin_rad_s: Vector3<f64>,
}

/// Position of the body at the start.
#[derive(Clone, Debug, PartialEq)]
pub enum InitialPosture {
    /// Seated by the rules of the report.
    Seated(Seating),
    /// Mounted on a rig.
    Mounted(Box<Mounting>),
    /// Placed as on a rig and released; [`InitialVelocity::Given`] is then relative to its vehicle.
    Placed(Box<Placing>),
    /// Several bodies, each as in [`Setup::members`](crate::model::setup::Setup::members).
    Together,
    /// Generalized coordinates of the report; their rates replace [`InitialVelocity`].
    Coordinates(Box<ReportCoordinates>),
    /// End of an earlier run, as far as cards give it (series 6 and 14). They do not contain largest deformations.
    Continued {
        /// As in [`InitialPosture::Coordinates`].
        coordinates: Box<ReportCoordinates>,
        /// Spheres and surfaces (indices) that have passed each other; all other overlapping pairs are in contact.
        passed: Vec<(usize, usize)>,
    },
}

/// Velocity of a seated body at the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum InitialVelocity {
    /// All points move with the vehicle.
    #[default]
    WithVehicle,
    /// All points have the velocity of the vehicle's origin; angular velocities are zero.
    VehicleOrigin,
    /// All points have this velocity, vehicle axes, m/s; angular velocities are zero.
    Given(Vector3<f64>),
}

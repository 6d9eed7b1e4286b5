//! How the body starts: posture, place and velocity, as data.
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

/// Where on what the body sits and how it holds itself. Angles as in Fig. 19: γ > 0 leans the top back.
#[derive(Clone, Debug, PartialEq)]
pub struct Seating {
    /// Index of the cushion: a surface, or a solid behind all surfaces.
    pub cushion: usize,
    /// Index of the seat back in the same way.
    pub back: usize,
    /// Lateral place of the body's middle plane, Y_v (right positive).
    pub lateral_m: f64,
    /// Angles under the names of segments, which lean by γ, and of hinges, which turn by α: `head`, or `upper_arms` for
    /// both. Other segments are aligned with their parent; heels determine the legs.
    pub angles_rad: Vec<(String, f64)>,
    /// X_VH, Z_VH: the heels in vehicle axes.
    pub heels_m: [f64; 2],
    /// X, Z of both hands in vehicle axes, elbows below; angles of the arms say where they are if absent.
    pub hands_m: Option<[f64; 2]>,
    /// What is moved from there.
    pub settle: Settling,
}

/// What is moved of a seated body until contacts, belts and weight balance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Settling {
    /// Nothing, as the report seats a body.
    Not,
    /// The body as one piece, its joints locked.
    #[default]
    Locked,
    /// Every joint, as of one who sleeps.
    Limp,
}

impl Seating {
    /// Angles under their names.
    pub fn angles(named_rad: &[(&str, f64)]) -> Vec<(String, f64)> {
        named_rad.iter().map(|(name, angle_rad)| ((*name).to_owned(), *angle_rad)).collect()
    }

    /// The angle under this name.
    pub fn angle_rad(&self, name: &str) -> Option<f64> {
        self.angles_rad.iter().find(|(own, _)| own == name).map(|(_, angle_rad)| *angle_rad)
    }
}

/// A body whose first segment is fixed to a frame: the vehicle, whose path is then that of a pendulum or a sled, or space.
#[derive(Clone, Debug, PartialEq)]
pub struct Mounting {
    /// The frame.
    pub frame: Frame,
    /// The point of the segment that it is held by, from the segment's lower end, segment axes, m.
    pub point_m: Vector3<f64>,
    /// Where that point is in the frame, m.
    pub place_m: Vector3<f64>,
    /// How the segment is turned from facing forward upright, as a vehicle is.
    pub attitude: Attitude,
    /// Angles under the names of the other segments and of hinges as in [`Seating::angles_rad`], in the plane that the mount
    /// faces.
    pub angles_rad: Vec<(String, f64)>,
}

impl Mounting {
    /// Motion of its frame; `vehicle` is the vehicle's.
    pub(crate) fn carrier(&self, vehicle: &FrameMotion) -> FrameMotion {
        if self.frame == Frame::Vehicle { *vehicle } else { FrameMotion::space() }
    }

    /// Turns what faces forward in a vehicle into axes of the frame, where the mount is turned by `attitude`.
    pub(crate) fn facing(&self, attitude: &Attitude) -> Matrix3<f64> {
        // of a vehicle that stands in space: F·A
        let axes = if self.frame == Frame::Vehicle { Matrix3::identity() } else { upright() };
        axes * attitude.matrix()
    }

    /// What the kernel has of it for a segment whose joint is at `joint_m` from its lower end.
    pub(crate) fn mount(&self, joint_m: Vector3<f64>) -> Mount<f64> {
        let frame = if self.frame == Frame::Vehicle { VEHICLE } else { SPACE };
        let axes = self.facing(&self.attitude) * upright();
        let place = self.place_m + axes * (joint_m - self.point_m);
        Mount { frame, place: V3::of(&place), axes: M3::of(&axes) }
    }
}

/// F: axes of an upright body that faces forward (X ahead, Y left, Z up) in those of a vehicle, and the other way round.
pub(crate) fn upright() -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0))
}

/// The angle under a name, said of it alone or of both sides.
pub(crate) fn angle_of(angles_rad: &[(String, f64)], name: &str) -> Option<f64> {
    let said = |name: &str| angles_rad.iter().find(|(own, _)| own == name).map(|(_, angle_rad)| *angle_rad);
    said(name).or_else(|| said(&both_sides(name)?))
}

/// A body that is put somewhere and let go.
#[derive(Clone, Debug, PartialEq)]
pub struct Placing {
    /// Where, and how it holds itself.
    pub at: Mounting,
    /// Whether it is lowered, or raised, until what it stands on carries its weight.
    pub stands: bool,
    /// Angular velocity of all of it about the point that it is put by, axes of the frame, rad/s.
    pub spin_rad_s: Vector3<f64>,
}

/// Position of the body at the start.
#[derive(Clone, Debug, PartialEq)]
pub enum InitialPosture {
    /// Seated by the rules of the report.
    Seated(Seating),
    /// Held by a rig.
    Mounted(Box<Mounting>),
    /// Put somewhere as a rig would hold it, and let go; [`InitialVelocity::Given`] is then the velocity beside its vehicle's.
    Placed(Box<Placing>),
    /// Each of several bodies as [`Setup::members`](crate::model::setup::Setup::members) say.
    Together,
    /// Given in the report's generalized coordinates; their rates replace [`InitialVelocity`].
    Coordinates(Box<ReportCoordinates>),
    /// Where an earlier run ended, as far as cards tell it (series 6 and 14). They carry no largest deformation.
    Continued {
        /// As in [`InitialPosture::Coordinates`].
        coordinates: Box<ReportCoordinates>,
        /// Spheres and surfaces (indices) that have passed each other; all others that overlap touch.
        passed: Vec<(usize, usize)>,
    },
}

/// Velocity of a seated body at the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum InitialVelocity {
    /// Every point moves as if fixed to the vehicle.
    #[default]
    WithVehicle,
    /// Every point has the velocity of the vehicle's origin; angular velocities are zero.
    VehicleOrigin,
    /// Every point has this velocity, vehicle axes, m/s; angular velocities are zero.
    Given(Vector3<f64>),
}

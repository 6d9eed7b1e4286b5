//! How the body starts: posture, place and velocity, as data.
//!
//! Report: "Initial Position of Passenger", Figs 19 and 20.

use nalgebra::Vector3;

use crate::body::both_sides;
use crate::motion::report_coordinates::ReportCoordinates;

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
    /// both. A segment of which nothing is said hangs as the one that carries it; heels say where the legs are.
    pub angles_rad: Vec<(String, f64)>,
    /// X_VH, Z_VH: the heels in vehicle axes.
    pub heels_m: [f64; 2],
    /// Move the seated body as one piece until contact and belt forces carry it.
    pub settle: bool,
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

    /// The angle of what has this name, said of it alone or of both sides.
    pub(crate) fn angle_of(&self, name: &str) -> Option<f64> {
        self.angle_rad(name).or_else(|| self.angle_rad(&both_sides(name)?))
    }
}

/// Position of the body at the start.
#[derive(Clone, Debug, PartialEq)]
pub enum InitialPosture {
    /// Seated by the rules of the report.
    Seated(Seating),
    /// Given in the report's generalized coordinates; their rates replace [`InitialVelocity`].
    Coordinates(Box<ReportCoordinates>),
    /// Where an earlier run ended, as far as cards tell it (series 6 and 14). They carry no greatest deformation.
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

//! How the body starts: posture, place and velocity, as data.
//!
//! Report: "Initial Position of Passenger", Figs 19 and 20.

use nalgebra::Vector3;

use crate::motion::report_coordinates::ReportCoordinates;

/// Where on what the body sits and how it holds itself. Angles as in Fig. 19: γ > 0 leans the top back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seating {
    /// Index of the cushion: a surface, or a solid behind all surfaces.
    pub cushion: usize,
    /// Index of the seat back in the same way.
    pub back: usize,
    /// Lateral place of the body's middle plane, Y_v (right positive).
    pub lateral_m: f64,
    /// γ₁ middle torso, γ₂ upper torso, γ₃ head, γ₄ lower torso.
    pub lean_rad: [f64; 4],
    /// γ₅, both upper arms.
    pub upper_arms_rad: f64,
    /// α of both elbows; negative brings the hands forward.
    pub elbows_rad: f64,
    /// X_VH, Z_VH: the heels in vehicle axes.
    pub heels_m: [f64; 2],
    /// Move the seated body as one piece until contact and belt forces carry it.
    pub settle: bool,
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

//! The plain reference: the report's equations of motion, written from its text and differentiated exactly.
//!
//! Source: R. D. Young, Research Report 140-2, Texas Transportation Institute, 1970, Eqs 1–77. Nothing here is fast and
//! nothing is shared with the simulator but the description of the body and its joints: place and turn of the segments
//! stand as printed, the energies as printed, and Lagrange's equations (Eq. 47) are applied to them by automatic
//! differentiation. Appendix III, the hand-derived result, is not used. The formulas hold in any consistent units.
//!
//! Departures: bars that Eqs 14–15 lost in print are restored, so is the sign in Eq. 46a; gravity is a vector, so that a
//! whole scene can be turned; ε, stops and twist follow the decisions of the joint model (ε = 0: the report's).

mod dual;
mod energy;
mod equations;
mod forces;
mod geometry;
mod joints;
mod motion;
mod vector;

pub use dual::{Dual, Number};
pub use energy::{gravity_energy, kinetic_energy, spine_energy};
pub use equations::{Equations, equations_of_motion};
pub use forces::{PointForce, contact_forces};
pub use geometry::{Pose, pose};
pub use joints::{ball, damping_forces, hinge, joint_angle};
pub use motion::{FREE, HINGED, SpaceMotion, space_accelerations, space_velocities};
pub use vector::Vector;

use nalgebra::Vector3;
use occupant_core::body::Body;
use occupant_core::forces::joint::Joints;

/// Number of generalized coordinates.
pub const DOF: usize = 31;

/// Everything that acts on the motion, besides the state itself.
#[derive(Clone, Debug)]
pub struct System {
    /// Masses and geometry.
    pub body: Body,
    /// Dampers, stops and springs; a spring needs its rest angle.
    pub joints: Joints,
    /// Acceleration of gravity in space axes, (0, 0, −g) in the report.
    pub gravity: Vector3<f64>,
    /// External forces.
    pub forces: Vec<PointForce>,
}

//! External forces as generalized forces: Eqs 63–68.

use super::{DOF, equations::varied, geometry::pose, vector::Vector};
use nalgebra::Vector3;
use occupant_core::body::{Body, Segment};

/// A force on a point of a segment.
#[derive(Clone, Debug, PartialEq)]
pub struct PointForce {
    /// The segment.
    pub segment: Segment,
    /// The point in segment axes, measured from the lower end: sphere centre + r.
    pub point: Vector3<f64>,
    /// The force in space axes.
    pub force: Vector3<f64>,
}

/// Q_f, Eq. 68.
pub fn contact_forces(body: &Body, forces: &[PointForce], q: &[f64; DOF]) -> [f64; DOF] {
    std::array::from_fn(|j| {
        let pose = pose(body, &varied(q, j));
        let work = |f: &PointForce| {
            let axes = pose.axes[f.segment.index()];
            // (65): X'_A = X' of the lower end + [T] (centre + r)
            let point =
                pose.lower_end[f.segment.index()] + f.point.x * axes.x + f.point.y * axes.y + f.point.z * axes.z;
            Vector::constant(&f.force).dot(point.slope())
        };
        forces.iter().map(work).sum()
    })
}

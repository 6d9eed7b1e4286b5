//! Mobility of the body: accelerations for unit loads in the initial posture.
//!
//! The equations of motion are linear in the loads, so the difference of two solutions is the exact response; at rest
//! there is no velocity term. Ours; the report has no such estimate.

use nalgebra::{Matrix3, SymmetricEigen, Vector3};

use crate::motion::dynamics::{Accelerations, Wrench, solve};
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::{MOST_HINGES, MOST_SEGMENTS};
use crate::motion::skeleton::Skeleton;
use crate::motion::state::State;
use crate::motion::vector::V3;

/// Inverse inertias of the body at the start of a run.
#[derive(Clone, Debug)]
pub struct Mobility<'a> {
    pub(crate) skeleton: &'a Skeleton<f64>,
    pub(crate) kinematics: Kinematics<f64>,
    pub(crate) unloaded: Accelerations<f64>,
}

impl<'a> Mobility<'a> {
    /// Those of a body in its initial position.
    pub(crate) fn new(skeleton: &'a Skeleton<f64>, start: &State<f64>) -> Self {
        let kinematics = Kinematics::new(skeleton, &start.still());
        let unloaded = solve(skeleton, &kinematics, &[0.0; MOST_HINGES], &[Wrench::zero(); MOST_SEGMENTS]);
        Mobility { skeleton, kinematics, unloaded }
    }

    /// Acceleration of a point of a segment for a unit force there, space axes, 1/kg.
    pub(crate) fn of_point(&self, segment: usize, point: V3<f64>) -> Matrix3<f64> {
        let arm = point - self.kinematics.joint[segment];
        let column = |force: V3<f64>| {
            let mut loads = [Wrench::zero(); MOST_SEGMENTS];
            loads[segment] = Wrench { force, moment: arm.cross(force) };
            let loaded = self.loaded(&loads);
            let joint = loaded.joint[segment] - self.unloaded.joint[segment];
            let alpha = loaded.alpha[segment] - self.unloaded.alpha[segment];
            (joint + alpha.cross(arm)).to_vector()
        };
        symmetric(column)
    }

    /// Angular acceleration of `outer` relative to `inner` for a unit moment between them, space axes, 1/(kg·m²).
    pub(crate) fn of_joint(&self, inner: usize, outer: usize) -> Matrix3<f64> {
        let relative = |a: &Accelerations<f64>| a.alpha[outer] - a.alpha[inner];
        let column = |moment: V3<f64>| {
            let mut loads = [Wrench::zero(); MOST_SEGMENTS];
            loads[outer].moment = moment;
            loads[inner].moment = -moment;
            (relative(&self.loaded(&loads)) - relative(&self.unloaded)).to_vector()
        };
        symmetric(column)
    }

    /// α̈ of a hinge, by its index in the state, for a unit moment in it, 1/(kg·m²).
    pub(crate) fn of_hinge(&self, hinge: usize) -> f64 {
        let lower = self.skeleton.layout.hinged()[hinge];
        let upper = self.skeleton.layout.parent(lower).unwrap_or(lower);
        let axis = self.kinematics.hinge_axis[hinge];
        let mut loads = [Wrench::zero(); MOST_SEGMENTS];
        loads[lower].moment = axis;
        loads[upper].moment = -axis;
        self.loaded(&loads).hinge[hinge] - self.unloaded.hinge[hinge]
    }

    pub(crate) fn loaded(&self, loads: &[Wrench<f64>; MOST_SEGMENTS]) -> Accelerations<f64> {
        solve(self.skeleton, &self.kinematics, &[0.0; MOST_HINGES], loads)
    }
}

/// Matrix of a linear response, symmetrized against rounding.
fn symmetric(column: impl Fn(V3<f64>) -> Vector3<f64>) -> Matrix3<f64> {
    let unit = |i: usize| V3::of(&Vector3::ith(i, 1.0));
    let matrix = Matrix3::from_columns(&[column(unit(0)), column(unit(1)), column(unit(2))]);
    (matrix + matrix.transpose()) * 0.5
}

/// Largest eigenvalue of a symmetric matrix.
pub(crate) fn greatest(matrix: Matrix3<f64>) -> f64 {
    SymmetricEigen::new(matrix).eigenvalues.max()
}

/// Part of a mobility perpendicular to `normal`.
pub(crate) fn across(mobility: &Matrix3<f64>, normal: &Vector3<f64>) -> Matrix3<f64> {
    let plane = Matrix3::identity() - normal * normal.transpose();
    plane * mobility * plane
}

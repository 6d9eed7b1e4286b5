//! A state without Euler angles, and its way to report coordinates where these are regular.

use crate::reference::{DOF, FREE, SpaceMotion, pose, space_velocities};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use occupant_core::body::Body;

/// Place, orientations (segment axes to space axes), hinge angles and speeds, in the order of [`FREE`] and of
/// [`crate::reference::HINGED`].
#[derive(Clone, Copy, Debug)]
pub struct SpaceState {
    /// T1.
    pub t1: Vector3<f64>,
    /// Orientations of the free segments.
    pub turn: [UnitQuaternion<f64>; 8],
    /// α.
    pub hinge: [f64; 4],
    /// Ṫ1, ω in space axes, α̇.
    pub speed: SpaceMotion,
}

impl SpaceMotion {
    /// The same motion in a scene turned by `r`.
    pub fn turned(&self, r: &UnitQuaternion<f64>) -> SpaceMotion {
        SpaceMotion { t1: r * self.t1, angular: self.angular.map(|w| r * w), hinge: self.hinge }
    }

    /// 31 numbers.
    pub fn numbers(&self) -> Vec<f64> {
        let vectors = std::iter::once(&self.t1).chain(&self.angular);
        let components = vectors.flat_map(|v| v.iter().copied());
        components.chain(self.hinge).collect()
    }
}

impl SpaceState {
    /// The state that belongs to report coordinates.
    pub fn from_report(body: &Body, q: &[f64; DOF], rates: &[f64; DOF]) -> SpaceState {
        let pose = pose(body, q);
        let turn = FREE.map(|segment| {
            let t = pose.axes[segment.index()];
            let columns = [t.x, t.y, t.z].map(Vector3::from);
            let matrix = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&columns));
            UnitQuaternion::from_rotation_matrix(&matrix)
        });
        SpaceState {
            t1: Vector3::new(q[0], q[1], q[2]),
            turn,
            hinge: [q[21], q[22], q[29], q[30]],
            speed: space_velocities(q, rates),
        }
    }

    /// q and q̇; meaningless where a free segment is vertical.
    pub fn to_report(&self) -> ([f64; DOF], [f64; DOF]) {
        let (mut q, mut rates) = ([0.0; DOF], [0.0; DOF]);
        for i in 0..3 {
            (q[i], rates[i]) = (self.t1[i], self.speed.t1[i]);
        }
        for (i, first) in [4, 7, 10, 13, 16, 19, 24, 27].into_iter().enumerate() {
            let (angles, angle_rates) = euler(&self.turn[i], &self.speed.angular[i]);
            q[first - 1..first + 2].copy_from_slice(&angles);
            rates[first - 1..first + 2].copy_from_slice(&angle_rates);
        }
        for (i, number) in [22, 23, 30, 31].into_iter().enumerate() {
            q[number - 1] = self.hinge[i];
            rates[number - 1] = self.speed.hinge[i];
        }
        (q, rates)
    }

    /// The same state in a scene turned by `r` about the origin.
    pub fn turned(&self, r: &UnitQuaternion<f64>) -> SpaceState {
        SpaceState {
            t1: r * self.t1,
            turn: self.turn.map(|turn| r * turn),
            hinge: self.hinge,
            speed: self.speed.turned(r),
        }
    }
}

/// φ, θ, ψ of Eq. 6 and their rates from ω = φ̇ Z' + θ̇ Y_n1 + ψ̇ Z_n.
fn euler(turn: &UnitQuaternion<f64>, omega: &Vector3<f64>) -> ([f64; 3], [f64; 3]) {
    let t = turn.to_rotation_matrix();
    let phi = t[(1, 2)].atan2(t[(0, 2)]); // (6c, f)
    let theta = t[(0, 2)].hypot(t[(1, 2)]).atan2(t[(2, 2)]); // (6c, f, i)
    let psi = t[(2, 1)].atan2(-t[(2, 0)]); // (6g, h)
    let y_n1 = Vector3::new(-phi.sin(), phi.cos(), 0.0);
    let axes = Matrix3::from_columns(&[Vector3::z(), y_n1, turn * Vector3::z()]);
    let rates = axes.lu().solve(omega).unwrap_or(Vector3::repeat(f64::NAN));
    ([phi, theta, psi], rates.into())
}

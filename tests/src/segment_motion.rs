//! Motion of every segment from its place and turn alone: differentiated twice, ω from ω× = Ṫ Tᵀ.
//!
//! Neither an energy nor Eqs 44–46 enter, so that it checks both the reference and the simulator.

use crate::reference::{DOF, Dual, Number, Pose, pose};
use nalgebra::{Matrix3, Vector3};
use occupant_core::body::{Body, SEGMENTS};

/// One segment's motion in space axes, from its place and turn alone.
pub struct SegmentMotion {
    /// Segment axes to space axes.
    pub turn: Matrix3<f64>,
    /// Of the centre of gravity, as all that follows of points.
    pub place: Vector3<f64>,
    /// ẋ.
    pub velocity: Vector3<f64>,
    /// ẍ.
    pub acceleration: Vector3<f64>,
    /// ω.
    pub omega: Vector3<f64>,
    /// ω̇.
    pub alpha: Vector3<f64>,
    /// About the centre of gravity, space axes.
    pub inertia: Matrix3<f64>,
    /// I ω̇ + ω × I ω.
    pub moment: Vector3<f64>,
}

/// Motion of all segments for given q, q̇ and q̈.
pub fn segment_motions(
    body: &Body,
    q: &[f64; DOF],
    rates: &[f64; DOF],
    accelerations: &[f64; DOF],
) -> [SegmentMotion; SEGMENTS] {
    let pose = moving_pose(body, q, rates, accelerations);
    std::array::from_fn(|i| {
        let turn = matrix(&pose, i, |x| x.value.value);
        let turn_rate = matrix(&pose, i, |x| x.slope.value);
        let turn_second = matrix(&pose, i, |x| x.slope.slope);
        let principal = body.segments[i].inertia_kg_m2;
        let inertia = turn * Matrix3::from_diagonal(&principal) * turn.transpose();
        let omega = axial(&(turn_rate * turn.transpose()));
        let alpha = axial(&(turn_second * turn.transpose()));
        SegmentMotion {
            turn,
            place: Vector3::from(pose.cg[i].0.map(|x| x.value.value)),
            velocity: Vector3::from(pose.cg[i].0.map(|x| x.slope.value)),
            acceleration: Vector3::from(pose.cg[i].0.map(|x| x.slope.slope)),
            omega,
            alpha,
            inertia,
            moment: inertia * alpha + omega.cross(&(inertia * omega)),
        }
    })
}

fn matrix<T: Number>(pose: &Pose<T>, segment: usize, part: impl Fn(T) -> f64) -> Matrix3<f64> {
    let t = pose.axes[segment];
    Matrix3::from_columns(&[t.x, t.y, t.z].map(|column| Vector3::from(column.0.map(&part))))
}

/// ω of ω×.
fn axial(m: &Matrix3<f64>) -> Vector3<f64> {
    0.5 * Vector3::new(m[(2, 1)] - m[(1, 2)], m[(0, 2)] - m[(2, 0)], m[(1, 0)] - m[(0, 1)])
}

/// The pose and its first and second time derivatives.
fn moving_pose(body: &Body, q: &[f64; DOF], rates: &[f64; DOF], second: &[f64; DOF]) -> Pose<Dual<Dual<f64>>> {
    let moving = std::array::from_fn(|j| Dual::new(Dual::new(q[j], rates[j]), Dual::new(rates[j], second[j])));
    pose(body, &moving)
}

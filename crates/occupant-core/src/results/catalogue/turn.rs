//! Rotations of segments and joints, and positions along axes that do not turn.
//!
//! A rotation is a rotation vector: its direction is the axis, its length the angle, 0 to π rad. In a plane it is the
//! angle. Nothing here is relative to the start of a run, so derivatives by the initial state are valid.

use nalgebra::{Matrix3, Vector3};
use occupant_units::unit::Unit::{Metre, Radian};

use super::body::OfSegment;
use super::joint::OfJoint;
use crate::body::tree::{Joint, Segment};
use crate::quantity::{Axes, Quantity, to_j211};
use crate::results::sample::Sample;
use crate::vehicle::{FrameMotion, PathCursor, rotation_vector};

type Of = Quantity<OfSegment>;
type Joined = Quantity<OfJoint>;

/// Of a segment.
pub(super) const SEGMENT: &[Of] = &[
    Of::vector(Radian, Axes::Vehicle, |(s, n)| from_upright(s, *n, &home_at_start(s, *n))).channel(
        "rotation",
        "rotation of the {} in space from upright and facing forward, as a rotation vector in the vehicle's initial axes: +y leans its top back",
    ),
    Of::vector(Radian, Axes::Vehicle, |(s, n)| from_upright(s, *n, &home(s, *n))).channel(
        "rotation_in_vehicle",
        "rotation of the {} relative to the vehicle from upright and facing forward, as a rotation vector in vehicle axes: +y leans its top back",
    ),
    Of::vector(Metre, Axes::Vehicle, |(s, n)| from_vehicle(s, *n)).channel(
        "level_position",
        "position of the centre of gravity of the {} from the vehicle's origin, in the vehicle's initial axes",
    ),
];

/// Of a joint.
pub(super) const JOINT: &[Joined] =
    &[Joined::vector(Radian, Axes::J211, |(s, joint)| to_j211(in_joint(s, *joint))).channel(
        "rotation",
        "rotation of the distal segment of the {} relative to the proximal one, as a rotation vector in the proximal segment's SAE J211 axes",
    )];

/// Home frame of the segment's body at the start.
fn home_at_start(s: &Sample<'_>, segment: Segment) -> FrameMotion {
    let (t_s, cursor) = (s.model.setup().time.start_s, &mut PathCursor::default());
    let homes = s.model.homes(&s.model.frames(t_s, t_s, cursor), &s.model.vehicle(t_s, t_s, cursor));
    homes[s.model.body().tree.body_of(segment)]
}

fn home(s: &Sample<'_>, segment: Segment) -> FrameMotion {
    s.homes[s.model.body().tree.body_of(segment)]
}

/// Axes of a segment, space axes.
fn axes(s: &Sample<'_>, segment: Segment) -> Matrix3<f64> {
    s.evaluation.kinematics.axes[segment.index()].to_matrix()
}

/// Rotation from upright, where a segment has X forward, Y left and Z up and the vehicle X forward, Y right and Z down.
fn from_upright(s: &Sample<'_>, segment: Segment, home: &FrameMotion) -> Vector3<f64> {
    rotation_vector(&(home.rotation.tr_mul(&axes(s, segment)) * Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0))))
}

fn from_vehicle(s: &Sample<'_>, segment: Segment) -> Vector3<f64> {
    let cg_m = s.evaluation.kinematics.cg(&s.model.system().skeleton, segment.index()).to_vector();
    home_at_start(s, segment).vector_to_frame(cg_m - home(s, segment).origin_m)
}

fn in_joint(s: &Sample<'_>, joint: Joint) -> Vector3<f64> {
    let row = &s.model.body().tree[joint];
    rotation_vector(&axes(s, row.proximal).tr_mul(&axes(s, row.distal)))
}

//! How far segments and joints have turned since the start of the run, and places along axes that do not turn.
//!
//! A turn is a rotation vector: its direction is the axis, its length the angle, 0 to π rad. In a plane it is the angle.

use nalgebra::{Matrix3, Rotation3, Vector3};
use occupant_units::unit::Unit::{Metre, Radian};

use super::body::OfSegment;
use super::joint::OfJoint;
use crate::body::tree::{Joint, Segment};
use crate::motion::kinematics::Kinematics;
use crate::motion::vector::M3;
use crate::quantity::{Axes, Quantity, to_j211};
use crate::results::sample::Sample;
use crate::vehicle::{FrameMotion, PathCursor};

type Of = Quantity<OfSegment>;
type Joined = Quantity<OfJoint>;

/// Of a segment.
pub(super) const SEGMENT: &[Of] = &[
    Of::vector(Radian, Axes::Vehicle, |(s, n)| in_space(s, *n)).channel(
        "rotation",
        "turn of the {} in space since the start, a rotation vector along the axes that the vehicle had then: +y leans its top back",
    ),
    Of::vector(Radian, Axes::Vehicle, |(s, n)| in_vehicle(s, *n)).channel(
        "rotation_in_vehicle",
        "turn of the {} as the vehicle sees it since the start, a rotation vector along the vehicle's axes: +y leans its top back",
    ),
    Of::vector(Metre, Axes::Vehicle, |(s, n)| from_vehicle(s, *n)).channel(
        "level_position",
        "place of the centre of gravity of the {} from the vehicle's origin, along the axes that the vehicle had at the start",
    ),
];

/// Of a joint.
pub(super) const JOINT: &[Joined] =
    &[Joined::vector(Radian, Axes::J211, |(s, joint)| to_j211(in_joint(s, *joint))).channel(
        "rotation",
        "turn of the distal segment of the {} against the proximal one since the start, a rotation vector along the proximal one's SAE J211 axes",
    )];

/// Orientations of segments at the start, space axes.
fn at_start(s: &Sample<'_>) -> Kinematics<f64> {
    Kinematics::new(&s.model.system().skeleton, &s.model.start().state)
}

/// The home of a segment's body at the start.
fn home_at_start(s: &Sample<'_>, segment: Segment) -> FrameMotion {
    let (t_s, cursor) = (s.model.setup().time.start_s, &mut PathCursor::default());
    let homes = s.model.homes(&s.model.frames(t_s, t_s, cursor), &s.model.vehicle(t_s, t_s, cursor));
    homes[s.model.body().tree.body_of(segment)]
}

fn home(s: &Sample<'_>, segment: Segment) -> FrameMotion {
    s.homes[s.model.body().tree.body_of(segment)]
}

/// The turn from one orientation to another, along the axes that both are told in.
fn turn(from: &Matrix3<f64>, to: &Matrix3<f64>) -> Vector3<f64> {
    Rotation3::from_matrix_unchecked(to * from.transpose()).scaled_axis()
}

fn matrix(axes: &M3<f64>) -> Matrix3<f64> {
    axes.to_matrix()
}

fn in_space(s: &Sample<'_>, segment: Segment) -> Vector3<f64> {
    let n = segment.index();
    let turned = turn(&matrix(&at_start(s).axes[n]), &matrix(&s.evaluation.kinematics.axes[n]));
    home_at_start(s, segment).vector_to_frame(turned)
}

fn in_vehicle(s: &Sample<'_>, segment: Segment) -> Vector3<f64> {
    let n = segment.index();
    let from = home_at_start(s, segment).rotation.tr_mul(&matrix(&at_start(s).axes[n]));
    let to = home(s, segment).rotation.tr_mul(&matrix(&s.evaluation.kinematics.axes[n]));
    turn(&from, &to)
}

fn from_vehicle(s: &Sample<'_>, segment: Segment) -> Vector3<f64> {
    let cg_m = s.evaluation.kinematics.cg(&s.model.system().skeleton, segment.index()).to_vector();
    home_at_start(s, segment).vector_to_frame(cg_m - home(s, segment).origin_m)
}

fn in_joint(s: &Sample<'_>, joint: Joint) -> Vector3<f64> {
    let row = &s.model.body().tree[joint];
    let relative =
        |k: &Kinematics<f64>| matrix(&k.axes[row.proximal.index()]).tr_mul(&matrix(&k.axes[row.distal.index()]));
    turn(&relative(&at_start(s)), &relative(&s.evaluation.kinematics))
}

//! Angles and loads of the joints.

use occupant_units::unit::Unit::{Newton, NewtonMetre, Radian};

use crate::body::tree::{Joint, Tree};
use crate::quantity::{Axes, Owner, Quantity};
use crate::results::reaction::reaction;
use crate::results::sample::Sample;

/// A joint.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfJoint;

impl Owner for OfJoint {
    type At<'a> = (&'a Sample<'a>, Joint);
}

type Of = Quantity<OfJoint>;

/// Field of the message `JointAngles`, one for each joint of a body: its number is the report's joint number + 1.
pub(super) fn angle(tree: &Tree, joint: Joint) -> Of {
    let row = &tree[joint];
    let body = tree.body_of(row.distal);
    let of_body = tree.joints().take_while(|j| *j != joint).filter(|j| tree.body_of(tree[*j].distal) == body).count();
    let (history, meaning) = if !row.is_hinge() {
        ("β of the {}", "β, angle between the Z axes of the two segments")
    } else if tree.landmarks().arms().any(|arm| arm.lower == row.distal) {
        ("α of the {}", "α about Y; negative brings the hand forward")
    } else {
        ("α of the {}", "α about Y; positive brings the heel back")
    };
    Of::number(Radian, |(s, joint)| s.joint_angle_rad(*joint)).channel("angle", history).field(
        of_body as u32 + 2,
        row.name.rsplit('.').next().unwrap_or(row.name),
        meaning,
    )
}

/// Message `JointLoad`.
pub(super) const LOAD: &[Of] = &[
    Of::vector(Newton, Axes::Segment, |(s, joint)| reaction(s, *joint).force_n)
        .channel("force", "force that the proximal segment of the {} exerts on the distal one, in its axes")
        .field(2, "force", "force that the proximal segment exerts on the distal one, in axes of the distal segment"),
    Of::vector(NewtonMetre, Axes::Segment, |(s, joint)| reaction(s, *joint).moment_n_m)
        .channel("moment", "moment that the proximal segment of the {} exerts on the distal one, in its axes")
        .field(
            3,
            "moment",
            "moment that the proximal segment exerts on the distal one; damper, stop and spring are part of it",
        ),
];

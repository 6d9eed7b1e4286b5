//! Loads of the joints: forces and moments between the two segments of a joint.
//!
//! By `kernel::carried`. The moment of a ball joint is that of its damper, stop, spring and muscle, because the joint
//! constrains no rotation; a hinge adds the two constraint moments across its axis.

use nalgebra::Vector3;

use crate::body::{Joint, Limb, Segment};
use crate::kernel::carried::Carried;
use crate::kernel::instruments::FEMURS;
use crate::motion::dynamics::Wrench;
use crate::results::sample::Sample;

/// Force and moment that the proximal segment of a joint exerts on the distal one, at the joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reaction {
    /// In axes of the distal segment, N.
    pub force_n: Vector3<f64>,
    /// In axes of the distal segment, N·m, including damper, stop and spring.
    pub moment_n_m: Vector3<f64>,
}

/// Reaction of `joint` in `sample`.
pub fn reaction(sample: &Sample<'_>, joint: Joint) -> Reaction {
    Loads::new(sample).reaction(joint)
}

/// Loads of joints at an output.
pub(super) struct Loads<'s, 'a> {
    sample: &'s Sample<'a>,
    carried: Carried<'s, f64>,
}

impl<'s, 'a> Loads<'s, 'a> {
    pub(super) fn new(sample: &'s Sample<'a>) -> Self {
        let skeleton = &sample.model.system().skeleton;
        Loads { sample, carried: Carried::of_evaluation(skeleton, sample.evaluation) }
    }

    /// Load of segment `n` at its proximal joint, space axes.
    fn at(&self, n: usize) -> Wrench<f64> {
        self.carried.at(n, self.carried.skeleton.layout.subtree(n))
    }

    /// [`reaction`] of `joint`.
    pub(super) fn reaction(&self, joint: Joint) -> Reaction {
        self.along(self.sample.model.body().tree[joint].distal, self.on_distal(joint))
    }

    /// Load of the proximal segment of a joint on the distal one, at the joint, space axes.
    fn on_distal(&self, joint: Joint) -> Wrench<f64> {
        let row = &self.sample.model.body().tree[joint];
        let load = self.at(row.carrying()[1].index());
        if row.is_reversed() { Wrench { force: -load.force, moment: -load.moment } } else { load }
    }

    /// A load in the axes of a segment.
    fn along(&self, segment: Segment, load: Wrench<f64>) -> Reaction {
        let (force, moment) = load.into_frame(&self.sample.evaluation.kinematics.axes[segment.index()]);
        Reaction { force_n: force.to_vector(), moment_n_m: moment.to_vector() }
    }

    /// [`mount_load`] of a root with the `load` at its joint.
    fn mount(&self, load: impl Fn(usize) -> Wrench<f64>) -> Option<Reaction> {
        let body = self.sample.model.body();
        let mounting = self.sample.model.setup().mounting()?;
        let root = body.tree.segment(0);
        let at_joint = self.along(root, load(root.index()));
        let arm = mounting.point_m - body.joint_m(root);
        Some(Reaction { moment_n_m: at_joint.moment_n_m - arm.cross(&at_joint.force_n), ..at_joint })
    }
}

/// Load of a mount on its segment at the mounting point, in axes of that segment, including the segment's own weight
/// and inertia; none for a body without a mount.
pub(crate) fn mount_load(sample: &Sample<'_>) -> Option<Reaction> {
    let loads = Loads::new(sample);
    loads.mount(|root| loads.at(root))
}

/// Load of a mounted segment on all that it carries, at the mounting point, in its axes, excluding its own weight and
/// inertia and its contacts; none for a body without a mount.
pub(crate) fn carried_by_mount(sample: &Sample<'_>) -> Option<Reaction> {
    let loads = Loads::new(sample);
    let beyond = |root: usize| loads.carried.skeleton.layout.subtree(root).filter(move |n| *n != root);
    loads.mount(|root| loads.carried.at(root, beyond(root)))
}

/// Axial force in a thigh at its knee end, tension positive as a load cell in the femur reports it, N: what the shank, the
/// contact spheres at that end and elements on them pull along the thigh. The thigh's own mass beyond a load cell in its middle
/// is not taken off. NaN for other segments.
///
/// Spheres in the distal half of the thigh count as at the knee.
pub fn femur_axial_n(sample: &Sample<'_>, thigh: Segment) -> f64 {
    let tree = sample.model.body().tree;
    let (of, legs) = (tree.body_of(thigh), tree.landmarks_at(thigh).legs);
    let is_of = |leg: Option<Limb>| leg.is_some_and(|leg| leg.upper == thigh);
    let side = [legs.right, legs.left].into_iter().position(is_of);
    side.map_or(f64::NAN, |side| sample.readings[of][FEMURS + side])
}

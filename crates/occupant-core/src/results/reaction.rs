//! Loads of the joints: forces and moments between the two segments of a joint.
//!
//! By `kernel::carried`. The moment of a ball joint is that of its damper, stop, spring and muscle, because the joint
//! constrains no rotation; a hinge adds the two constraint moments across its axis.

use nalgebra::Vector3;

use crate::body::{Joint, Limb, Segment};
use crate::forces::contact::surface::Frame;
use crate::kernel::carried::Carried;
use crate::kernel::instruments::FEMURS;
use crate::motion::dynamics::Wrench;
use crate::results::sample::Sample;

/// Force and moment: those that the proximal segment of a joint exerts on the distal one, at the joint, in its axes, unless
/// said otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reaction {
    /// N.
    pub force_n: Vector3<f64>,
    /// N·m; in a joint including damper, stop and spring.
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

/// Force and moment at a site of the lower legs of the body of a sample, SAE J211 axes of the shank: the upper and the lower site
/// of the right leg, then of the left one. NaN without a foot of its own.
pub(crate) fn tibia_load(sample: &Sample<'_>, site: usize) -> [Vector3<f64>; 2] {
    let system = sample.model.system();
    let carried = Carried::of_evaluation(&system.skeleton, sample.evaluation);
    let found = system.instruments.get(sample.of).and_then(|own| own.tibia(site / 2, &carried));
    let none = Vector3::from_element(f64::NAN);
    found.map_or([none; 2], |loads| loads[site % 2].map(|load| load.to_vector()))
}

/// Force and moment that all bodies exert on a vehicle with this `home` frame, in its axes, N and N·m about its origin: less
/// what they get from elsewhere. Frames that `belongs` accepts are parts of the vehicle. Belts, bags and mounts of a body are
/// those of its home.
///
/// By Newton's and Euler's laws: a body's inertia, less its weight, is the sum of all that acts on it.
pub fn push_on_vehicle(sample: &Sample<'_>, home: Frame, belongs: &dyn Fn(Frame) -> bool) -> Reaction {
    let (setup, tree) = (sample.model.setup(), sample.model.body().tree);
    let origin = sample.frame(home);
    let is_inside = |body: usize| setup.members.get(body).map_or(Frame::Vehicle, |member| member.home) == home;
    let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
    let loads = Loads::new(sample);
    let trunks = loads.carried.skeleton.layout.trunks();
    for segment in trunks.iter().enumerate().filter(|(body, _)| is_inside(*body)).flat_map(|(_, own)| own.segments()) {
        let Wrench { force: own, moment: about } = loads.carried.inertial(segment);
        let (own, arm) = (own.to_vector(), loads.carried.k.joint[segment].to_vector() - origin.origin_m);
        force += own;
        moment += about.to_vector() + arm.cross(&own);
    }
    let frames: Vec<Frame> =
        setup.surfaces.iter().map(|own| own.frame).chain(setup.solids.iter().map(|own| own.frame)).collect();
    let body_of = |segment: usize| tree.body_of(tree.segment(segment));
    for contact in sample.contacts() {
        let own = sample.model.system().spheres[contact.sphere].segment;
        let partner = match frames.get(contact.surface) {
            Some(Frame::Segment(segment)) => is_inside(body_of(*segment)),
            Some(frame) => belongs(*frame),
            None => {
                let other = contact.surface - frames.len();
                sample.model.system().spheres.get(other).is_some_and(|site| is_inside(body_of(site.segment)))
            }
        };
        // contacts of two spheres come once for each side
        let sign = match (is_inside(body_of(own)), partner) {
            (true, false) => -1.0,
            (false, true) if contact.surface < frames.len() => 1.0,
            _ => continue,
        };
        let seen = sample.seen_from(own);
        let (all, edge) = (seen.vector_to_space(contact.force_n), seen.vector_to_space(contact.edge_n));
        let arm = |point: nalgebra::Point3<f64>| seen.point_to_space(point.coords) - origin.origin_m;
        force += all * sign;
        moment += (arm(contact.point_m).cross(&(all - edge)) + arm(contact.edge_point_m).cross(&edge)) * sign;
    }
    let along = |v: Vector3<f64>| origin.vector_to_frame(-v);
    Reaction { force_n: along(force), moment_n_m: along(moment) }
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

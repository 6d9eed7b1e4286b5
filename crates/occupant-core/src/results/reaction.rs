//! What the joints carry: forces and moments between the two segments of a joint.
//!
//! Newton's and Euler's equations of each segment, from the tips inwards, with the accelerations that the evaluation found:
//! the load at a segment's proximal joint is what its motion needs, less what acts on it, plus what the segments beyond it
//! ask. About the proximal joint, with r the place of the centre of gravity and c that of a distal joint,
//!
//! ```text
//! f = M (a + g Z′) − F + Σ f_distal
//! τ = Iα + ω × Iω + r × M (a + g Z′) − T + Σ (τ_distal + c × f_distal)
//! ```
//!
//! F and T are the loads of contacts and all other force elements but joints. The moment of a ball joint is that of its damper, stop, spring and muscle, for it constrains none;
//! a hinge adds the two constraint moments across its axis.

use nalgebra::Vector3;

use crate::body::Joint;
use crate::body::Segment;
use crate::motion::dynamics::Wrench;
use crate::motion::layout::MOST_SEGMENTS;
use crate::motion::vector::{V3, v3};
use crate::results::sample::Sample;

/// Force and moment that the proximal segment of a joint exerts on the distal one, at the joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reaction {
    /// In axes of the distal segment, N.
    pub force_n: Vector3<f64>,
    /// In axes of the distal segment, N·m. Damper, stop and spring are part of it.
    pub moment_n_m: Vector3<f64>,
}

/// What `joint` carries in `sample`.
pub fn reaction(sample: &Sample<'_>, joint: Joint) -> Reaction {
    Loads::new(sample).reaction(joint)
}

/// Loads of force elements, from which reactions follow.
pub(super) struct Loads<'s, 'a> {
    sample: &'s Sample<'a>,
    /// Moments of dampers, stops, limits, friction, locks, springs and muscles, which the evaluation counts among the loads.
    passive: [Wrench<f64>; MOST_SEGMENTS],
}

impl<'s, 'a> Loads<'s, 'a> {
    pub(super) fn new(sample: &'s Sample<'a>) -> Self {
        let (k, system) = (&sample.evaluation.kinematics, sample.model.system());
        let mut passive = system.forces.joints.loads(k, sample.state, &system.skeleton.layout).wrench;
        let limits = sample.actions.limits.iter().map(|action| (action.joint, action.moment));
        let muscles = sample.actions.muscles.iter().map(|action| (action.joint, action.moment));
        for (joint, moment) in limits.chain(muscles) {
            let row = &sample.model.body().tree[joint];
            let [inner, outer] = row.between().map(Segment::index);
            passive[outer].moment += moment;
            passive[inner].moment -= moment;
        }
        Loads { sample, passive }
    }

    /// What segment `n` needs at its proximal joint, space axes.
    fn at(&self, n: usize) -> Wrench<f64> {
        let e = self.sample.evaluation;
        let (k, skeleton) = (&e.kinematics, &self.sample.model.system().skeleton);
        let link = &skeleton.links[n];
        let upward = v3(0.0, 0.0, skeleton.gravity);
        let inertial = (e.accelerations.cg(skeleton, k, n) + upward) * link.mass;
        let mut force = inertial - e.wrench[n].force;
        let arm = k.axes[n].out(link.cg);
        let applied = e.wrench[n].moment - self.passive[n].moment;
        let mut moment = self.spin(n) + arm.cross(inertial) - applied;
        for next in skeleton.layout.children(n) {
            let load = self.at(next);
            force += load.force;
            moment += load.moment + (k.joint[next] - k.joint[n]).cross(load.force);
        }
        Wrench { force, moment }
    }

    /// Iα + ω × Iω about the centre of gravity.
    fn spin(&self, n: usize) -> V3<f64> {
        let e = self.sample.evaluation;
        let axes = &e.kinematics.axes[n];
        let link = &self.sample.model.system().skeleton.links[n];
        let by_inertia = |v: V3<f64>| axes.out(link.by_inertia(axes.into_frame(v)));
        let omega = e.kinematics.omega[n];
        by_inertia(e.accelerations.alpha[n]) + omega.cross(by_inertia(omega))
    }

    /// [`reaction`] of `joint`.
    pub(super) fn reaction(&self, joint: Joint) -> Reaction {
        self.along(self.sample.model.body().tree[joint].distal, self.on_distal(joint))
    }

    /// What the proximal segment of a joint exerts on the distal one, at the joint, space axes.
    fn on_distal(&self, joint: Joint) -> Wrench<f64> {
        let row = &self.sample.model.body().tree[joint];
        let load = self.at(row.carrying()[1].index());
        if row.is_reversed() { Wrench { force: -load.force, moment: -load.moment } } else { load }
    }

    /// A load along the axes of a segment.
    fn along(&self, segment: Segment, load: Wrench<f64>) -> Reaction {
        let (force, moment) = load.into_frame(&self.sample.evaluation.kinematics.axes[segment.index()]);
        Reaction { force_n: force.to_vector(), moment_n_m: moment.to_vector() }
    }

    /// [`mount_load`].
    fn mount(&self) -> Option<Reaction> {
        let body = self.sample.model.body();
        let mounting = self.sample.model.setup().mounting()?;
        let root = body.tree.segment(0);
        let at_joint = self.along(root, self.at(root.index()));
        let arm = mounting.point_m - body.joint_m(root);
        Some(Reaction { moment_n_m: at_joint.moment_n_m - arm.cross(&at_joint.force_n), ..at_joint })
    }

    /// [`upper_neck`].
    pub(super) fn upper_neck(&self) -> Reaction {
        let body = self.sample.model.body();
        let Some(neck) = self.sample.landmarks().neck else {
            return Reaction { force_n: Vector3::repeat(f64::NAN), moment_n_m: Vector3::repeat(f64::NAN) };
        };
        let at_joint = self.reaction(neck);
        let condyles_m = match self.sample.model.setup().members.get(self.sample.of) {
            Some(member) => member.alone.body.condyles_m,
            None => body.condyles_m,
        };
        let Some(condyles_m) = condyles_m else { return at_joint };
        Reaction { moment_n_m: at_joint.moment_n_m - condyles_m.cross(&at_joint.force_n), ..at_joint }
    }

    /// [`femur_axial_n`] of `thigh`.
    pub(super) fn femur_axial_n(&self, thigh: Segment) -> f64 {
        let sample = self.sample;
        let k = &sample.evaluation.kinematics;
        let body = sample.model.body();
        let shanks = body.tree.joints().filter(|joint| body.tree[*joint].proximal == thigh);
        let carried = shanks.map(|joint| self.on_distal(joint).force).reduce(|a, b| a + b).unwrap_or(V3::zero());
        let half_m = 0.5 * body.segment(thigh).length_m;
        let at_knee = |s: &usize| {
            let sphere = &body.spheres[*s];
            sphere.segment == thigh && sphere.centre_from_lower_end_m.z < half_m
        };
        let of_sphere = |s| sample.sphere_force_n(s) + sample.sphere_pull_n(s, None);
        let pushed: Vector3<f64> = (0..body.spheres.len()).filter(at_knee).map(of_sphere).sum();
        let pushed = V3::of(&sample.seen_from(thigh.index()).vector_to_space(pushed));
        // Z of a thigh points from the knee to the hip: a force at the knee against it pulls
        -(pushed - carried).dot(k.axes[thigh.index()].z)
    }
}

/// What the neck carries at the occipital condyles, where limits of necks hold: M − c × F with M and F at the neck's joint and
/// c the condyles seen from there. It follows from the head's motion and what touches it, wherever the joint is. Of a body
/// that does not say where they are, what its neck's joint carries; of one without a neck no numbers.
pub(crate) fn upper_neck(sample: &Sample<'_>) -> Reaction {
    Loads::new(sample).upper_neck()
}

/// What a mount exerts on the segment that it holds, at the point that it holds it by, in axes of that segment; none of a body
/// that is on no mount. The segment's own weight and inertia are part of it.
pub(crate) fn mount_load(sample: &Sample<'_>) -> Option<Reaction> {
    Loads::new(sample).mount()
}

/// Axial force in a thigh at its knee end, tension positive as a load cell in the femur reports it, N: what the shank, the
/// contact spheres at that end and elements on them pull along the thigh. The thigh's own mass beyond a load cell in its middle
/// is not taken off.
///
/// Spheres in the distal half of the thigh count as at the knee.
pub fn femur_axial_n(sample: &Sample<'_>, thigh: Segment) -> f64 {
    Loads::new(sample).femur_axial_n(thigh)
}

//! Loads of the joints, from the results of an evaluation.
//!
//! Newton's and Euler's equations of all segments beyond a joint, with the accelerations of the evaluation. About the
//! joint, with d the positions of the segments' own joints and r those of their centres of gravity relative to these,
//!
//! ```text
//! f = Σ [M (a + g Z′) − F]
//! τ = Σ [Iα + ω × Iω + r × M (a + g Z′) − T + d × (M (a + g Z′) − F)]
//! ```
//!
//! F and T are the loads of contacts and all other force elements except joints.

use crate::kernel::{Evaluation, Scratch};
use crate::motion::dynamics::{Accelerations, Wrench};
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::{MOST_SEGMENTS, MOST_SLIDES};
use crate::motion::scalar::Scalar;
use crate::motion::skeleton::Skeleton;
use crate::motion::vector::{V3, v3};

/// Results of an evaluation from which the loads of joints follow.
#[derive(Clone, Copy)]
pub(crate) struct Carried<'a, S> {
    pub skeleton: &'a Skeleton<S>,
    pub k: &'a Kinematics<S>,
    pub accelerations: &'a Accelerations<S>,
    wrench: &'a [Wrench<S>; MOST_SEGMENTS],
    /// Moments of all loads except joints.
    outer: &'a [V3<S>; MOST_SEGMENTS],
    /// Forces on the spheres at the knees, by leg.
    pub knees: &'a [V3<S>],
    /// Resistance of the plates, N.
    pub resist: &'a [S; MOST_SLIDES],
}

impl<'a, S> Carried<'a, S> {
    /// Results of the latest evaluation.
    #[inline(always)]
    pub(crate) fn of(skeleton: &'a Skeleton<S>, scratch: &'a Scratch<S>) -> Self {
        let Scratch { kinematics: k, load, sweep, .. } = scratch;
        let accelerations = &sweep.accelerations;
        let (wrench, outer, knees, resist) = (&load.wrench, &load.outer, &load.knees, &load.resist);
        Carried { skeleton, k, accelerations, wrench, outer, knees, resist }
    }

    /// Results of an evaluation.
    pub(crate) fn of_evaluation(skeleton: &'a Skeleton<S>, e: &'a Evaluation<S>) -> Self {
        let (k, accelerations) = (&e.kinematics, &e.accelerations);
        let (wrench, outer, knees, resist) = (&e.wrench, &e.outer, &e.knees, &e.resist);
        Carried { skeleton, k, accelerations, wrench, outer, knees, resist }
    }
}

impl<S: Scalar> Carried<'_, S> {
    /// Wrench that segment `n` and all distal to it, listed in `subtree`, need at its proximal joint, space axes.
    #[inline(always)]
    pub(crate) fn at(&self, n: usize, subtree: impl Iterator<Item = usize>) -> Wrench<S> {
        let mut sum = Wrench::zero();
        for m in subtree {
            let own = self.own(m);
            sum.force += own.force;
            sum.moment += own.moment;
            if m != n {
                sum.moment += (self.k.joint[m] - self.k.joint[n]).cross(own.force);
            }
        }
        sum
    }

    /// Wrench that one segment needs about its proximal joint.
    #[inline(always)]
    pub(crate) fn own(&self, m: usize) -> Wrench<S> {
        let (k, link) = (self.k, &self.skeleton.links[m]);
        let inertial = self.specific_force(m) * link.mass;
        let arm = k.axes[m].out(link.cg);
        let moment = self.spin(m) + arm.cross(inertial) - self.outer[m];
        let mut own = Wrench { force: inertial - self.wrench[m].force, moment };
        if k.sliding > 0 {
            self.slid(m, &mut own);
        }
        own
    }

    /// Inertia less weight of one segment: all that acts on it besides gravity, about its proximal joint, space axes.
    pub(crate) fn inertial(&self, m: usize) -> Wrench<S> {
        let own = self.own(m);
        Wrench { force: own.force + self.wrench[m].force, moment: own.moment + self.outer[m] }
    }

    /// Adds the difference that sliding plates of a segment make.
    #[inline(always)]
    fn slid(&self, m: usize, own: &mut Wrench<S>) {
        let up = v3(S::zero(), S::zero(), self.skeleton.gravity);
        for (i, slide) in self.skeleton.slides.iter().enumerate() {
            if slide.segment != m {
                continue;
            }
            let [now, rest] = self.accelerations.sliding(self.k, i, m);
            let [now, rest] = [(now + up) * slide.mass, (rest + up) * slide.mass];
            own.force += now - rest;
            own.moment += self.k.slides[i].arm().cross(now) - self.k.slides[i].rest.cross(rest);
        }
    }

    /// a + g Z′ at the centre of gravity: the reading of an accelerometer there, space axes, m/s².
    #[inline(always)]
    pub(crate) fn specific_force(&self, m: usize) -> V3<S> {
        self.accelerations.cg(self.skeleton, self.k, m) + v3(S::zero(), S::zero(), self.skeleton.gravity)
    }

    /// Iα + ω × Iω about the centre of gravity.
    #[inline(always)]
    fn spin(&self, m: usize) -> V3<S> {
        let omega = self.k.omega[m];
        self.by_inertia(m, self.accelerations.alpha[m]) + omega.cross(self.by_inertia(m, omega))
    }

    /// I v.
    #[inline(always)]
    fn by_inertia(&self, m: usize, v: V3<S>) -> V3<S> {
        let axes = &self.k.axes[m];
        axes.out(self.skeleton.links[m].central.mul(axes.into_frame(v)))
    }
}

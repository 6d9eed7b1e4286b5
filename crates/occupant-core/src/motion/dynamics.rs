//! Equations of motion: D·u̇ = E + F_p + F_s + Q_f + R (Eq. 53) solved by one sweep in and one sweep out of the tree.
//!
//! At its joint a subtree is represented by a few small matrices and vectors: the force and moment that it requires
//! there for an acceleration of the joint. `articulated` computes them for any tree, `closed` for that of the report.
//! Gravity is uniform: it only shifts every acceleration, and is added at the end. The result is the report's.

use crate::motion::frame::{Frames, Moving};
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::{Layout, MOST_HINGES, MOST_SEGMENTS, MOST_SLIDES};
use crate::motion::scalar::Scalar;
use crate::motion::skeleton::{Root, Skeleton};
use crate::motion::state::{State, Work};
use crate::motion::vector::{M3, V3, v3};
use crate::motion::{articulated, closed};

/// Force and moment on a segment, space axes; the moment is about the segment's proximal joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<S> {
    /// N.
    pub force: V3<S>,
    /// N·m.
    pub moment: V3<S>,
}

impl<S: Scalar> Wrench<S> {
    /// Force and moment along the axes of a frame.
    #[inline(always)]
    pub(crate) fn into_frame(self, axes: &M3<S>) -> (V3<S>, V3<S>) {
        (axes.into_frame(self.force), axes.into_frame(self.moment))
    }

    /// No load.
    #[inline(always)]
    pub fn zero() -> Self {
        Wrench { force: V3::zero(), moment: V3::zero() }
    }
}

/// Accelerations of the tree, space axes.
#[derive(Clone, Copy, Debug)]
pub struct Accelerations<S> {
    /// Of each segment's proximal joint, m/s².
    pub joint: [V3<S>; MOST_SEGMENTS],
    /// Angular acceleration of each segment, rad/s².
    pub alpha: [V3<S>; MOST_SEGMENTS],
    /// α̈ of the hinges, rad/s².
    pub hinge: [S; MOST_HINGES],
    /// s̈ of the sliding point masses, m/s².
    pub slides: [S; MOST_SLIDES],
}

/// Accelerations under the loads `wrench` (without gravity, which is added here): solves (53). A guided root is at
/// rest.
#[inline(always)]
pub fn solve<S: Scalar>(
    body: &Skeleton<S>,
    k: &Kinematics<S>,
    hinge_rate: &[S],
    wrench: &[Wrench<S>; MOST_SEGMENTS],
) -> Accelerations<S> {
    let mut sweep = Sweep::blank(body);
    sweep.solve(body, k, hinge_rate, (wrench, &[S::zero(); MOST_SLIDES]), None);
    sweep.accelerations
}

/// Both sweeps through the trees.
#[derive(Clone, Debug)]
pub(crate) struct Sweep<S> {
    closed: Option<closed::Sweep<S>>,
    any: Option<articulated::Sweep<S>>,
    /// Results of the last call of [`Sweep::solve`].
    pub accelerations: Accelerations<S>,
}

impl<S: Scalar> Sweep<S> {
    /// Empty sweeps for these bodies.
    #[inline(always)]
    pub(crate) fn blank(bodies: &Skeleton<S>) -> Self {
        let is_there = |closed: bool| bodies.roots.iter().any(|root| root.is_closed == closed);
        let o = V3::zero();
        let accelerations = Accelerations {
            joint: [o; MOST_SEGMENTS],
            alpha: [o; MOST_SEGMENTS],
            hinge: [S::zero(); MOST_HINGES],
            slides: [S::zero(); MOST_SLIDES],
        };
        Sweep {
            closed: is_there(true).then(closed::Sweep::blank),
            any: is_there(false).then(articulated::Sweep::blank),
            accelerations,
        }
    }

    /// As [`solve`], with the forces Q − S on the sliding point masses along their axes; with `frames`, a guided root
    /// accelerates with its mount, which adds the reaction power to that of vehicles, W.
    #[inline(always)]
    pub(crate) fn solve(
        &mut self,
        bodies: &Skeleton<S>,
        k: &Kinematics<S>,
        hinge_rate: &[S],
        (wrench, drive): (&[Wrench<S>; MOST_SEGMENTS], &[S; MOST_SLIDES]),
        frames: Option<(&Frames<S>, &mut [Work<S>])>,
    ) {
        let (out, gravity) = (&mut self.accelerations, v3(S::zero(), S::zero(), -bodies.gravity));
        let (frames, mut power) = frames.unzip();
        for (body, Root { mount, is_closed }) in bodies.roots.iter().enumerate() {
            if let (true, Some(sweep)) = (is_closed, &mut self.closed) {
                sweep.solve(bodies, body, k, hinge_rate, wrench, out);
            } else if let Some(sweep) = &mut self.any {
                let root = mount.as_ref().zip(frames).map(|(mount, frames)| mount.of(frames));
                let still = Moving::space();
                let carrier = root.as_ref().unwrap_or(&still);
                let a = carrier.acceleration - gravity;
                sweep.solve((bodies, body), k, hinge_rate, (wrench, drive), [a, carrier.alpha], out);
                if let (Some(root), Some(power)) = (&root, &mut power) {
                    // of a mount in space, which is at rest, it is 0
                    let first = bodies.layout.trunks()[body].first;
                    let Wrench { force, moment } = sweep.at_root(first, a, root.alpha);
                    power[body].vehicle += force.dot(root.velocity) + moment.dot(root.omega);
                }
            }
        }
        // F_p (51a), (56): a uniform acceleration of all joints
        for a in &mut out.joint[..bodies.links.len()] {
            *a += gravity;
        }
    }
}

impl<S: Scalar> Accelerations<S> {
    /// a_child = a_parent + α×c + ω×(ω×c).
    #[inline(always)]
    pub(crate) fn carry(&mut self, k: &Kinematics<S>, child: usize, parent: usize) {
        let c = k.joint[child] - k.joint[parent];
        let w = k.omega[parent];
        self.joint[child] = self.joint[parent] + self.alpha[parent].cross(c) + w.cross(w.cross(c));
    }

    /// Acceleration of a sliding point mass, and that of the segment at its undeflected position.
    #[inline(always)]
    pub(crate) fn sliding(&self, k: &Kinematics<S>, slide: usize, n: usize) -> [V3<S>; 2] {
        let slid = &k.slides[slide];
        let beside = k.omega[n].cross(slid.axis) * (slid.speed + slid.speed) + slid.axis * self.slides[slide];
        [self.at(k, n, slid.arm()) + beside, self.at(k, n, slid.rest)]
    }

    /// Acceleration of the point fixed to segment `n` at `r` from its joint.
    #[inline(always)]
    pub(crate) fn at(&self, k: &Kinematics<S>, n: usize, r: V3<S>) -> V3<S> {
        let w = k.omega[n];
        self.joint[n] + self.alpha[n].cross(r) + w.cross(w.cross(r))
    }

    /// Acceleration of the centre of gravity of segment `n`.
    #[inline(always)]
    pub fn cg(&self, body: &Skeleton<S>, k: &Kinematics<S>, n: usize) -> V3<S> {
        self.at(k, n, k.axes[n].out(body.links[n].cg))
    }

    /// Rate of change of `state`, in which force elements do work at the rate `power`, by body.
    #[inline(always)]
    pub fn rate(&self, layout: &Layout, state: &State<S>, power: &[Work<S>]) -> State<S> {
        let mut rate = State::zero(state.shape());
        self.write_rate(layout, state, power, &mut rate);
        rate
    }

    /// Writes [`Accelerations::rate`] to a state of the same shape; state variables of force elements are unchanged.
    #[inline(always)]
    pub(crate) fn write_rate(&self, layout: &Layout, state: &State<S>, power: &[Work<S>], rate: &mut State<S>) {
        for (body, (trunk, power)) in layout.trunks().iter().zip(power).enumerate() {
            rate.set_t1_of(body, state.velocity_of(body));
            rate.set_velocity_of(body, self.joint[trunk.first]);
            rate.set_work(body, power);
        }
        for (slot, &n) in layout.free().iter().enumerate() {
            rate.set_orientation(slot, state.orientation(slot).rate(state.omega(slot)));
            rate.set_omega(slot, self.alpha[n]);
        }
        rate.hinge_mut().copy_from_slice(state.hinge_rate());
        for (rate, acceleration) in rate.hinge_rate_mut().iter_mut().zip(&self.hinge) {
            *rate = *acceleration;
        }
    }
}

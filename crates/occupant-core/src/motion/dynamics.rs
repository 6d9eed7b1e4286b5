//! Equations of motion: D·u̇ = E + F_p + F_s + Q_f + R (Eq. 53) solved by one sweep in and one sweep out of the tree.
//!
//! Seen from its joint a subtree is a few small matrices and vectors: what force and moment it needs there for an
//! acceleration of the joint. `articulated` finds them for any tree, `closed` for that of the report. Gravity
//! is uniform: it only shifts every acceleration, and is added at the end. The result is the report's.

use crate::motion::frame::Moving;
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::{Layout, MOST_HINGES, MOST_SEGMENTS};
use crate::motion::scalar::Scalar;
use crate::motion::skeleton::Skeleton;
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
}

/// Accelerations under the loads `wrench` (without gravity, which is added here): solves (53). A guided root stands still.
#[inline(always)]
pub fn solve<S: Scalar>(
    body: &Skeleton<S>,
    k: &Kinematics<S>,
    hinge_rate: &[S],
    wrench: &[Wrench<S>; MOST_SEGMENTS],
) -> Accelerations<S> {
    let mut sweep = Sweep::blank(body);
    sweep.solve(body, k, hinge_rate, wrench, None);
    sweep.accelerations
}

/// Both sweeps through the tree.
#[derive(Clone, Debug)]
pub(crate) struct Sweep<S> {
    by: By<S>,
    /// Of the last call of [`Sweep::solve`].
    pub accelerations: Accelerations<S>,
}

/// How a tree is swept.
#[derive(Clone, Debug)]
enum By<S> {
    ClosedForms(closed::Sweep<S>),
    Any(articulated::Sweep<S>),
}

impl<S: Scalar> Sweep<S> {
    /// Nothing solved yet of a body like `body`.
    #[inline(always)]
    pub(crate) fn blank(body: &Skeleton<S>) -> Self {
        let by =
            if body.is_closed { By::ClosedForms(closed::Sweep::blank()) } else { By::Any(articulated::Sweep::blank()) };
        let o = V3::zero();
        let accelerations =
            Accelerations { joint: [o; MOST_SEGMENTS], alpha: [o; MOST_SEGMENTS], hinge: [S::zero(); MOST_HINGES] };
        Sweep { by, accelerations }
    }

    /// As [`solve`]; a guided root accelerates as `root` does, which gives the power that comes back, W.
    #[inline(always)]
    pub(crate) fn solve(
        &mut self,
        body: &Skeleton<S>,
        k: &Kinematics<S>,
        hinge_rate: &[S],
        wrench: &[Wrench<S>; MOST_SEGMENTS],
        root: Option<&Moving<S>>,
    ) -> S {
        let (out, mut power) = (&mut self.accelerations, S::zero());
        let gravity = v3(S::zero(), S::zero(), -body.gravity);
        match &mut self.by {
            By::ClosedForms(sweep) => sweep.solve(body, k, hinge_rate, wrench, out),
            By::Any(sweep) => {
                let still = Moving::space();
                let carrier = root.unwrap_or(&still);
                let a = carrier.acceleration - gravity;
                sweep.solve(body, k, hinge_rate, wrench, [a, carrier.alpha], out);
                if let Some(root) = root {
                    let Wrench { force, moment } = sweep.at_root(a, root.alpha);
                    power = force.dot(root.velocity) + moment.dot(root.omega);
                }
            }
        }
        // F_p (51a), (56): a uniform acceleration of all joints
        for a in &mut out.joint[..body.links.len()] {
            *a += gravity;
        }
        power
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

    /// Acceleration of the centre of gravity of segment `n`.
    #[inline(always)]
    pub fn cg(&self, body: &Skeleton<S>, k: &Kinematics<S>, n: usize) -> V3<S> {
        let r = k.axes[n].out(body.links[n].cg);
        let w = k.omega[n];
        self.joint[n] + self.alpha[n].cross(r) + w.cross(w.cross(r))
    }

    /// The rate of change of `state`, in which force elements do work at the rate `power`.
    #[inline(always)]
    pub fn rate(&self, layout: &Layout, state: &State<S>, power: Work<S>) -> State<S> {
        let mut rate = State::zero(state.shape());
        self.write_rate(layout, state, power, &mut rate);
        rate
    }

    /// [`Accelerations::rate`] to a state of the same shape, of which no own number of a force element is touched.
    #[inline(always)]
    pub(crate) fn write_rate(&self, layout: &Layout, state: &State<S>, power: Work<S>, rate: &mut State<S>) {
        rate.set_t1(state.velocity());
        rate.set_velocity(self.joint[0]);
        for (slot, &n) in layout.free().iter().enumerate() {
            rate.set_orientation(slot, state.orientation(slot).rate(state.omega(slot)));
            rate.set_omega(slot, self.alpha[n]);
        }
        rate.hinge_mut().copy_from_slice(state.hinge_rate());
        for (rate, acceleration) in rate.hinge_rate_mut().iter_mut().zip(&self.hinge) {
            *rate = *acceleration;
        }
        rate.set_work(power);
    }
}

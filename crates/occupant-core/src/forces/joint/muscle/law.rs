//! The torque of a muscle and its activation.
//!
//! T = −a(t)·sat(Kρ + Dω, T_max) on the outer segment, ρ the rotation vector from the posture that is held, ω the relative
//! angular velocity, sat by length. The activation follows ȧ = (u − a)/τ. Its aim u is the tone a₀, and 1 from when the
//! reaction time is over until the muscle relaxes: both are known before the run, so that a is closed:
//!
//! ```text
//! a = a₀ + (1 − a₀)(E(t − t_off) − E(t − t_on)),  E(t) = exp(−max(t, 0)/τ)
//! ```
//!
//! There is no delay of the feedback: the reaction time is a single lag. What muscles do is work from outside.

use super::unknown;
use crate::body::{Joint, Tree};
use crate::forces::decay::decay;
use crate::forces::element::Instant;
use crate::forces::joint::posture::{Posture, length};
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;

/// A muscle as data.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Muscle {
    pub(crate) joint: Joint,
    /// K, N·m/rad.
    pub(crate) stiffness_n_m: f64,
    /// D, N·m·s/rad.
    pub(crate) damping_n_m_s: f64,
    /// T_max, N·m.
    pub(crate) most_n_m: f64,
    /// a₀, 0 to 1.
    pub(crate) tone: f64,
    /// τ, s.
    pub(crate) rise_s: f64,
    /// t_on and t_off, s; [`NEVER_S`] for what does not happen.
    pub(crate) times_s: [f64; 2],
}

/// A time after every run, s.
pub(crate) const NEVER_S: f64 = 1e30;

/// Constants of a muscle.
#[derive(Clone, Debug)]
pub struct MuscleLaw<S> {
    pub(super) joint: Joint,
    /// Inner and outer segment.
    pub(super) segments: (usize, usize),
    pub(super) held: Posture<S>,
    stiffness: S,
    damping: S,
    most: S,
    tone: S,
    rise: S,
    times: [S; 2],
}

/// What a muscle does at one instant.
#[derive(Clone, Copy, Debug)]
pub struct MuscleAction<S> {
    /// The joint.
    pub(crate) joint: Joint,
    /// a.
    pub(super) activation: S,
    /// Moment on the outer segment, space axes, N·m.
    pub(crate) moment: V3<S>,
    /// T·ω, W.
    pub(super) power: S,
}

impl MuscleLaw<f64> {
    /// One whose posture is not known yet.
    pub(super) fn new(tree: &Tree, muscle: &Muscle) -> Self {
        let row = &tree[muscle.joint];
        MuscleLaw {
            joint: muscle.joint,
            segments: (row.proximal.index(), row.distal.index()),
            held: unknown(),
            stiffness: muscle.stiffness_n_m,
            damping: muscle.damping_n_m_s,
            most: muscle.most_n_m,
            tone: muscle.tone,
            rise: muscle.rise_s,
            times: muscle.times_s,
        }
    }
}

impl<S: Copy> MuscleLaw<S> {
    pub(super) fn zip<A: Copy, T>(&self, other: &MuscleLaw<A>, f: &impl Fn(S, A) -> T) -> MuscleLaw<T> {
        MuscleLaw {
            joint: self.joint,
            segments: self.segments,
            held: self.held.zip(&other.held, f),
            stiffness: f(self.stiffness, other.stiffness),
            damping: f(self.damping, other.damping),
            most: f(self.most, other.most),
            tone: f(self.tone, other.tone),
            rise: f(self.rise, other.rise),
            times: std::array::from_fn(|i| f(self.times[i], other.times[i])),
        }
    }
}

impl<S: Scalar> MuscleLaw<S> {
    #[inline(always)]
    pub(super) fn act(&self, at: &Instant<'_, S>) -> MuscleAction<S> {
        let (k, (inner, outer)) = (at.k, self.segments);
        let activation = self.activation(at.frames.time);
        let omega = k.omega[outer] - k.omega[inner];
        let wanted = self.held.turned_to(&k.axes[inner], &k.axes[outer]) * self.stiffness + omega * self.damping;
        let moment = -(wanted * (activation * self.most / self.most.max(length(wanted))));
        MuscleAction { joint: self.joint, activation, moment, power: moment.dot(omega) }
    }

    /// a at a time.
    #[inline(always)]
    fn activation(&self, time: S) -> S {
        let [on, off] = self.times.map(|from| decay((time - from).max(S::zero()) / self.rise));
        self.tone + (S::one() - self.tone) * (off - on)
    }
}

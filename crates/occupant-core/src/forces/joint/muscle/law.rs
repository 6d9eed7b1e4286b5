//! The torque of a muscle and its activation.
//!
//! T = −a(t)·(sat(Kρ + Dω + s, T_max) − T₀) on the outer segment, with ρ the rotation vector from the posture to hold,
//! ω the relative angular velocity, sat by length, and T₀ the muscle's own torque, which turns with the inner segment.
//! s is the demand of reflexes, the same law with a delay: in axes of the inner segment ṡ = (K_f ρ + D_f ω − s)/τ_f,
//! three state variables, 0 at the start. In a settled body a muscle that `carries` also bears, whatever its activation,
//! the initial load of its joint: T_w in axes of the inner segment. The activation follows ȧ = (u − a)/τ. Its target u
//! is the tone a₀, and 1 from the end of the reaction time until the muscle relaxes. Both times are known before the
//! run, so a has a closed form:
//!
//! ```text
//! a = a₀ + (1 − a₀)(E(t − t_off) − E(t − t_on)),  E(t) = exp(−max(t, 0)/τ)
//! ```
//!
//! Kρ + Dω acts immediately, because active muscles are stiff. Muscles do external work.

use crate::body::{Body, Joint, JointPlace, Segment};
use crate::forces::decay::decay;
use crate::forces::element::Instant;
use crate::forces::joint::posture::{Posture, length};
use crate::motion::kinematics::Kinematics;
use crate::motion::scalar::Scalar;
use crate::motion::state::State;
use crate::motion::vector::{M3, V3};
use nalgebra::{UnitQuaternion, Vector3};

/// Muscle data.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Muscle {
    /// The joint.
    pub joint: Joint,
    /// K, N·m/rad.
    pub stiffness_n_m: f64,
    /// D, N·m·s/rad.
    pub damping_n_m_s: f64,
    /// Delayed feedback; none without reflexes.
    pub reflex: Option<Reflex>,
    /// T_max, N·m.
    pub most_n_m: f64,
    /// Posture to hold, as the rotation from the joint's axes on the proximal segment to those on the distal one; the
    /// initial posture if none.
    pub hold: Option<UnitQuaternion<f64>>,
    /// T₀ on the distal segment, in the joint's axes on the proximal one, N·m.
    pub torque_n_m: Vector3<f64>,
    /// a₀, 0 to 1.
    pub tone: f64,
    /// Whether it carries T_w, if it holds the initial posture and has no torque of its own.
    pub carries: bool,
    /// τ, s.
    pub rise_s: f64,
    /// t_on and t_off, s; [`NEVER_S`] for neither.
    pub times_s: [f64; 2],
}

/// Delayed feedback of a muscle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflex {
    /// K_f, N·m/rad.
    pub stiffness_n_m: f64,
    /// D_f, N·m·s/rad.
    pub damping_n_m_s: f64,
    /// τ_f, s.
    pub delay_s: f64,
}

/// Moment for which the state variable of a reflex is 1, N·m.
const UNIT_N_M: f64 = 100.0;

/// A time after the end of every run, s.
pub const NEVER_S: f64 = 1e30;

/// Constants of a muscle.
#[derive(Clone, Debug)]
pub struct MuscleLaw<S> {
    pub(super) joint: Joint,
    /// Inner and outer segment.
    pub(super) segments: (usize, usize),
    pub(super) held: Posture<S>,
    /// Whether it bears the initial load of its joint in a settled body.
    carries: bool,
    stiffness: S,
    damping: S,
    /// K_f, D_f and τ_f, and the index of s among the state variables that elements own.
    reflex: Option<([S; 3], usize)>,
    most: S,
    /// T₀, axes of the inner segment.
    torque: V3<S>,
    /// T_w, axes of the inner segment.
    carried: V3<S>,
    tone: S,
    rise: S,
    times: [S; 2],
}

/// State of a muscle at one instant.
#[derive(Clone, Copy, Debug)]
pub struct MuscleAction<S> {
    /// a.
    pub(super) activation: S,
    /// Moment on the outer segment, space axes, N·m.
    pub(crate) moment: V3<S>,
    /// T·ω, W.
    pub(super) power: S,
    /// s, axes of the inner segment, N·m.
    felt: V3<S>,
    /// K_f ρ + D_f ω in those axes, N·m.
    asked: V3<S>,
}

impl MuscleLaw<f64> {
    /// Law for a given posture; the initial posture is not known yet.
    pub(super) fn new(body: &Body, muscle: &Muscle) -> Self {
        let (row, JointPlace { proximal, distal }) = (&body.tree[muscle.joint], body.place(muscle.joint));
        let posture = proximal.axes * muscle.hold.unwrap_or_default() * distal.axes.inverse();
        // of a pin that is turned round the proximal segment is the outer one
        let is_turned = row.between() != [row.proximal, row.distal];
        let (posture, torque_n_m) = if is_turned {
            (posture.inverse(), -(distal.axes * muscle.torque_n_m))
        } else {
            (posture, proximal.axes * muscle.torque_n_m)
        };
        MuscleLaw {
            joint: muscle.joint,
            segments: row.between().map(Segment::index).into(),
            held: Posture(M3::of(&posture.to_rotation_matrix().into_inner())),
            carries: muscle.carries && muscle.hold.is_none() && muscle.torque_n_m == Vector3::zeros(),
            stiffness: muscle.stiffness_n_m,
            damping: muscle.damping_n_m_s,
            reflex: muscle.reflex.map(|reflex| ([reflex.stiffness_n_m, reflex.damping_n_m_s, reflex.delay_s], 0)),
            most: muscle.most_n_m,
            torque: V3::of(&torque_n_m),
            carried: V3::zero(),
            tone: muscle.tone,
            rise: muscle.rise_s,
            times: muscle.times_s,
        }
    }
}

impl MuscleLaw<f64> {
    /// Appends the initial state variables of its reflex.
    pub(super) fn own(&mut self, numbers: &mut Vec<f64>) {
        if let Some((_, first)) = &mut self.reflex {
            *first = numbers.len();
            numbers.extend([0.0; 3]);
        }
    }

    /// Sets, at the start with a settled body, the moment that the outer segment needs to stay at rest, for a muscle
    /// that carries it.
    pub(crate) fn carry(&mut self, k: &Kinematics<f64>, moment: impl Fn(usize) -> V3<f64>) {
        let (inner, outer) = self.segments;
        if self.carries {
            let needed = k.axes[inner].into_frame(moment(outer));
            self.carried = needed * (self.most / self.most.max(length(needed)));
        }
    }
}

impl<S: Copy> MuscleLaw<S> {
    /// Whether another law differs in numbers only.
    pub(super) fn is_like<A>(&self, other: &MuscleLaw<A>) -> bool {
        self.joint == other.joint && self.reflex.is_some() == other.reflex.is_some()
    }

    pub(super) fn zip<A: Copy, T>(&self, other: &MuscleLaw<A>, f: &impl Fn(S, A) -> T) -> MuscleLaw<T> {
        MuscleLaw {
            joint: self.joint,
            segments: self.segments,
            held: self.held.zip(&other.held, f),
            carries: self.carries,
            stiffness: f(self.stiffness, other.stiffness),
            damping: f(self.damping, other.damping),
            reflex: self
                .reflex
                .zip(other.reflex.as_ref())
                .map(|((one, first), (other, _))| (std::array::from_fn(|i| f(one[i], other[i])), first)),
            most: f(self.most, other.most),
            torque: self.torque.zip(&other.torque, f),
            carried: self.carried.zip(&other.carried, f),
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
        let turned = self.held.turned_to(&k.axes[inner], &k.axes[outer]);
        let mut wanted = turned * self.stiffness + omega * self.damping;
        let (mut felt, mut asked) = (V3::zero(), V3::zero());
        if let Some(([stiffness, damping, _], first)) = self.reflex {
            felt = late(at.state, first);
            asked = k.axes[inner].into_frame(turned * stiffness + omega * damping);
            wanted += k.axes[inner].out(felt);
        }
        let own = k.axes[inner].out(self.carried + self.torque * activation);
        let moment = own - wanted * (activation * self.most / self.most.max(length(wanted)));
        MuscleAction { activation, moment, power: moment.dot(omega), felt, asked }
    }

    /// Writes the rates of the reflex's state variables.
    #[inline(always)]
    pub(super) fn flow(&self, action: &MuscleAction<S>, rates: &mut [S]) {
        let Some(([.., delay], first)) = self.reflex else { return };
        let rate = (action.asked - action.felt) * (S::of(1.0 / UNIT_N_M) / delay);
        for (to, rate) in rates.iter_mut().skip(first).zip([rate.x, rate.y, rate.z]) {
            *to = rate;
        }
    }

    /// Activation a at a time.
    #[inline(always)]
    fn activation(&self, time: S) -> S {
        let [begins, ends] = self.times;
        let on = decay((time - begins).max(S::zero()) / self.rise);
        let off = decay((time - ends).max(S::zero()) / self.rise);
        self.tone + (S::one() - self.tone) * (off - on)
    }
}

/// Delayed moment s in a state; 0 while the body is being placed.
#[inline(always)]
fn late<S: Scalar>(state: &State<S>, first: usize) -> V3<S> {
    let Some([x, y, z]) = state.own().get(first..first + 3) else { return V3::zero() };
    V3 { x: *x, y: *y, z: *z } * S::of(UNIT_N_M)
}

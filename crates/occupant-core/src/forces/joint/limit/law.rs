//! Elastic limits of joints: torques that are gradients, with loss on unloading, and dry friction.
//!
//! With the excess χ, the bend or rotation of a joint beyond its limit, and χ_m the largest committed since it was last
//! inside, the torque is a force function with unloading by stretch ([`crate::forces::function`]).

use super::curve::Curve;
use super::lock::{Lock, LockPast, Pair};
use super::triads::{Pose, Triads};
use crate::body::Joint;
use crate::forces::element::Instant;
use crate::forces::function::FunctionLaw;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;

/// Elastic stop: torque over the excess angle, N·m over rad.
pub type Stop<S> = FunctionLaw<S>;

/// Limit of the bend θ.
#[derive(Clone, Debug, PartialEq)]
pub struct Bend<S> {
    /// θ₀ over the azimuth, rad.
    pub angle: Curve<S>,
    /// Torque over θ − θ₀.
    pub stop: Stop<S>,
    /// Cosine of a lower bound of θ₀.
    gate: S,
}

/// Limits of the twist of a ball joint, or of the angle of a hinge.
#[derive(Clone, Debug, PartialEq)]
pub struct Turn<S> {
    /// Range without torque, rad.
    pub range: [S; 2],
    /// Torque over the angle beyond the range.
    pub stop: Stop<S>,
    /// Cosine of the nearer limit.
    gate: S,
}

/// Dry friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction<S> {
    /// C_f, N·m.
    pub torque: S,
    /// ω_f, rad/s, at which friction has 71 % of its full value.
    pub speed: S,
}

/// Distance of a bend limit's gate below the least θ₀ on the grid, rad.
const MARGIN_RAD: f64 = 0.05;

impl Bend<f64> {
    /// Limit of the bend with its torque.
    pub fn new(angle: Curve<f64>, stop: Stop<f64>) -> Self {
        let [least, _] = angle.bounds();
        let gate = occupant_units::trig::sin_cos((least - MARGIN_RAD).max(0.0)).1;
        Bend { angle, stop, gate }
    }
}

impl Turn<f64> {
    /// Range, rad, with the torque beyond it.
    pub fn new(range: [f64; 2], stop: Stop<f64>) -> Self {
        let [lower, upper] = range;
        let nearer = upper.min(-lower).max(0.0);
        Turn { range, stop, gate: occupant_units::trig::sin_cos(nearer).1 + 1e-9 }
    }
}

/// Position of a joint in the state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Site {
    Ball,
    /// Index among the state's hinges.
    Hinge(usize),
}

/// Constants of one joint.
#[derive(Clone, Debug)]
pub struct LimitLaw<S> {
    pub(super) joint: Joint,
    pub(super) site: Site,
    /// Inner and outer segment.
    pub(super) segments: (usize, usize),
    pub(super) triads: Triads<S>,
    pub(super) bend: Option<Bend<S>>,
    pub(super) turn: Option<Turn<S>>,
    pub(super) friction: Option<Friction<S>>,
    pub(super) lock: Option<Lock<S>>,
}

/// Memory between steps of the two stops of a joint (bend, and twist or hinge) and of its lock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitHistory<S> {
    pub(super) stops: [Past<S>; 2],
    pub(super) lock: LockPast<S>,
}

/// Memory of a stop between steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Past<S> {
    /// χ_m, rad; 0 inside the limit.
    pub(super) greatest: S,
    /// Energy dissipated before the joint was last inside the range, less the amount at the start, J.
    pub(super) lost: S,
}

/// State of limits, friction and lock of a joint at one instant.
#[derive(Clone, Copy, Debug)]
pub struct LimitAction<S> {
    /// The joint.
    pub(crate) joint: Joint,
    /// Bend, azimuth and twist of a ball joint, or the angle of a hinge, rad; known at commits.
    pub(crate) angles: [S; 3],
    /// χ, the larger excess of both stops, rad; 0 inside the limits.
    pub(crate) excess: S,
    /// Moment of the stops on the outer segment, space axes, N·m.
    pub(crate) stop: V3<S>,
    /// Moment of the lock on the outer segment.
    pub(super) lock: V3<S>,
    /// 1 with a closed lock, else 0.
    pub(super) closed: S,
    /// Moment of stops, lock and friction.
    pub(crate) moment: V3<S>,
    /// Energy stored in stops and lock, J.
    pub(crate) stored: S,
    /// Energy dissipated in them since the start, J.
    pub(crate) lost: S,
    /// Power dissipated by friction, W.
    pub(super) dissipated: S,
}

impl<S: Copy> LimitHistory<S> {
    /// Copies the posture that the lock holds in `other`.
    pub(crate) fn hold_as(&mut self, other: &Self) {
        self.lock = other.lock;
    }
}

impl<S: Copy> LimitLaw<S> {
    /// Shape: laws of equal shape can be computed side by side.
    pub(super) fn shape(&self) -> (Joint, [usize; 4], Option<bool>) {
        let bend = self.bend.as_ref().map_or([0; 2], |bend| [bend.angle.len(), bend.stop.len()]);
        let turn = self.turn.as_ref().map_or(0, |turn| turn.stop.len());
        let slips = self.lock.as_ref().map(|lock| lock.slips);
        (self.joint, [bend[0], bend[1], turn, usize::from(self.friction.is_some())], slips)
    }

    /// f applied to corresponding numbers of this and `other`, which has the same shape.
    pub(super) fn zip<A: Copy, T>(&self, other: &LimitLaw<A>, f: &impl Fn(S, A) -> T) -> LimitLaw<T> {
        LimitLaw {
            joint: self.joint,
            site: self.site,
            segments: self.segments,
            triads: self.triads.zip(&other.triads, f),
            bend: self.bend.as_ref().zip(other.bend.as_ref()).map(|(a, b)| Bend {
                angle: a.angle.zip(&b.angle, f),
                stop: a.stop.zip(&b.stop, f),
                gate: f(a.gate, b.gate),
            }),
            turn: self.turn.as_ref().zip(other.turn.as_ref()).map(|(a, b)| Turn {
                range: [f(a.range[0], b.range[0]), f(a.range[1], b.range[1])],
                stop: a.stop.zip(&b.stop, f),
                gate: f(a.gate, b.gate),
            }),
            friction: self
                .friction
                .as_ref()
                .zip(other.friction.as_ref())
                .map(|(a, b)| Friction { torque: f(a.torque, b.torque), speed: f(a.speed, b.speed) }),
            lock: self.lock.as_ref().zip(other.lock.as_ref()).map(|(a, b)| a.zip(b, f)),
        }
    }
}

/// Reaction of a stop.
struct Reply<S> {
    torque: S,
    stored: S,
    lost: S,
}

impl<S: Scalar> Past<S> {
    fn none() -> Self {
        Past { greatest: S::zero(), lost: S::zero() }
    }

    /// Memory at the start: an initial excess counts as no loss.
    pub(super) fn start(stop: Option<(&Stop<S>, S)>) -> Self {
        stop.map_or(Past::none(), |(stop, excess)| {
            let greatest = excess.max(S::zero());
            Past { greatest, lost: -lost(stop, greatest) }
        })
    }
}

impl<S: Scalar> Past<S> {
    #[inline(always)]
    fn commit(&mut self, stop: &Stop<S>, excess: S) {
        let (o, beyond) = (S::zero(), excess.gt(S::zero()));
        self.lost = S::select(beyond, self.lost, self.lost + lost(stop, self.greatest));
        self.greatest = S::select(beyond, self.greatest.max(excess), o);
    }

    #[inline(always)]
    fn respond(&self, stop: &Stop<S>, excess: S) -> Reply<S> {
        let found = stop.respond(excess, self.greatest);
        let top = excess.max(self.greatest).max(S::zero());
        let torque = found.force + stop.unknown(self.greatest);
        Reply { torque, stored: stop.returned_to(found.loading)[1], lost: self.lost + lost(stop, top) }
    }
}

/// Energy that a stop has dissipated up to an excess.
#[inline(always)]
fn lost<S: Scalar>(stop: &Stop<S>, greatest: S) -> S {
    stop.returned_to(greatest)[2]
}

impl<S: Scalar> LimitAction<S> {
    /// No action.
    #[inline(always)]
    fn none(joint: Joint) -> Self {
        let (o, none) = (S::zero(), V3::zero());
        LimitAction {
            joint,
            angles: [o; 3],
            excess: o,
            stop: none,
            lock: none,
            closed: o,
            moment: none,
            stored: o,
            lost: o,
            dissipated: o,
        }
    }

    /// Adds a stop that acts along `moment`, the moment of a torque of 1 N·m, in the lanes where it is `near`.
    #[inline(always)]
    fn push(&mut self, near: S::Mask, moment: V3<S>, excess: S, reply: &Reply<S>) {
        self.stop += V3::select(near, moment * reply.torque, V3::zero());
        self.excess = self.excess.max(excess);
        self.stored += reply.stored;
        self.lost += reply.lost;
    }
}

impl<S: Scalar> LimitLaw<S> {
    /// Action, and the lanes in which there is any. At an accepted step the history is first updated with the present
    /// angles.
    #[inline(always)]
    pub(super) fn act(&self, at: &Instant<'_, S>, past: &mut LimitHistory<S>) -> (LimitAction<S>, S::Mask) {
        let accepted = at.accepted;
        let (k, (inner, outer)) = (at.k, self.segments);
        let mut action = LimitAction::none(self.joint);
        let acts = if let Site::Hinge(limb) = self.site {
            let (angle, axis) = (at.state.hinge()[limb], k.hinge_axis[limb]);
            action.angles[0] = angle;
            // no closure for the library to call: it would be compiled without the registers of lanes
            match &self.turn {
                Some(turn) => turn.act(accepted, S::truth(true), angle, || axis, &mut past.stops[1], &mut action),
                None => S::truth(false),
            }
        } else {
            self.act_ball(accepted, &self.triads.pose(&k.axes[inner], &k.axes[outer]), past, &mut action)
        };
        let omega = k.omega[outer] - k.omega[inner];
        let locks = match &self.lock {
            Some(lock) => lock.act(&self.pair(at, omega), &mut past.lock, &mut action),
            None => S::truth(false),
        };
        action.moment = action.stop + action.lock;
        let Some(friction) = &self.friction else { return (action, acts | locks) };
        // T = −C_f ω/√(|ω|² + ω_f²)
        let squared = omega.norm_squared();
        let scale = friction.torque / (squared + friction.speed * friction.speed).sqrt();
        action.moment -= omega * scale;
        action.dissipated = scale * squared;
        (action, S::truth(true))
    }

    #[inline(always)]
    fn pair<'a>(&self, at: &Instant<'a, S>, omega: V3<S>) -> Pair<'a, S> {
        let (inner, outer) = self.segments;
        Pair { axes: (&at.k.axes[inner], &at.k.axes[outer]), omega, time: at.frames.time, accepted: at.accepted }
    }

    /// Memory in the present position: stops without loss, the lock closed.
    pub(super) fn start(&self, at: &Instant<'_, S>) -> LimitHistory<S> {
        let held = |_: &Lock<S>| LockPast::start(&self.pair(at, V3::zero()));
        LimitHistory {
            stops: self.excess(at).map(Past::start),
            lock: self.lock.as_ref().map_or_else(LockPast::none, held),
        }
    }

    /// Stops of bend and twist.
    #[inline(always)]
    fn act_ball(
        &self,
        accepted: bool,
        pose: &Pose<S>,
        past: &mut LimitHistory<S>,
        action: &mut LimitAction<S>,
    ) -> S::Mask {
        let [bend_past, turn_past] = &mut past.stops;
        let mut acts = S::truth(false);
        if accepted {
            action.angles = [pose.bend(), pose.azimuth(), pose.twist()];
        }
        if let Some(bend) = &self.bend {
            acts = bend.act(accepted, pose, bend_past, action);
        }
        if let Some(turn) = &self.turn {
            let near = pose.is_twisted_beyond(turn.gate);
            if accepted || S::any(near) {
                acts = acts | turn.act(accepted, near, pose.twist(), || pose.twisting(), turn_past, action);
            }
        }
        acts
    }

    /// Stops of bend and turn, with χ of each.
    pub(super) fn excess(&self, at: &Instant<'_, S>) -> [Option<(&Stop<S>, S)>; 2] {
        let (k, (inner, outer)) = (at.k, self.segments);
        let pose = self.triads.pose(&k.axes[inner], &k.axes[outer]);
        let angle = if let Site::Hinge(limb) = self.site { at.state.hinge()[limb] } else { pose.twist() };
        let bend = self.bend.as_ref().map(|b| (&b.stop, pose.bend() - b.angle.around(pose.azimuth()).0));
        [bend, self.turn.as_ref().map(|turn| (&turn.stop, turn.excess(angle).0))]
    }
}

impl<S: Scalar> Bend<S> {
    /// V = ∫f(χ), χ = θ − θ₀(φ): the moment is −f (e_θ − θ₀′ e_φ).
    #[inline(always)]
    fn act(&self, accepted: bool, pose: &Pose<S>, past: &mut Past<S>, action: &mut LimitAction<S>) -> S::Mask {
        let near = pose.is_bent_beyond(self.gate);
        if accepted || S::any(near) {
            let (limit, rise) = self.angle.around(pose.azimuth());
            let excess = pose.bend() - limit;
            if accepted {
                past.commit(&self.stop, excess);
            }
            let moment = pose.swinging() * rise - pose.bending();
            action.push(near, moment, excess, &past.respond(&self.stop, excess));
        }
        near
    }
}

impl<S: Scalar> Turn<S> {
    /// χ, and the sign of the exceeded limit.
    #[inline(always)]
    fn excess(&self, angle: S) -> (S, S) {
        let [below, above] = [self.range[0] - angle, angle - self.range[1]];
        (above.max(below), S::select(below.lt(above), S::one(), -S::one()))
    }

    /// The moment is −f times the axis about which the angle grows.
    #[inline(always)]
    fn act(
        &self,
        accepted: bool,
        near: S::Mask,
        angle: S,
        axis: impl Fn() -> V3<S>,
        past: &mut Past<S>,
        action: &mut LimitAction<S>,
    ) -> S::Mask {
        let (excess, sign) = self.excess(angle);
        let near = near & excess.gt(S::zero());
        if accepted || S::any(near) {
            if accepted {
                past.commit(&self.stop, excess);
            }
            action.push(near, axis() * -sign, excess, &past.respond(&self.stop, excess));
        }
        near
    }
}

#[cfg(test)]
#[path = "tests.rs"]
pub(super) mod tests;

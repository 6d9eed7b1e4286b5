//! Moments in the joints: viscous dampers, stops, springs in β, resistance to twist.
//!
//! Report: "The Viscous Damper", "Joint Stops", Figs 9–11. For a ball joint between segments k and l: n = Z_k × Z_l, s = |n|,
//! ω = ω_l − ω_k. Our decision: β = atan2(√(s² + ε²), Z_k·Z_l), which has no singular posture; then
//! β̇ = n·ω/√(s² + ε²), exactly.

use std::array::from_fn;

use crate::body::Joint;
use crate::body::SEGMENTS;
use crate::forces::joint::{BallJoint, HingeJoint, Joints, Stop};
use crate::motion::dynamics::Wrench;
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::{BALL_JOINTS, BALLS, HINGE_JOINTS, LIMBS};
use crate::motion::scalar::Scalar;
use crate::motion::state::State;
use crate::motion::vector::V3;
use crash_measures::trig;

/// Damping that rises from `begin` over `1/slope` radians by `rise`.
#[derive(Clone, Copy, Debug)]
struct Limit<S> {
    begin: S,
    slope: S,
    rise: S,
}

impl<S: Copy> Limit<S> {
    fn zip<A: Copy, T>(&self, other: &Limit<A>, f: &impl Fn(S, A) -> T) -> Limit<T> {
        Limit { begin: f(self.begin, other.begin), slope: f(self.slope, other.slope), rise: f(self.rise, other.rise) }
    }
}

impl<S: Scalar> Limit<S> {
    /// `sign` is −1 for a stop met by falling angles.
    fn new(stop: Option<Stop>, damping: f64, sign: f64) -> Self {
        // far outside any angle where there is no stop
        let none = Limit { begin: S::of(1e9), slope: S::one(), rise: S::zero() };
        stop.map_or(none, |s| Limit {
            begin: S::of(sign * s.begin_rad),
            slope: S::of(1.0 / (sign * (s.full_rad - s.begin_rad)).max(1e-9)),
            rise: S::of(s.damping_n_m_s - damping),
        })
    }

    /// J − J_N at an angle that grows towards the stop.
    #[inline(always)]
    fn extra(&self, angle: S) -> S {
        self.rise * ((angle - self.begin) * self.slope).clamp01()
    }
}

/// Constants of a ball joint.
#[derive(Clone, Copy, Debug)]
pub struct Ball<S> {
    damping: S,
    twist: S,
    stop: Limit<S>,
    /// cos β_N·√(1 + ε²): where Z_k·Z_l is greater, the stop has not begun and β is not needed for it.
    stop_cosine: S,
    stiffness: S,
    rest: S,
    has_spring: bool,
}

/// Constants of a hinge.
#[derive(Clone, Copy, Debug)]
pub struct Hinge<S> {
    damping: S,
    lower: Limit<S>,
    upper: Limit<S>,
}

/// Force laws of all joints.
#[derive(Clone, Debug)]
pub struct JointSystem<S> {
    /// In the order of [`BALL_JOINTS`].
    pub balls: [Ball<S>; BALLS.len()],
    /// In the order of [`HINGE_JOINTS`].
    pub hinges: [Hinge<S>; LIMBS.len()],
    epsilon_squared: S,
}

/// What a ball joint does at one instant.
#[derive(Clone, Copy, Debug)]
pub struct BallAction<S> {
    /// Moment on segment l (the opposite on k), space axes, N·m.
    pub moment: V3<S>,
    /// Energy stored in the spring, J.
    pub stored: S,
    /// Power dissipated by damper and stop, W.
    pub dissipated: S,
}

impl<S: Copy> Ball<S> {
    fn zip<A: Copy, T>(&self, other: &Ball<A>, f: &impl Fn(S, A) -> T) -> Ball<T> {
        Ball {
            damping: f(self.damping, other.damping),
            twist: f(self.twist, other.twist),
            stop: self.stop.zip(&other.stop, f),
            stop_cosine: f(self.stop_cosine, other.stop_cosine),
            stiffness: f(self.stiffness, other.stiffness),
            rest: f(self.rest, other.rest),
            has_spring: self.has_spring,
        }
    }
}

impl<S: Copy> Hinge<S> {
    fn zip<A: Copy, T>(&self, other: &Hinge<A>, f: &impl Fn(S, A) -> T) -> Hinge<T> {
        Hinge {
            damping: f(self.damping, other.damping),
            lower: self.lower.zip(&other.lower, f),
            upper: self.upper.zip(&other.upper, f),
        }
    }
}

impl<S: Copy> JointSystem<S> {
    /// f applied to every number and the one in the same place of `other`, which has springs in the same joints.
    pub(crate) fn zip<A: Copy, T>(&self, other: &JointSystem<A>, f: &impl Fn(S, A) -> T) -> JointSystem<T> {
        JointSystem {
            balls: from_fn(|i| self.balls[i].zip(&other.balls[i], f)),
            hinges: from_fn(|i| self.hinges[i].zip(&other.hinges[i], f)),
            epsilon_squared: f(self.epsilon_squared, other.epsilon_squared),
        }
    }

    /// Which ball joints have a spring.
    pub(crate) fn springs(&self) -> [bool; BALLS.len()] {
        from_fn(|i| self.balls[i].has_spring)
    }
}

impl<S: Scalar> JointSystem<S> {
    /// Constants from data; `rest_rad` are the β₀ of the ball joints that do not give their own.
    pub fn new(joints: &Joints, rest_rad: &[f64; BALLS.len()]) -> Self {
        let ball_law = |joint: Joint| joints[joint].ball().copied().unwrap_or_default();
        let hinge_law = |joint: Joint| joints[joint].hinge().copied().unwrap_or_default();
        JointSystem {
            balls: from_fn(|i| ball(&ball_law(BALL_JOINTS[i]), rest_rad[i], joints.epsilon)),
            hinges: from_fn(|i| hinge(&hinge_law(HINGE_JOINTS[i]))),
            epsilon_squared: S::of(joints.epsilon * joints.epsilon),
        }
    }

    /// Adds all joint moments to `wrench` and shows what the ball joints do; returns the power that they dissipate, W.
    #[inline(always)]
    pub fn apply(
        &self,
        k: &Kinematics<S>,
        state: &State<S>,
        wrench: &mut [Wrench<S>; SEGMENTS],
        show: &mut impl FnMut(&BallAction<S>),
    ) -> S {
        let mut dissipated = S::zero();
        for (i, &(inner, outer)) in BALLS.iter().enumerate() {
            let action = self.ball(i, k);
            show(&action);
            // R (76), and F_s
            wrench[outer].moment += action.moment;
            wrench[inner].moment -= action.moment;
            dissipated += action.dissipated;
        }
        for (i, &(upper, lower)) in LIMBS.iter().enumerate() {
            let rate = state.hinge_rate[i];
            let torque = self.hinges[i].torque(state.hinge[i], rate); // β is α (72)
            let moment = k.axes[upper].y * torque;
            // R of elbows and knees (77)
            wrench[lower].moment += moment;
            wrench[upper].moment -= moment;
            dissipated -= torque * rate;
        }
        dissipated
    }

    /// Ball joint `i` of [`BALLS`].
    #[inline(always)]
    pub fn ball(&self, i: usize, k: &Kinematics<S>) -> BallAction<S> {
        let (inner, outer) = BALLS[i];
        let joint = &self.balls[i];
        let (z_k, z_l) = (k.axes[inner].z, k.axes[outer].z);
        let omega = k.omega[outer] - k.omega[inner];
        let normal = z_k.cross(z_l);
        let cosine = z_k.dot(z_l); // (58)
        // s² + ε², kept off zero for ε = 0 at β = 0, where n = 0 makes every moment vanish
        let sine_squared = (normal.norm_squared() + self.epsilon_squared).max(S::of(1e-30));
        let inverse = S::one() / sine_squared;
        let bending = normal.dot(omega); // n·ω, of the sign of β̇

        let stopping = cosine.lt(joint.stop_cosine) & bending.gt(S::zero());
        let near_stop = S::any(stopping);
        // β as an arc tangent (61), (71)
        let beta = if near_stop || joint.has_spring { sine_squared.sqrt().atan2(cosine) } else { S::zero() };
        let mut damping = joint.damping;
        if near_stop {
            damping = S::select(stopping, damping + joint.stop.extra(beta), damping);
        }
        // T = −J [n (n·ω) + ε² ω_⊥]/(s² + ε²) (69)
        let across = omega - z_k * z_k.dot(omega);
        let scale = damping * inverse;
        let mut moment = -(normal * (scale * bending) + across * (scale * self.epsilon_squared));
        // −T·ω (70)
        let mut dissipated = scale * (bending * bending + self.epsilon_squared * across.norm_squared());
        // T = −J_t Z_l (Z_l·ω)
        let twisting = z_l.dot(omega);
        moment -= z_l * (joint.twist * twisting);
        dissipated += joint.twist * twisting * twisting;
        let mut stored = S::zero();
        if joint.has_spring {
            // V = ½K(β − β₀)² (57), T = −K(β − β₀) n/√(s² + ε²) (51b), (62)
            let bent = joint.stiffness * (beta - joint.rest);
            moment -= normal * (bent * inverse.sqrt());
            stored = S::of(0.5) * bent * (beta - joint.rest);
        }
        BallAction { moment, stored, dissipated }
    }

    /// β of ball joint `i` of [`BALLS`], rad.
    pub fn beta(&self, i: usize, k: &Kinematics<S>) -> S {
        let (inner, outer) = BALLS[i];
        let (z_k, z_l) = (k.axes[inner].z, k.axes[outer].z);
        let sine = (z_k.cross(z_l).norm_squared() + self.epsilon_squared).sqrt();
        sine.atan2(z_k.dot(z_l))
    }

    /// Energy stored in all springs, J.
    pub fn stored(&self, k: &Kinematics<S>) -> S {
        let mut sum = S::zero();
        for i in 0..BALLS.len() {
            sum += self.ball(i, k).stored;
        }
        sum
    }
}

impl<S: Scalar> Hinge<S> {
    /// Torque about Y on the lower segment: −J α̇, with each stop only while moving into it (Figs 10, 11).
    #[inline(always)]
    pub fn torque(&self, angle: S, rate: S) -> S {
        let o = S::zero();
        let upper = S::select(rate.gt(o), self.upper.extra(angle), o);
        let lower = S::select(rate.lt(o), self.lower.extra(-angle), o);
        -(self.damping + upper + lower) * rate
    }
}

fn ball<S: Scalar>(data: &BallJoint, rest_rad: f64, epsilon: f64) -> Ball<S> {
    let (stiffness, rest) = data.spring.map_or((0.0, 0.0), |s| (s.stiffness_n_m, s.rest_rad.unwrap_or(rest_rad)));
    let stop_cosine = data.stop.map_or(-2.0, |s| trig::sin_cos(s.begin_rad).1 * (1.0 + epsilon * epsilon).sqrt());
    Ball {
        damping: S::of(data.damping_n_m_s),
        twist: S::of(data.twist_damping_n_m_s),
        stop: Limit::new(data.stop, data.damping_n_m_s, 1.0),
        stop_cosine: S::of(stop_cosine),
        stiffness: S::of(stiffness),
        rest: S::of(rest),
        has_spring: data.spring.is_some(),
    }
}

fn hinge<S: Scalar>(data: &HingeJoint) -> Hinge<S> {
    Hinge {
        damping: S::of(data.damping_n_m_s),
        lower: Limit::new(data.lower_stop, data.damping_n_m_s, -1.0),
        upper: Limit::new(data.upper_stop, data.damping_n_m_s, 1.0),
    }
}

//! Moments in the joints: viscous dampers, stops, springs in β, resistance to twist.
//!
//! Report: "The Viscous Damper", "Joint Stops", Figs 9–11. For a ball joint between segments k and l: Z_k and Z_l are
//! the Z axes of its triads (in the report's body those of the segments), n = Z_k × Z_l, s = |n|, ω = ω_l − ω_k. Our
//! decision: β = atan2(√(s² + ε²), Z_k·Z_l), which has no singular posture; then β̇ = n·ω/√(s² + ε²), exactly.

use crate::body::{Joint, Segment};
use nalgebra::Vector3;

use crate::forces::element::Load;
use crate::forces::joint::{DAMPING, Joints, Stop};
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::Layout;
use crate::motion::scalar::Scalar;
use crate::motion::skeleton::Skeleton;
use crate::motion::state::State;
use crate::motion::vector::V3;
use occupant_units::trig;

/// Damping that rises from angle `begin` by `rise` over `1/slope` radians.
#[derive(Clone, Copy, Debug)]
struct Limit<S> {
    begin: S,
    slope: S,
    rise: S,
    /// Angle of full damping.
    full: S,
}

impl<S: Copy> Limit<S> {
    fn zip<A: Copy, T>(&self, other: &Limit<A>, f: &impl Fn(S, A) -> T) -> Limit<T> {
        Limit {
            begin: f(self.begin, other.begin),
            slope: f(self.slope, other.slope),
            rise: f(self.rise, other.rise),
            full: f(self.full, other.full),
        }
    }
}

impl<S: Scalar> Limit<S> {
    /// `sign` is −1 for a stop reached by falling angles.
    fn new(stop: Option<Stop>, damping: f64, sign: f64) -> Self {
        // far outside any angle where there is no stop
        let none = Limit { begin: S::of(1e9), slope: S::one(), rise: S::zero(), full: S::of(1e9) };
        stop.map_or(none, |s| Limit {
            begin: S::of(sign * s.begin_rad),
            slope: S::of(1.0 / (sign * (s.full_rad - s.begin_rad)).max(1e-9)),
            rise: S::of(s.damping_n_m_s - damping),
            full: S::of(sign * s.full_rad),
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
    /// The joint.
    pub joint: Joint,
    /// Proximal and distal segment.
    pub segments: (usize, usize),
    /// Z of the triads in axes of these segments; none if they are the segments' Z.
    z: Option<[V3<S>; 2]>,
    damping: S,
    twist: S,
    stop: Limit<S>,
    /// cos β_N·√(1 + ε²): where Z_k·Z_l exceeds it, the stop does not act and β is not needed.
    stop_cosine: S,
    stiffness: S,
    rest: S,
    has_spring: bool,
}

/// Constants of a hinge.
#[derive(Clone, Copy, Debug)]
pub struct Hinge<S> {
    /// The joint.
    pub joint: Joint,
    /// Inner and outer segment.
    pub segments: (usize, usize),
    damping: S,
    lower: Limit<S>,
    upper: Limit<S>,
}

/// Force laws of all joints.
#[derive(Clone, Debug, Default)]
pub struct JointSystem<S> {
    /// In the tree's order of joints.
    pub balls: Vec<Ball<S>>,
    /// In the order of the state's hinges.
    pub hinges: Vec<Hinge<S>>,
    epsilon_squared: S,
}

/// State of a joint at one instant.
#[derive(Clone, Copy, Debug)]
pub struct JointAction<S> {
    /// Moment on segment l (reaction on k), space axes, N·m.
    pub moment: V3<S>,
    /// Energy stored in the spring, J.
    pub stored: S,
    /// Power dissipated by damper and stop, W.
    pub dissipated: S,
    /// Angle beyond the end of its stop while moving into it, rad; of a hinge, beyond the upper and the lower stop.
    pub(crate) beyond: [S; 2],
}

impl<S: Copy> Ball<S> {
    fn zip<A: Copy, T>(&self, other: &Ball<A>, f: &impl Fn(S, A) -> T) -> Ball<T> {
        let z = self.z.as_ref().zip(other.z.as_ref());
        Ball {
            joint: self.joint,
            segments: self.segments,
            z: z.map(|([k, l], [others_k, others_l])| [k.zip(others_k, f), l.zip(others_l, f)]),
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
            joint: self.joint,
            segments: self.segments,
            damping: f(self.damping, other.damping),
            lower: self.lower.zip(&other.lower, f),
            upper: self.upper.zip(&other.upper, f),
        }
    }
}

impl<S: Copy> JointSystem<S> {
    /// f applied to corresponding numbers of this and `other`, which has the same joints and springs.
    pub(crate) fn zip<A: Copy, T>(&self, other: &JointSystem<A>, f: &impl Fn(S, A) -> T) -> JointSystem<T> {
        JointSystem {
            balls: self.balls.iter().zip(&other.balls).map(|(a, b)| a.zip(b, f)).collect(),
            hinges: self.hinges.iter().zip(&other.hinges).map(|(a, b)| a.zip(b, f)).collect(),
            epsilon_squared: f(self.epsilon_squared, other.epsilon_squared),
        }
    }

    /// Presence of a spring and of own triads, by ball joint.
    pub(super) fn structure(&self) -> impl Iterator<Item = (Joint, bool, bool)> + '_ {
        self.balls.iter().map(|ball| (ball.joint, ball.has_spring, ball.z.is_some()))
    }
}

impl JointSystem<f64> {
    /// Constants from data; `rest_rad` is β₀ of the ball joints without their own, in the order of
    /// [`JointSystem::balls`].
    pub fn new(joints: &Joints, skeleton: &Skeleton<f64>, rest_rad: impl Fn(usize) -> f64) -> Self {
        let (tree, layout) = (joints.tree(), &skeleton.layout);
        let balls = tree.joints().filter(|joint| !tree[*joint].is_hinge()).enumerate();
        let carriers = layout.hinged().iter().filter_map(|&n| tree.bearer(tree.segment(n)));
        JointSystem {
            balls: balls.map(|(i, joint)| ball(joints, joint, skeleton, rest_rad(i))).collect(),
            hinges: carriers.map(|joint| hinge(joints, joint)).collect(),
            epsilon_squared: joints.epsilon * joints.epsilon,
        }
    }
}

impl<S: Scalar> JointSystem<S> {
    /// Loads of the joints alone.
    pub fn loads(&self, k: &Kinematics<S>, state: &State<S>, layout: &Layout) -> Load<S> {
        let mut load = Load::zero(layout, []);
        self.apply(k, state, &mut load, &mut |_| {});
        load
    }

    /// Adds all joint moments and their dissipated power to `load` and shows the actions of the joints, ball joints
    /// first.
    #[inline(always)]
    pub(crate) fn apply(
        &self,
        k: &Kinematics<S>,
        state: &State<S>,
        load: &mut Load<S>,
        show: &mut impl FnMut(&JointAction<S>),
    ) {
        for ball in &self.balls {
            let action = ball.act(k, self.epsilon_squared);
            let (inner, outer) = ball.segments;
            show(&action);
            // R (76), and F_s
            load.wrench[outer].moment += action.moment;
            load.wrench[inner].moment -= action.moment;
            load.power_at(outer).sums[DAMPING] += action.dissipated;
        }
        let (angles, rates) = (state.hinge(), state.hinge_rate());
        for (i, hinge) in self.hinges.iter().enumerate() {
            let (upper, lower) = hinge.segments;
            let torque = hinge.torque(angles[i], rates[i]); // β is α (72)
            let moment = k.hinge_axis[i] * torque;
            let (stored, dissipated, beyond) = (S::zero(), -(torque * rates[i]), hinge.beyond(angles[i]));
            show(&JointAction { moment, stored, dissipated, beyond });
            // R of elbows and knees (77)
            load.wrench[lower].moment += moment;
            load.wrench[upper].moment -= moment;
            load.power_at(lower).sums[DAMPING] += dissipated;
        }
    }

    /// Action of ball joint `i` of [`JointSystem::balls`].
    pub fn ball(&self, i: usize, k: &Kinematics<S>) -> JointAction<S> {
        self.balls[i].act(k, self.epsilon_squared)
    }

    /// β of ball joint `i` of [`JointSystem::balls`], rad.
    pub fn beta(&self, i: usize, k: &Kinematics<S>) -> S {
        let (z_k, z_l) = self.balls[i].axes(k);
        let sine = (z_k.cross(z_l).norm_squared() + self.epsilon_squared).sqrt();
        sine.atan2(z_k.dot(z_l))
    }

    /// Proximal and distal segment of the joint of an action.
    pub(super) fn segments(&self, number: usize) -> (usize, usize) {
        let hinge = || self.hinges[number - self.balls.len()].segments;
        self.balls.get(number).map_or_else(hinge, |ball| ball.segments)
    }

    /// The joint of each action.
    pub(crate) fn joints(&self) -> impl Iterator<Item = Joint> + '_ {
        self.balls.iter().map(|ball| ball.joint).chain(self.hinges.iter().map(|hinge| hinge.joint))
    }

    /// Energy stored in all springs, J.
    pub fn stored(&self, k: &Kinematics<S>) -> S {
        let mut sum = S::zero();
        for ball in &self.balls {
            sum += ball.act(k, self.epsilon_squared).stored;
        }
        sum
    }
}

impl<S: Scalar> Ball<S> {
    /// Z_k and Z_l, space axes.
    #[inline(always)]
    pub(super) fn axes(&self, k: &Kinematics<S>) -> (V3<S>, V3<S>) {
        let (inner, outer) = (&k.axes[self.segments.0], &k.axes[self.segments.1]);
        match &self.z {
            None => (inner.z, outer.z),
            Some([z_k, z_l]) => (inner.out(*z_k), outer.out(*z_l)),
        }
    }

    /// Action of the joint.
    #[inline(always)]
    fn act(&self, k: &Kinematics<S>, epsilon_squared: S) -> JointAction<S> {
        let joint = self;
        let (z_k, z_l) = joint.axes(k);
        let omega = k.omega[joint.segments.1] - k.omega[joint.segments.0];
        let normal = z_k.cross(z_l);
        let cosine = z_k.dot(z_l); // (58)
        // s² + ε², kept off zero for ε = 0 at β = 0, where n = 0 makes every moment vanish
        let sine_squared = (normal.norm_squared() + epsilon_squared).max(S::of(1e-30));
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
        let mut moment = -(normal * (scale * bending) + across * (scale * epsilon_squared));
        // −T·ω (70)
        let mut dissipated = scale * (bending * bending + epsilon_squared * across.norm_squared());
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
        let beyond = [S::select(stopping, (beta - joint.stop.full).max(S::zero()), S::zero()), S::zero()];
        JointAction { moment, stored, dissipated, beyond }
    }
}

impl<S: Scalar> Hinge<S> {
    /// Torque about its axis on the distal segment: −J α̇, with each stop only while moving into it (Figs 10, 11).
    #[inline(always)]
    pub fn torque(&self, angle: S, rate: S) -> S {
        let o = S::zero();
        let upper = S::select(rate.gt(o), self.upper.extra(angle), o);
        let lower = S::select(rate.lt(o), self.lower.extra(-angle), o);
        -(self.damping + upper + lower) * rate
    }

    /// Angles beyond the ends of the upper and the lower stop, rad.
    #[inline(always)]
    fn beyond(&self, angle: S) -> [S; 2] {
        let o = S::zero();
        [(angle - self.upper.full).max(o), (-angle - self.lower.full).max(o)]
    }
}

fn ball(joints: &Joints, joint: Joint, skeleton: &Skeleton<f64>, rest_rad: f64) -> Ball<f64> {
    let row = &joints.tree()[joint];
    let segments = row.between().map(Segment::index).into();
    let mut z = skeleton.links[row.carrying()[1].index()].triads.map(|triad| triad.z);
    if row.is_reversed() {
        z.reverse();
    }
    let (data, epsilon) = (joints[joint].ball().copied().unwrap_or_default(), joints.epsilon);
    let (stiffness, rest) = data.spring.map_or((0.0, 0.0), |s| (s.stiffness_n_m, s.rest_rad.unwrap_or(rest_rad)));
    Ball {
        joint,
        segments,
        z: (z != [V3::of(&Vector3::z()); 2]).then_some(z),
        damping: data.damping_n_m_s,
        twist: data.twist_damping_n_m_s,
        stop: Limit::new(data.stop, data.damping_n_m_s, 1.0),
        stop_cosine: data.stop.map_or(-2.0, |s| trig::sin_cos(s.begin_rad).1 * (1.0 + epsilon * epsilon).sqrt()),
        stiffness,
        rest,
        has_spring: data.spring.is_some(),
    }
}

fn hinge(joints: &Joints, joint: Joint) -> Hinge<f64> {
    let row = &joints.tree()[joint];
    let data = joints[joint].hinge().copied().unwrap_or_default();
    Hinge {
        joint,
        segments: row.between().map(Segment::index).into(),
        damping: data.damping_n_m_s,
        lower: Limit::new(data.lower_stop, data.damping_n_m_s, -1.0),
        upper: Limit::new(data.upper_stop, data.damping_n_m_s, 1.0),
    }
}

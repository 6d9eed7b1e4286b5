//! Elastic limits of joints by direction, dry friction and locks, which the report does not have.

mod check;
mod curve;
mod law;
mod lock;
mod results;
mod triads;

use std::f64::consts::PI;

use nalgebra::Vector3;

use crate::body::{Body, Joint, Segment};
use crate::forces::element::{Element, Instant, Load, StoredEnergy, Unlike, WorkSum};
use crate::forces::joint::{DAMPING, Joints};
use crate::forces::list::STORES;
use crate::forces::rate::Rate;
use crate::forces::sphere::Site as Sphere;
use crate::motion::layout::Layout;
use crate::motion::mobility::{Mobility, across, greatest};
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;
use crate::quantity::energy;
pub use curve::Curve;
pub use law::{Bend, Friction, Stop, Turn};
pub(crate) use law::{LimitAction, LimitHistory, LimitLaw};
use law::{Past, Site};
pub use lock::Lock;
use lock::LockPast;
use placed_text::Problems;
use triads::Triads;

/// Places of the energies that the stops store and have dissipated.
const STORED_AT: usize = 3;
const LOST_AT: usize = 4;

/// Excess angle at which the slope of a stop's torque is evaluated for step estimates, rad: 30°.
const ESTIMATE_RAD: f64 = 0.52;

/// Limits at other joints, or laws with other numbers of points.
const OTHER_LIMITS: Unlike = Unlike("other joints have elastic limits, or their curves have other numbers of points");

/// The centre axis ĉ of a joint and the direction x̂ of azimuth 0, in the inner segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Centre {
    /// Centre along the outer segment, azimuth 0 forward, both turned about Y: positive pitch moves a head forward and
    /// a hanging limb backward.
    Pitch {
        /// Rotation about Y of the inner segment.
        pitch_rad: f64,
    },
    /// Two directions; for a left joint, those of the right joint.
    Axes {
        /// ĉ, of any length.
        axis: Vector3<f64>,
        /// Direction of azimuth 0.
        forward: Vector3<f64>,
    },
}

/// Limits, friction and lock of one joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits {
    /// The joint.
    pub joint: Joint,
    /// Reference directions of the angles.
    pub centre: Centre,
    /// Limit of a ball joint's bend.
    pub bend: Option<Bend<f64>>,
    /// Limit of a ball joint's twist or of a hinge's angle.
    pub turn: Option<Turn<f64>>,
    /// Dry friction.
    pub friction: Option<Friction<f64>>,
    /// Lock: holds until a moment is reached.
    pub lock: Option<Lock<f64>>,
}

/// Largest total bend forward and back that the limit of one of two neck joints permits, rad: GEBOD's 50°, plus
/// rounding.
const HALF_A_NECK_RAD: f64 = 0.872_666;

impl Limits {
    /// Whether the limit fits one of two neck joints rather than a single one.
    pub(crate) fn is_of_half_a_neck(&self) -> bool {
        let both = |bend: &Bend<f64>| [0.0, PI].iter().map(|angle| bend.angle.around(*angle).0).sum::<f64>();
        self.bend.as_ref().is_some_and(|bend| both(bend) < HALF_A_NECK_RAD)
    }
}

/// The kind of force element: elastic limits, dry friction and locks of joints.
#[derive(Clone, Copy, Debug)]
pub struct JointLimits;

impl Element for JointLimits {
    const OPTIONAL: bool = true;
    const STORED: &'static [StoredEnergy] = &[
        StoredEnergy {
            at: STORED_AT,
            quantity: energy(
                14,
                "stops",
                "stored in elastic stops and locks of joints",
                "recoverable, in elastic stops and locks of joints",
            ),
            held_by: None,
        },
        StoredEnergy {
            at: LOST_AT,
            quantity: energy(
                15,
                "lost_stops",
                "lost in elastic stops and locks of joints",
                "lost in elastic stops and locks of joints since the start, by what they remember",
            ),
            held_by: None,
        },
    ];
    const SUMS: &'static [WorkSum] = &[];
    const NAMES: [&'static str; 2] = ["joint", "joints"];

    type Data<'a> = &'a Joints;
    type Law<S> = Vec<LimitLaw<S>>;
    type Past<S> = LimitHistory<S>;
    type Hints<S: Scalar> = ();
    type Action<S> = LimitAction<S>;

    fn check(data: &Joints, _body: &Body, problems: &mut Problems) {
        data.limits.iter().for_each(|limits| check::check(data, limits, problems));
    }

    fn new(data: &Joints, body: &Body) -> Vec<LimitLaw<f64>> {
        let layout = Layout::of(body.tree);
        data.limits.iter().map(|limits| law(body, limits, &layout)).collect()
    }

    fn begin(law: &mut Vec<LimitLaw<f64>>, data: &Joints, _: &Body, at: &Instant<'_, f64>, problems: &mut Problems) {
        law.iter().for_each(|law| check::start(data, law, at, problems));
    }

    fn start(law: &Vec<LimitLaw<f64>>, at: &Instant<'_, f64>) -> Vec<LimitHistory<f64>> {
        law.iter().map(|law| law.start(at)).collect()
    }

    fn hints<S: Scalar>(_law: &Vec<LimitLaw<S>>) {}

    fn count<S>(law: &Vec<LimitLaw<S>>) -> usize {
        law.len()
    }

    fn zip<S: Copy, A: Copy, T>(
        one: &Vec<LimitLaw<S>>,
        other: &Vec<LimitLaw<A>>,
        f: &impl Fn(S, A) -> T,
    ) -> Result<Vec<LimitLaw<T>>, Unlike> {
        let is_like = one.iter().map(LimitLaw::shape).eq(other.iter().map(LimitLaw::shape));
        is_like.then(|| one.iter().zip(other).map(|(a, b)| a.zip(b, f)).collect()).ok_or(OTHER_LIMITS)
    }

    fn each<S, A>(one: &mut LimitHistory<S>, other: &mut LimitHistory<A>, f: &mut impl FnMut(&mut S, &mut A)) {
        for (one, other) in one.stops.iter_mut().zip(&mut other.stops) {
            f(&mut one.greatest, &mut other.greatest);
            f(&mut one.lost, &mut other.lost);
        }
        one.lock.each(&mut other.lock, f);
    }

    fn map<A: Copy, S>(past: &LimitHistory<A>, f: &mut impl FnMut(A) -> S) -> LimitHistory<S> {
        let mut stop = |past: &Past<A>| Past { greatest: f(past.greatest), lost: f(past.lost) };
        let [bend, turn] = &past.stops;
        let stops = [stop(bend), stop(turn)];
        LimitHistory { stops, lock: past.lock.map(f) }
    }

    fn is_possible(_: &Self::Law<f64>, _: usize, past: &LimitHistory<f64>) -> bool {
        past.stops.iter().all(|stop| stop.greatest >= 0.0) && [-1.0, 0.0, 1.0].contains(&past.lock.closed)
    }

    fn confine(past: &mut LimitHistory<f64>) {
        past.stops.iter_mut().for_each(|stop| stop.greatest = stop.greatest.max(0.0));
    }

    fn can_switch(law: &Vec<LimitLaw<f64>>) -> bool {
        law.iter().any(|law| law.lock.as_ref().is_some_and(|lock| !lock.slips))
    }

    #[inline(always)]
    fn switches<S: Scalar>(past: &LimitHistory<S>) -> S {
        past.lock.closed
    }

    fn due<S: Scalar<Mask = bool>>(
        law: &Vec<LimitLaw<S>>,
        number: usize,
        before: &LimitHistory<S>,
        now: &LimitHistory<S>,
        times_s: [S; 2],
    ) -> Option<S> {
        before.lock.due(&now.lock, law.get(number)?.lock.as_ref()?, times_s)
    }

    #[inline(always)]
    fn apply<S: Scalar>(
        law: &Vec<LimitLaw<S>>,
        at: &Instant<'_, S>,
        past: &mut [LimitHistory<S>],
        _hints: &mut (),
        load: &mut Load<S>,
        show: &mut impl FnMut(&LimitAction<S>),
    ) {
        for (law, past) in law.iter().zip(past) {
            let (action, acts) = law.act(at, past);
            if S::any(acts) {
                let (inner, outer) = law.segments;
                let [k, l] = [load.wrench[inner].moment, load.wrench[outer].moment];
                load.wrench[outer].moment = V3::select(acts, l + action.moment, l);
                load.wrench[inner].moment = V3::select(acts, k - action.moment, k);
                load.power_at(outer).sums[DAMPING] += action.dissipated;
            }
            show(&action);
        }
    }

    fn failure(data: &Joints, law: &Vec<LimitLaw<f64>>, past: &[LimitHistory<f64>]) -> Option<String> {
        let all = data.limits.iter().zip(law).zip(past);
        all.into_iter().find_map(|((limits, law), past)| law.overrun(data.tree()[limits.joint].name, past))
    }

    fn rates(
        data: &Joints,
        _body: &Body,
        _at: &Instant<'_, f64>,
        _actions: &[LimitAction<f64>],
        mobility: &Mobility<'_>,
    ) -> Vec<Rate> {
        data.limits.iter().flat_map(|limits| rates(data, limits, mobility)).collect()
    }

    fn segment(law: &Vec<LimitLaw<f64>>, _spheres: &[Sphere<f64>], number: usize, _action: &LimitAction<f64>) -> usize {
        law[number].segments.1
    }

    fn stored_j(actions: &[LimitAction<f64>], stored_j: &mut [f64; STORES]) {
        stored_j[STORED_AT] = actions.iter().map(|action| action.stored).sum();
        stored_j[LOST_AT] = actions.iter().map(|action| action.lost).sum();
    }
}

fn law(body: &Body, limits: &Limits, layout: &Layout) -> LimitLaw<f64> {
    let row = &body.tree[limits.joint];
    let [_, carried] = row.carrying();
    LimitLaw {
        joint: limits.joint,
        site: layout.hinge_slot(carried.index()).map_or(Site::Ball, Site::Hinge),
        segments: row.between().map(Segment::index).into(),
        triads: Triads::new(body, limits.joint, &limits.centre),
        bend: limits.bend.clone(),
        turn: limits.turn.clone(),
        friction: limits.friction,
        lock: limits.lock,
    }
}

/// Steepest torque of the stops up to [`ESTIMATE_RAD`], friction at its steepest and the lock, about the axes that
/// yield most.
fn rates(data: &Joints, limits: &Limits, mobility: &Mobility<'_>) -> Vec<Rate> {
    let row = &data.tree()[limits.joint];
    let [inner, outer] = row.between().map(Segment::index);
    let relative = mobility.of_joint(inner, outer);
    let z = mobility.kinematics.axes[outer].z.to_vector();
    let hinge = mobility.skeleton.layout.hinge_slot(row.carrying()[1].index()).map(|hinge| mobility.of_hinge(hinge));
    let turning = hinge.unwrap_or(z.dot(&(relative * z)));
    let spring = |stop: &Stop<f64>, by: &str, give: f64| {
        Rate::of_spring(row.name.to_owned(), by.to_owned(), 1.0 / give, stop.steepness(ESTIMATE_RAD).0)
    };
    let bend = limits.bend.as_ref().map(|bend| spring(&bend.stop, "limit", greatest(across(&relative, &z))));
    let turn = limits.turn.as_ref().map(|turn| spring(&turn.stop, "limit", turning));
    let give = || hinge.unwrap_or_else(|| greatest(relative));
    let friction = limits.friction.and_then(|friction| {
        Rate::of_damper(&format!("{}, friction", row.name), 1.0 / give(), friction.torque / friction.speed)
    });
    let lock = limits.lock.map(|l| Rate::of_spring(row.name.to_owned(), "lock".to_owned(), 1.0 / give(), l.stiffness));
    [bend, turn, friction, lock].into_iter().flatten().filter(|rate| rate.coefficient > 0.0).collect()
}

#[cfg(test)]
pub(super) use law::tests::{free_neck, nodding};

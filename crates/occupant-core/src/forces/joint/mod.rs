//! Moments in the joints: viscous dampers, stops, springs in β, resistance to twist.

mod check;
mod data;
mod law;
pub mod limit;
pub mod muscle;
mod posture;
mod preset;
mod rates;

pub use data::*;
pub use law::*;

use crate::body::Body;
use crate::forces::element::{Element, Instant, Load, StoredEnergy, Unlike, WorkSum};
use crate::forces::list::STORES;
use crate::forces::rate::Rate;
use crate::forces::shown::{Reported, Tracked, Tracker};
use crate::forces::sphere::Site;
use crate::forces::table::Column;
use crate::motion::mobility::Mobility;
use crate::motion::scalar::Scalar;
use crate::motion::skeleton::Skeleton;
use crate::quantity::energy;
use placed_text::Problems;

/// Index of the work dissipated by dampers and stops.
pub const DAMPING: usize = 2;

/// Springs at other joints.
pub(crate) const OTHER_SPRINGS: Unlike = Unlike("other joints have springs");

/// The kind of force element: moments in the joints.
#[derive(Clone, Copy, Debug)]
pub struct JointMoments;

impl Element for JointMoments {
    const STORED: &'static [StoredEnergy] = &[StoredEnergy {
        at: 0,
        quantity: energy(5, "spine", "stored in the joints' springs", "stored in joint springs"),
        held_by: None,
    }];
    const SUMS: &'static [WorkSum] = &[WorkSum {
        at: DAMPING,
        quantity: energy(
            10,
            "lost_joints",
            "dissipated by joints",
            "dissipated by joint dampers and stops since the start",
        ),
    }];
    const NAMES: [&'static str; 2] = ["joint damper", "joint dampers"];

    type Data<'a> = &'a Joints;
    type Law<S> = JointSystem<S>;
    type Past<S> = ();
    type Hints<S: Scalar> = ();
    type Action<S> = JointAction<S>;

    fn check(data: &Joints, _body: &Body, problems: &mut Problems) {
        check::check(data, problems);
    }

    fn new(data: &Joints, body: &Body) -> JointSystem<f64> {
        JointSystem::new(data, &Skeleton::new(body, 0.0), |_| 0.0)
    }

    /// Springs are at rest in the initial posture unless their angles are given.
    fn begin(law: &mut JointSystem<f64>, data: &Joints, body: &Body, at: &Instant<'_, f64>, problems: &mut Problems) {
        check::start(data, law, at, problems);
        *law = JointSystem::new(data, &Skeleton::new(body, 0.0), |i| law.beta(i, at.k));
    }

    fn start(_law: &JointSystem<f64>, _at: &Instant<'_, f64>) -> Vec<()> {
        Vec::new()
    }

    fn hints<S: Scalar>(_law: &JointSystem<S>) {}

    fn count<S>(_law: &JointSystem<S>) -> usize {
        0
    }

    fn most_actions<S>(law: &JointSystem<S>) -> usize {
        law.balls.len() + law.hinges.len()
    }

    fn zip<S: Copy, A: Copy, T>(
        one: &JointSystem<S>,
        other: &JointSystem<A>,
        f: &impl Fn(S, A) -> T,
    ) -> Result<JointSystem<T>, Unlike> {
        if one.structure().eq(other.structure()) { Ok(one.zip(other, f)) } else { Err(OTHER_SPRINGS) }
    }

    fn each<S, A>(_one: &mut (), _other: &mut (), _f: &mut impl FnMut(&mut S, &mut A)) {}

    fn map<A: Copy, S>(_past: &(), _f: &mut impl FnMut(A) -> S) {}

    #[inline(always)]
    fn apply<S: Scalar>(
        law: &JointSystem<S>,
        at: &Instant<'_, S>,
        _past: &mut [()],
        _hints: &mut (),
        load: &mut Load<S>,
        show: &mut impl FnMut(&JointAction<S>),
    ) {
        load.end_of_outer();
        law.apply(at.k, at.state, load, show);
    }

    fn rates(
        data: &Joints,
        _body: &Body,
        _at: &Instant<'_, f64>,
        _actions: &[JointAction<f64>],
        mobility: &Mobility<'_>,
    ) -> Vec<Rate> {
        rates::rates(data, mobility)
    }

    fn segment(law: &JointSystem<f64>, _spheres: &[Site<f64>], number: usize, _action: &JointAction<f64>) -> usize {
        law.segments(number).1
    }

    fn stored_j(actions: &[JointAction<f64>], stored_j: &mut [f64; STORES]) {
        stored_j[Self::STORED[0].at] = actions.iter().map(|joint| joint.stored).sum();
    }
}

impl Reported for JointMoments {
    const SHOWS_PEAKS: bool = false;
    const PEAKS: &'static [Tracked] = &[Tracked {
        column: Column::number("beyond_stop_rad", "beyond stop, rad", 3),
        time: None,
        at_least_zero: true,
    }; 2];

    #[inline(always)]
    fn track<S: Scalar>(joint: &JointAction<S>, tracker: &mut impl Tracker<S>) {
        tracker.numbers(&joint.beyond);
    }
}

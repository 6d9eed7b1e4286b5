//! Elastic limits in results.

use occupant_units::unit::Unit::{self, NewtonMetre, Radian};

use super::{JointLimits, LimitAction, LimitHistory, LockPast, Past};
use crate::forces::shown::{Named, OneOf, Reported, Tracked, Tracker};
use crate::forces::stored::Archive;
use crate::forces::table::Column;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;
use crate::quantity::{FieldWords, Quantity};

type Of = Quantity<OneOf<JointLimits>>;

fn length(moment: V3<f64>) -> f64 {
    moment.norm_squared().sqrt()
}

impl Reported for JointLimits {
    const MESSAGE: &'static str = "JointLimit";

    const QUANTITIES: &'static [Of] = &[
        Of::number(Radian, |a| a.angles[0]).channel("bend", "bend of the {} from its centre axis").field(
            2,
            "bend",
            "angle between centre axis and outer segment; of a hinge its angle",
        ),
        Of::number(Radian, |a| a.angles[1]).channel("azimuth", "direction of the bend of the {}").field(
            3,
            "azimuth",
            "0 is forward, 90° the left of a neck and the outside of a limb; 0 of a hinge",
        ),
        Of::number(Radian, |a| a.angles[2]).channel("twist", "twist of the {}").field(
            4,
            "twist",
            "turn of the outer segment about itself, swing apart; 0 of a hinge",
        ),
        Of::number(Radian, |a| a.excess).channel("excess", "angle of the {} beyond its limit").field(
            5,
            "excess",
            "angle beyond the limit, the larger of bend and twist; 0 within",
        ),
        Of::number(NewtonMetre, |a| length(a.stop)).channel("stop_moment", "moment of the stops of the {}").field(
            6,
            "stop_moment",
            "magnitude of the moment of the elastic stops",
        ),
        Of::number(NewtonMetre, |a| length(a.lock)).channel("lock_moment", "moment of the lock of the {}").field(
            7,
            "lock_moment",
            "magnitude of the moment of the lock; 0 once it is open",
        ),
    ];

    const PEAKS: &'static [Tracked] = &[
        Tracked {
            column: Column {
                scale: 180.0 / std::f64::consts::PI,
                ..Column::number("greatest_excess_rad", "beyond limit, °", 1)
            }
            .measure("greatest_excess", Radian),
            time: Some(Column::time("excess_time_s").measure("excess_time", Unit::Second)),
            at_least_zero: true,
        },
        Tracked {
            column: Column::number("stop_peak_n_m", "stop moment, N·m", 1).measure("stop_peak", NewtonMetre),
            time: Some(Column::time("stop_time_s").measure("stop_time", Unit::Second)),
            at_least_zero: true,
        },
        Tracked {
            column: Column::number("lock_peak_n_m", "lock moment, N·m", 1).measure("lock_peak", NewtonMetre),
            time: Some(Column::time("lock_time_s").measure("lock_time", Unit::Second)),
            at_least_zero: true,
        },
    ];

    #[inline(always)]
    fn track<S: Scalar>(a: &LimitAction<S>, tracker: &mut impl Tracker<S>) {
        tracker.numbers(&[a.excess, a.stop.norm_squared().sqrt(), a.lock.norm_squared().sqrt()]);
    }

    fn keep(past: &mut Vec<LimitHistory<f64>>, like: Option<&[LimitHistory<f64>]>, file: &mut dyn Archive) {
        let number = if like.is_some() { 43 } else { 42 };
        let meaning = "of each joint with limits: greatest angle beyond the limit (rad) and energy lost before (J), of bend, \
                       of twist or hinge";
        let list = past.iter().flat_map(|joint| joint.stops).flat_map(|stop| [stop.greatest, stop.lost]).collect();
        let list = file.numbers(FieldWords { number, stem: "joint_limits", meaning }, list);
        let locks = keep_locks(past, like.is_some(), file);
        let (joints, []) = list.as_chunks() else {
            return file.refuse("a list of joint limits with parts missing");
        };
        if !locks.is_empty() && locks.len() != joints.len() * LOCK {
            return file.refuse("a list of joint locks with parts missing");
        }
        let stop = |greatest, lost| Past { greatest, lost };
        let mut locks = locks.into_iter();
        let mut history = |&[a, b, c, d]: &[f64; 4]| LimitHistory {
            stops: [stop(a, b), stop(c, d)],
            lock: LockPast::none().map(&mut |none: f64| locks.next().unwrap_or(none)),
        };
        *past = joints.iter().map(&mut history).collect();
    }

    fn named<'a>(data: Self::Data<'a>) -> Vec<Named<'a>> {
        data.limits.iter().map(|limits| Named { name: data.tree()[limits.joint].name, sphere: None }).collect()
    }

    fn event<S: Scalar>(before: &LimitAction<S>, now: &LimitAction<S>) -> Option<(&'static str, Option<S>)> {
        let is_beyond = |action: &LimitAction<S>| S::any(action.excess.gt(S::zero()));
        let is_closed = |action: &LimitAction<S>| S::any(action.closed.gt(S::zero()));
        match (is_closed(before), is_closed(now)) {
            (true, false) => return Some(("opens its lock", None)),
            (false, true) => return Some(("closes its lock", None)),
            _ => {}
        }
        match (is_beyond(before), is_beyond(now)) {
            (false, true) => Some(("reaches its elastic limit", None)),
            (true, false) => Some(("leaves its elastic limit", None)),
            _ => None,
        }
    }
}

/// Count of numbers of a lock.
const LOCK: usize = 13;

/// Reads or writes the memory of the locks; nothing is written without a lock.
fn keep_locks(past: &[LimitHistory<f64>], is_step: bool, file: &mut dyn Archive) -> Vec<f64> {
    let number = if is_step { 49 } else { 48 };
    let meaning = "of each joint with limits, if any has a lock: 1 if it is closed, -1 if it is open and the joint slow, 0 if it is open; \
                   the posture that it holds (axes of the outer segment in the inner one, nine numbers), when it was last closed or \
                   turned fast (s), how fast it turns while it is open (rad/s), energy lost (J)";
    let mut list = Vec::new();
    for joint in past {
        joint.lock.map(&mut |x| list.push(x));
    }
    if list.iter().all(|x| *x == 0.0) {
        list.clear();
    }
    file.numbers(FieldWords { number, stem: "joint_locks", meaning }, list)
}

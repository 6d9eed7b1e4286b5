//! Elastic limits, dry friction and lock of a joint: their keys, converted to [`Limits`].

use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::Builder;
use super::joints::JointSection;
use super::quantity::{FRACTION, NOT_NEGATIVE, POSITIVE, all_si, si_or};
use super::{Angle, AngularVelocity, Moment, MomentPerAngle2, MomentPerAngle3, Ratio, RotationalStiffness};
use occupant_core::body::{Joint, JointRow};
use occupant_core::forces::function::{Beyond, Function};
use occupant_core::forces::joint::limit::{Bend, Centre, Curve, Friction, Limits, Lock, Stop, Turn};
use occupant_core::forces::spring::LEAST_FRACTION;
use placed_text::{Problem, with_key};

/// Default speed of dry friction, rad/s: 0.4 × 30 °/s.
const FRICTION_RAD_S: f64 = 12.0 * std::f64::consts::PI / 180.0;

/// A lock without a stiffness reaches its moment at this angle, rad: 2°.
const LOCK_RAD: f64 = 2.0 * std::f64::consts::PI / 180.0;

/// The axis from which a ball joint bends, and the direction of azimuth 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-at-most-one" = [["pitch", "axis"]], "x-together" = [["axis", "forward"]]))]
pub(crate) struct CentreSection {
    /// Rotation of the axis about Y of the inner segment: positive moves a head forward and a hanging limb back.
    pub(crate) pitch: Option<Angle>,
    /// The axis in the inner segment (X forward, Y left, Z up when standing), pointing away from the joint. For a left
    /// joint give that of the right one; it is mirrored.
    pub(crate) axis: Option<[Ratio; 3]>,
    /// A direction across the axis, in the inner segment: bending that way has azimuth 0.
    pub(crate) forward: Option<[Ratio; 3]>,
}

/// Elastic limit of the bend.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-at-most-one" = [["angle", "angles"], ["angle", "azimuths"]]))]
pub(crate) struct BendLimitSection {
    /// One limit for all directions, 0.5° to 170°.
    pub(crate) angle: Option<Angle<POSITIVE>>,
    /// Directions, at least four, increasing within 360°: 0° is forward, 90° the outside of a limb or the left of a
    /// neck.
    pub(crate) azimuths: Option<Vec<Angle>>,
    /// The limit in each direction, 5° to 170°, with a periodic cubic spline between. If `azimuths` is absent, those of
    /// the preset apply.
    pub(crate) angles: Option<Vec<Angle<POSITIVE>>>,
    /// Torque beyond the limit.
    pub(crate) torque: Option<StopTorqueSection>,
}

/// Elastic limits of an angle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RangeLimitSection {
    /// Lower and upper limit.
    pub(crate) range: Option<[Angle; 2]>,
    /// Torque beyond the limits.
    pub(crate) torque: Option<StopTorqueSection>,
}

/// Torque over the angle x beyond a limit: c1 x + c2 x² + c3 x³, or straight lines through points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-together" = [["angles", "moments"]]))]
pub(crate) struct StopTorqueSection {
    /// c1.
    pub(crate) c1: Option<RotationalStiffness<NOT_NEGATIVE>>,
    /// c2.
    pub(crate) c2: Option<MomentPerAngle2<NOT_NEGATIVE>>,
    /// c3.
    pub(crate) c3: Option<MomentPerAngle3<NOT_NEGATIVE>>,
    /// Angles beyond the limit, increasing from 0.
    pub(crate) angles: Option<Vec<Angle<NOT_NEGATIVE>>>,
    /// The torque at each, from 0.
    pub(crate) moments: Option<Vec<Moment<NOT_NEGATIVE>>>,
    /// Torque beyond the last of `moments`; "extends" if absent.
    pub(crate) beyond: Option<Beyond>,
    /// μ, fraction of its work that unloading returns; 1 if absent.
    pub(crate) returned: Option<Ratio<FRACTION>>,
}

/// Dry friction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FrictionSection {
    /// Friction moment when sliding.
    pub(crate) torque: Moment<NOT_NEGATIVE>,
    /// Speed at which it reaches 71 % of that moment; 12 deg/s if absent.
    pub(crate) speed: Option<AngularVelocity<POSITIVE>>,
}

/// A lock: a spring in all directions to the initial posture, which opens when a moment is reached. Without `until` it
/// never opens, like a joint of rubber.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-at-most-one" = [["slips", "relock_below"]]))]
pub(crate) struct LockSection {
    /// Moment at which the lock opens; never if absent.
    pub(crate) until: Option<Moment<POSITIVE>>,
    /// Stiffness while locked; if absent, such that `until` is reached at 2°.
    pub(crate) stiffness: Option<RotationalStiffness<POSITIVE>>,
    /// True: instead of opening, the lock slips at that moment.
    pub(crate) slips: Option<bool>,
    /// An open lock closes again once the joint has been slower than this for 5 ms; never if absent.
    pub(crate) relock_below: Option<AngularVelocity<POSITIVE>>,
}

/// Limits, friction and lock of a joint, if it has any.
pub(super) fn limits(b: &mut Builder, joint: Joint, row: &JointRow, section: &JointSection) -> Option<Limits> {
    let path = format!("joints.{}", row.name);
    let key = if row.is_hinge() { "angle_limit" } else { "twist_limit" };
    let range = if row.is_hinge() { &section.angle_limit } else { &section.twist_limit };
    let bend = section.limit.as_deref().filter(|_| !row.is_hinge());
    let limits = Limits {
        joint,
        centre: section.centre.as_deref().map_or(Centre::Pitch { pitch_rad: 0.0 }, centre),
        bend: bend.map(|limit| bend_limit(b, &with_key(&path, "limit"), limit)),
        turn: range.as_deref().map(|limit| turn_limit(b, &with_key(&path, key), limit)),
        friction: section
            .friction
            .as_ref()
            .map(|friction| Friction { torque: friction.torque.si(), speed: si_or(&friction.speed, FRICTION_RAD_S) }),
        lock: section.lock.as_deref().map(|section| lock(b, &with_key(&path, "lock"), section)),
    };
    let is_any = limits.bend.is_some() || limits.turn.is_some() || limits.friction.is_some() || limits.lock.is_some();
    is_any.then_some(limits)
}

fn lock(b: &mut Builder, path: &str, section: &LockSection) -> Lock<f64> {
    let stiffness = match &section.until {
        Some(until) => si_or(&section.stiffness, until.si() / LOCK_RAD),
        None => b.needed(path, "stiffness", &section.stiffness),
    };
    Lock {
        until: si_or(&section.until, 1e30),
        stiffness,
        slips: section.slips == Some(true),
        relock_below: si_or(&section.relock_below, 0.0),
    }
}

fn centre(section: &CentreSection) -> Centre {
    let vector = |v: &[Ratio; 3]| Vector3::from(all_si(v));
    match (&section.axis, &section.forward) {
        (Some(axis), Some(forward)) => Centre::Axes { axis: vector(axis), forward: vector(forward) },
        _ => Centre::Pitch { pitch_rad: si_or(&section.pitch, 0.0) },
    }
}

fn turn_limit(b: &mut Builder, path: &str, section: &RangeLimitSection) -> Turn<f64> {
    if section.range.is_none() {
        b.error(path, format!("`{path}` has no key `range`"), "range = two increasing angles");
    }
    let range = section.range.as_ref().map_or([f64::NAN; 2], all_si);
    Turn::new(range, stop(b, path, &section.torque))
}

fn bend_limit(b: &mut Builder, path: &str, section: &BendLimitSection) -> Bend<f64> {
    let torque = stop(b, path, &section.torque);
    let (azimuths, angles) = match (&section.azimuths, &section.angles) {
        (Some(azimuths), Some(angles)) => (azimuths, angles),
        (None, Some(angles)) => {
            let hint = Some(all_round(angles.len())).filter(|_| angles.len() >= 4);
            let problem =
                Problem::error(with_key(path, "angles"), "`angles` without `azimuths`", "a direction for each");
            b.report(problem.with_hint(hint));
            return Bend::new(Curve::constant(f64::NAN), torque);
        }
        (_, None) => return Bend::new(Curve::constant(b.needed(path, "angle", &section.angle)), torque),
    };
    let points = pairs(azimuths, angles);
    let turn = std::f64::consts::TAU;
    let rise = points.windows(2).all(|both| both[0][0] < both[1][0]);
    let starts = points.first().is_some_and(|first| first[0].abs() <= 0.5 * turn + 1e-9);
    let within = points.first().zip(points.last()).is_some_and(|(first, last)| last[0] - first[0] < turn - 1e-9);
    if points.len() < 4 || azimuths.len() != angles.len() || !(rise && starts && within) {
        let found = format!("{} azimuths and {} angles", azimuths.len(), angles.len());
        let expected =
            "four or more increasing azimuths within 360°, the first from −180° to 180°, and an angle for each";
        b.error(&with_key(path, "azimuths"), found, expected);
        return Bend::new(Curve::constant(f64::NAN), torque);
    }
    Bend::new(Curve::periodic(&points), torque)
}

/// The azimuths for the angles of a limit.
fn all_round(count: usize) -> String {
    let all: Vec<String> = (0..count).map(|i| placed_text::number(i as f64 * 360.0 / count as f64)).collect();
    format!("azimuths = [{}] go with {count} angles", all.join(", "))
}

/// The torque of the limit at `path`.
fn stop(b: &mut Builder, path: &str, section: &Option<StopTorqueSection>) -> Stop<f64> {
    let Some(section) = section else {
        b.error(path, format!("`{path}` has no key `torque`"), "torque = { c2 = \"5 in lbf/deg^2\" } or the like");
        return Stop::polynomial([0.0; 3], 1.0);
    };
    let path = &with_key(path, "torque");
    let coefficients = [si_or(&section.c1, 0.0), si_or(&section.c2, 0.0), si_or(&section.c3, 0.0)];
    let returned = si_or(&section.returned, 1.0);
    if returned < LEAST_FRACTION {
        let found = format!("{returned}, taken as {LEAST_FRACTION}");
        let expected = "at least 0.01: unloading needs some slope";
        b.report(Problem::warning(with_key(path, "returned"), found, expected));
    }
    let (Some(angles), Some(moments)) = (&section.angles, &section.moments) else {
        return Stop::polynomial(coefficients, returned);
    };
    let points = pairs(angles, moments);
    let rise = points.windows(2).all(|both| both[0][0] < both[1][0]);
    if points.len() < 2 || angles.len() != moments.len() || points[0] != [0.0; 2] || !rise {
        let found = format!("{} angles and {} moments", angles.len(), moments.len());
        b.error(
            &with_key(path, "angles"),
            found,
            "two or more angles that increase from 0, a moment for each, the first 0",
        );
    }
    if coefficients != [0.0; 3] {
        b.error(path, "coefficients and points of one torque", "c1, c2, c3, or angles and moments");
    }
    Stop::new(&Function { beyond: section.beyond.unwrap_or_default(), ..Function::lines(points, returned) })
}

/// Pairs of two lists.
fn pairs<const X: usize, const Y: usize, const R: usize, const Q: usize>(
    x: &[super::Quantity<X, R>],
    y: &[super::Quantity<Y, Q>],
) -> Vec<[f64; 2]> {
    x.iter().zip(y).map(|(x, y)| [x.si(), y.si()]).collect()
}

//! Checks of limits and friction of a joint, alone and in the initial posture.

use std::f64::consts::PI;

use super::{Centre, Curve, Joints, LimitHistory, LimitLaw, Limits, Stop};
use crate::body::Joint;
use crate::forces::element::Instant;
use crate::forces::joint::JointLaw;
use placed_text::Problems;

/// Bounds of θ₀ and of the twist, degrees: the azimuth is undefined near θ = 0, the twist jumps at ±180°. A limit
/// independent of azimuth needs none.
const BEND_DEG: [f64; 2] = [5.0, 170.0];
const EVEN_DEG: f64 = 0.5;
const TWIST_DEG: f64 = 150.0;

/// Angle beyond an elastic limit at which a joint may begin, rad: 10°.
const BEYOND_RAD: f64 = 0.1745;

pub(super) fn check(joints: &Joints, limits: &Limits, problems: &mut Problems) {
    let row = &joints.tree()[limits.joint];
    let path = format!("joints.{}", row.name);
    let keys = if row.is_hinge() { ["", "angle_limit"] } else { ["limit", "twist_limit"] };
    let [bend_path, turn_path] = keys.map(|key| format!("{path}.{key}"));
    if let Centre::Axes { axis, forward } = limits.centre
        && let across = axis.cross(&forward).norm()
        && (across.is_nan() || across <= 1e-6 * axis.norm() * forward.norm())
    {
        let found = "`axis` and `forward` along one line, or of no length";
        problems.error(format!("{path}.centre"), found, "two directions, ahead across the axis");
    }
    if let Some(bend) = &limits.bend {
        check_bend(&bend.angle, limits.turn.is_some(), row.side().is_none(), &bend_path, problems);
        check_stop(&bend.stop, &bend_path, problems);
    }
    if let Some(turn) = &limits.turn {
        let [lower, upper] = turn.range.map(f64::to_degrees);
        let most = if row.is_hinge() { 360.0 } else { TWIST_DEG };
        if !(lower < upper && lower >= -most && upper <= most) {
            let expected = format!("two angles that rise, from −{most}° to {most}°");
            problems.error(format!("{turn_path}.range"), format!("{lower:.1}° to {upper:.1}°"), expected);
        }
        check_stop(&turn.stop, &turn_path, problems);
    }
    let has_old_stop = match &joints[limits.joint] {
        JointLaw::Ball(ball) => ball.stop.is_some() && limits.bend.is_some(),
        JointLaw::Hinge(hinge) => (hinge.lower_stop.or(hinge.upper_stop)).is_some() && limits.turn.is_some(),
    };
    if has_old_stop {
        problems.warning(&path, "a viscous stop and an elastic limit in one joint", "one of them: both act");
    }
}

fn check_bend(angle: &Curve<f64>, is_twisted: bool, is_in_the_middle: bool, path: &str, problems: &mut Problems) {
    let [least, most] = angle.bounds().map(f64::to_degrees);
    let lowest = if most - least < 1e-9 { EVEN_DEG } else { BEND_DEG[0] };
    let (highest, beside) = if is_twisted { (TWIST_DEG, ", beside a limit of twist") } else { (BEND_DEG[1], "") };
    if !(least >= lowest - 1e-9 && most <= highest + 1e-9) {
        let found = format!("limits from {least:.1}° to {most:.1}°");
        problems.error(path, found, format!("{lowest}° to {highest}° everywhere{beside}"));
    } else if is_in_the_middle && !angle.is_even() {
        let found = "limits that differ to the left and to the right of a joint in the middle";
        problems.warning(path, found, "the same angle at 90° and 270°, and so on");
    }
}

fn check_stop(stop: &Stop<f64>, path: &str, problems: &mut Problems) {
    let (steepest, falls) = stop.steepness(PI);
    if falls || steepest.is_nan() || steepest <= 0.0 {
        let found = if falls { "a torque that falls somewhere" } else { "no torque at all" };
        problems.error(format!("{path}.torque"), found, "a torque that rises with the angle beyond the limit");
    }
}

/// Warns of joints that begin beyond their elastic limits.
pub(super) fn start(joints: &Joints, law: &LimitLaw<f64>, at: &Instant<'_, f64>, problems: &mut Problems) {
    let path = format!("joints.{}", joints.tree()[law.joint].name);
    let excess = law.excess(at).into_iter().flatten().fold(0.0, |most, (_, excess)| excess.max(most));
    let found = format!("{:.1}° beyond its elastic limit at the start", excess.to_degrees());
    let expected = "a posture that the body can take, or a wider limit";
    if excess > BEYOND_RAD {
        problems.error(path, found, expected);
    } else if excess > 0.0 {
        problems.warning(path, found, expected);
    }
}

impl LimitLaw<f64> {
    fn stops(&self) -> [Option<&Stop<f64>>; 2] {
        [self.bend.as_ref().map(|bend| &bend.stop), self.turn.as_ref().map(|turn| &turn.stop)]
    }

    /// Angle beyond the end of a curve, as text.
    pub(super) fn overrun(&self, joint: &str, past: &LimitHistory<f64>) -> Option<String> {
        let words = |x: f64| format!("{:.1}°", x.to_degrees());
        let of = format!("the joint {joint} beyond its limit");
        let both = self.stops().into_iter().zip(&past.stops);
        both.filter_map(|(stop, past)| stop?.overrun(&of, past.greatest, words)).next()
    }

    /// The joint.
    pub(crate) fn joint(&self) -> Joint {
        self.joint
    }

    /// Least last point of the torques of its stops, rad.
    pub(crate) fn last_point_rad(&self) -> f64 {
        self.stops().into_iter().flatten().fold(f64::INFINITY, |least, stop| least.min(stop.end()))
    }
}

//! Position and speed of the vehicle during the run.

use crate::forces::contact::surface::Frame;
use crate::model::setup::{STANDARD_GRAVITY_M_S2, Setup, TimeSpan};
use crate::vehicle::{FrameMotion, PathCursor, VehiclePath};
use placed_text::{Problem, Problems, with_key};

/// Usual and possible range of a quantity of a vehicle's motion.
struct Pace {
    of: fn(&FrameMotion) -> f64,
    what: &'static str,
    /// SI unit: its text and its value in SI.
    unit: (&'static str, f64),
    usual: f64,
    /// Bound, SI, beyond which positions lose the digits that forces need.
    most: f64,
    slip: &'static str,
}

/// Largest jump of position that counts as rounding, m.
const LEAP_M: f64 = 0.01;

const G: f64 = STANDARD_GRAVITY_M_S2;

/// Quantity, unit, usual and possible bounds, and the likely mistake.
#[rustfmt::skip]
const PACES: [Pace; 4] = [
    pace(|m| m.origin_m.norm(), "distance from the origin", ("m", 1.0), f64::INFINITY, 1e8,
        "shift the path so that it starts near the origin"),
    pace(|m| m.velocity_m_s.norm(), "speed", ("m/s", 1.0), 100.0, 1e6, "look at the units of times and places"),
    pace(|m| m.acceleration_m_s2.norm(), "acceleration", ("g", G), 100.0 * G, 1e9,
        "look at the units of times, places and accelerations"),
    pace(|m| m.angular_velocity_rad_s.norm(), "rate of turning", ("rad/s", 1.0), 50.0, 1e6,
        "look at the units of angles and rates; bare angles are degrees"),
];

const fn pace(
    of: fn(&FrameMotion) -> f64,
    what: &'static str,
    unit: (&'static str, f64),
    usual: f64,
    most: f64,
    slip: &'static str,
) -> Pace {
    Pace { of, what, unit, usual, most, slip }
}

/// Number of instants checked besides those at which the path is given.
const INSTANTS: u32 = 256;

/// Reports a path that ends before the run, and one that is impossible for a vehicle.
pub(in crate::model) fn check_path(setup: &Setup, problems: &mut Problems) {
    let (time, path) = (&setup.time, &setup.path);
    if let Err(problem) = path.check_span(time.start_s, time.end_s) {
        return problems.error("path", problem.to_string(), "a path for the whole run");
    }
    check_jumps(setup, problems);
    check_others(setup, problems);
    let mut cursor = PathCursor::default();
    let motions: Vec<(f64, FrameMotion)> =
        instants(setup).into_iter().map(|t_s| (t_s, path.motion(t_s, t_s, &mut cursor))).collect();
    if let Some((t_s, motion)) = motions.iter().find(|(_, motion)| !motion.is_finite()) {
        let found = format!("the vehicle's distance from the origin is {} m", motion.origin_m.norm());
        let found =
            if motion.origin_m.norm().is_finite() { "a motion with numbers that are not".to_owned() } else { found };
        return problems.error("path", format!("{found} at t = {t_s} s"), "finite numbers all along the run");
    }
    check_leaps(setup, &motions, problems);
    for Pace { of, what, unit: (unit, si), usual, most, slip } in PACES {
        let greatest = motions.iter().map(|(t_s, motion)| (*t_s, of(motion))).max_by(|a, b| a.1.total_cmp(&b.1));
        let Some((t_s, value)) = greatest.filter(|(_, value)| value.is_nan() || *value > usual.min(most)) else {
            continue;
        };
        let found = format!("the vehicle's {what} is {:.3e} {unit} at t = {t_s} s", value / si);
        let problem = if value <= most {
            Problem::warning("path", found, format!("at most {} {unit} in a crash", usual / si))
        } else {
            Problem::error("path", found, format!("at most {:.1e} {unit}, which the numbers can carry", most / si))
        };
        problems.push(problem.with_hint(Some(slip)));
    }
}

/// Reports a program's own path with jumps: a position inconsistent with its velocity.
fn check_leaps(setup: &Setup, motions: &[(f64, FrameMotion)], problems: &mut Problems) {
    if !matches!(setup.path, VehiclePath::Own(_)) {
        return;
    }
    let mut sorted: Vec<&(f64, FrameMotion)> = motions.iter().collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let leap = sorted.windows(2).find(|pair| {
        let ((t_0, a), (t_1, b)) = (pair[0], pair[1]);
        let (dt_s, speed) = (t_1 - t_0, a.velocity_m_s.norm().max(b.velocity_m_s.norm()));
        let most_m = speed * dt_s + a.acceleration_m_s2.norm().max(b.acceleration_m_s2.norm()) * dt_s * dt_s;
        (b.origin_m - a.origin_m).norm() > 2.0 * most_m + LEAP_M
    });
    if let Some([(t_0, a), (t_1, b)]) = leap.map(|pair| [pair[0], pair[1]]) {
        let found = format!(
            "the vehicle moves {:.3e} m between t = {t_0} s and {t_1} s at speeds of {:.3e} and {:.3e} m/s",
            (b.origin_m - a.origin_m).norm(),
            a.velocity_m_s.norm(),
            b.velocity_m_s.norm()
        );
        problems.error("path", found, "a position that changes as its velocity requires");
    }
}

/// Reports other frames whose path ends before the run or is not finite.
fn check_others(setup: &Setup, problems: &mut Problems) {
    let time = &setup.time;
    for frame in &setup.frames {
        let name = with_key("frames", &frame.name);
        if let Err(problem) = frame.path.check_span(time.start_s, time.end_s) {
            problems.error(name, problem.to_string(), "a path for the whole run");
            continue;
        }
        let mut cursor = PathCursor::default();
        let is_broken = |t_s: &f64| !frame.path.motion(*t_s, *t_s, &mut cursor).is_finite();
        let mut spread = (0..=INSTANTS).map(|i| instant(time, i));
        if let Some(t_s) = spread.find(is_broken) {
            problems.error(name, format!("numbers that are not finite at t = {t_s} s"), "a path of finite numbers");
        }
    }
}

/// Instant with this index, spread over the run, s.
fn instant(time: &TimeSpan, i: u32) -> f64 {
    time.start_s + (time.end_s - time.start_s) * f64::from(i) / f64::from(INSTANTS)
}

/// Instants spread over the run, those at which the path is given, and the midpoints between all of them.
fn instants(setup: &Setup) -> Vec<f64> {
    let time = &setup.time;
    let spread = (0..=INSTANTS).map(|i| instant(time, i));
    let given = setup.path.given_s().into_iter().filter(|t_s| (time.start_s..=time.end_s).contains(t_s));
    let mut all: Vec<f64> = spread.chain(given).collect();
    all.sort_by(f64::total_cmp);
    let middles = all.windows(2).map(|pair| f64::midpoint(pair[0], pair[1]));
    middles.chain(all.iter().copied()).collect()
}

/// Permitted change of a mount's velocity from one instant to the next, m/s and rad/s.
const JUMP: f64 = 1e-3;

/// Reports a jump of velocity in the path of a mount, whose force would be infinite.
fn check_jumps(setup: &Setup, problems: &mut Problems) {
    let time = &setup.time;
    if setup.mounting().is_none_or(|mounting| mounting.frame == Frame::Space) {
        return;
    }
    let jump = |t_s: f64| {
        let by_s = 1e-9 * (time.end_s - time.start_s);
        let [before, after] =
            [t_s - by_s, t_s + by_s].map(|middle_s| setup.path.motion(t_s, middle_s, &mut PathCursor::default()));
        let turning = (after.angular_velocity_rad_s - before.angular_velocity_rad_s).norm();
        (after.velocity_m_s - before.velocity_m_s).norm().max(turning)
    };
    let within = setup.path.breaks_s().into_iter().filter(|t_s| *t_s > time.start_s && *t_s < time.end_s);
    if let Some(t_s) = within.into_iter().find(|t_s| jump(*t_s) > JUMP) {
        problems.error_with_hint(
            "path",
            format!("the velocity of the mount jumps by {:.3} m/s or rad/s at t = {t_s} s", jump(t_s)),
            "a velocity without jumps: a mounted segment cannot yield",
            "splines between the times of a table, `after = \"coast\"`, or an end of the run before",
        );
    }
}

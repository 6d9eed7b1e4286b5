//! Which accelerometers of a vehicle give its path: those that agree on the forward velocity change, and of these the ones that
//! ring least. The mean of the left and the right one is the motion between them: a yaw of the vehicle cancels out of it.

use std::borrow::Cow;

use super::motion::at_times;
use crate::base::Failure;
use crate::signals::{Recording, Signal};

/// Between the names of sensors whose mean is used.
pub(super) const JOIN: &str = " + ";
/// The centre of gravity of a vehicle in ISO-MME.
const CENTRE: &str = "VEHCCG";
/// The centre of gravity, then the mean of a left and a right location, is preferred if it rings at most this many times as much
/// as the quietest location.
const MOST_RINGING: f64 = 2.0;

/// A location with a forward accelerometer, or the mean of several.
#[derive(Clone)]
pub(super) struct Location<'a> {
    pub name: String,
    /// Accelerations forward, to the right, down.
    pub axes: [Option<Cow<'a, Signal>>; 3],
    /// Forward velocity change, m/s; NaN without a unit.
    change_m_s: f64,
    /// Sum of all rises and falls of the forward acceleration, m/s²; infinite without a unit.
    ringing_m_s2: f64,
}

impl<'a> Location<'a> {
    fn new(name: String, axes: [Option<Cow<'a, Signal>>; 3]) -> Option<Self> {
        let forward = axes[0].as_ref()?;
        let (change_m_s, ringing_m_s2) = (velocity_change_m_s(forward), ringing_m_s2(forward));
        Some(Location { name, axes, change_m_s, ringing_m_s2 })
    }

    /// The mean of several locations, along an axis of those that have it.
    fn mean(of: &[&Self]) -> Option<Self> {
        let axis = |i: usize| match of.iter().filter_map(|own| own.axes[i].as_deref()).collect::<Vec<_>>()[..] {
            [] => None,
            ref all => Some(Cow::Owned(mean(all))),
        };
        let names: Vec<&str> = of.iter().map(|own| own.name.as_str()).collect();
        Location::new(names.join(JOIN), [0, 1, 2].map(axis))
    }

    pub(super) fn is_centre(&self) -> bool {
        self.name == CENTRE
    }

    /// Its name in a sentence.
    pub(super) fn told(&self) -> String {
        if self.name.contains(JOIN) {
            format!("the mean of {}", self.name.replace(JOIN, " and "))
        } else {
            self.name.clone()
        }
    }
}

/// The locations of a record, in its order.
pub(super) fn locations(recording: &Recording) -> Vec<Location<'_>> {
    let mut found: Vec<(String, [Option<Cow<'_, Signal>>; 3])> = Vec::new();
    for signal in &recording.signals {
        let Some((place, axis)) = acceleration(signal) else { continue };
        let at = found.iter().position(|(own, _)| *own == place).unwrap_or_else(|| {
            found.push((place, [None, None, None]));
            found.len() - 1
        });
        found[at].1[axis].get_or_insert(Cow::Borrowed(signal));
    }
    found.into_iter().filter_map(|(name, axes)| Location::new(name, axes)).collect()
}

/// The location of this name, or the mean of several with `+` between them.
///
/// # Errors
/// A name that is none of a forward accelerometer.
pub(super) fn named<'a>(all: &[Location<'a>], words: &str) -> Result<Location<'a>, Failure> {
    let find = |word: &str| {
        all.iter().find(|own| own.name.eq_ignore_ascii_case(word.trim())).ok_or_else(|| {
            let names: Vec<&str> = all.iter().map(|own| own.name.as_str()).collect();
            Failure::with_help(
                format!("--at {words}: {} has no forward accelerometer", word.trim()),
                &format!("places are {}", if names.is_empty() { "none".to_owned() } else { names.join(", ") }),
            )
        })
    };
    let of = words.split('+').map(find).collect::<Result<Vec<_>, _>>()?;
    match of[..] {
        [one] => Ok(one.clone()),
        _ => Location::mean(&of).ok_or_else(|| Failure::plain(format!("--at {words}: no common acceleration"))),
    }
}

/// The location that gives the path, and why if there are several.
///
/// Each location has a vote on the velocity change; a left and a right one that differ have one together, their mean. If most
/// are near the median, one of those is taken.
pub(super) fn chosen<'a>(all: &[Location<'a>]) -> Option<(Location<'a>, Option<String>)> {
    let pairs = pairs(all);
    let is_turned = |pair: &&(usize, usize)| !near(all[pair.0].change_m_s, all[pair.1].change_m_s);
    let mean = |pair: &(usize, usize)| Location::mean(&[&all[pair.0], &all[pair.1]]);
    let turned: Vec<&(usize, usize)> = pairs.iter().filter(is_turned).collect();
    let is_alone = |i: &usize| !turned.iter().any(|pair| [pair.0, pair.1].contains(i));
    let mut candidates: Vec<Location<'a>> = (0..all.len()).filter(is_alone).map(|i| all[i].clone()).collect();
    candidates.extend(turned.iter().filter_map(|pair| mean(pair)));
    let votes: Vec<f64> = candidates.iter().map(|own| own.change_m_s).filter(|change| !change.is_nan()).collect();
    candidates.extend(pairs.iter().filter(|pair| !is_turned(pair)).filter_map(mean));
    let middle = median(&votes);
    let agree = votes.iter().filter(|change| near(**change, middle)).count();
    let is_agreed = 2 * agree > votes.len();
    let pool: Vec<&Location<'a>> = candidates.iter().filter(|own| !is_agreed || near(own.change_m_s, middle)).collect();
    let least = |fits: &dyn Fn(&Location<'a>) -> bool| {
        let fitting = pool.iter().filter(|own| fits(own));
        fitting.min_by(|a, b| a.ringing_m_s2.total_cmp(&b.ringing_m_s2)).copied()
    };
    let quietest = least(&|_| true)?;
    let is_good = |own: &Location<'a>| own.ringing_m_s2 <= MOST_RINGING * quietest.ringing_m_s2;
    let centre = least(&|own| own.is_centre() && is_good(own));
    let sides = least(&|own| own.name.contains(JOIN) && is_good(own));
    let own = centre.or(sides).unwrap_or(quietest);
    if centre.is_some() || all.len() < 2 {
        return Some((own.clone(), None));
    }
    let rings = if std::ptr::eq(own, quietest) { "the least ringing" } else { "little ringing" };
    let why = if is_agreed {
        let (count, number) = (votes.len(), placed_text::number((middle * 3.6).round()));
        format!("{rings} of the {agree} of {count} locations with a forward delta-v of {number} km/h ± 10 %")
    } else {
        format!("{rings}; the locations do not agree on the delta-v")
    };
    Some((own.clone(), Some(why)))
}

/// Left and right locations whose names are otherwise the same: `DSLF` and `DSRF`, `SILLLE` and `SILLRI`.
fn pairs(all: &[Location<'_>]) -> Vec<(usize, usize)> {
    let are_sides = |a: &str, b: &str| {
        let differ: Vec<(u8, u8)> = a.bytes().zip(b.bytes()).filter(|(a, b)| a != b).collect();
        a.len() == b.len() && matches!(differ[..], [(b'L', b'R')] | [(b'L', b'R'), (b'E', b'I')])
    };
    let of = |left: usize| (0..all.len()).map(move |right| (left, right));
    (0..all.len()).flat_map(of).filter(|&(left, right)| are_sides(&all[left].name, &all[right].name)).collect()
}

/// Within a tenth, or half a metre per second.
fn near(change_m_s: f64, middle_m_s: f64) -> bool {
    (change_m_s - middle_m_s).abs() <= (0.1 * middle_m_s.abs()).max(0.5)
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    match sorted.len() {
        0 => f64::NAN,
        count => 0.5 * (sorted[(count - 1) / 2] + sorted[count / 2]),
    }
}

/// Mean of signals at the times of the first, in its unit.
fn mean(of: &[&Signal]) -> Signal {
    let first = of[0];
    let factor = |signal: &Signal| signal.scale.map_or(f64::NAN, |scale| scale.factor);
    let parts: Vec<Vec<f64>> = of.iter().map(|signal| at_times(signal, &first.time_s)).collect();
    let weights: Vec<f64> = of.iter().map(|signal| factor(signal) / factor(first) / of.len() as f64).collect();
    let value = |i: usize| parts.iter().zip(&weights).map(|(values, weight)| values[i] * weight).sum();
    let names: Vec<&str> = of.iter().map(|signal| signal.name.as_str()).collect();
    Signal {
        name: names.join(JOIN),
        code: None,
        scale: first.scale.filter(|_| of.iter().all(|signal| signal.scale.is_some())),
        values: (0..first.time_s.len()).map(value).collect(),
        ..first.clone()
    }
}

/// Location and axis of a vehicle accelerometer, by code or NHTSA name; none for other signals.
fn acceleration(signal: &Signal) -> Option<(String, usize)> {
    if let Some(code) = signal.code {
        return code.vehicle_acceleration();
    }
    let parts: Vec<&str> = signal.name.split('_').collect();
    match parts[..] {
        ["NA", place, axis, "AC"] => Some((place.to_owned(), "XYZ".find(axis.chars().next()?)?)),
        _ => None,
    }
}

fn velocity_change_m_s(signal: &Signal) -> f64 {
    let samples = signal.time_s.windows(2).zip(signal.values.windows(2)).filter(|(_, v)| !(v[0] + v[1]).is_nan());
    let sum: f64 = samples.map(|(t, v)| 0.5 * (t[1] - t[0]) * (v[0] + v[1])).sum();
    signal.scale.map_or(f64::NAN, |scale| sum * scale.factor)
}

fn ringing_m_s2(signal: &Signal) -> f64 {
    let steps = signal.values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).filter(|step| step.is_finite());
    steps.sum::<f64>() * signal.scale.map_or(f64::INFINITY, |scale| scale.factor.abs())
}

/// Note if locations give velocity changes that differ by more than a tenth.
pub(super) fn disagreement(all: &[Location<'_>]) -> Option<String> {
    let known = || all.iter().filter(|own| !own.change_m_s.is_nan());
    let of = |pick: fn(f64, f64) -> f64| known().map(|own| own.change_m_s).reduce(pick);
    let (least, most) = of(f64::min).zip(of(f64::max))?;
    let differ = most - least > 0.1 * most.abs().max(least.abs()) && most - least > 0.5;
    let told = known().map(|own| format!("{} {:.1}", own.name, own.change_m_s * 3.6)).collect::<Vec<_>>().join(", ");
    differ.then(|| {
        format!("locations on the vehicle disagree on its forward delta-v, km/h: {told}; choose another with --at")
    })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;
    use std::path::PathBuf;

    use super::*;
    use crate::signals::scale_of;

    /// A half sine of 20 g in 100 ms, a lever arm times a yaw acceleration, and a ring, at NHTSA's places.
    fn record(places: &[(&str, f64, f64, &str)]) -> Recording {
        let time_s: Vec<f64> = (0..1001).map(|i| 1e-4 * f64::from(i)).collect();
        let signal = |&(place, yaw_g, ring_g, unit): &(&str, f64, f64, &str)| {
            let scale = scale_of(unit);
            let unit_g = scale.map_or(1.0, |scale| scale.factor / 9.80665);
            let value =
                |t: &f64| ((-20.0 + yaw_g) * (PI * t / 0.1).sin() + ring_g * (2.0 * PI * 200.0 * t).sin()) / unit_g;
            Signal {
                name: format!("NA_{place}_XG_AC"),
                code: None,
                unit: Some(unit.to_owned()),
                scale,
                values: time_s.iter().map(value).collect(),
                time_s: time_s.clone(),
                place: String::new(),
            }
        };
        let signals = places.iter().map(signal).collect();
        Recording { path: PathBuf::from("r"), sha256: String::new(), signals, notes: Vec::new() }
    }

    fn best(places: &[(&str, f64, f64, &str)]) -> (String, f64) {
        let record = record(places);
        let (own, _) = chosen(&locations(&record)).expect("a location");
        (own.name, own.change_m_s)
    }

    #[test]
    fn a_left_and_a_right_sensor_give_the_motion_between_them() {
        // whatever the yaw, and in different units: 2/π · 20 g · 0.1 s
        let wanted = -2.0 / PI * 20.0 * 9.80665 * 0.1;
        for yaw_g in [0.0, 1.0, 6.0] {
            let found = best(&[("DSLF", yaw_g, 3.0, "g"), ("DSRF", -yaw_g, 2.0, "m/s^2"), ("ENGN", 12.0, 9.0, "g")]);
            assert_eq!(found.0, "DSLF + DSRF", "{yaw_g}");
            assert!((found.1 / wanted - 1.0).abs() < 1e-5, "{} {wanted}", found.1);
        }
        // one of the two rings
        assert_eq!(best(&[("DSLF", 0.0, 40.0, "g"), ("DSRF", 0.0, 2.0, "g")]).0, "DSRF");
        // names that differ otherwise are no pair
        assert_eq!(best(&[("DSLF", 0.0, 4.0, "g"), ("DSRR", 0.0, 3.0, "g")]).0, "DSRR");
    }

    #[test]
    fn locations_are_named_one_by_one_or_together() {
        let record = record(&[("DSLF", 2.0, 0.0, "g"), ("DSRF", -4.0, 0.0, "g"), ("RRUN", 0.0, 0.0, "furlong")]);
        let all = locations(&record);
        let change = |words: &str| named(&all, words).map(|own| own.change_m_s);
        let (left, right) = (change("dslf").unwrap_or(0.0), change(" DSRF").unwrap_or(0.0));
        assert!(change("DSLF + DSRF").is_ok_and(|both| (both - 0.5 * (left + right)).abs() < 1e-12));
        // without a unit no mean is known
        assert!(named(&all, "DSLF+RRUN").is_ok_and(|own| own.axes[0].as_ref().is_some_and(|a| a.scale.is_none())));
        for words in ["", "DSLF+", "DSLF+DSRF+NONE"] {
            assert!(named(&all, words).is_err(), "{words}");
        }
    }
}

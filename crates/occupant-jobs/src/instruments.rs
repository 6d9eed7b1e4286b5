//! The instruments of a dummy in a test: which columns of a table are the signals of injury measures.

use crash_measures::injury::{Signals, Special};
use crash_measures::signal::uniform_interval;
use occupant_units::unit::Unit::{
    self, MetrePerSecondSquared, Newton, NewtonMetre, RadianPerSecond, RadianPerSecondSquared,
};

use crate::base::Failure;
use occupant_files::measured::{MapArgument, Pair, Wanted, pairs};
use occupant_files::signals::Recording;

/// Signals of every body, in the order of [`Signals::all_mut`]: channel name, unit, and whether its axes are those of a
/// segment (Y left, Z up) instead of SAE J211 (Y right, Z down).
const VECTORS: [(&str, Unit, bool); 7] = [
    ("head.acceleration", MetrePerSecondSquared, true),
    ("upper_torso.acceleration", MetrePerSecondSquared, true),
    ("lower_torso.acceleration", MetrePerSecondSquared, true),
    ("head.angular_velocity", RadianPerSecond, true),
    ("head.angular_acceleration", RadianPerSecondSquared, true),
    ("neck.force", Newton, false),
    ("neck.moment", NewtonMetre, false),
];
/// The femurs, which follow.
const FEMURS: [&str; 2] = ["right_femur.axial", "left_femur.axial"];
/// Number of vectors for which a resultant suffices.
const ACCELERATIONS: usize = 3;
/// Number of vectors of which measures need all axes; of the neck some do with one.
const WHOLE: usize = 5;

/// Destination of a signal.
#[derive(Clone, Copy, Debug)]
enum Goal {
    /// Index in [`Signals::all_mut`], and factor on its values.
    Common(usize, f64),
    /// Resultant of the acceleration with this index.
    Resultant(usize),
    Special(Special),
}

/// Signals recorded in a test.
#[derive(Clone, Debug)]
pub struct Instruments {
    /// The signals, SI units, along SAE J211 axes.
    pub signals: Signals,
    /// Signals with the columns they are read from.
    pub read: Vec<(String, String)>,
    /// Deviations from the headings.
    pub notes: Vec<String>,
}

impl Instruments {
    /// Signals of the occupant on `seat` in a recording; `shift_s` is added to its clock.
    ///
    /// # Errors
    /// A map or unit that does not fit, no signal that a measure is made of, times that are not equally spaced, signals with
    /// other times.
    pub fn of(recording: &Recording, maps: &[MapArgument], seat: char, shift_s: f64) -> Result<Self, Failure> {
        let goals = goals();
        known(maps, &goals)?;
        let wanted: Vec<Wanted> = goals.iter().map(|(name, unit, _)| wanted(name, *unit)).collect();
        let mut notes = recording.notes.clone();
        let mut found = pairs(recording, &wanted, maps, seat, &mut notes)?;
        found.retain(|pair| is_whole(pair, &mut notes));
        let Some(first) = found.first() else {
            let file = recording.path.display();
            if !notes.is_empty() {
                let what = format!("{file} has no complete signal for any injury measure: {}", notes.join("; "));
                return Err(Failure::with_help(what, "fill or cut what is missing in the table"));
            }
            let names: Vec<&str> = recording.signals.iter().take(8).map(|signal| signal.name.as_str()).collect();
            return Err(Failure::with_help(
                format!("{file} has no signal for any injury measure"),
                &format!(
                    "it has {}; assign them with --map, such as '{}=head.acceleration.x'",
                    names.join(", "),
                    names.first().unwrap_or(&"column")
                ),
            ));
        };
        let file = recording.path.display();
        let interval_s = uniform_interval(&first.time_s).map_err(|error| {
            Failure::with_help(
                format!("{file}: {}: {error}", first.signal),
                "resample the table: measures need a constant sample interval",
            )
        })?;
        if let Some(other) = found.iter().find(|pair| pair.time_s != first.time_s) {
            return Err(Failure::with_help(
                format!("{file}: {} has different times than {}", other.signal, first.signal),
                "write all signals at the same times, as one table",
            ));
        }
        let signals = Signals { start_s: first.time_s[0] + shift_s, interval_s, ..filled(&found, &goals) };
        let read: Vec<_> = found.iter().map(|pair| (goals[pair.channel].0.clone(), pair.signal.clone())).collect();
        notes.extend(VECTORS[..WHOLE].iter().filter_map(|(name, ..)| incomplete(name, &read)));
        Ok(Instruments { signals, read, notes })
    }

    /// Times of the first and the last sample, s.
    pub fn span_s(&self) -> [f64; 2] {
        let Signals { start_s, interval_s, .. } = self.signals;
        [start_s, start_s + self.signals.len().saturating_sub(1) as f64 * interval_s]
    }
}

/// What to say of a vector of which neither all axes nor the resultant were read.
fn incomplete(name: &str, read: &[(String, String)]) -> Option<String> {
    let has = |axis: &str| read.iter().any(|(goal, _)| goal.strip_prefix(name) == Some(axis));
    let missing: Vec<&str> = [".x", ".y", ".z"].into_iter().filter(|axis| !has(axis)).collect();
    let is_part = (1..3).contains(&missing.len()) && !has(".resultant");
    is_part.then(|| {
        format!("{name} has no {}: measures that need all its axes are left out", missing.join(", ").replace('.', ""))
    })
}

/// Whether a signal has all values; if not, that is noted.
fn is_whole(pair: &Pair, notes: &mut Vec<String>) -> bool {
    let missing: Vec<usize> = (0..pair.values.len()).filter(|i| pair.values[*i].is_nan()).collect();
    let Some(first) = missing.first() else { return true };
    notes.push(format!(
        "{} is skipped: {} of its {} values are missing, the first at {:.1} ms",
        pair.signal,
        missing.len(),
        pair.values.len(),
        1e3 * pair.time_s[*first]
    ));
    false
}

/// Checks that maps name signals used by measures.
fn known(maps: &[MapArgument], goals: &[(String, Unit, Goal)]) -> Result<(), Failure> {
    let stranger = maps.iter().map(MapArgument::channel).find(|name| goals.iter().all(|(own, ..)| own != name));
    let Some(stranger) = stranger else { return Ok(()) };
    let like = goals.iter().map(|(name, ..)| name.as_str());
    let near: Vec<&str> = like.filter(|name| name.split('.').next() == stranger.split('.').next()).collect();
    let hint = if near.is_empty() { "see the list in measures.md".to_owned() } else { near.join(", ") };
    Err(Failure::with_help(format!("--map: no injury measure uses `{stranger}`"), &format!("measures use {hint}")))
}

fn wanted(name: &str, unit: Unit) -> Wanted {
    Wanted { name: name.to_owned(), unit: Some((unit.dimension(), unit.symbol().to_owned())), place: None }
}

/// All signals used by measures.
fn goals() -> Vec<(String, Unit, Goal)> {
    let mut goals = Vec::new();
    for (v, (name, unit, turned)) in VECTORS.into_iter().enumerate() {
        for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
            let sign = if turned && axis > 0 { -1.0 } else { 1.0 };
            goals.push((format!("{name}.{letter}"), unit, Goal::Common(3 * v + axis, sign)));
        }
        if v < ACCELERATIONS {
            goals.push((format!("{name}.resultant"), unit, Goal::Resultant(v)));
        }
    }
    for (side, name) in FEMURS.into_iter().enumerate() {
        goals.push((name.to_owned(), Newton, Goal::Common(3 * VECTORS.len() + side, 1.0)));
    }
    goals.extend(Special::all().map(|which| (which.to_string(), which.unit(), Goal::Special(which))));
    goals
}

/// Signals with the data found; empty where missing.
fn filled(found: &[Pair], goals: &[(String, Unit, Goal)]) -> Signals {
    let length = found.first().map_or(0, |pair| pair.values.len());
    let mut common = vec![vec![f64::NAN; length]; 3 * VECTORS.len() + FEMURS.len()];
    let mut signals = Signals::new();
    let goal = |pair: &Pair| goals[pair.channel].2;
    for pair in found {
        match goal(pair) {
            Goal::Common(place, sign) => common[place] = pair.values.iter().map(|value| sign * value).collect(),
            Goal::Special(which) => drop(signals.special.insert(which, pair.values.clone())),
            Goal::Resultant(_) => (),
        }
    }
    for pair in found {
        let Goal::Resultant(v) = goal(pair) else { continue };
        if common[3 * v..3 * v + 3].iter().any(|values| values.iter().all(|value| value.is_nan())) {
            signals.resultants[v] = Some(pair.values.clone());
        }
    }
    signals.all_mut().zip(common).for_each(|(own, values)| *own = values);
    signals
}

#[cfg(test)]
mod tests {
    use super::*;
    use crash_measures::injury::{Filtering, Options, assess};
    use crash_measures::measure::Dummy;
    use crash_measures::signal::CfcFamily;
    use occupant_files::signals::Signal;
    use std::collections::BTreeMap;
    use std::f64::consts::PI;

    /// Instruments of a table at 10 kHz, of 300 ms; each column is a half-sine of 40 ms with this peak, SI units.
    fn read(columns: &[(&str, f64)]) -> Result<Instruments, Failure> {
        let time_s: Vec<f64> = (0..3000).map(|i| f64::from(i) * 1e-4).collect();
        let pulse = |t: f64| if (0.05..0.09).contains(&t) { (PI * (t - 0.05) / 0.04).sin() } else { 0.0 };
        let signals = columns.iter().map(|(name, peak)| Signal {
            name: (*name).to_owned(),
            code: None,
            unit: None,
            scale: None,
            time_s: time_s.clone(),
            values: time_s.iter().map(|t| peak * pulse(*t)).collect(),
            place: "column".to_owned(),
        });
        let (path, sha256, notes) = ("test.csv".into(), String::new(), Vec::new());
        Instruments::of(&Recording { path, sha256, signals: signals.collect(), notes }, &[], '1', 0.0)
    }

    fn measures(columns: &[(&str, f64)]) -> BTreeMap<String, f64> {
        let filtering = Filtering::Classes(CfcFamily::SaeJ211);
        let options = Options { filtering, dummy: Dummy::BioRidIi, ..Options::default() };
        let found = assess(&read(columns).unwrap().signals, &options);
        found.into_iter().filter_map(|m| Some((m.name.to_owned(), m.value?))).collect()
    }

    #[test]
    fn a_neck_without_side_loads_is_filtered_and_judged() {
        let some = [("neck.force.x", 200.0), ("neck.force.z", 2000.0), ("neck.moment.y", 40.0)];
        let others = [("neck.force.y", 0.0), ("neck.moment.x", 0.0), ("neck.moment.z", 0.0)];
        let (part, whole) = (measures(&some), measures(&[some, others].concat()));
        for name in ["nij", "neck_tension", "neck_compression", "neck_flexion", "neck_extension"] {
            assert_eq!(part.get(name), whole.get(name), "{name}");
        }
        assert!(part["neck_tension"] > 1900.0);
    }

    #[test]
    fn a_resultant_says_nothing_of_an_axis() {
        let (t1, ahead) = (Special::T1.to_string(), ("head.acceleration.x", 20.0));
        let (t1, resultant) = ((t1.as_str(), 50.0), ("head.acceleration.resultant", 80.0));
        let [x, both, alone] =
            [vec![t1, ahead], vec![t1, ahead, resultant], vec![t1, resultant]].map(|all| measures(&all));
        assert_eq!((x.get("nic"), x.get("hic15")), (both.get("nic"), None));
        assert_eq!((alone.get("nic"), alone.get("hic15")), (None, both.get("hic15")));
        assert!(x["nic"] > 1.0 && both["hic15"] > 1.0);
    }

    #[test]
    fn what_is_incomplete_or_there_twice_is_said() {
        let notes = read(&[("head.acceleration.x", 1.0), ("head.acceleration.z", 1.0)]).unwrap().notes;
        assert!(notes.iter().any(|note| note.starts_with("head.acceleration has no y")), "{notes:?}");
        let twice = read(&[("head.acceleration.x", 1.0), ("head.acceleration.x", 2.0)]).unwrap_err();
        assert!(format!("{twice:?}").contains("more than one signal for head.acceleration.x"), "{twice:?}");
    }
}

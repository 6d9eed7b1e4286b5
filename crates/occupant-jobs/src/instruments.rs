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

/// Destination of a signal.
#[derive(Clone, Copy, Debug)]
enum Goal {
    /// Index in [`Signals::all_mut`], and factor on its values.
    Common(usize, f64),
    /// X of an acceleration known only by its resultant.
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
            let names: Vec<&str> = recording.signals.iter().take(8).map(|signal| signal.name.as_str()).collect();
            return Err(Failure::with_help(
                format!("{} has no signal for any injury measure", recording.path.display()),
                &format!(
                    "it has {}; assign them with --map, such as '{}[g]=head.acceleration.x'",
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
        let read = found.iter().map(|pair| (goals[pair.channel].0.clone(), pair.signal.clone())).collect();
        Ok(Instruments { signals, read, notes })
    }
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
            goals.push((format!("{name}.resultant"), unit, Goal::Resultant(3 * v)));
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
        let Goal::Resultant(x) = goal(pair) else { continue };
        if (x..x + 3).any(|axis| common[axis].iter().all(|value| value.is_nan())) {
            common[x].clone_from(&pair.values);
            common[x + 1..x + 3].iter_mut().for_each(|values| *values = vec![0.0; length]);
        }
    }
    signals.all_mut().zip(common).for_each(|(own, values)| *own = values);
    signals
}

//! The instruments of a dummy in a test: which columns of a table are the signals of injury measures.

use crash_measures::injury::{Signals, Special};
use crash_measures::signal::uniform_interval;
use occupant_units::unit::Unit::{
    self, MetrePerSecondSquared, Newton, NewtonMetre, RadianPerSecond, RadianPerSecondSquared,
};

use crate::base::Failure;
use occupant_files::measured::{MapArgument, Pair, Wanted, pairs};
use occupant_files::signals::Recording;

/// What every body has, in the order of [`Signals::all_mut`]: its name as a channel of a run, its unit, and whether its axes
/// are those of a segment (Y left, Z up), not of SAE J211 (Y right, Z down).
const VECTORS: [(&str, Unit, bool); 7] = [
    ("head.acceleration", MetrePerSecondSquared, true),
    ("upper_torso.acceleration", MetrePerSecondSquared, true),
    ("lower_torso.acceleration", MetrePerSecondSquared, true),
    ("head.angular_velocity", RadianPerSecond, true),
    ("head.angular_acceleration", RadianPerSecondSquared, true),
    ("neck.force", Newton, false),
    ("neck.moment", NewtonMetre, false),
];
/// The thighs, behind them.
const FEMURS: [&str; 2] = ["right_femur.axial", "left_femur.axial"];
/// Of so many of the vectors a resultant alone will do.
const ACCELERATIONS: usize = 3;

/// Where a signal goes.
#[derive(Clone, Copy, Debug)]
enum Goal {
    /// The place in [`Signals::all_mut`], and what its values are multiplied by.
    Common(usize, f64),
    /// The X of an acceleration of which nothing else is known.
    Resultant(usize),
    Special(Special),
}

/// What a test read.
#[derive(Clone, Debug)]
pub struct Instruments {
    /// The signals, SI units, along SAE J211 axes.
    pub signals: Signals,
    /// Which signal is read from which column.
    pub read: Vec<(String, String)>,
    /// What was read otherwise than it is written.
    pub notes: Vec<String>,
}

impl Instruments {
    /// Those of a recording, of the occupant on `seat`; `shift_s` is added to its clock.
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

/// Whether a signal has all its values; if not, that is noted.
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

/// Whether maps name signals that measures are made of.
fn known(maps: &[MapArgument], goals: &[(String, Unit, Goal)]) -> Result<(), Failure> {
    let stranger = maps.iter().map(MapArgument::channel).find(|name| goals.iter().all(|(own, ..)| own != name));
    let Some(stranger) = stranger else { return Ok(()) };
    let like = goals.iter().map(|(name, ..)| name.as_str());
    let near: Vec<&str> = like.filter(|name| name.split('.').next() == stranger.split('.').next()).collect();
    let hint = if near.is_empty() { "see the list in measures.md".to_owned() } else { near.join(", ") };
    Err(Failure::with_help(format!("--map: no injury measure uses `{stranger}`"), &format!("measures use {hint}")))
}

fn wanted(name: &str, unit: Unit) -> Wanted {
    Wanted { name: name.to_owned(), unit: Some((unit.dimension(), unit.symbol().to_owned())) }
}

/// Every signal that a measure can be made of.
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

/// Signals with what was found; no numbers of what was not.
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

//! Which signals of a record are the motion of its vehicle, side by side at common times: accelerations and rates, velocity changes, or
//! places and angles. They keep their file's units and axes.

use std::borrow::Cow;

use crash_measures::signal::{Hole, bridged, holes, usual_interval};
use occupant_core::vehicle::{Station, unwrap_angles};
use occupant_scenario::{column_in, column_named};

use super::locations::{JOIN, Location, chosen, disagreement, locations, named};
use crate::base::Failure;
use crate::signals::{Recording, Signal};

/// Columns of records, and the corresponding channels of runs.
pub(super) const OF_RUNS: [(&str, &str); 6] = [
    ("ax", "vehicle.acceleration.x"),
    ("ay", "vehicle.acceleration.y"),
    ("az", "vehicle.acceleration.z"),
    ("wx", "vehicle.angular_velocity.x"),
    ("wy", "vehicle.angular_velocity.y"),
    ("wz", "vehicle.angular_velocity.z"),
];
/// Columns of positions and angles; of velocity changes.
const OF_PLACES: [&str; 6] = ["x", "y", "z", "roll", "pitch", "yaw"];
const OF_CHANGES: [&str; 2] = ["dvx", "dvy"];

/// Longest gap of a velocity change that is bridged by default, s: recorders write every 10 ms.
const SHORT_S: f64 = 0.020_001;

/// Kind of recorded motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionKind {
    /// Accelerations and rates of sensors.
    Accelerations,
    /// Velocity changes of an event data recorder.
    Changes,
    /// Positions and angles.
    Places,
}

/// A column of the motion.
#[derive(Clone, Debug)]
pub struct Column {
    /// Name as in paths of scenarios.
    pub name: &'static str,
    /// Its unit as written.
    pub unit: String,
    /// SI value of one unit.
    pub factor: f64,
    /// Values in its unit; NaN where missing.
    pub values: Vec<f64>,
}

/// The recorded motion of a vehicle.
#[derive(Clone, Debug)]
pub struct Motion {
    /// Its kind.
    pub kind: MotionKind,
    /// Its description.
    pub words: String,
    /// Times, s.
    pub time_s: Vec<f64>,
    /// Its columns.
    pub columns: Vec<Column>,
    /// Names of the signals that it is built from.
    pub signals: Vec<String>,
}

/// Signals found, by column.
type Found<'a> = Vec<(&'static str, Cow<'a, Signal>)>;

/// Choice of signals, and gaps to bridge.
#[derive(Clone, Copy, Debug, Default)]
pub struct Placed<'a> {
    /// Location of the vehicle's sensors; the centre of gravity, or the first available, if absent.
    pub at: Option<&'a str>,
    /// Longest gap that is bridged, s.
    pub bridge_s: Option<f64>,
}

impl Motion {
    /// The motion in a record; none if it has none.
    ///
    /// # Errors
    /// A place that has no accelerometers; a signal without a unit; a hole that was not to be bridged.
    pub fn of(recording: &Recording, placed: Placed, notes: &mut Vec<String>) -> Result<Option<Self>, Failure> {
        let (kind, found, words) = recorded(recording, placed.at, notes)?;
        let Some((_, first)) = found.first() else { return Ok(None) };
        notes.extend(beyond(&found, first));
        notes.extend(found.iter().filter_map(|(name, signal)| doubled(recording, name, signal)));
        let column = |(name, signal): &(&'static str, Cow<'_, Signal>)| {
            let (scale, unit) = signal.scale.zip(signal.unit.clone()).ok_or_else(|| without_unit(signal))?;
            if column_in(name, scale.dimension) != Some(*name) {
                return Err(Failure::with_help(
                    format!("{}: `{unit}` is not a unit for {}, which should be {name}", signal.place, signal.name),
                    "give its real unit, such as ax[g], wz[deg/s] or x[m]",
                ));
            }
            Ok(Column { name, unit, factor: scale.factor, values: at_times(signal, &first.time_s) })
        };
        let mut motion = Motion {
            kind,
            words,
            time_s: first.time_s.clone(),
            columns: found.iter().map(column).collect::<Result<_, Failure>>()?,
            signals: found.iter().flat_map(|(_, signal)| signal.name.split(JOIN)).map(str::to_owned).collect(),
        };
        motion.trim(notes);
        if motion.time_s.len() < 2 {
            return Err(Failure::plain(format!(
                "{}: no two times have values of all of {}",
                recording.path.display(),
                motion.names().join(", ")
            )));
        }
        motion.bridge(placed.bridge_s, notes)?;
        motion.unwrap(notes);
        Ok(Some(motion))
    }

    /// A column in SI, by name.
    pub fn si(&self, name: &str) -> Option<Vec<f64>> {
        let column = self.columns.iter().find(|column| column.name == name)?;
        Some(column.values.iter().map(|value| value * column.factor).collect())
    }

    /// Whether it has a column of this name.
    pub fn has(&self, name: &str) -> bool {
        self.columns.iter().any(|column| column.name == name)
    }

    /// Names of its columns.
    pub fn names(&self) -> Vec<&'static str> {
        self.columns.iter().map(|column| column.name).collect()
    }

    /// Cuts off the ends where a column has no value.
    fn trim(&mut self, notes: &mut Vec<String>) {
        let is_whole = |i: usize| self.columns.iter().all(|column| !column.values[i].is_nan());
        let count = self.time_s.len();
        let from = (0..count).find(|&i| is_whole(i)).unwrap_or(count);
        let to = (from..count).rev().find(|&i| is_whole(i)).map_or(from, |i| i + 1);
        if to - from < count && to > from {
            notes.push(format!(
                "{} have common values from {} s to {} s, at {} of {count} times; the rest is skipped",
                self.names().join(", "),
                self.time_s[from],
                self.time_s[to - 1],
                to - from
            ));
        }
        self.time_s = self.time_s[from..to].to_vec();
        self.columns.iter_mut().for_each(|column| column.values = column.values[from..to].to_vec());
    }

    /// Fills gaps linearly, if requested.
    fn bridge(&mut self, most_s: Option<f64>, notes: &mut Vec<String>) -> Result<(), Failure> {
        let missing: Vec<(String, Hole)> = self.missing();
        let Some((_, longest)) = missing.iter().max_by(|a, b| a.1.length_s().total_cmp(&b.1.length_s())) else {
            return Ok(());
        };
        let is_short = self.kind == MotionKind::Changes && longest.length_s() <= SHORT_S;
        let told: Vec<String> = missing
            .iter()
            .take(3)
            .map(|(what, hole)| {
                format!("{what} from {} s to {} s", placed_text::number(hole.from_s), placed_text::number(hole.to_s))
            })
            .collect();
        let all = format!(
            "{}{}",
            told.join(", "),
            if missing.len() > 3 { format!(", and {} more", missing.len() - 3) } else { String::new() }
        );
        let length = placed_text::number((longest.length_s() * 1e6 - 1e-3).ceil() / 1e3);
        if !is_short && most_s.is_none_or(|most_s| longest.length_s() > most_s * (1.0 + 1e-9)) {
            let help = format!(
                "--bridge '{length} ms' fills gaps up to that length linearly; what happened in them stays unknown"
            );
            return Err(Failure::with_help(
                format!("samples are missing: {all}; the longest gap is {length} ms"),
                &help,
            ));
        }
        notes.push(format!("gaps were filled linearly: {all}; the longest is {length} ms"));
        let values: Vec<Vec<f64>> = self.columns.iter().map(|column| column.values.clone()).collect();
        let (time_s, values) = bridged(&self.time_s, &values);
        self.time_s = time_s;
        self.columns.iter_mut().zip(values).for_each(|(column, values)| column.values = values);
        Ok(())
    }

    /// The gaps: times missing in all columns, and values missing in one.
    fn missing(&self) -> Vec<(String, Hole)> {
        let mut all: Vec<(String, Hole)> =
            holes(&self.time_s).into_iter().map(|hole| ("all".to_owned(), hole)).collect();
        for column in &self.columns {
            let mut i = 1;
            while i < column.values.len() {
                let run = column.values[i..].iter().take_while(|value| value.is_nan()).count();
                if run > 0 {
                    let hole = Hole { after: i - 1, from_s: self.time_s[i - 1], to_s: self.time_s[i + run] };
                    all.push((column.name.to_owned(), hole));
                }
                i += run + 1;
            }
        }
        all
    }

    /// Unwraps angles recorded between −180° and 180°.
    fn unwrap(&mut self, notes: &mut Vec<String>) {
        let angles = ["roll", "pitch", "yaw"].map(|name| self.columns.iter().position(|column| column.name == name));
        if angles.iter().all(Option::is_none) {
            return;
        }
        let told = |i: usize| angles.map(|at| at.map_or(0.0, |c| self.columns[c].values[i] * self.columns[c].factor));
        let told: Vec<[f64; 3]> = (0..self.time_s.len()).map(told).collect();
        let mut stations: Vec<Station> = told.iter().map(|angles| Station::new(0.0, [0.0; 3], *angles)).collect();
        unwrap_angles(&mut stations);
        let mut names: Vec<&str> = Vec::new();
        for (i, (station, told)) in stations.iter().zip(&told).enumerate() {
            let attitude = station.pose.attitude;
            let whole = [attitude.roll_rad, attitude.pitch_rad, attitude.yaw_rad];
            for (axis, at) in angles.iter().enumerate().filter_map(|(axis, at)| Some((axis, (*at)?))) {
                if whole[axis] != told[axis] {
                    let column = &mut self.columns[at];
                    column.values[i] += (whole[axis] - told[axis]) / column.factor;
                    names.extend((!names.contains(&column.name)).then_some(column.name));
                }
            }
        }
        if !names.is_empty() {
            notes.push(format!("{} jumped by more than half a turn: full turns were added", names.join(", ")));
        }
    }
}

/// Reports signals that extend beyond the time span of the first.
fn beyond(found: &Found<'_>, first: &Signal) -> Option<String> {
    let ends = |signal: &Signal| Some([*signal.time_s.first()?, *signal.time_s.last()?]);
    let [from_s, to_s] = ends(first)?;
    let least_s = 1.5 * usual_interval(&first.time_s);
    let goes_on = |signal: &Signal| ends(signal).is_some_and(|[a, b]| a < from_s - least_s || b > to_s + least_s);
    let names: Vec<&str> = found.iter().filter(|(_, signal)| goes_on(signal)).map(|(name, _)| *name).collect();
    (!names.is_empty()).then(|| {
        format!(
            "{} {} given before or after {}, which covers {} s to {} s: skipped there",
            names.join(", "),
            if names.len() == 1 { "is" } else { "are" },
            first.name,
            placed_text::number(from_s),
            placed_text::number(to_s)
        )
    })
}

fn without_unit(signal: &Signal) -> Failure {
    Failure::with_help(
        format!("{}: {} has no known unit, but is vehicle motion", signal.place, signal.name),
        "write its unit into its heading, such as ax[g], or name all columns with --columns, such as 't[s],ax[g],-'",
    )
}

/// Values at other times, interpolated linearly between existing samples; NaN where there are none.
pub(super) fn at_times(signal: &Signal, time_s: &[f64]) -> Vec<f64> {
    if signal.time_s == time_s {
        return signal.values.clone();
    }
    let most_s = 1.5 * usual_interval(&signal.time_s);
    let value = |t_s: &f64| {
        let after = signal.time_s.partition_point(|own_s| own_s < t_s);
        let (to_s, to) = (*signal.time_s.get(after)?, signal.values[after]);
        if to_s == *t_s {
            return Some(to);
        }
        let before = after.checked_sub(1)?;
        let (from_s, from) = (signal.time_s[before], signal.values[before]);
        (to_s - from_s <= most_s).then(|| from + (to - from) * ((t_s - from_s) / (to_s - from_s)))
    };
    time_s.iter().map(|t_s| value(t_s).unwrap_or(f64::NAN)).collect()
}

/// Whether a signal is a column of this name.
pub(super) fn is_named(signal: &Signal, name: &str) -> bool {
    match signal.scale {
        _ if signal.name == name => true,
        Some(scale) => column_in(&signal.name, scale.dimension) == Some(name),
        None => column_named(&signal.name) == Some(name),
    }
}

/// Note if another column with the same name has other values.
fn doubled(recording: &Recording, name: &str, taken: &Signal) -> Option<String> {
    let si = |signal: &Signal| -> Vec<f64> {
        let factor = signal.scale.map_or(1.0, |scale| scale.factor);
        signal.values.iter().map(|value| value * factor).collect()
    };
    let own = si(taken);
    let most = own.iter().filter(|v| v.is_finite()).fold(0.0_f64, |most, v| most.max(v.abs()));
    let differs = |other: &Signal| {
        let far = |(a, b): (&f64, &f64)| (a - b).abs() > 0.02 * most;
        other.values.len() != own.len() || own.iter().zip(&si(other)).any(far)
    };
    let is_other = |signal: &&Signal| !std::ptr::eq(*signal, taken) && is_named(signal, name) && differs(signal);
    let others: Vec<&Signal> = recording.signals.iter().filter(is_other).collect();
    let first = others.first().filter(|_| is_named(taken, name))?;
    Some(format!(
        "{} different columns are {name}: `{}` is used, not `{}`; choose with --columns",
        others.len() + 1,
        taken.name,
        first.name
    ))
}

/// The signals that are the motion: those of a place, of a table's own headings, or of the best location on the vehicle.
fn recorded<'a>(
    recording: &'a Recording,
    at: Option<&str>,
    notes: &mut Vec<String>,
) -> Result<(MotionKind, Found<'a>, String), Failure> {
    let (kind, found, words) = plain(recording);
    let locations = locations(recording);
    if let Some(words) = at {
        return Ok(of_location(named(&locations, words)?, found));
    }
    // a table's own headings
    let has_own = found.iter().any(|(name, signal)| *name == "ax" && signal.code.is_none());
    let Some((best, why)) = chosen(&locations).filter(|_| kind == MotionKind::Accelerations || found.is_empty()) else {
        return Ok((kind, found, words));
    };
    notes.extend(disagreement(&locations));
    if has_own || best.is_centre() {
        return Ok((kind, found, words));
    }
    let names: Vec<&str> = locations.iter().map(|own| own.name.as_str()).collect();
    let told = |why| {
        let (own, all) = (best.told(), names.join(", "));
        format!("the path is that of {own}, which has {why}; choose another with --at: {all}")
    };
    notes.extend(why.map(told));
    Ok(of_location(best, found))
}

/// Accelerations of a location, with the rates of the vehicle.
fn of_location<'a>(own: Location<'a>, found: Found<'a>) -> (MotionKind, Found<'a>, String) {
    let words = format!("accelerations at {}", own.told());
    let rates = found.into_iter().filter(|(name, _)| name.starts_with('w'));
    let columns = OF_RUNS.iter().zip(own.axes).filter_map(|((name, _), signal)| Some((*name, signal?)));
    (MotionKind::Accelerations, columns.chain(rates).collect(), words)
}

/// Signals that identify their columns by code, or by heading and unit.
fn plain(recording: &Recording) -> (MotionKind, Found<'_>, String) {
    let coded = |name: &str| {
        let of = |signal: &&Signal| signal.code.is_some_and(|code| code.sign_for(name, '0').is_some());
        recording.signals.iter().find(of)
    };
    let named = |name: &str| recording.signals.iter().find(|signal| is_named(signal, name));
    let of = |names: &[&'static str]| -> Found {
        names.iter().filter_map(|name| Some((*name, Cow::Borrowed(named(name)?)))).collect()
    };
    let own = |name: &str, channel: &str| coded(channel).or_else(|| named(name)).map(Cow::Borrowed);
    let recorded: Found = OF_RUNS.iter().filter_map(|(name, channel)| Some((*name, own(name, channel)?))).collect();
    let has_acceleration = recorded.iter().any(|(name, _)| name.starts_with('a'));
    let (changes, places) = (of(&OF_CHANGES), of(&OF_PLACES));
    // rates beside velocity changes or places are theirs
    if has_acceleration || (!recorded.is_empty() && changes.is_empty() && places.is_empty()) {
        return (MotionKind::Accelerations, recorded, "accelerations and rates of the centre of gravity".to_owned());
    }
    if !changes.is_empty() {
        let yaw = recorded.into_iter().filter(|(name, _)| *name == "wz");
        return (MotionKind::Changes, changes.into_iter().chain(yaw).collect(), "velocity changes".to_owned());
    }
    (MotionKind::Places, places, "places and angles".to_owned())
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::*;
    use crate::signals::scale_of;

    /// The whole record counts, whichever signal is first.
    #[test]
    fn what_a_shorter_signal_lacks_is_told() {
        let signal = |name: &str, count: usize| Signal {
            name: name.to_owned(),
            code: None,
            unit: Some("g".to_owned()),
            scale: scale_of("g"),
            time_s: (0..count).map(|i| 1e-3 * i as f64).collect(),
            values: vec![1.0; count],
            place: String::new(),
        };
        for (ax, ay, words) in [(80, 100, "ay is given before or after ax"), (100, 80, "80 of 100 times")] {
            let signals = vec![signal("ax", ax), signal("ay", ay)];
            let recording = Recording { path: PathBuf::from("r"), sha256: String::new(), signals, notes: Vec::new() };
            let mut notes = Vec::new();
            let motion = Motion::of(&recording, Placed::default(), &mut notes).ok().flatten().expect("a motion");
            assert_eq!(motion.time_s.len(), 80);
            assert!(notes.iter().any(|note| note.contains(words)), "{notes:?}");
        }
    }

    /// Two columns with one name are one quantity in two units, or a duplicate heading.
    #[test]
    fn a_heading_that_stands_twice_is_said() {
        let signal = |unit: &str, value: f64| Signal {
            name: "ax".to_owned(),
            code: None,
            unit: Some(unit.to_owned()),
            scale: scale_of(unit),
            time_s: vec![0.0, 0.1, 0.2],
            values: vec![value; 3],
            place: String::new(),
        };
        let notes = |signals: Vec<Signal>| {
            let recording = Recording { path: PathBuf::from("r"), sha256: String::new(), signals, notes: Vec::new() };
            let mut notes = Vec::new();
            assert!(Motion::of(&recording, Placed::default(), &mut notes).is_ok_and(|motion| motion.is_some()));
            notes
        };
        assert_eq!(notes(vec![signal("g", -1.0), signal("m/s^2", -9.81)]), Vec::<String>::new());
        assert!(notes(vec![signal("g", -1.0), signal("g", -3.0)])[0].contains("2 different columns are ax"));
    }
}

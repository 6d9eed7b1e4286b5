//! Which signals of a record are the motion of its vehicle, and the section of a scenario that makes a path of them.

use crash_measures::signal::STANDARD_GRAVITY_MPS2;
use occupant_core::vehicle::{Station, unwrap_angles};
use occupant_scenario::column_named;

use super::Request;
use super::curves::{at, heading, written};
use crate::base::Failure;
use crate::files::measured::Imported;
use crate::files::signals::{Recording, Signal};

/// A vehicle's path as a table and the section of a scenario that reads it.
#[derive(Debug)]
pub(crate) struct PathTable {
    /// The table as CSV.
    pub(crate) csv: Vec<u8>,
    /// What it is, in words.
    pub(crate) words: String,
    /// The keys of the section but for `file`.
    pub(crate) keys: Vec<String>,
    /// Names of the signals that it is made of.
    pub(super) signals: Vec<String>,
}

/// Columns of records and the channels of a run that they are.
const OF_RUNS: [(&str, &str); 6] = [
    ("ax", "vehicle.acceleration.x"),
    ("ay", "vehicle.acceleration.y"),
    ("az", "vehicle.acceleration.z"),
    ("wx", "vehicle.angular_velocity.x"),
    ("wy", "vehicle.angular_velocity.y"),
    ("wz", "vehicle.angular_velocity.z"),
];
/// Columns of places and angles; of velocity changes.
const OF_PLACES: [&str; 6] = ["x", "y", "z", "roll", "pitch", "yaw"];
const OF_CHANGES: [&str; 2] = ["dvx", "dvy"];

/// Length of the beginning of a record that says whether gravity is in it, s.
const BEFORE_S: f64 = 0.01;
/// Samples that are at most so far apart can be filtered by CFC 60, s.
const FILTERED_S: f64 = 5e-4;

type Columns<'a> = Vec<(&'static str, &'a Signal)>;

/// The path of the vehicle in a record.
///
/// # Errors
/// A place that has no accelerometers; a signal without a unit.
pub(super) fn of(
    recording: &Recording,
    imported: &Imported,
    request: &Request,
    notes: &mut Vec<String>,
) -> Result<Option<PathTable>, Failure> {
    let (columns, words) = match request.place {
        Some(place) => accelerometers(recording, Some(place), notes)?,
        None => match plain(recording) {
            (columns, _) if columns.is_empty() => accelerometers(recording, None, notes)?,
            found => found,
        },
    };
    let Some((_, first)) = columns.first() else { return Ok(None) };
    if let Some((_, signal)) = columns.iter().find(|(_, signal)| signal.scale.is_none()) {
        return Err(Failure::with_help(
            format!(
                "{}: {} has no unit that is known, and is to be the motion of the vehicle",
                signal.place, signal.name
            ),
            "write its unit into its heading, such as ax[g]",
        ));
    }
    let mut rows: Vec<(String, Vec<f64>)> =
        columns.iter().map(|(name, signal)| (heading(name, signal), at(signal, &first.time_s))).collect();
    let is_whole = |i: &usize| rows.iter().all(|(_, values)| !values[*i].is_nan());
    let kept: Vec<usize> = (0..first.time_s.len()).filter(is_whole).collect();
    let time_s: Vec<f64> = kept.iter().map(|&i| first.time_s[i]).collect();
    rows.iter_mut().for_each(|(_, values)| *values = kept.iter().map(|&i| values[i]).collect());
    unwrap(&columns, &mut rows, notes);
    let csv = written(&time_s, &rows).map_err(|error| Failure::plain(format!("the path cannot be made: {error}")))?;
    let keys = keys(&columns, &time_s, imported, request, notes);
    let signals = columns.iter().map(|(_, signal)| signal.name.clone()).collect();
    Ok(Some(PathTable { csv, words: format!("{words}, {} times", time_s.len()), keys, signals }))
}

/// Continues angles that were written between −180° and 180°, so that none jumps.
fn unwrap(columns: &Columns, rows: &mut [(String, Vec<f64>)], notes: &mut Vec<String>) {
    let angles = ["roll", "pitch", "yaw"].map(|name| columns.iter().position(|(own, _)| *own == name));
    let factor = |column: usize| columns[column].1.scale.map_or(1.0, |scale| scale.factor);
    let count = rows.first().map_or(0, |(_, values)| values.len());
    let told = |i: usize| angles.map(|at| at.map_or(0.0, |column| rows[column].1[i] * factor(column)));
    let told: Vec<[f64; 3]> = (0..count).map(told).collect();
    let mut stations: Vec<Station> = told.iter().map(|angles| Station::new(0.0, [0.0; 3], *angles)).collect();
    unwrap_angles(&mut stations);
    let mut names = Vec::new();
    for (i, (station, told)) in stations.iter().zip(&told).enumerate() {
        let attitude = station.pose.attitude;
        let whole = [attitude.roll_rad, attitude.pitch_rad, attitude.yaw_rad];
        for (axis, column) in angles.iter().enumerate().filter_map(|(axis, at)| Some((axis, (*at)?))) {
            if whole[axis] != told[axis] {
                rows[column].1[i] += (whole[axis] - told[axis]) / factor(column);
                names.extend((!names.contains(&columns[column].0)).then_some(columns[column].0));
            }
        }
    }
    if !names.is_empty() {
        notes.push(format!("{} jumped by more than half a turn: turns were added", names.join(", ")));
    }
}

/// Signals that say themselves which of the columns they are, by code or by heading.
fn plain(recording: &Recording) -> (Columns<'_>, String) {
    let coded = |name: &str| {
        let of = |signal: &&Signal| signal.code.is_some_and(|code| code.sign_for(name, '0').is_some());
        recording.signals.iter().find(of)
    };
    let is_named = |signal: &Signal, name: &str| signal.name == name || column_named(&signal.name) == Some(name);
    let named = |name: &str| recording.signals.iter().find(|signal| is_named(signal, name));
    let of =
        |names: &[&'static str]| -> Columns { names.iter().filter_map(|name| Some((*name, named(name)?))).collect() };
    let recorded: Columns =
        OF_RUNS.iter().filter_map(|(name, channel)| Some((*name, coded(channel).or_else(|| named(name))?))).collect();
    if !recorded.is_empty() {
        return (recorded, "accelerations and rates of the centre of gravity".to_owned());
    }
    let changes = of(&OF_CHANGES);
    if !changes.is_empty() {
        return (changes, "velocity changes".to_owned());
    }
    (of(&OF_PLACES), "places and angles".to_owned())
}

/// The accelerometers at a place of the vehicle, by a word of their names; the first place that looks ahead, if none is asked for.
fn accelerometers<'a>(
    recording: &'a Recording,
    place: Option<&str>,
    notes: &mut Vec<String>,
) -> Result<(Columns<'a>, String), Failure> {
    let all: Vec<(String, usize, &Signal)> = recording
        .signals
        .iter()
        .filter_map(|signal| acceleration(signal).map(|(of, axis)| (of, axis, signal)))
        .collect();
    let mut places: Vec<&str> = Vec::new();
    for (of, ..) in all.iter().filter(|(_, axis, _)| *axis == 0) {
        if !places.contains(&of.as_str()) {
            places.push(of);
        }
    }
    let Some(own) = (match place {
        Some(word) => places.iter().find(|of| of.eq_ignore_ascii_case(word)),
        None => places.first(),
    }) else {
        return match place {
            None => Ok((Vec::new(), String::new())),
            Some(word) => Err(Failure::with_help(
                format!("--at {word}: no such place of the vehicle has an accelerometer that looks ahead"),
                &format!("places are {}", if places.is_empty() { "none".to_owned() } else { places.join(", ") }),
            )),
        };
    };
    if place.is_none() && places.len() > 1 {
        notes.push(format!("the path is that of {own}; --at takes another: {}", places.join(", ")));
    }
    let axis = |axis: usize| all.iter().find(|(of, along, _)| of == own && *along == axis).map(|(.., signal)| *signal);
    let columns = [0, 1, 2].iter().filter_map(|&i| Some((OF_RUNS[i].0, axis(i)?))).collect();
    Ok((columns, format!("accelerations at {own}")))
}

/// The place of the vehicle and the axis of an accelerometer, by code or by the name of NHTSA; none of what is no such thing.
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

/// The keys of the section of a path.
fn keys(
    columns: &Columns,
    time_s: &[f64],
    imported: &Imported,
    request: &Request,
    notes: &mut Vec<String>,
) -> Vec<String> {
    let has = |name: &str| columns.iter().any(|(own, _)| *own == name);
    let text = |words: &str| toml_edit::Value::from(words).to_string();
    if OF_PLACES.iter().any(|name| has(name)) {
        return keys_of_places(imported, request);
    }
    let known = imported.record.speed_km_h.map(|speed| format!("{speed} km/h"));
    let speed = request.speed.map(str::to_owned).or(known).unwrap_or_else(|| {
        notes.push("how fast the vehicle went is not told: `speed` is a guess of 50 km/h; --speed says it".to_owned());
        "50 km/h".to_owned()
    });
    let mut keys = vec!["kind = \"sensors\"".to_owned(), format!("speed = {}", text(&speed))];
    if OF_RUNS.iter().any(|(name, _)| has(name)) && !OF_CHANGES.iter().any(|name| has(name)) {
        keys.push(format!(
            "gravity = \"{}\"            # or included, removed, zeroed: what it does in the record",
            gravity(columns)
        ));
        let longest_s = time_s.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        keys.extend((longest_s <= FILTERED_S).then(|| "filter = \"cfc60\"".to_owned()));
    }
    let starts_before = time_s.first().is_some_and(|t| *t < 0.0) && time_s.last().is_some_and(|t| *t > 0.0);
    keys.extend(
        starts_before.then(|| "start = \"0 ms\"              # first contact, on the clock of the record".to_owned()),
    );
    keys.push("after = \"coast\"             # beyond the last row".to_owned());
    keys
}

/// The keys of the section of a path of places and angles.
fn keys_of_places(imported: &Imported, request: &Request) -> Vec<String> {
    let text = |words: &str| toml_edit::Value::from(words).to_string();
    let axes = imported.z_up.then(|| "axes = \"z_up\"               # x forward, y left, z up".to_owned());
    let offset = request.cg.map(|cg| format!("offset = [{}, 0, 0]", text(&format!("-{}", cg.trim()))));
    let after = "after = \"coast\"             # beyond the last row".to_owned();
    ["kind = \"table\"".to_owned()].into_iter().chain(axes).chain(offset).chain([after]).collect()
}

/// What gravity does in the record: a level vehicle before its crash reads −1 g along z, or 0 without gravity.
fn gravity(columns: &Columns) -> &'static str {
    let Some((_, az)) = columns.iter().find(|(name, _)| *name == "az") else { return "removed" };
    let first_s = az.time_s[0] + BEFORE_S;
    let before: Vec<f64> =
        az.time_s.iter().zip(&az.values).take_while(|(t, _)| **t <= first_s).map(|(_, v)| *v).collect();
    let factor = az.scale.map_or(1.0, |scale| scale.factor);
    let mean_g = before.iter().sum::<f64>() / before.len() as f64 * factor / STANDARD_GRAVITY_MPS2;
    if (mean_g + 1.0).abs() < 0.2 { "included" } else { "zeroed" }
}

//! The record of a test as files of this program: a path of a vehicle, curves to compare with, and a scenario that uses the path.

mod curves;
mod path;
mod scenario;

use occupant_scenario::kind::{KINDS, SPEED};

use crate::base::Failure;
use occupant_files::measured::{Axes, Imported};
use occupant_files::signals::Recording;

pub use path::{PathFilter, PathTable};
pub use scenario::{is_belted, scenario};

/// A requested import.
#[derive(Clone, Debug, Default)]
pub struct Request<'a> {
    /// Location of the vehicle's sensors; if absent the centre of gravity, or a representative location.
    pub place: Option<&'a str>,
    /// First and last time to write, s.
    pub window_s: [Option<f64>; 2],
    /// Initial speed of the path, as in a scenario.
    pub speed: Option<&'a str>,
    /// Direction of axes, if given.
    pub axes: Option<Axes>,
    /// Longest gap that is bridged, s.
    pub bridge_s: Option<f64>,
    /// Rests at the start and at the end, as in a scenario.
    pub baseline: [Option<&'a str>; 2],
    /// Low-pass filter of the path, if given.
    pub filter: Option<PathFilter>,
    /// Distance of the centre of gravity ahead of the point that follows the trajectory, as in a scenario.
    pub cg: Option<&'a str>,
}

/// Result of an import.
#[derive(Debug)]
pub struct Made {
    /// The vehicle's path; none if the record has none.
    pub path: Option<PathTable>,
    /// The curves as a table, and how many they are; none if all is path.
    pub curves: Option<(Vec<u8>, usize)>,
    /// Notes.
    pub notes: Vec<String>,
}

/// Makes path and curves of a record.
///
/// # Errors
/// Signals of the path that have no unit, and a place or window without any.
pub fn import(imported: &Imported, request: &Request) -> Result<Made, Failure> {
    let recording = within(&imported.recording, request.window_s);
    if recording.signals.is_empty() {
        return Err(Failure::plain("there is no sample between --from and --to"));
    }
    let is_done = |note: &str| request.cg.is_some() && note.contains("--cg");
    let mut notes: Vec<String> = recording.notes.iter().filter(|note| !is_done(note)).cloned().collect();
    let path = path::of(&recording, imported, request, &mut notes)?;
    let used = path.as_ref().map_or(&[][..], |path| &path.signals);
    let others: Vec<_> = recording.signals.iter().filter(|signal| !used.contains(&signal.name)).collect();
    let curves = if others.is_empty() { None } else { Some((curves::table(&others)?, others.len())) };
    if let Some(path) = path.as_ref().filter(|path| !path.is_forward) {
        let names: Vec<String> = others.iter().take(12).map(|signal| format!("`{}`", signal.name)).collect();
        let rest = if names.is_empty() { String::new() } else { format!("; the record also has {}", names.join(", ")) };
        notes.push(format!(
            "the path has no motion along x: it is made of {}{rest}. If a column is the longitudinal motion, name it with --columns, such as 't[ms],dvx[km/h]'",
            path.signals.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
        ));
    }
    if path.is_none() && request.place.is_none() {
        let names: Vec<String> = recording.signals.iter().take(12).map(|s| format!("`{}`", s.name)).collect();
        notes.push(format!(
            "no signal is known as vehicle motion, so no path and no scenario are written. The record has {}. Name the columns with --columns, such as 't[ms],dvx[km/h]' or 't[s],ax[g],-,wz[deg/s]'",
            names.join(", ")
        ));
    }
    Ok(Made { path, curves, notes })
}

/// A speed in words, m/s.
fn speed(text: &str) -> Result<f64, String> {
    if let Ok(bare) = text.trim().parse::<f64>() {
        return Err(format!("`{bare}` has no unit"));
    }
    KINDS[SPEED].read(text).map_err(|error| error.found)
}

/// Samples between two times; signals without any are left out.
fn within(recording: &Recording, [from_s, to_s]: [Option<f64>; 2]) -> Recording {
    let mut recording = recording.clone();
    let is_in = |t: f64| from_s.is_none_or(|from| t >= from) && to_s.is_none_or(|to| t <= to);
    for signal in &mut recording.signals {
        let kept = |(t, _): &(f64, f64)| is_in(*t);
        let samples = signal.time_s.iter().copied().zip(signal.values.iter().copied()).filter(kept);
        (signal.time_s, signal.values) = samples.unzip();
    }
    recording.signals.retain(|signal| !signal.time_s.is_empty());
    recording
}

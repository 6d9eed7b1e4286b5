//! The section of a scenario that makes a path of the recorded motion, and its table.

use crash_measures::signal::{STANDARD_GRAVITY_MPS2, usual_interval};

use super::Request;
use super::curves::written;
use crate::base::Failure;
use occupant_files::measured::{Axes, Imported, Known, Motion, MotionKind, Placed, doubts, recorded_speed};
use occupant_files::signals::Recording;

/// A vehicle's path as a table and the section of a scenario that reads it.
#[derive(Debug)]
pub struct PathTable {
    /// The table as CSV.
    pub csv: Vec<u8>,
    /// Description.
    pub words: String,
    /// Keys of the section except `file`.
    pub keys: Vec<String>,
    /// First and last time of the run, s.
    pub run_s: [f64; 2],
    /// Names of the signals that it is built from.
    pub(super) signals: Vec<String>,
    /// Whether it has motion along x.
    pub(super) is_forward: bool,
}

/// Duration at the start of a record used to detect gravity in it, s.
const BEFORE_S: f64 = 0.01;
/// Largest sample interval for CFC 60, s.
const FILTERED_S: f64 = 5e-4;
/// A run of a crash is not shorter, s: an occupant needs so long to reach his greatest excursion.
const SHORTEST_RUN_S: f64 = 0.15;
/// A velocity change that begins later than its time zero begins with a row of 0, s.
const BEGINS_S: f64 = 0.02;

/// The path of the vehicle in a record.
///
/// # Errors
/// A place that has no accelerometers; a signal without a unit; holes that were not to be bridged.
pub(super) fn of(
    recording: &Recording,
    imported: &Imported,
    request: &Request,
    notes: &mut Vec<String>,
) -> Result<Option<PathTable>, Failure> {
    let placed = Placed { at: request.place, bridge_s: request.bridge_s };
    let Some(mut motion) = Motion::of(recording, placed, notes)? else { return Ok(None) };
    begin_at_zero(&mut motion, notes);
    let axes = axes(&motion, imported, request, notes);
    let time_s = &motion.time_s;
    let (first_s, last_s) = (time_s[0], time_s[time_s.len() - 1]);
    let (keys, speed_m_s) = match motion.kind {
        MotionKind::Places => (keys_of_places(request)?, None),
        _ => keys_of_sensors(&motion, imported, request, notes)?,
    };
    notes.extend(doubts(
        &motion,
        Known {
            contact_s: None,
            speed_m_s,
            baseline: request.baseline.map(|length| length.is_some()),
            smoothed_hz: request.filter.and_then(PathFilter::hertz),
        },
    ));
    let rows: Vec<(String, Vec<f64>)> =
        motion.columns.iter().map(|c| (format!("{}[{}]", c.name, c.unit), c.values.clone())).collect();
    let csv = written(time_s, &rows).map_err(|error| Failure::plain(format!("the path cannot be made: {error}")))?;
    let number = placed_text::number;
    Ok(Some(PathTable {
        csv,
        words: format!("{}, {} times from {} s to {} s", motion.words, time_s.len(), number(first_s), number(last_s)),
        keys: [&keys[..1], &axes, &keys[1..]].concat(),
        run_s: run_s(&motion, request, notes),
        is_forward: ["x", "ax", "dvx"].iter().any(|name| motion.has(name)),
        signals: motion.signals,
    }))
}

/// First and last time of the run, s; that of a short record goes on, unless the last time of it was asked for.
fn run_s(motion: &Motion, request: &Request, notes: &mut Vec<String>) -> [f64; 2] {
    let (first_s, last_s) = (motion.time_s[0], motion.time_s[motion.time_s.len() - 1]);
    // what stands before the clock of the record is before first contact
    let begin_s = if first_s < 0.0 && last_s > 0.0 { 0.0 } else { first_s };
    let is_whole = motion.kind == MotionKind::Places || request.window_s[1].is_some();
    if is_whole || last_s - begin_s >= SHORTEST_RUN_S {
        return [begin_s, last_s];
    }
    let end_s = begin_s + SHORTEST_RUN_S;
    let [last_ms, end_ms] = [last_s, end_s].map(|t_s| placed_text::number((1e4 * t_s).round() / 10.0));
    notes.push(format!(
        "the record ends at {last_ms} ms: the vehicle coasts from there, and the run ends at {end_ms} ms"
    ));
    [begin_s, end_s]
}

/// A table of velocity changes that begins after its time zero has 0 there.
fn begin_at_zero(motion: &mut Motion, notes: &mut Vec<String>) {
    let first_s = motion.time_s[0];
    if motion.kind != MotionKind::Changes || first_s <= 0.0 || first_s > BEGINS_S {
        return;
    }
    notes.push(format!("the velocity changes start at {first_s} s; a value of 0 is added at 0 s"));
    motion.time_s.insert(0, 0.0);
    for column in &mut motion.columns {
        let value = if column.name == "wz" { column.values[0] } else { 0.0 };
        column.values.insert(0, value);
    }
}

/// The key for the direction of axes, and the assumption made.
fn axes(motion: &Motion, imported: &Imported, request: &Request, notes: &mut Vec<String>) -> Vec<String> {
    let has_sides =
        ["y", "z", "roll", "pitch", "yaw", "ay", "az", "wx", "wy", "wz", "dvy"].iter().any(|name| motion.has(name));
    let told = request.axes.or(imported.axes);
    if told.is_none() && has_sides {
        notes.push(Axes::TAKEN.to_owned());
    }
    match told.unwrap_or(Axes::ZDown) {
        Axes::ZUp => vec!["axes = \"z_up\"               # x forward, y left, z up".to_owned()],
        Axes::ZDown => Vec::new(),
    }
}

/// Low-pass filter of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PathFilter {
    /// None at all.
    None,
    /// A channel frequency class, for accelerations and rates.
    Class(u32),
    /// Cutoff frequency, Hz, for positions and angles.
    Frequency(f64),
}

impl PathFilter {
    fn hertz(self) -> Option<f64> {
        match self {
            PathFilter::Frequency(hertz) => Some(hertz),
            _ => None,
        }
    }
}

/// The keys of a path of sensors, the first its kind, and the speed that they say, m/s, if it is no guess.
fn keys_of_sensors(
    motion: &Motion,
    imported: &Imported,
    request: &Request,
    notes: &mut Vec<String>,
) -> Result<(Vec<String>, Option<f64>), Failure> {
    let text = |words: &str| toml_edit::Value::from(words).to_string();
    let known = imported.record.speed_km_h.map(|speed| format!("{speed} km/h"));
    let recorded = || {
        let of_impact =
            imported.report.speed_m_s.map(|(speed, line)| (format!("the speed at impact of line {line}"), speed));
        let before = || {
            let (name, t_s, speed_m_s) = recorded_speed(&imported.recording)?;
            Some((format!("{name} at {} s", placed_text::number(t_s)), speed_m_s))
        };
        let (words, speed_m_s) = of_impact.or_else(before)?;
        let speed = format!("{} km/h", placed_text::number((speed_m_s * 3.6e3).round() / 1e3));
        notes.push(format!("`speed` is {words}, {speed}; change it with --speed"));
        Some(speed)
    };
    if let Some(Err(found)) = request.speed.map(super::speed) {
        let help = "give a speed with its unit, such as --speed '50 km/h'";
        return Err(Failure::with_help(format!("--speed: {found}"), help));
    }
    let told = request.speed.map(str::to_owned).or(known).or_else(recorded);
    let speed_m_s = told.as_deref().and_then(|speed| super::speed(speed).ok());
    let speed = told.unwrap_or_else(|| {
        notes.push(
            "the record has no vehicle speed: `speed` is set to 50 km/h; give the real one with --speed".to_owned(),
        );
        "50 km/h".to_owned()
    });
    let mut keys = vec!["kind = \"sensors\"".to_owned(), format!("speed = {}", text(&speed))];
    if motion.kind == MotionKind::Accelerations {
        keys.push(format!(
            "gravity = \"{}\"            # or included, removed, zeroed: what it does in the record",
            gravity(motion)
        ));
        let fits = usual_interval(&motion.time_s) <= FILTERED_S;
        let class = match request.filter {
            None => fits.then_some(60),
            Some(PathFilter::None) => None,
            Some(PathFilter::Class(class)) => Some(class),
            Some(PathFilter::Frequency(_)) => return Err(other_filter("60, 180, 600, 1000 or none for accelerations")),
        };
        keys.extend(class.map(|class| format!("filter = \"cfc{class}\"")));
        for (key, length) in ["baseline", "baseline_end"].iter().zip(request.baseline) {
            keys.extend(length.map(|length| format!("{key} = {}", text(length))));
        }
    } else if request.filter.is_some_and(|filter| filter != PathFilter::None) {
        return Err(other_filter("none for velocity changes"));
    }
    let starts_before =
        motion.time_s.first().is_some_and(|t| *t < 0.0) && motion.time_s.last().is_some_and(|t| *t > 0.0);
    keys.extend(
        starts_before.then(|| "start = \"0 ms\"              # first contact, on the clock of the record".to_owned()),
    );
    keys.push("after = \"coast\"             # beyond the last row".to_owned());
    Ok((keys, speed_m_s))
}

fn other_filter(expected: &str) -> Failure {
    Failure::with_help("--filter does not apply to this record", &format!("give {expected}"))
}

/// The keys of a path of places and angles, the first its kind.
fn keys_of_places(request: &Request) -> Result<Vec<String>, Failure> {
    let text = |words: &str| toml_edit::Value::from(words).to_string();
    let offset = request.cg.map(|cg| format!("offset = [{}, 0, 0]", text(&format!("-{}", cg.trim()))));
    let filter = match request.filter {
        None | Some(PathFilter::None) => None,
        Some(PathFilter::Frequency(hertz)) => {
            Some(format!("filter = \"{hertz} Hz\"             # smooths the table from here on"))
        }
        Some(PathFilter::Class(_)) => {
            return Err(other_filter("a frequency for positions and angles, such as '15 Hz'"));
        }
    };
    let after = "after = \"coast\"             # beyond the last row".to_owned();
    Ok(["kind = \"table\"".to_owned()].into_iter().chain(offset).chain(filter).chain([after]).collect())
}

/// Gravity in the record: a level vehicle before its crash reads −1 g along z, or 0 without gravity.
fn gravity(motion: &Motion) -> &'static str {
    let Some(az) = motion.si("az") else { return "removed" };
    let first_s = motion.time_s[0] + BEFORE_S;
    let count = motion.time_s.partition_point(|t| *t <= first_s).max(1);
    let mean_g = az[..count].iter().sum::<f64>() / count as f64 / STANDARD_GRAVITY_MPS2;
    if (mean_g.abs() - 1.0).abs() < 0.2 { "included" } else { "zeroed" }
}

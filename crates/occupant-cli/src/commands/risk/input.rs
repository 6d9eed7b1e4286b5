//! Input of `occupant risk`: recorded data, or the path of a scenario or run.

use crash_measures::signal::{ChannelClass, STANDARD_GRAVITY_MPS2, SignalError, smooth};
use nalgebra::Vector3;
use occupant_core::vehicle::{
    AccelerationRecord, AfterEnd, DeltaVRecord, Interpolation, SensorDefinition, SensorGravity, SensorPath,
    SensorRecord, Station, TablePath, TravelDirection, VehiclePath, VehiclePose,
};
use occupant_study::risk::{Preparation, Unprepared, VehicleSignals, prepare};

use super::Args;
use crate::base::{Failure, ending, input_file, note};
use occupant_files::mcap::StoredRun;
use occupant_files::measured::{self, Axes, Known, Motion, MotionKind, Placed, Reading, doubts, rounded_table};
use occupant_jobs::files::scenario::{self, ScenarioArgs, warn_of};
use occupant_jobs::import::PathFilter;
use occupant_jobs::risk::{PATH_INTERVAL_S, Subject};

/// Duration at the start of a record used to detect gravity in it, s.
const BEFORE_S: f64 = 0.01;

/// The signals of the file; remarks go to `notes`.
pub(crate) fn measured(
    args: &Args,
    wanted: &Preparation,
    notes: &mut Vec<String>,
) -> Result<(Subject, VehicleSignals), Failure> {
    let name = args.file.display().to_string();
    let extension = ending(&args.file);
    if matches!(extension.as_str(), "toml" | "json" | "mcap") {
        let subject = path_of(args, &name, &extension, wanted, notes)?;
        return sampled(&name, subject, wanted);
    }
    if !args.overrides.is_empty() {
        return Err(Failure::with_help(
            format!("--set with {name}, which is not a scenario"),
            "leave --set out, or give a scenario (.toml, .json)",
        ));
    }
    let (motion, axes) = motion(args, &name, notes)?;
    let known = Known {
        contact_s: wanted.start_s,
        speed_m_s: None,
        baseline: wanted.baseline_s.map(|length| length.is_some()),
        smoothed_hz: hertz(args),
    };
    notes.extend(doubts(&motion, known));
    if motion.kind == MotionKind::Accelerations {
        let record = record(&motion, axes);
        notes.extend(doubt_of_gravity(&record, args.gravity_included));
        let signals = prepare(&record, wanted).map_err(|error| unprepared(&name, &error))?;
        return Ok((Subject::recorded(&name, record), signals));
    }
    let path = path(&motion, axes, hertz(args)).map_err(|reason| Failure::plain(format!("{name}: {reason}")))?;
    let ends = [motion.time_s[0], motion.time_s[motion.time_s.len() - 1]];
    let interval_s = wanted.interval_s.unwrap_or(PATH_INTERVAL_S);
    let subject = Subject::path(&name, &path, ends, interval_s).ok_or_else(|| unsampled(&name, interval_s))?;
    sampled(&name, subject, &Preparation { baseline_s: [None; 2], ..wanted.clone() })
}

/// Signals of a path, sampled as requested, without sensors or gravity.
fn sampled(name: &str, subject: Subject, wanted: &Preparation) -> Result<(Subject, VehicleSignals), Failure> {
    let of_path = Preparation { interval_s: None, ..wanted.clone() };
    let mut signals = prepare(&subject.record, &of_path).map_err(|error| unprepared(name, &error))?;
    signals.initial = subject.initial;
    Ok((subject, signals))
}

fn hertz(args: &Args) -> Option<f64> {
    match args.filter {
        Some(PathFilter::Frequency(hertz)) => Some(hertz),
        _ => None,
    }
}

/// The path of the scenario or run in the file.
fn path_of(
    args: &Args,
    name: &str,
    extension: &str,
    wanted: &Preparation,
    notes: &mut Vec<String>,
) -> Result<Subject, Failure> {
    let foreign = [
        ("--columns", args.columns.is_some()),
        ("--offset", args.offset.is_some()),
        ("--gravity-included", args.gravity_included),
        ("--z-up", args.z_up),
        ("--axes", args.axes.is_some()),
        ("--bridge", args.bridge.is_some()),
        ("--baseline", args.baseline.is_some()),
        ("--at", args.at.is_some()),
        ("--filter as a frequency", hertz(args).is_some()),
        ("--set", extension == "mcap" && !args.overrides.is_empty()),
    ];
    if let Some((flag, _)) = foreign.iter().find(|(_, given)| *given) {
        return Err(Failure::with_help(
            format!("{flag} does not go with {name}"),
            "a path is the motion of the centre of gravity itself; leave the flag out",
        ));
    }
    let model = match extension {
        "mcap" => {
            let bytes = input_file::read(&args.file)?;
            let run =
                StoredRun::read(&bytes).map_err(|reason| Failure::plain(format!("{name} cannot be read: {reason}")))?;
            if let Some(flaw) = run.flaw() {
                note(&format!("{name} is {flaw}"));
            }
            scenario::stored(&args.file, &run)?.1
        }
        _ => {
            let opened =
                scenario::open(&ScenarioArgs { scenario: args.file.clone(), overrides: args.overrides.clone() })?;
            warn_of(&opened);
            opened.model
        }
    };
    if args.vehicle.is_none() {
        notes.extend(rounded_table(&model.setup().path));
    }
    let interval_s = wanted.interval_s.unwrap_or(PATH_INTERVAL_S);
    let subject = Subject::of_run(name, model.setup(), args.vehicle.as_deref(), interval_s).map_err(|known| {
        let known: Vec<&str> = known.iter().map(String::as_str).collect();
        let asked = args.vehicle.as_deref().unwrap_or_default();
        Failure::with_help(
            format!("--vehicle {asked}: {name} has no such vehicle"),
            &format!("name {}", placed_text::one_of(&known, '`')),
        )
    })?;
    subject.ok_or_else(|| unsampled(name, interval_s))
}

fn unsampled(name: &str, interval_s: f64) -> Failure {
    Failure::with_help(
        format!("the path of {name} cannot be sampled every {interval_s} s"),
        "give an interval with at least one and at most 1.5 million samples",
    )
}

/// The motion in a record, and the direction of its axes.
fn motion(args: &Args, name: &str, notes: &mut Vec<String>) -> Result<(Motion, Axes), Failure> {
    let vehicle = args.vehicle.as_deref().map(|number| {
        number.parse().map_err(|_| {
            Failure::with_help(
                format!("--vehicle {number}: a record has numbered vehicles"),
                "give a number, such as 2",
            )
        })
    });
    let reading = Reading { vehicle: vehicle.transpose()?, columns: args.columns.as_deref(), ..Reading::default() };
    let imported = measured::import(&args.file, reading)?;
    notes.extend(imported.recording.notes.iter().cloned());
    let placed = Placed { at: args.at.as_deref(), bridge_s: args.bridge };
    let found = Motion::of(&imported.recording, placed, notes)?;
    let names: Vec<String> = imported.recording.signals.iter().take(12).map(|s| format!("`{}`", s.name)).collect();
    let motion = found.ok_or_else(|| {
        Failure::with_help(
            format!("{name} has no acceleration, angular rate, velocity change or position; it has {}", names.join(", ")),
            "name its columns ax, ay, az, wx, wy, wz with units, in the headings or with --columns 't[s],ax[g],-,wz[deg/s]'",
        )
    })?;
    let unused = imported.recording.signals.iter().filter(|signal| !motion.signals.contains(&signal.name));
    let unused: Vec<&str> = unused.map(|signal| signal.name.as_str()).take(12).collect();
    if !unused.is_empty() {
        notes.push(format!("not used: {}", unused.join(", ")));
    }
    let told = args.axes.or(args.z_up.then_some(Axes::ZUp)).or(imported.axes);
    if told.is_none() && motion.names().iter().any(|name| !["ax", "x", "dvx"].contains(name)) {
        notes.push(Axes::TAKEN.to_owned());
    }
    Ok((motion, told.unwrap_or(Axes::ZDown)))
}

/// A column in axes forward, right, down.
fn turned(motion: &Motion, axes: Axes, name: &str, axis: usize) -> Option<Vec<f64>> {
    let mut values = motion.si(name)?;
    if axes == Axes::ZUp && axis > 0 {
        values.iter_mut().for_each(|value| *value = -*value);
    }
    Some(values)
}

fn record(motion: &Motion, axes: Axes) -> AccelerationRecord {
    let three = |names: [&str; 3]| [0, 1, 2].map(|axis| turned(motion, axes, names[axis], axis));
    AccelerationRecord {
        time_s: motion.time_s.clone(),
        acceleration_m_s2: three(["ax", "ay", "az"]),
        rate_rad_s: three(["wx", "wy", "wz"]),
    }
}

/// The path given by velocity changes, or by positions and angles.
fn path(motion: &Motion, axes: Axes, smoothed_hz: Option<f64>) -> Result<VehiclePath, String> {
    let problems = |problems: Vec<occupant_core::vehicle::PathProblem>| {
        problems.first().map_or_else(String::new, ToString::to_string)
    };
    if motion.kind == MotionKind::Changes {
        let record = DeltaVRecord {
            time_s: motion.time_s.clone(),
            longitudinal_m_s: turned(motion, axes, "dvx", 0),
            lateral_m_s: turned(motion, axes, "dvy", 1),
            yaw_rate_rad_s: turned(motion, axes, "wz", 2),
        };
        let definition = SensorDefinition {
            record: SensorRecord::DeltaV(record),
            initial: VehiclePose::default(),
            initial_speed_m_s: 0.0,
            direction: TravelDirection::Heading,
            offset_m: Vector3::zeros(),
            gravity: SensorGravity::Removed,
            gravity_m_s2: STANDARD_GRAVITY_MPS2,
            filter: None,
            baseline_s: None,
            baseline_end_s: None,
            strength: 1.0,
            starts_at_s: None,
            after: AfterEnd::Coast,
        };
        return SensorPath::new(definition).map(|path| VehiclePath::Sensors(Box::new(path))).map_err(problems);
    }
    let count = motion.time_s.len();
    let column = |name: &str, axis: usize| {
        let values = turned(motion, axes, name, axis).unwrap_or_else(|| vec![0.0; count]);
        match smoothed_hz {
            Some(hertz) => smooth(&motion.time_s, &values, hertz).map_err(|error| error.to_string()),
            None => Ok(values),
        }
    };
    let places = [column("x", 0)?, column("y", 1)?, column("z", 2)?];
    let angles = [column("roll", 0)?, column("pitch", 1)?, column("yaw", 2)?];
    let station =
        |i: usize| Station::new(motion.time_s[i], [0, 1, 2].map(|a| places[a][i]), [0, 1, 2].map(|a| angles[a][i]));
    let path = TablePath::new((0..count).map(station).collect(), Interpolation::Spline, AfterEnd::Coast);
    path.map(VehiclePath::Table).map_err(problems)
}

/// Warning if a record contradicts the gravity setting: a level vehicle before its crash reads −1 g along z, or 0
/// without gravity.
fn doubt_of_gravity(record: &AccelerationRecord, included: bool) -> Option<String> {
    let az = record.acceleration_m_s2[2].as_ref()?;
    let first_s = record.time_s.first()? + BEFORE_S;
    let count = record.time_s.iter().take_while(|t| **t <= first_s).count();
    let mean_g = az[..count].iter().sum::<f64>() / count as f64 / STANDARD_GRAVITY_MPS2;
    let near = |expected: f64| (mean_g - expected).abs() < 0.2;
    let remedy = match included {
        _ if near(1.0) => "z seems to point up: use --axes z_up",
        false if near(-1.0) => "the record seems to include gravity: use --gravity-included",
        true if near(0.0) => "the record seems not to include gravity: leave --gravity-included out",
        _ => return None,
    };
    Some(format!("az begins at {mean_g:.2} g; {remedy}"))
}

/// The largest filter class below half the sample rate `nyquist_hz`, as help text.
fn remedy(nyquist_hz: f64) -> String {
    // the corner of one pass of two lies at 2.08 times the class
    let fits = ChannelClass::ALL.into_iter().rev().find(|class| 2.1 * class.hertz() < nyquist_hz);
    let class = fits.map_or_else(
        || "the sample rate is too low for any class".to_owned(),
        |c| format!("use --filter CFC{}", c.hertz()),
    );
    format!("{class}; use --filter none for data that are filtered already")
}

/// Error message of an unusable record, with its remedy.
fn unprepared(name: &str, error: &Unprepared) -> Failure {
    if let Unprepared::Channel { name: "t", error: SignalError::NotUniform { index, found_s, expected_s } } = error {
        return Failure::with_help(
            format!(
                "{name}: samples are not evenly spaced: sample {} is at {found_s} s, not {expected_s} s",
                index + 1
            ),
            "resample linearly, such as --interval '0.1 ms'",
        );
    }
    let help = match error {
        Unprepared::Channel { error: SignalError::CornerAboveNyquist { nyquist_hz, .. }, .. } => &remedy(*nyquist_hz),
        Unprepared::Channel { .. } => "correct the record, or choose another interval or window",
        Unprepared::NoChannel => "name columns ax, ay, az, wx, wy, wz with their units",
        Unprepared::OffsetNeedsRates { .. } => {
            "add the columns (zeros, if the vehicle did not turn), or leave --offset out"
        }
        Unprepared::Baseline(_) => "give the length of the quiet part, such as --baseline '50 ms'",
        Unprepared::Window { .. } => "give --start and --to inside the record",
    };
    Failure::with_help(format!("{name} cannot be assessed: {error}"), help)
}

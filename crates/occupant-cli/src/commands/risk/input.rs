//! What `occupant risk` measures: recorded data, or the path of a scenario or run.

use crash_measures::signal::{ChannelClass, STANDARD_GRAVITY_MPS2, SignalError};
use occupant_scenario::{Diagnostics, RecordFile, read_record};
use occupant_study::risk::{Preparation, Unprepared, VehicleSignals, prepare};

use super::Args;
use crate::base::{Failure, ending, input_file, note};
use crate::files::mcap::StoredRun;
use crate::files::scenario::{self, ScenarioArgs};
use crate::jobs::risk::Subject;

/// Sample interval of paths, s, where none is asked for.
const PATH_INTERVAL_S: f64 = 1e-4;

/// Length of the beginning of a record that says whether gravity is in it, s.
const BEFORE_S: f64 = 0.01;

/// What the file holds, and the signals that it gives.
pub(crate) fn measured(args: &Args, wanted: &Preparation) -> Result<(Subject, VehicleSignals), Failure> {
    let name = args.file.display().to_string();
    let extension = ending(&args.file);
    if matches!(extension.as_str(), "toml" | "json" | "mcap") {
        let subject = path_of(args, &name, &extension, wanted)?;
        // the path was sampled as asked, and it knows neither sensors nor gravity
        let of_path = Preparation { interval_s: None, ..wanted.clone() };
        let mut signals = prepare(&subject.record, &of_path).map_err(|error| unprepared(&name, None, &error))?;
        signals.initial = subject.initial;
        return Ok((subject, signals));
    }
    if !args.overrides.is_empty() {
        return Err(Failure::with_help(
            format!("--set with {name}, which is not a scenario"),
            "leave --set out, or give a scenario (.toml, .json)",
        ));
    }
    let file = recorded(args, &name)?;
    let subject = Subject::recorded(&name, &file);
    let signals = prepare(&subject.record, wanted).map_err(|error| unprepared(&name, Some(&file), &error))?;
    Ok((subject, signals))
}

/// The path of the scenario or run in the file.
fn path_of(args: &Args, name: &str, extension: &str, wanted: &Preparation) -> Result<Subject, Failure> {
    let foreign = [
        ("--columns", args.columns.is_some()),
        ("--offset", args.offset.is_some()),
        ("--gravity-included", args.gravity_included),
        ("--z-up", args.z_up),
        ("--set", extension == "mcap" && !args.overrides.is_empty()),
    ];
    if let Some((flag, _)) = foreign.iter().find(|(_, given)| *given) {
        return Err(Failure::with_help(
            format!("{flag} does not go with {name}"),
            "a path has the motion of the centre of gravity itself; leave the flag out",
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
            opened.warn();
            opened.model
        }
    };
    let interval_s = wanted.interval_s.unwrap_or(PATH_INTERVAL_S);
    Subject::path(name, model.setup(), interval_s).ok_or_else(|| {
        Failure::with_help(
            format!("the path of {name} cannot be sampled every {interval_s} s"),
            "give an interval that the run has at least one and at most 1.5 million of",
        )
    })
}

/// The record in a CSV file, with its axes forward, right, down.
fn recorded(args: &Args, name: &str) -> Result<RecordFile, Failure> {
    let bytes = input_file::read(&args.file)?;
    let mut file = read_record(&bytes, name, args.columns.as_deref()).map_err(|problems| {
        let count = scenario::counted(problems.len());
        Failure::CouldNotRun(format!("{problems}\n\n{name}: {count}, nothing was measured"))
    })?;
    if args.z_up {
        let record = &mut file.record;
        for channels in [&mut record.acceleration_m_s2, &mut record.rate_rad_s] {
            for channel in channels[1..].iter_mut().flatten() {
                channel.iter_mut().for_each(|value| *value = -*value);
            }
        }
    }
    if let Some(words) = doubt_of_gravity(&file, args.gravity_included) {
        note(&format!("{name}: {words}"));
    }
    Ok(file)
}

/// What speaks against what is said of gravity: a level vehicle before its crash reads −1 g along z, or 0 without gravity.
fn doubt_of_gravity(file: &RecordFile, included: bool) -> Option<String> {
    let az = file.record.acceleration_m_s2[2].as_ref()?;
    let first_s = file.record.time_s.first()? + BEFORE_S;
    let count = file.record.time_s.iter().take_while(|t| **t <= first_s).count();
    let mean_g = az[..count].iter().sum::<f64>() / count as f64 / STANDARD_GRAVITY_MPS2;
    let near = |expected: f64| (mean_g - expected).abs() < 0.2;
    let remedy = match included {
        _ if near(1.0) => "z seems to point up: say --z-up",
        false if near(-1.0) => "gravity seems to be in the record: say --gravity-included",
        true if near(0.0) => "gravity seems not to be in the record: leave --gravity-included out",
        _ => return None,
    };
    Some(format!("az begins at {mean_g:.2} g; {remedy}"))
}

/// The greatest class that fits samples with half the rate `nyquist_hz`.
fn remedy(nyquist_hz: f64) -> String {
    // the corner of one pass of two lies at 2.08 times the class
    let fits = ChannelClass::ALL.into_iter().rev().find(|class| 2.1 * class.hertz() < nyquist_hz);
    let class =
        fits.map_or_else(|| "no class fits so few samples".to_owned(), |c| format!("use --filter CFC{}", c.hertz()));
    format!("{class}; --filter none is for data that are filtered already")
}

/// Why a record cannot be measured, with the remedy.
fn unprepared(name: &str, file: Option<&RecordFile>, error: &Unprepared) -> Failure {
    if let (Some(file), Unprepared::Channel { name: "t", error }) = (file, error)
        && let SignalError::NotUniform { index, found_s, expected_s } = error
    {
        let mut problems = Diagnostics::new();
        problems.push(file.at(
            *index,
            format!("samples that are not evenly spaced: t = {found_s} s"),
            &format!("{expected_s} s"),
            Some("resample by straight lines with --interval, such as --interval '0.1 ms'"),
        ));
        return Failure::CouldNotRun(problems.to_string());
    }
    let help = match error {
        Unprepared::Channel { error: SignalError::CornerAboveNyquist { nyquist_hz, .. }, .. } => &remedy(*nyquist_hz),
        Unprepared::Channel { .. } => "mend the record, or choose another interval or window",
        Unprepared::NoChannel => "name columns ax, ay, az, wx, wy, wz with their units",
        Unprepared::OffsetNeedsRates { .. } => {
            "add the columns (zeros, if the vehicle did not turn), or leave --offset out"
        }
        Unprepared::Window { .. } => "give --start and --end inside the record",
    };
    Failure::with_help(format!("{name} cannot be measured: {error}"), help)
}

//! `occupant risk`.

use std::path::PathBuf;

use clap::ValueEnum;
use occupant_core::measure::limits::Rule;
use occupant_core::scenario::kind::UnitSystem;
use occupant_core::scenario::quantity::Quantity;
use occupant_core::scenario::{Diagnostics, RecordFile, read_record};
use occupant_core::signal::{CfcFamily, ChannelClass, SignalError};
use occupant_core::vehicle_risk::{
    Flight, Preparation, Unprepared, VehicleSignals, VerticalGravity, prepare,
};

use super::exit::{Done, Failure};
use super::scenario::{self, ScenarioArgs};
use super::speak::{self, print, say};
use crate::mcap::StoredRun;
use crate::risk::{Report, Subject, json, text};

/// Measure the risk to occupants from the vehicle's motion alone
///
/// OIV, ORA, THIV, PHD, ASI, 50 ms averages, angles, velocity changes, OLC, and what rules say of them. FILE is recorded data
/// (a CSV with `t` and any of `ax`, `ay`, `az`, `wx`, `wy`, `wz` with their units, such as t[s],ax[g],wz[deg/s]; x forward,
/// y right, z down), a scenario, or a run.mcap. Exit code 1 if a rule named by --rule is broken.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Recorded data (.csv), a scenario (.toml, .json) or the results of a run (.mcap)
    #[arg(value_name = "FILE")]
    file: PathBuf,

    /// Judge by this rule; may be repeated; all are shown if absent
    #[arg(long, value_name = "RULE")]
    rule: Vec<RuleChoice>,

    /// Channel frequency class of the filter; "none" for data that are filtered already
    #[arg(long, value_name = "CLASS", default_value = "180")]
    cfc: ClassChoice,

    /// Filter coefficients
    #[arg(long, value_name = "FAMILY", default_value = "iso6487")]
    coefficients: FamilyChoice,

    /// Sample interval: recorded data are resampled by straight lines, paths are sampled (0.1 ms if absent)
    #[arg(long, value_name = "TIME")]
    interval: Option<String>,

    /// Time of first contact; the first sample if absent
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    start: Option<String>,

    /// Time up to which the record is looked at; its end if absent
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    end: Option<String>,

    /// Where the sensors stand, from the centre of gravity: forward, right, down, such as "-0.3 m,0,10 cm"
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    offset: Option<String>,

    /// Gravity is in az: a level vehicle at rest reads −1 g
    #[arg(long)]
    gravity_included: bool,

    /// The recorded axes are x forward, y left, z up
    #[arg(long)]
    z_up: bool,

    /// Head of THIV ahead of the centre of gravity (X0); 0 if absent
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    head_start: Option<String>,

    /// Free distance forward and back; 0.6 m if absent
    #[arg(long, value_name = "LENGTH")]
    flail_x: Option<String>,

    /// Free distance to either side; 0.3 m if absent
    #[arg(long, value_name = "LENGTH")]
    flail_y: Option<String>,

    /// Change a value of the scenario, such as --set path.speed='30 mph'; may be repeated
    #[arg(long = "set", value_name = "PATH.TO.KEY=VALUE")]
    overrides: Vec<String>,

    /// Print the report as JSON, in SI
    #[arg(long)]
    json: bool,
}

/// Rules that judge a vehicle's motion.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum RuleChoice {
    /// MASH 2016
    Mash,
    /// MASH 2016, breakaway supports
    MashSupports,
    /// NCHRP Report 350
    Nchrp350,
    /// EN 1317-1:1998
    #[value(name = "en1317-1998")]
    En1317Edition1998,
    /// EN 1317-1:2010
    #[value(name = "en1317-2010")]
    En1317Edition2010,
}

impl RuleChoice {
    fn rule(self) -> Rule {
        match self {
            RuleChoice::Mash => Rule::Mash2016,
            RuleChoice::MashSupports => Rule::Mash2016Supports,
            RuleChoice::Nchrp350 => Rule::Nchrp350,
            RuleChoice::En1317Edition1998 => Rule::En1317Edition1998,
            RuleChoice::En1317Edition2010 => Rule::En1317Edition2010,
        }
    }
}

/// Filter classes.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum ClassChoice {
    #[value(name = "60")]
    Cfc60,
    #[value(name = "180")]
    Cfc180,
    #[value(name = "600")]
    Cfc600,
    #[value(name = "1000")]
    Cfc1000,
    None,
}

/// Filter coefficients.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum FamilyChoice {
    /// ISO 6487
    Iso6487,
    /// SAE J211
    J211,
}

/// Sample interval of paths, s, where none is asked for.
const PATH_INTERVAL_S: f64 = 1e-4;

/// Measures and judges.
pub fn risk(args: &Args) -> Result<Done, Failure> {
    let preparation = preparation(args)?;
    let flight = flight(args)?;
    let rules: Vec<Rule> = args.rule.iter().map(|rule| rule.rule()).collect();
    let (subject, signals) = measured(args, &preparation)?;
    warn_of_coarse_samples(&signals, &preparation);
    let report = Report::new(subject, preparation, signals, flight, &rules);
    match args.json {
        true => print(&speak::json(&json(&report))?)?,
        false => print(&text(&report))?,
    }
    let broken = report.judgements.iter().filter(|j| j.breaks_the_rule());
    let broken: Vec<String> = broken
        .map(|j| format!("{} {}", j.limit.rule.name(), j.measure))
        .collect();
    match rules.is_empty() || broken.is_empty() {
        true => Ok(Done::Well),
        false => {
            say(&format!("error: beyond the limit: {}", broken.join(", ")));
            Ok(Done::Unwell)
        }
    }
}

fn preparation(args: &Args) -> Result<Preparation, Failure> {
    let class = match args.cfc {
        ClassChoice::Cfc60 => Some(ChannelClass::Cfc60),
        ClassChoice::Cfc180 => Some(ChannelClass::Cfc180),
        ClassChoice::Cfc600 => Some(ChannelClass::Cfc600),
        ClassChoice::Cfc1000 => Some(ChannelClass::Cfc1000),
        ClassChoice::None => None,
    };
    let family = match args.coefficients {
        FamilyChoice::Iso6487 => CfcFamily::Iso6487,
        FamilyChoice::J211 => CfcFamily::SaeJ211,
    };
    let interval_s = quantity::<TIME>("--interval", &args.interval)?;
    if let Some(interval_s) = interval_s {
        positive("--interval", interval_s)?;
    }
    Ok(Preparation {
        filter: class.map(|class| (class, family)),
        interval_s,
        offset_m: offset(args.offset.as_deref())?,
        gravity: match args.gravity_included {
            true => VerticalGravity::Included,
            false => VerticalGravity::Removed,
        },
        start_s: quantity::<TIME>("--start", &args.start)?,
        end_s: quantity::<TIME>("--end", &args.end)?,
    })
}

fn flight(args: &Args) -> Result<Flight, Failure> {
    let mut flight = Flight::default();
    if let Some(x_m) = quantity::<LENGTH>("--flail-x", &args.flail_x)? {
        flight.distances.longitudinal_m = positive("--flail-x", x_m)?;
        flight.head.forward_m = x_m;
    }
    if let Some(y_m) = quantity::<LENGTH>("--flail-y", &args.flail_y)? {
        flight.distances.lateral_m = positive("--flail-y", y_m)?;
        flight.head.sideways_m = y_m;
    }
    if let Some(x_m) = quantity::<LENGTH>("--head-start", &args.head_start)? {
        flight.head.start_x_m = x_m;
    }
    Ok(flight)
}

/// What the file holds, and the signals that it gives.
fn measured(args: &Args, wanted: &Preparation) -> Result<(Subject, VehicleSignals), Failure> {
    let name = args.file.display().to_string();
    let extension = args.file.extension().unwrap_or_default();
    let extension = extension.to_string_lossy().to_ascii_lowercase();
    if matches!(extension.as_str(), "toml" | "json" | "mcap") {
        let subject = path_of(args, &name, &extension, wanted)?;
        // the path was sampled as asked, and it knows neither sensors nor gravity
        let of_path = Preparation {
            interval_s: None,
            ..wanted.clone()
        };
        let mut signals =
            prepare(&subject.record, &of_path).map_err(|error| unprepared(&name, None, &error))?;
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
    let signals =
        prepare(&subject.record, wanted).map_err(|error| unprepared(&name, Some(&file), &error))?;
    Ok((subject, signals))
}

/// The path of the scenario or run in the file.
fn path_of(
    args: &Args,
    name: &str,
    extension: &str,
    wanted: &Preparation,
) -> Result<Subject, Failure> {
    let foreign = [
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
            let bytes = read(args, name)?;
            let run = StoredRun::read(&bytes)
                .map_err(|reason| Failure::plain(format!("{name} cannot be read: {reason}")))?;
            let loaded = scenario::stored(&args.file, &run)?;
            let (model, _) = loaded.model().map_err(|problems| {
                Failure::plain(format!("the scenario in {name} is refused:\n{problems}"))
            })?;
            model
        }
        _ => {
            let opened = scenario::open(&ScenarioArgs {
                scenario: args.file.clone(),
                overrides: args.overrides.clone(),
            })?;
            if !opened.warnings.is_empty() {
                say(&format!("{}\n", opened.warnings));
            }
            opened.model
        }
    };
    let interval_s = wanted.interval_s.unwrap_or(PATH_INTERVAL_S);
    Subject::path(name, model.setup(), interval_s).ok_or_else(|| {
        Failure::with_help(
            format!("the path of {name} cannot be sampled every {interval_s} s"),
            "give an interval that the run has at least one and at most ten million of",
        )
    })
}

fn read(args: &Args, name: &str) -> Result<Vec<u8>, Failure> {
    std::fs::read(&args.file)
        .map_err(|error| Failure::plain(format!("{name} cannot be read: {error}")))
}

/// The record in a CSV file, with its axes forward, right, down.
fn recorded(args: &Args, name: &str) -> Result<RecordFile, Failure> {
    let bytes = read(args, name)?;
    let mut file = read_record(&bytes, name).map_err(|problems| {
        let count = problems.iter().count();
        let errors = if count == 1 { "error" } else { "errors" };
        Failure::CouldNotRun(format!(
            "{problems}\n\n{name}: {count} {errors}, nothing was measured"
        ))
    })?;
    if args.z_up {
        let record = &mut file.record;
        for channels in [&mut record.acceleration_m_s2, &mut record.rate_rad_s] {
            for channel in channels[1..].iter_mut().flatten() {
                channel.iter_mut().for_each(|value| *value = -*value);
            }
        }
    }
    Ok(file)
}

/// Why a record cannot be measured, with the remedy.
fn unprepared(name: &str, file: Option<&RecordFile>, error: &Unprepared) -> Failure {
    if let (Some(file), Unprepared::Channel { name: "t", error }) = (file, error)
        && let SignalError::NotUniform {
            index,
            found_s,
            expected_s,
        } = error
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
        Unprepared::Channel {
            error: SignalError::CornerAboveNyquist { .. },
            ..
        } => {
            "use a lower class, such as --cfc 60, or --cfc none for data that are filtered already"
        }
        Unprepared::Channel { .. } => "mend the record, or choose another interval or window",
        Unprepared::NoChannel => "name columns ax, ay, az, wx, wy, wz with their units",
        Unprepared::OffsetNeedsRates { .. } => {
            "add the columns (zeros, if the vehicle did not turn), or leave --offset out"
        }
        Unprepared::Window { .. } => "give --start and --end inside the record",
    };
    Failure::with_help(format!("{name} cannot be measured: {error}"), help)
}

/// SAE J211 asks for at least ten samples in a period of the class.
fn warn_of_coarse_samples(signals: &VehicleSignals, preparation: &Preparation) {
    if let Some((class, _)) = preparation.filter
        && signals.dt_s * class.hertz() > 0.1 * (1.0 + 1e-6)
    {
        say(&format!(
            "warning: {:.0} samples a second are less than ten times the class, CFC {:.0}: peaks may be missed",
            1.0 / signals.dt_s,
            class.hertz()
        ));
    }
}

const LENGTH: usize = occupant_core::scenario::kind::LENGTH;
const TIME: usize = occupant_core::scenario::kind::TIME;

/// A flag's quantity in SI; a bare number is in SI.
fn quantity<const KIND: usize>(flag: &str, words: &Option<String>) -> Result<Option<f64>, Failure> {
    words
        .as_deref()
        .map(|text| si::<KIND>(flag, text))
        .transpose()
}

fn si<const KIND: usize>(flag: &str, text: &str) -> Result<f64, Failure> {
    let text = text.trim();
    let quantity = match text.parse() {
        Ok(number) => Quantity::<KIND>::bare(number),
        Err(_) => Quantity::<KIND>::text(text),
    };
    match quantity.si(UnitSystem::Si) {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(value) => Err(Failure::plain(format!(
            "{flag} {text}: found {value}, expected a finite number"
        ))),
        Err(error) => Err(Failure::plain(format!(
            "{flag} {text}: {}, expected {}",
            error.found, error.expected
        ))),
    }
}

fn positive(flag: &str, value: f64) -> Result<f64, Failure> {
    match value > 0.0 {
        true => Ok(value),
        false => Err(Failure::plain(format!(
            "{flag}: found {value}, expected more than 0"
        ))),
    }
}

fn offset(words: Option<&str>) -> Result<[f64; 3], Failure> {
    let Some(words) = words else {
        return Ok([0.0; 3]);
    };
    let parts: Vec<&str> = words.split(',').collect();
    let [x, y, z] = parts[..] else {
        return Err(Failure::with_help(
            format!(
                "--offset {words}: found {} lengths, expected 3",
                parts.len()
            ),
            "give forward, right and down, such as --offset '-0.3 m,0,10 cm'",
        ));
    };
    let length = |text| si::<LENGTH>("--offset", text);
    Ok([length(x)?, length(y)?, length(z)?])
}

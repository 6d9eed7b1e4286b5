//! `occupant risk`.

mod input;
mod options;

use std::path::{Path, PathBuf};

use crash_measures::measure::limits::Rule;
use crash_measures::signal::CfcFamily;
use occupant_scenario::kind::UnitSystem;
use occupant_study::risk::{Preparation, VehicleSignals};

use super::flags::history::interval;
use crate::base::{
    Done, Failure, SYSTEMS, input_file, is_page, note, one_of, print, publish, refuse_input, say, sha256,
};
use input::measured;
use occupant_files::measured::{AXES, Axes};
use occupant_jobs::import::PathFilter;
use occupant_jobs::risk::{Report, json, page, text};
use options::{errors, flight, preparation};

/// Assess occupant risk from the vehicle's motion alone: OIV, ORA, THIV, PHD, ASI
///
/// Also prints 50 ms averages, angles, delta-v, OLC, and the limits of each rule. FILE is a scenario, a run (.mcap), or any
/// record that `occupant import` reads: accelerations, velocity changes or positions. A plain table needs `t` and any of
/// `ax`, `ay`, `az`, `wx`, `wy`, `wz` with units, such as t[s],ax[g],wz[deg/s]; x forward, y right, z down. Exit code 1 if
/// a rule named by --rule is not met.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// A record (.csv, .tdms, a test's folder …), a scenario (.toml, .json) or a run (.mcap)
    #[arg(value_name = "FILE")]
    file: PathBuf,

    /// Also write the report as an HTML page with time histories
    #[arg(short, long, value_name = "REPORT.html")]
    output: Option<PathBuf>,

    /// Replace an existing file
    #[arg(short, long, requires = "output")]
    force: bool,

    /// Units of printed numbers; both SI and US units if absent. JSON is always SI
    #[arg(long, value_name = "SYSTEM", value_parser = one_of(&SYSTEMS))]
    units: Option<UnitSystem>,

    /// Which vehicle: its name in a scenario or run, its number in a record; the first if absent
    #[arg(long, value_name = "NAME|NUMBER")]
    vehicle: Option<String>,

    /// Which accelerometer location of the test to use, such as DSLF, or DSLF+DSRF for the mean; if absent the one with least
    /// ringing among those that agree on delta-v
    #[arg(long, value_name = "PLACE")]
    at: Option<String>,

    /// Judge by this rule. May be repeated; all rules are shown if absent
    #[arg(long, value_name = "RULE", value_parser = one_of(&RULES))]
    rule: Vec<Rule>,

    /// Filter: CFC60, CFC180 (the default), CFC600 or CFC1000; none for data that are already filtered; or a frequency, such as
    /// '15 Hz', to smooth a table of positions first
    #[arg(long, alias = "cfc", value_name = "CLASS|FREQUENCY", value_parser = super::import::filter)]
    filter: Option<PathFilter>,

    /// Standard for the filter coefficients
    #[arg(long, value_name = "STANDARD", default_value = "iso6487", value_parser = one_of(&FAMILIES))]
    coefficients: CfcFamily,

    /// Sample interval: records are resampled linearly; paths are sampled, every 0.1 ms if absent
    #[arg(long, value_name = "TIME")]
    interval: Option<String>,

    /// Time of first contact; the first sample if absent
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    start: Option<String>,

    /// End of the assessment; the end of the record if absent
    #[arg(long = "to", alias = "end", value_name = "TIME", allow_hyphen_values = true)]
    end: Option<String>,

    /// Names and units for the columns, instead of the file's headings: `-` skips a column, a minus before a name reverses its
    /// sign, such as 't[ms],-,ax[g],-ay[g]'
    #[arg(long, value_name = "COLUMNS", allow_hyphen_values = true)]
    columns: Option<String>,

    /// Position of the sensors from the centre of gravity: forward, right, down, such as "-0.3 m,0,10 cm"
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    offset: Option<String>,

    /// Fill gaps up to this length linearly, such as '5 ms'; gaps are an error if absent
    #[arg(long, value_name = "TIME", value_parser = interval)]
    bridge: Option<f64>,

    /// Length of the quiet part at the start of the record, used to remove zero offsets
    #[arg(long, value_name = "TIME")]
    baseline: Option<String>,

    /// Length of the quiet part at the end, used to remove linear drift as well
    #[arg(long, value_name = "TIME", requires = "baseline")]
    baseline_end: Option<String>,

    /// Bound of a sensor error (±): gain='1 %', offset='0.05 g', rate='0.2 deg/s', angle='1 deg' or place='20 mm'. Each measure
    /// then gets the 95 % interval of 400 records with random errors within these bounds. May be repeated
    #[arg(long, value_name = "WHAT=BOUND")]
    sensor_error: Vec<String>,

    /// The record includes gravity: az reads −1 g when the vehicle is level and at rest
    #[arg(long)]
    gravity_included: bool,

    /// Axes of the record; if absent as the file format defines them, else z_down
    #[arg(long, value_name = "AXES", value_parser = one_of(&AXES))]
    axes: Option<Axes>,

    /// The recorded axes are x forward, y left, z up: --axes z_up
    #[arg(long, hide = true, conflicts_with = "axes")]
    z_up: bool,

    /// Distance of the THIV head ahead of the centre of gravity (X0); 0 if absent
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    head_start: Option<String>,

    /// Flail distance forward and back; 0.6 m if absent
    #[arg(long, value_name = "LENGTH")]
    flail_x: Option<String>,

    /// Flail distance to each side; 0.3 m if absent
    #[arg(long, value_name = "LENGTH")]
    flail_y: Option<String>,

    /// Change a value of the scenario, such as --set path.speed='30 mph'. May be repeated
    #[arg(long = "set", value_name = "PATH.TO.KEY=VALUE")]
    overrides: Vec<String>,

    /// Print JSON, in SI units
    #[arg(long)]
    json: bool,
}

/// Rules that judge a vehicle's motion: names on the command line, names in help.
const RULES: [(&str, &str, Rule); 10] = [
    ("mash", "MASH 2016", Rule::Mash2016),
    ("mash-supports", "MASH 2016, breakaway supports", Rule::Mash2016Supports),
    ("nchrp350", "NCHRP Report 350", Rule::Nchrp350),
    ("nchrp350-supports", "NCHRP Report 350, breakaway supports", Rule::Nchrp350Supports),
    ("en1317-1998", "EN 1317-1:1998", Rule::En1317Edition1998),
    ("en1317-2010", "EN 1317-1:2010", Rule::En1317Edition2010),
    ("en1317-3-head-on", "EN 1317-3, crash cushion struck head on", Rule::En1317CushionHeadOn),
    ("en1317-3-side", "EN 1317-3, crash cushion struck on its side", Rule::En1317CushionSide),
    ("en12767", "EN 12767, supports, at 50 to 100 km/h", Rule::En12767),
    ("en12767-slow", "EN 12767, supports, at 35 km/h", Rule::En12767Slow),
];

/// Families of filter coefficients: names on the command line, names in help.
const FAMILIES: [(&str, &str, CfcFamily); 3] = [
    ("iso6487", "ISO 6487", CfcFamily::Iso6487),
    ("sae-j211", "SAE J211", CfcFamily::SaeJ211),
    ("j211", "The same as sae-j211", CfcFamily::SaeJ211),
];

/// Computes measures and compares them with the rules.
pub(crate) fn risk(args: &Args) -> Result<Done, Failure> {
    let preparation = preparation(args)?;
    let flight = flight(args)?;
    let errors = errors(args)?;
    let mut notes = Vec::new();
    // what was taken for granted may be why it fails
    let (subject, signals) = measured(args, &preparation, &mut notes).inspect_err(|_| notes.iter().for_each(note))?;
    warn_of_coarse_samples(&signals, &preparation);
    let mut report = Report::new(subject, preparation, signals, flight, &args.rule).with_errors(errors);
    report.notes = [notes, report.notes].concat();
    report.notes.iter().for_each(note);
    if args.json {
        print(&crate::base::json(&json(&report))?)?
    } else {
        print(&text(&report, args.units))?
    }
    if let Some(output) = &args.output {
        write(args, output, &report)?;
    }
    let broken = report.judgements.iter().filter(|j| j.breaks_the_rule());
    let broken: Vec<String> = broken.map(|j| format!("{} {}", j.limit.rule.name(), j.measure)).collect();
    if args.rule.is_empty() || broken.is_empty() {
        Ok(Done::Well)
    } else {
        say(&format!("error: beyond the limit: {}", broken.join(", ")));
        Ok(Done::Unwell)
    }
}

/// Writes the page.
fn write(args: &Args, output: &Path, report: &Report) -> Result<(), Failure> {
    if !is_page(output) {
        return Err(Failure::ending(output, ".html"));
    }
    refuse_input(output, &args.file)?;
    let mut origin = vec![("source", args.file.display().to_string())];
    if !args.file.is_dir() {
        origin.push(("its SHA-256", sha256(&input_file::read(&args.file)?)));
    }
    publish(output, args.force, page(report, args.units, &origin).as_bytes())?;
    say(&format!("wrote {}", output.display()));
    Ok(())
}

/// Warns if there are fewer than ten samples per period of the class, the minimum of SAE J211.
fn warn_of_coarse_samples(signals: &VehicleSignals, preparation: &Preparation) {
    if let Some((class, _)) = preparation.filter
        && signals.dt_s * class.hertz() > 0.1 * (1.0 + 1e-6)
    {
        say(&format!(
            "warning: {:.0} samples per second are less than ten times the class, CFC {:.0}: peaks may be missed",
            1.0 / signals.dt_s,
            class.hertz()
        ));
    }
}

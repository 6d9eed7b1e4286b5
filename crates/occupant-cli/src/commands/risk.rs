//! `occupant risk`.

mod input;
mod options;

use std::path::PathBuf;

use crash_measures::measure::limits::Rule;
use crash_measures::signal::{CfcFamily, ChannelClass};
use occupant_study::risk::{Preparation, VehicleSignals};

use crate::base::{Done, Failure, one_of, print, say, talk};
use crate::files::history::Filter;
use crate::jobs::risk::{Report, json, text};
use input::measured;
use options::{flight, preparation};

/// Measure the risk to occupants from the vehicle's motion alone
///
/// OIV, ORA, THIV, PHD, ASI, 50 ms averages, angles, velocity changes, OLC, and what rules say of them. FILE is recorded data
/// (a table with `t` and any of `ax`, `ay`, `az`, `wx`, `wy`, `wz` with their units, such as t[s],ax[g],wz[deg/s], or with a
/// recorder's headings, such as Time (ms); x forward, y right, z down), a scenario, or a run.mcap. Exit code 1 if a rule named by --rule is broken.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Recorded data (.csv), a scenario (.toml, .json) or the results of a run (.mcap)
    #[arg(value_name = "FILE")]
    file: PathBuf,

    /// Judge by this rule; may be repeated; all are shown if absent
    #[arg(long, value_name = "RULE", value_parser = one_of(&RULES))]
    rule: Vec<Rule>,

    /// Filter: CFC60, CFC180, CFC600 or CFC1000; "none" for data that are filtered already
    #[arg(long = "filter", alias = "cfc", value_name = "CLASS", default_value = "CFC180", value_parser = class)]
    cfc: Class,

    /// Filter coefficients
    #[arg(long, value_name = "FAMILY", default_value = "iso6487", value_parser = one_of(&FAMILIES))]
    coefficients: CfcFamily,

    /// Sample interval: recorded data are resampled by straight lines, paths are sampled (0.1 ms if absent)
    #[arg(long, value_name = "TIME")]
    interval: Option<String>,

    /// Time of first contact; the first sample if absent
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    start: Option<String>,

    /// Time up to which the record is looked at; its end if absent
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    end: Option<String>,

    /// Names and units of the file's columns in place of its own headings, `-` for one that is left out, such as 't[ms],-,ax[g]'
    #[arg(long, value_name = "COLUMNS")]
    columns: Option<String>,

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

/// A class of filters, or none.
type Class = Option<ChannelClass>;

/// Rules that judge a vehicle's motion: names on the command line, names in help.
const RULES: [(&str, &str, Rule); 5] = [
    ("mash", "MASH 2016", Rule::Mash2016),
    ("mash-supports", "MASH 2016, breakaway supports", Rule::Mash2016Supports),
    ("nchrp350", "NCHRP Report 350", Rule::Nchrp350),
    ("en1317-1998", "EN 1317-1:1998", Rule::En1317Edition1998),
    ("en1317-2010", "EN 1317-1:2010", Rule::En1317Edition2010),
];

/// Filter coefficients, likewise.
const FAMILIES: [(&str, &str, CfcFamily); 3] = [
    ("iso6487", "ISO 6487", CfcFamily::Iso6487),
    ("sae-j211", "SAE J211", CfcFamily::SaeJ211),
    ("j211", "SAE J211, its name before", CfcFamily::SaeJ211),
];

fn class(text: &str) -> Result<Class, String> {
    match text.parse()? {
        Filter::None => Ok(None),
        Filter::Class(class) => Ok(Some(class)),
        Filter::J211 => {
            Err("all channels of a vehicle have one class; expected CFC60, CFC180, CFC600, CFC1000 or none".to_owned())
        }
    }
}

/// Measures and judges.
pub(crate) fn risk(args: &Args) -> Result<Done, Failure> {
    let preparation = preparation(args)?;
    let flight = flight(args)?;
    let (subject, signals) = measured(args, &preparation)?;
    warn_of_coarse_samples(&signals, &preparation);
    let report = Report::new(subject, preparation, signals, flight, &args.rule);
    if args.json {
        print(&talk::json(&json(&report))?)?
    } else {
        print(&text(&report))?
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

//! `occupant measures`.

use std::path::PathBuf;

use clap::ValueEnum;
use crash_measures::injury::{Filtering, Measure, Options};
use crash_measures::measure::Dummy;
use crash_measures::signal::CfcFamily;
use occupant_core::results::summary::{Caveat, Summary};
use placed_text::shown;
use serde::Serialize;

use super::flags::history::interval;
use super::tables::measures::{long, remarks, risks};
use super::tables::summary::Marks;
use crate::base::failure::{Done, Failure};
use crate::base::talk::{self, note, print};
use crate::files::results::Results;

/// Readings of filtered channels are taken so often, s: the 10 kHz of SAE J211.
const FILTERED_S: f64 = 1e-4;

/// Injury measures of a run against limits and risk curves
///
/// HIC, 3 ms levels, severity indices, BrIC, DAMAGE, neck and femur loads, Nij. A simulated signal has no noise, so nothing
/// is filtered unless --filter asks for it. Exit code 1 if a limit is exceeded and --strict is given.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The results of `occupant run`
    #[arg(value_name = "RUN.mcap")]
    run: PathBuf,

    /// Filter each channel by its class (head 1000, neck 1000/600, chest 180, femur 600, head rotation 60)
    #[arg(long, value_name = "FAMILY", default_value = "none")]
    filter: Filter,

    /// Run the case again and take the readings this often, such as '0.1 ms': what happens between the outputs of the file counts
    /// then. With a filter it is 0.1 ms where the outputs are further apart
    #[arg(long, value_name = "TIME", value_parser = interval)]
    interval: Option<f64>,

    /// The dummy whose limits and risk curves hold
    #[arg(long, value_name = "DUMMY", default_value = "hybrid-iii-50m")]
    dummy: DummyChoice,

    /// Exit with code 1 if a limit is exceeded
    #[arg(long)]
    strict: bool,

    /// Print JSON instead of tables; SI units
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Filter {
    /// The signals as they are
    None,
    /// Coefficients of SAE J211
    SaeJ211,
    /// Coefficients of ISO 6487
    Iso6487,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum DummyChoice {
    /// Hybrid III, 50th percentile male
    #[value(name = "hybrid-iii-50m")]
    HybridIii50M,
    /// Hybrid III, 5th percentile female
    #[value(name = "hybrid-iii-5f")]
    HybridIii5F,
    /// THOR, 50th percentile male
    #[value(name = "thor-50m")]
    Thor50M,
}

#[derive(Serialize)]
struct Answer<'a> {
    file: String,
    title: &'a str,
    complete: bool,
    dummy: &'static str,
    measures: &'a [Measure],
    caveats: &'a [Caveat],
    notes: Vec<String>,
}

/// Prints the measures of a run.
pub(crate) fn measures(args: &Args) -> Result<Done, Failure> {
    let results = Results::open(&args.run)?;
    let options = options(args);
    let own_s = results.model.setup().time.output_s;
    let needed_s = (options.filtering != Filtering::None && own_s > 1.01 * FILTERED_S).then_some(FILTERED_S);
    let again_s = args.interval.or(needed_s);
    let [own_ms, interval_ms] = [own_s, again_s.unwrap_or(own_s)].map(|s| (1e9 * s).round() / 1e6);
    let mut notes = results.notes();
    let summary = match again_s {
        None => results.summary_judged(options)?,
        Some(interval_s) => {
            notes.push(format!(
                "the case is run again with readings every {interval_ms} ms; the file has outputs every {own_ms} ms"
            ));
            results.summary_again(options, interval_s)?
        }
    };
    if args.json {
        print(&talk::json(&Answer {
            file: args.run.display().to_string(),
            title: &results.model.setup().title,
            complete: results.is_complete(),
            dummy: options.dummy.name(),
            measures: &summary.measures,
            caveats: &summary.caveats,
            notes,
        })?)?;
    } else {
        notes.iter().for_each(note);
        print(&text(&results, interval_ms, &options, &summary))?;
    }
    let exceeded = summary.measures.iter().any(|m| m.limits.iter().any(|l| !l.passed));
    Ok(if exceeded && args.strict { Done::Unwell } else { Done::Well })
}

fn options(args: &Args) -> Options {
    Options {
        dummy: match args.dummy {
            DummyChoice::HybridIii50M => Dummy::HybridIii50M,
            DummyChoice::HybridIii5F => Dummy::HybridIii5F,
            DummyChoice::Thor50M => Dummy::Thor50M,
        },
        filtering: match args.filter {
            Filter::None => Filtering::None,
            Filter::SaeJ211 => Filtering::Classes(CfcFamily::SaeJ211),
            Filter::Iso6487 => Filtering::Classes(CfcFamily::Iso6487),
        },
    }
}

fn text(results: &Results, interval_ms: f64, options: &Options, Summary { measures, caveats, .. }: &Summary) -> String {
    let marks = Marks::of(caveats);
    let filter = match options.filtering {
        Filtering::None => "unfiltered",
        Filtering::Classes(CfcFamily::SaeJ211) => "filtered by SAE J211 classes",
        Filtering::Classes(CfcFamily::Iso6487) => "filtered by ISO 6487 classes",
    };
    let title = shown(&results.model.setup().title);
    let dummy = options.dummy.name();
    [
        format!(
            "{title}\nreadings every {interval_ms} ms, {filter}; limits and risks of a {dummy}\n"
        ),
        long(measures, &marks),
        marks.explained().unwrap_or_default(),
        risks(measures, &marks),
        remarks(measures),
        "Limits and curves were read where others quote them, not in the rules: check the rule before a legal statement.\n"
            .to_owned(),
    ]
    .join("\n")
}

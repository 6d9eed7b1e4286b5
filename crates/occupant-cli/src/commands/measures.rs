//! `occupant measures`.

use std::path::PathBuf;

use crash_measures::injury::{Filtering, Measure, Options};
use crash_measures::measure::Dummy;
use crash_measures::signal::CfcFamily;
use occupant_core::results::summary::{Caveat, Summary};
use placed_text::shown;
use serde::Serialize;

use super::flags::history::interval;
use super::tables::measures::{remarks, risks, table};
use super::tables::summary::Marks;
use crate::base::{Done, Failure, note, one_of, print, talk};
use crate::files::history::family_name;
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
    #[arg(long, value_name = "FAMILY", default_value = "none", value_parser = one_of(&FILTERS))]
    filter: Filtering,

    /// Run the case again and take the readings this often, such as '0.1 ms': what happens between the outputs of the file counts
    /// then. With a filter it is 0.1 ms where the outputs are further apart
    #[arg(long, value_name = "TIME", value_parser = interval)]
    interval: Option<f64>,

    /// The dummy whose limits and risk curves hold
    #[arg(long, value_name = "DUMMY", default_value = "hybrid-iii-50m", value_parser = one_of(&DUMMIES))]
    dummy: Dummy,

    /// Exit with code 1 if a limit is exceeded
    #[arg(long)]
    strict: bool,

    /// Print JSON instead of tables; SI units
    #[arg(long)]
    json: bool,
}

/// Filters: names on the command line, names in help.
const FILTERS: [(&str, &str, Filtering); 3] = [
    ("none", "The signals as they are", Filtering::None),
    ("sae-j211", "Coefficients of SAE J211", Filtering::Classes(CfcFamily::SaeJ211)),
    ("iso6487", "Coefficients of ISO 6487", Filtering::Classes(CfcFamily::Iso6487)),
];

/// Dummies, likewise.
const DUMMIES: [(&str, &str, Dummy); 3] = [
    ("hybrid-iii-50m", "Hybrid III, 50th percentile male", Dummy::HybridIii50M),
    ("hybrid-iii-5f", "Hybrid III, 5th percentile female", Dummy::HybridIii5F),
    ("thor-50m", "THOR, 50th percentile male", Dummy::Thor50M),
];

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
    let options = Options { dummy: args.dummy, filtering: args.filter };
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

fn text(results: &Results, interval_ms: f64, options: &Options, Summary { measures, caveats, .. }: &Summary) -> String {
    let marks = Marks::of(caveats);
    let filter = match options.filtering {
        Filtering::None => "unfiltered".to_owned(),
        Filtering::Classes(family) => format!("filtered by {} classes", family_name(family)),
    };
    let title = shown(&results.model.setup().title);
    let dummy = options.dummy.name();
    [
        format!(
            "{title}\nreadings every {interval_ms} ms, {filter}; limits and risks of a {dummy}\n"
        ),
        table(measures, &marks),
        marks.explained().unwrap_or_default(),
        risks(measures, &marks),
        remarks(measures),
        "Limits and curves were read where others quote them, not in the rules: check the rule before a legal statement.\n"
            .to_owned(),
    ]
    .join("\n")
}

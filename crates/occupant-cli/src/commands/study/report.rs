//! `occupant study report`.

use std::path::PathBuf;

use crate::base::{Failure, UnitsArg, deliver, json, print, progress};
use occupant_jobs::files::store::is_address;
use occupant_jobs::study::{Wanted, answer, matrix_text, page, paragraphs};

/// Make an HTML page of a study: which inputs matter, how much, and the worst cases
///
/// The sweep may be finished or still running. The page opens in any browser and needs no network. Its numbers are also
/// written to REPORT.parquet beside it, and the samples to REPORT-samples.parquet.
#[derive(Debug, clap::Args)]
pub(crate) struct ReportArgs {
    /// The folder of `occupant sweep`, or several folders with shards of one sweep, or addresses of object stores
    #[arg(value_name = "FOLDER", required = true)]
    folders: Vec<PathBuf>,

    /// The page; FOLDER/report.html if absent. An earlier report of the same study is replaced
    #[arg(short, long, value_name = "FILE.html")]
    output: Option<PathBuf>,

    /// Replace existing files
    #[arg(short, long)]
    force: bool,

    #[command(flatten)]
    units: UnitsArg,

    /// Results to report, such as hic15,belts.*.peak; if absent, those of head, chest, pelvis and belts that vary
    #[arg(long, value_name = "FIGURES", value_delimiter = ',')]
    to: Vec<String>,

    /// A limit besides those of rules, such as hic15=700 or 'head_excursion.forward=650 mm': the report says how probable it is
    /// that it is exceeded. May be repeated
    #[arg(long, value_name = "FIGURE=VALUE")]
    limit: Vec<String>,

    /// Print what can be quoted of each result as JSON, in SI units, instead of text
    #[arg(long)]
    json: bool,
}

/// Makes the report of a study.
pub(crate) fn report(args: &ReportArgs) -> Result<(), Failure> {
    let Some(first) = args.folders.first() else {
        return Err(Failure::plain("give the folder of a sweep"));
    };
    if let (None, true) = (&args.output, is_address(first)) {
        return Err(Failure::with_help("the page of an object store has no folder", "give -o FILE.html"));
    }
    let page_at = args.output.clone().unwrap_or_else(|| first.join("report.html"));
    let units = |scenario| args.units.or(Some(scenario));
    let (force, is_unasked) = (args.force, args.output.is_none());
    let wanted =
        Wanted { folders: &args.folders, page: &page_at, to: &args.to, limits: &args.limit, force, is_unasked };
    let report = wanted.write(units, progress::show(false))?;
    if args.json {
        print(&json(&answer(&report))?)?;
    } else {
        print(&matrix_text(&report))?;
        print(&format!("\n{}", paragraphs(&report)))?;
    }
    deliver(&page_at, true, page(&report).as_bytes())
}

//! `occupant report`.

use std::path::{Path, PathBuf};

use crate::base::{Failure, Units, UnitsArg, deliver_and, file_name, is_page, note, refuse_input, say};
use occupant_files::results::Results;
use occupant_jobs::report::{MOST_RUNS, page_judged, subject};
use occupant_pictures::html::is_page_of;

/// Make an HTML page of one to four runs: 3-D motion, histories, measures
///
/// The page opens in any browser and needs no network. Keys: space plays, arrows step, 1 to 4 choose the view.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The results of `occupant run`. Several runs are shown side by side, with their curves and numbers
    #[arg(value_name = "RUN.mcap", required = true, num_args = 1..=4)]
    runs: Vec<PathBuf>,

    /// The page; RUN.html beside the run if absent. An earlier report of the same run is replaced
    #[arg(short, long, value_name = "FILE.html")]
    output: Option<PathBuf>,

    /// Channels to plot before the others, by name or pattern, such as 'head.acceleration.*'
    #[arg(long = "channel", alias = "channels", value_name = "NAMES")]
    channels: Vec<String>,

    #[command(flatten)]
    units: UnitsArg,

    /// Judge people too by limits made for dummies: passed or failed. Without it they are yardsticks
    #[arg(long)]
    verdict: bool,

    /// Replace existing files
    #[arg(short, long)]
    force: bool,

    /// Open the page with the system's default program
    #[arg(long)]
    open: bool,

    /// Another run to compare with: drawn as a ghost or side by side
    #[arg(long, value_name = "OTHER.mcap")]
    against: Option<PathBuf>,
}

pub(crate) fn report(args: &Args) -> Result<(), Failure> {
    let files: Vec<PathBuf> = args.runs.iter().chain(&args.against).cloned().collect();
    let output = args.output.clone().unwrap_or_else(|| args.runs[0].with_extension("html"));
    let is_unasked = args.output.is_none();
    write(&files, &output, (args.force, is_unasked, args.open), (&args.channels, args.verdict), args.units)
}

/// Writes the page of runs. `force`: replace any existing file; `is_unasked`: replace an earlier page of the same runs;
/// `open`: open the page; `channels`: plots before the others; `verdict`: judge people too.
pub(crate) fn write(
    files: &[PathBuf],
    output: &Path,
    (force, is_unasked, open): (bool, bool, bool),
    (channels, verdict): (&[String], bool),
    units: UnitsArg,
) -> Result<(), Failure> {
    if !is_page(output) {
        return Err(Failure::ending(output, ".html"));
    }
    if files.len() > MOST_RUNS {
        let found = format!("{} runs on one page", files.len());
        return Err(Failure::with_help(found, &format!("give at most {MOST_RUNS}")));
    }
    files.iter().try_for_each(|input| refuse_input(output, input))?;
    let runs = files.iter().map(|file| Results::open(file)).collect::<Result<Vec<_>, _>>()?;
    runs.iter().flat_map(Results::notes).for_each(|text| note(&text));
    let force = force || is_unasked && replaces_earlier(files, output);
    let units = runs.first().map_or_else(Units::default, |run| units.or(run.loaded.scenario.units));
    let page = page_judged(&runs, channels, units, verdict)?;
    deliver_and(open, output, force, page.as_bytes())
}

/// Whether the page is an earlier one of the same runs, which is then reported as replaced.
fn replaces_earlier(files: &[PathBuf], output: &Path) -> bool {
    let names: Vec<String> = files.iter().map(|run| file_name(run)).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let is_earlier = is_page_of(output, &subject(&names));
    if is_earlier {
        say(&format!("note: replacing {}, an earlier report of the same run (use -o to keep it)", output.display()));
    }
    is_earlier
}

//! `occupant report`.

use std::path::{Path, PathBuf};

use crate::base::{Failure, UnitsArg, deliver_and, file_name, is_page, note, refuse_input, say};
use crate::files::results::Results;
use crate::jobs::report::{page, subject};
use crate::pictures::html::is_page_of;

/// Make a page of a run: motion in 3-D, time histories, measures, contacts and where it comes from, in one HTML file
///
/// It opens in any browser and loads nothing from the network. Keys: space plays, arrows step, 1 to 4 choose the view.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The results of `occupant run`
    #[arg(value_name = "RUN.mcap")]
    run: PathBuf,

    /// The page; RUN.html beside the run if absent, where an earlier report of the same is replaced
    #[arg(short, long, value_name = "FILE.html")]
    output: Option<PathBuf>,

    #[command(flatten)]
    units: UnitsArg,

    /// Replace a file that exists
    #[arg(short, long)]
    force: bool,

    /// Open what was written with the program that the system has for it
    #[arg(long)]
    open: bool,

    /// Another run, drawn as a ghost or beside, with its curves and numbers beside those of the first
    #[arg(long, value_name = "OTHER.mcap")]
    against: Option<PathBuf>,
}

pub(crate) fn report(args: &Args) -> Result<(), Failure> {
    let output = args.output.clone().unwrap_or_else(|| args.run.with_extension("html"));
    if !is_page(&output) {
        return Err(Failure::ending(&output, ".html"));
    }
    for input in std::iter::once(&args.run).chain(&args.against) {
        refuse_input(&output, input)?;
    }
    let run = Results::open(&args.run)?;
    let against = args.against.as_deref().map(Results::open).transpose()?;
    std::iter::once(&run).chain(&against).flat_map(Results::notes).for_each(|text| note(&text));
    let force = args.force || replaces_earlier(args, &output);
    let page = page(&run, against.as_ref(), args.units.or(run.loaded.scenario.units))?;
    deliver_and(args.open, &output, force, page.as_bytes())
}

/// Whether the page of the default name is an earlier one of the same runs; then says that it is replaced.
fn replaces_earlier(args: &Args, output: &Path) -> bool {
    let names: Vec<String> = std::iter::once(&args.run).chain(&args.against).map(|run| file_name(run)).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let is_earlier = args.output.is_none() && is_page_of(output, &subject(&names));
    if is_earlier {
        say(&format!("{} is an earlier report of the same and is replaced; -o keeps both", output.display()));
    }
    is_earlier
}

//! `occupant report`.

use std::path::PathBuf;

use crate::base::{Failure, UnitsArg, deliver_and, is_page, note, refuse_input};
use crate::files::results::Results;
use crate::jobs::report::page;

/// Make a page of a run: motion in 3-D, time histories, measures, contacts and where it comes from, in one HTML file
///
/// It opens in any browser and loads nothing from the network. Keys: space plays, arrows step, 1 to 4 choose the view.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The results of `occupant run`
    #[arg(value_name = "RUN.mcap")]
    run: PathBuf,

    /// The page; RUN.html beside the run if absent
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
    deliver_and(
        args.open,
        &output,
        args.force,
        page(&run, against.as_ref(), args.units.or(run.loaded.scenario.units))?.as_bytes(),
    )
}

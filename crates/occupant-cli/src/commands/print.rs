//! `occupant print`.

use std::path::PathBuf;

use cardio_legacy::print::{printout, uneven};

use super::flags::history::interval;
use crate::base::{Failure, UnitsArg, deliver, note, print, refuse_input, say};
use occupant_jobs::print::read;

/// Print a run as paged text, in the layout of the 1970 program
///
/// The input and the computed seating come first, then the results at each print time, then the pairs of sphere and
/// surface that an extension run needs. 132 columns, 60 lines per page, form feeds between pages.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The results of `occupant run`
    #[arg(value_name = "RUN.mcap")]
    run: PathBuf,

    /// The file to write; standard output if absent
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Replace an existing file
    #[arg(short, long, requires = "output")]
    force: bool,

    /// Print interval (DTPRNT), such as '10 ms' or 0.01; every output if absent
    #[arg(long = "interval", alias = "every", value_name = "TIME", allow_hyphen_values = true, value_parser = interval)]
    every: Option<f64>,

    #[command(flatten)]
    units: UnitsArg,
}

pub(crate) fn print_run(args: &Args) -> Result<(), Failure> {
    let name = args.run.display();
    let (case, flaw) = read(&args.run)?;
    let units = args.units.or(case.loaded.scenario.units).system;
    let text = printout(&case, units.into(), args.every).map_err(|e| Failure::plain(format!("{name}: {e}")))?;
    match &args.output {
        Some(path) => {
            refuse_input(path, &args.run)?;
            deliver(path, args.force, text.as_bytes())?;
        }
        None => print(&text)?,
    }
    if let Some(words) = args.every.and_then(|every_s| uneven(&case, every_s)) {
        note(&words);
    }
    if let Some(flaw) = flaw {
        note(&format!("{name} is {flaw}"));
    }
    if !case.is_complete() {
        say(&format!("{name} is partial; the last page says so"));
    }
    Ok(())
}

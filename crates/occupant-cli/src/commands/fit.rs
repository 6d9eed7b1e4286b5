//! `occupant fit`.

use std::path::PathBuf;

use super::flags::sweep::{EngineArgs, folder_of};
use crate::base::{Failure, json, listen, print, program, progress, quoted, say};
use occupant_files::measured::MapArgument;
use occupant_jobs::files::study_folder::folder::Folder;
use occupant_jobs::fit::fitting::Fitting;
use occupant_jobs::fit::opening::Given;
use occupant_jobs::fit::{fit as fit_in, report};
use occupant_jobs::search::Work;

/// Fit the parameters of a study to a test
///
/// Searches each parameter's range for the values that best reproduce measured channels of one or more tests. The study's
/// [fit] section says what counts. A global search (CMA-ES with restarts) is followed by a local refinement and by
/// profile intervals: how far each parameter can move while the others compensate.
///
/// Writes FOLDER/fit.json, fitted.toml (the scenario with the fitted values; fitted/TEST.toml for several tests),
/// plots/*.svg (measured and computed, before and after) and history.parquet and .csv (all candidates). Run the same
/// command again to resume an interrupted fit; the result is the same. A surface from a drop test: `occupant surface`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The study, TOML or JSON
    #[arg(value_name = "STUDY")]
    study: PathBuf,

    /// A test: a CSV table or an ISO-MME test. May be repeated. Not needed if the study names its tests
    #[arg(long = "test", alias = "to", value_name = "FILE")]
    to: Vec<PathBuf>,

    /// The folder for the results; named after the study, in the current folder, if absent
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,

    /// Assign a column of the tests to a channel: 'column=channel', 'column[unit]=channel', or 'column=-channel' to reverse
    /// the sign. Not needed for columns that have a channel's name
    #[arg(long, value_name = "MAP")]
    map: Vec<MapArgument>,

    /// Change a value in all scenarios, such as --set time.end='120 ms'. May be repeated
    #[arg(long = "set", value_name = "PATH.TO.KEY=VALUE")]
    overrides: Vec<String>,

    #[command(flatten)]
    engine: EngineArgs,

    /// Wait while another process works in the folder, instead of ending with exit code 75
    #[arg(long)]
    wait: bool,

    /// Remove the results in the folder and start again
    #[arg(long)]
    restart: bool,

    /// Print the content of fit.json instead of tables
    #[arg(long)]
    json: bool,

    /// Print no progress, no warnings and no tables
    #[arg(short, long)]
    quiet: bool,
}

pub(crate) fn fit(args: &Args) -> Result<(), Failure> {
    let engine = args.engine.engine()?;
    let given = Given { files: &args.to, maps: &args.map, overrides: &args.overrides };
    let fitting = Fitting::open(&args.study, &given, program())?;
    if !args.quiet {
        fitting.warnings.iter().for_each(|w| say(&format!("{w}\n")));
    }
    let folder = Folder::of_fit(&args.output.clone().map_or_else(|| folder_of(&args.study), Ok)?);
    let interrupt = listen("stopping; press Ctrl-C again to stop at once");
    let (engine, interrupt, show) = (&engine, &interrupt, progress::show(args.quiet));
    let found = fit_in(&fitting, &folder, &Work { engine, interrupt, show, restart: args.restart, wait: args.wait })?;
    match (args.json, args.quiet) {
        (true, _) => print(&json(&found)?),
        (false, true) => Ok(()),
        (false, false) => {
            let path = folder.path.display();
            let one = folder.path.join("fitted.toml").is_file();
            let next = if one {
                format!("next: occupant run {}\n", quoted(folder.path.join("fitted.toml").display()))
            } else {
                String::new()
            };
            print(&format!("{}\nwritten to {path}\n{next}", report::text(&found)))
        }
    }
}

//! `occupant optimise`.

use std::path::PathBuf;

use super::flags::sweep::{EngineArgs, folder_of};
use crate::base::{Done, Failure, json, listen, print, program, progress, quoted, say};
use occupant_jobs::files::study_folder::folder::Folder;
use occupant_jobs::optimise::{Optimising, optimise as optimise_in, text};
use occupant_jobs::search::Work;

/// Find the parameters with which a measure is smallest
///
/// Searches each parameter's range for the values that make a measure, or a weighted sum of measures, as small or as large as
/// possible within limits on other measures. The study's [optimise] section says which. A run with a caveat on one of these
/// measures does not win. With an [ensemble] in the study, a quantile of its members counts.
///
/// Writes FOLDER/optimum.json, best.toml (the scenario with the best values), report.html (measures, limits, what the optimum
/// hangs on, best runs, history) and history.parquet and .csv (all candidates). Run the same command again to resume an
/// interrupted search; the result is the same. Exit code 1: no candidate keeps all limits.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The study, TOML or JSON
    #[arg(value_name = "STUDY")]
    study: PathBuf,

    /// The folder for the results; named after the study, in the current folder, if absent
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,

    /// Change a value in the scenario, such as --set time.end='120 ms'. May be repeated
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

    /// Print the content of optimum.json instead of tables
    #[arg(long)]
    json: bool,

    /// Print no progress, no warnings and no tables
    #[arg(short, long)]
    quiet: bool,
}

pub(crate) fn optimise(args: &Args) -> Result<Done, Failure> {
    let engine = args.engine.engine()?;
    let of = Optimising::open(&args.study, &args.overrides, program())?;
    if !args.quiet {
        of.warnings.iter().for_each(|w| say(&format!("{w}\n")));
    }
    let folder = Folder::of_optimum(&args.output.clone().map_or_else(|| folder_of(&args.study), Ok)?);
    let interrupt = listen("stopping; press Ctrl-C again to stop at once");
    let (engine, interrupt, show) = (&engine, &interrupt, progress::show(args.quiet));
    let found = optimise_in(&of, &folder, &Work { engine, interrupt, show, restart: args.restart, wait: args.wait })?;
    match (args.json, args.quiet) {
        (true, _) => print(&json(&found)?)?,
        (false, true) => {}
        (false, false) => {
            let best = quoted(folder.path.join("best.toml").display());
            let path = folder.path.display();
            print(&format!("{}\nwritten to {path}\nnext: occupant run {best}\n", text::text(&found)))?;
        }
    }
    Ok(if found.is_allowed { Done::Well } else { Done::Unwell })
}

//! `occupant fit`.

use std::path::PathBuf;

use super::flags::sweep::{EngineArgs, folder_of};
use crate::base::{Failure, json, listen, print, program, progress, quoted, say};
use occupant_files::measured::MapArgument;
use occupant_jobs::files::study_folder::checksums::Checksums;
use occupant_jobs::files::study_folder::folder::Folder;
use occupant_jobs::files::study_folder::journal::Journal;
use occupant_jobs::files::study_folder::shard::Shard;
use occupant_jobs::fit::evaluator::Evaluator;
use occupant_jobs::fit::fitting::Fitting;
use occupant_jobs::fit::identified::search;
use occupant_jobs::fit::opening::Given;
use occupant_jobs::fit::output::Output;
use occupant_jobs::fit::progress::Progress;
use occupant_jobs::fit::report;
use occupant_jobs::sweep::stored::sha256_of;
use occupant_jobs::sweep::words::{tell_damaged, warn_unlocked};

/// Find the parameters of a study with which runs follow a test best
///
/// Looks for the values of the study's parameters, each between the ends of its range, with which measured channels of one
/// test or of several are reproduced best; the study's [fit] says what counts. A global search (CMA-ES with growing
/// populations) is followed by a refinement and by intervals: how far each parameter can go while the others make up for it.
/// Writes FOLDER/fit.json, fitted.toml (the scenario with the fitted numbers and where they come from; of several scenarios
/// fitted/TEST.toml), plots/*.svg (measured against computed, before and after) and history.parquet and .csv (every candidate).
/// The same command resumes a fit that was interrupted or killed, and ends at the same answer.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The study, TOML or JSON
    #[arg(value_name = "STUDY")]
    study: PathBuf,

    /// A test: a text table (CSV) or an ISO-MME test; may be repeated. Not needed where the study names its tests
    #[arg(long = "test", alias = "to", value_name = "FILE")]
    to: Vec<PathBuf>,

    /// The folder of the results, made if it is not there; that of the study's name in the present folder if absent
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,

    /// Which column of the tests is which channel: 'column=channel', 'column[unit]=channel', 'column=-channel' for opposite
    /// signs; columns named as channels are found without
    #[arg(long, value_name = "MAP")]
    map: Vec<MapArgument>,

    /// Change a value in all scenarios, such as --set time.end='120 ms'; may be repeated
    #[arg(long = "set", value_name = "PATH.TO.KEY=VALUE")]
    overrides: Vec<String>,

    #[command(flatten)]
    engine: EngineArgs,

    /// Remove the results that the folder holds and begin anew
    #[arg(long)]
    restart: bool,

    /// Print what fit.json holds instead of tables
    #[arg(long)]
    json: bool,

    /// No progress, no warnings, no tables
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
    let sha256 = sha256_of(&fitting.manifest)?;
    let held = folder.claim(&fitting.manifest, &fitting.texts, Shard::WHOLE, args.restart)?;
    warn_unlocked(&held, "fitting into one folder", args.quiet);
    let sums = Checksums::open(&folder.path, |_| true)?;
    let interrupt = listen("stopping; once more to stop at once");
    let progress = Progress::new(fitting.fit.budget, progress::show(args.quiet));
    let mut evaluator = Evaluator::new(&fitting, (&folder, &sums), &sha256, &engine, &interrupt, progress)?;
    tell_damaged(&[held.mended, sums.damaged()].concat());
    if evaluator.known() > 0 && !args.quiet {
        say(&format!("resuming: {} runs are there", evaluator.known()));
    }
    let answer = search(&fitting, &mut evaluator)?;
    let records = evaluator.close()?;
    let found = Output { fitting: &fitting, folder: &folder, sums: &sums }.write(&answer, &records)?;
    Journal::list(&folder, Shard::WHOLE, &sums)?;
    sums.close()?;
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

//! `occupant sweep`.

mod merge;

use std::path::{Path, PathBuf};

use clap::Subcommand;

use super::flags::sweep as flags;
use crate::base::{Done, Failure, UnitsArg, listen, print, program, progress, say};
use occupant_jobs::files::scenario::warn;
use occupant_jobs::files::study_folder::folder::Folder;
use occupant_jobs::files::study_folder::texts::Texts;
use occupant_jobs::sweep::job::Sweep;
use occupant_jobs::sweep::plan::Plan;

/// Run every sample of a study and write one table
///
/// Writes FOLDER/results.parquet: a row for each sample with its inputs, all measures of the run and how it ended. A sample
/// that fails is a row with its reason. The same command resumes a sweep that was interrupted or killed: every
/// finished sample is kept. On several machines, each computes a part of the study into the same folder (--shard, or a Slurm job
/// array), and `occupant sweep merge FOLDER` makes the table.
#[derive(Debug, clap::Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub(crate) struct Args {
    #[command(subcommand)]
    command: Option<Step>,

    /// The study, TOML or JSON
    #[arg(value_name = "STUDY", required = true)]
    study: Option<PathBuf>,

    /// The folder of the results, made if it is not there; that of the study's name in the present folder if absent
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,

    /// Change a value in all samples, such as --set time.end='250 ms'; may be repeated
    #[arg(long = "set", value_name = "PATH.TO.KEY=VALUE")]
    overrides: Vec<String>,

    #[command(flatten)]
    engine: flags::EngineArgs,

    /// Compute one part of the study only, such as 3/8; else OCCUPANT_SHARD says which, else the Slurm job array that this
    /// is a task of
    #[arg(long, value_name = "I/N")]
    shard: Option<String>,

    /// Write whole runs as runs/NUMBER.mcap instead of those that the study says: all, none, '3, 17' or
    /// 'worst 5 by head.peak'
    #[arg(long, value_name = "WHICH")]
    keep: Option<String>,

    /// Write nothing: say how many samples there are, show the first, and estimate time and size by running one
    #[arg(long)]
    dry_run: bool,

    /// Write the table as results.csv too, with the units in columns.csv
    #[arg(long)]
    csv: bool,

    /// Remove the results that the folder holds and begin anew
    #[arg(long)]
    restart: bool,

    #[command(flatten)]
    units: UnitsArg,

    /// No progress, no warnings, no table of what it came to
    #[arg(short, long)]
    quiet: bool,
}

#[derive(Debug, Subcommand)]
enum Step {
    Merge(merge::MergeArgs),
}

/// Runs a sweep, or merges one.
pub(crate) fn sweep(args: &Args) -> Result<Done, Failure> {
    match (&args.command, &args.study) {
        (Some(Step::Merge(args)), _) => merge::merge(args),
        (None, Some(study)) => {
            let output = args.output.clone().map_or_else(|| flags::folder_of(study), Ok)?;
            let sweep = open(args, study, &output)?;
            if args.dry_run {
                return print(&sweep.rehearse()?).map(Into::into);
            }
            sweep.plan.refuse_hopeless()?;
            let (done, words) = sweep.run()?;
            print(&words)?;
            Ok(done)
        }
        (None, None) => Err(Failure::plain("a sweep needs a study")),
    }
}

fn open(args: &Args, study: &Path, output: &Path) -> Result<Sweep, Failure> {
    let (shard, told_by) = flags::shard(args.shard.as_deref())?;
    let texts = Texts::of_files(study);
    let plan = Plan::open(study, &args.overrides, &texts, program())?;
    let keep = flags::keep(args.keep.as_deref(), &plan)?;
    if args.restart && !shard.is_whole() {
        return Err(Failure::with_help(
            "--restart of one shard would remove the results of the others",
            "remove the folder before the first shard begins",
        ));
    }
    if args.csv && !shard.is_whole() {
        return Err(Failure::with_help("a shard writes no table", "give --csv to `occupant sweep merge`"));
    }
    if !args.quiet {
        warn(&plan.warnings);
        if let Some(variable) = told_by {
            say(&format!("shard {shard}, as {variable} says"));
        }
    }
    Ok(Sweep {
        csv: args.csv || (plan.study.csv && shard.is_whole()),
        folder: Folder::at(output),
        engine: args.engine.engine()?,
        interrupt: listen("stopping; once more to stop at once"),
        restart: args.restart,
        show: progress::show(args.quiet),
        units: args.units.or(Some(plan.study.base.units())),
        plan,
        shard,
        keep,
    })
}

//! `occupant sweep`.

mod merge;
mod status;

use std::path::{Path, PathBuf};

use clap::Subcommand;

use super::flags::sweep as flags;
use crate::base::{Done, Existing, Failure, UnitsArg, listen, print, program, progress, say};
use occupant_files::table::Form;
use occupant_jobs::files::scenario::warn;
use occupant_jobs::files::store::is_address;
use occupant_jobs::files::study_folder::block::Block;
use occupant_jobs::files::study_folder::folder::Folder;
use occupant_jobs::files::study_folder::texts::Texts;
use occupant_jobs::study::write_design;
use occupant_jobs::sweep::job::Sweep;
use occupant_jobs::sweep::kept;
use occupant_jobs::sweep::plan::Plan;

/// Run every sample of a study and write one table of results
///
/// Writes FOLDER/results.parquet: one row per sample with its inputs, all measures and how it ended. A failed sample has a
/// row with the reason. Run the same command again to resume an interrupted sweep; finished samples are kept. To share a
/// sweep between machines, give each a part (--shard, --range, or a Slurm job array): each writes a table of its own into
/// FOLDER/parts, and `occupant sweep merge FOLDER` makes one of them at the end. If the study has a
/// `rating`, the runs are rated then.
#[derive(Debug, clap::Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub(crate) struct Args {
    #[command(subcommand)]
    command: Option<Step>,

    /// The study, TOML or JSON
    #[arg(value_name = "STUDY", required = true)]
    study: Option<PathBuf>,

    /// The folder for the results; named after the study, in the current folder, if absent. Or the address of an object store, such as
    /// s3://BUCKET/PREFIX (also gs://, az://, file://), if this build has the feature `object-store`
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,

    /// With an address: the folder on this machine for what is not finished; one in the folder for temporary files if absent
    #[arg(long, value_name = "FOLDER")]
    scratch: Option<PathBuf>,

    /// Change a value in all samples, such as --set time.end='250 ms'. May be repeated
    #[arg(long = "set", value_name = "PATH.TO.KEY=VALUE")]
    overrides: Vec<String>,

    #[command(flatten)]
    engine: flags::EngineArgs,

    /// Compute only this part of the study, such as 3/8. If absent, OCCUPANT_SHARD or the Slurm job array decides
    #[arg(long, value_name = "I/N")]
    shard: Option<String>,

    /// Compute only these samples, such as 1000..2000 (up to 1999) or 1000-1999, as `occupant sweep status --missing` prints them.
    /// With --shard, that part of them
    #[arg(long, value_name = "FROM..TO")]
    range: Option<String>,

    /// Wait while another process computes the same samples, instead of ending with exit code 75
    #[arg(long)]
    wait: bool,

    /// Which whole runs to write as runs/NUMBER.mcap: all, none, '3, 17' or 'worst 5 by head.peak'; those of the study if
    /// absent
    #[arg(long, value_name = "WHICH")]
    keep: Option<String>,

    /// Only show the number of samples and the first few, and estimate time and size by running some, spread over the study, as the sweep will
    #[arg(long)]
    dry_run: bool,

    /// Only write the samples, a row each, as FILE.csv, .parquet, .xlsx or .mat; a study can read them as its table of samples
    #[arg(long, value_name = "FILE", conflicts_with = "dry_run")]
    design_only: Option<PathBuf>,

    /// Also write the table as results.csv, with the units in columns.csv
    #[arg(long)]
    csv: bool,

    /// Remove the results in the folder and start again; with --design-only, replace its file
    #[arg(long)]
    restart: bool,

    #[command(flatten)]
    units: UnitsArg,

    /// Print no progress, no warnings and no summary
    #[arg(short, long)]
    quiet: bool,
}

#[derive(Debug, Subcommand)]
enum Step {
    Merge(merge::MergeArgs),
    Status(status::StatusArgs),
}

/// Runs a sweep, or merges one.
pub(crate) fn sweep(args: &Args) -> Result<Done, Failure> {
    match (&args.command, &args.study) {
        (Some(Step::Merge(args)), _) => merge::merge(args),
        (Some(Step::Status(args)), _) => status::status(args).map(|()| Done::Well),
        (None, Some(study)) => {
            if let Some(file) = &args.design_only {
                return design_only(args, study, file);
            }
            let output = args.output.clone().map_or_else(|| flags::folder_of(study), Ok)?;
            let Some(sweep) = open(args, study, &output)? else {
                if !args.quiet {
                    say("this part of the study has no sample: nothing to do");
                }
                return Ok(Done::Well);
            };
            if args.dry_run {
                return print(&sweep.rehearse()?).map(Into::into);
            }
            sweep.plan.refuse_hopeless()?;
            let (done, words) = sweep.run()?;
            print(&words)?;
            Ok(done)
        }
        (None, None) => Err(Failure::plain("give a study to sweep")),
    }
}

/// Writes the samples without running any.
fn design_only(args: &Args, study: &Path, file: &Path) -> Result<Done, Failure> {
    let refused =
        |found: &str, help: &str| Err(Failure::with_help(format!("--design-only {}: {found}", file.display()), help));
    if Form::of(file).is_none() {
        return refused("unknown file format", "use the extension .csv, .parquet, .xlsx or .mat");
    }
    if file.exists() && !args.restart {
        return refused("the file exists", "replace it with --restart, or choose another name");
    }
    let plan = Plan::open(study, &args.overrides, &Texts::of_files(study), program())?;
    if !args.quiet {
        warn(&plan.warnings);
    }
    let written = write_design(&plan, file, Existing::by(args.restart))?;
    let left_out = match plan.study.samples() - written {
        0 => String::new(),
        left_out => format!("; {left_out} break a constraint"),
    };
    print(&format!("wrote {}, {written} samples{left_out}\n", file.display())).map(Into::into)
}

/// The sweep; none for a part of the study without samples.
fn open(args: &Args, study: &Path, output: &Path) -> Result<Option<Sweep>, Failure> {
    let (shard, told_by) = flags::shard(args.shard.as_deref())?;
    let texts = Texts::of_files(study);
    let plan = Plan::open(study, &args.overrides, &texts, program())?;
    let samples = plan.manifest.samples;
    let range = flags::range(args.range.as_deref(), samples)?;
    let block = Block::new(shard.range(&range));
    let is_whole = !is_address(output) && block.as_ref().is_some_and(|block| block.is_all_of(samples));
    let keep = kept::chosen(args.keep.as_deref(), &plan)?;
    if args.restart && !is_whole {
        let found = "--restart with an address";
        if is_address(output) {
            return Err(Failure::with_help(found, "remove the files there yourself, or choose another prefix"));
        }
        return Err(Failure::with_help(
            "--restart with a part of the study would remove the results of the others",
            "remove the folder before you start the first part",
        ));
    }
    if args.csv && !is_whole {
        let found = "a part of the study is not written as CSV";
        return Err(Failure::with_help(found, "give --csv to `occupant sweep merge`"));
    }
    if !args.quiet {
        warn(&plan.warnings);
        if let Some(variable) = told_by {
            say(&format!("shard {shard}, from {variable}"));
        }
    }
    let Some(block) = block else {
        return Ok(None);
    };
    // a preview looks at no store
    let folder = if args.dry_run { Folder::at(output) } else { Folder::given(output, args.scratch.as_deref())? };
    Ok(Some(Sweep {
        csv: args.csv || (plan.study.csv && is_whole),
        folder,
        engine: args.engine.engine()?,
        kernel: args.engine.kernel.clone(),
        interrupt: listen("stopping; press Ctrl-C again to stop at once"),
        restart: args.restart,
        show: progress::show(args.quiet),
        units: args.units.or(Some(plan.study.base.units())),
        plan,
        block,
        wait: args.wait,
        keep,
    }))
}

//! `occupant sweep merge`.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

use occupant_core::run::batch::Kernel;

use crate::base::{Done, Failure, UnitsArg, print, quoted};
use crate::commands::flags::sweep::engine;
use occupant_jobs::files::study_folder::checksums::Checksums;
use occupant_jobs::files::study_folder::folder::Folder;
use occupant_jobs::files::study_folder::journal::Journal;
use occupant_jobs::files::study_folder::problem::Problem;
use occupant_jobs::sweep::results::refuse_gaps;
use occupant_jobs::sweep::stored::{MadeBy, Stored, open_with};
use occupant_jobs::sweep::words::{judged, tell, tell_damaged};
use occupant_jobs::sweep::{kept, results};

/// Merge the parts of a sweep into one table
///
/// Lists missing samples, if any. Of samples that stand in two parts the first counts.
#[derive(Debug, clap::Args)]
pub(crate) struct MergeArgs {
    /// The folder of the sweep, or several folders with parts of one sweep
    #[arg(value_name = "FOLDER", required = true)]
    folders: Vec<PathBuf>,

    /// The folder for the table; the first FOLDER if absent
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,

    /// Which whole runs to write, as in `occupant sweep --keep`, such as 'worst 5 by head.peak'
    #[arg(long, value_name = "WHICH")]
    keep: Option<String>,

    /// Number of threads for the worst runs; one per core if absent
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,

    /// Also write the table as results.csv, with the units in columns.csv
    #[arg(long)]
    csv: bool,

    #[command(flatten)]
    units: UnitsArg,

    /// Print no summary
    #[arg(short, long)]
    quiet: bool,
}

/// Makes one table of shards.
pub(crate) fn merge(args: &MergeArgs) -> Result<Done, Failure> {
    let opened = open_with(&args.folders, MadeBy::ThisProgram, Journal::read_parts)?;
    let Stored { manifest, plan, journal, .. } = opened;
    refuse_gaps(&journal, &manifest)?;
    let Some(target) = args.output.as_ref().or(args.folders.first()) else {
        return Err(Failure::plain("give the folder of a sweep"));
    };
    let target = Folder::at(target);
    std::fs::create_dir_all(&target.path).map_err(Problem::io("create", &target.path))?;
    target.refuse_other_results(&manifest)?;
    target.describe(&plan.manifest, &plan.texts)?;
    let keep = kept::chosen(args.keep.as_deref(), &plan)?;
    kept::prepare(&keep, &target)?;
    let sums = Checksums::open(&target.path, |name| !name.starts_with("bands/"))?;
    journal.runs_in(&target).for_each(|(name, sum)| sums.learn(name, sum, true));
    tell_damaged(&sums.damaged());
    let runs = kept::among(&sums.damaged(), &target, 0..manifest.samples);
    let found = results::write((&target, &sums), &journal, &manifest, &keep, args.csv || plan.study.csv)?;
    let (wanted, engine) = (found.worst.iter().copied().chain(runs), engine(args.threads, Kernel::best())?);
    kept::write_missing(&plan, (&target, &sums), &journal, wanted, &engine, &AtomicBool::new(false))?;
    sums.close()?;
    target.clear_journals_if_alone()?;
    let next = format!("occupant study report {}", quoted(target.path.display()));
    if !args.quiet {
        print(&tell(&found, None, &next, args.units.or(Some(plan.study.base.units()))))?;
    }
    Ok(judged(&found.census))
}

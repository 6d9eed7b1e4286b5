//! `occupant sweep merge`.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

use occupant_core::run::batch::Kernel;

use crate::base::{Done, Failure, UnitsArg, note, print, quoted};
use crate::commands::flags::sweep::engine;
use occupant_jobs::base::Interrupt;
use occupant_jobs::files::store::is_address;
use occupant_jobs::files::study_folder::checksums::{Checksums, sample_of};
use occupant_jobs::files::study_folder::folder::Folder;
use occupant_jobs::files::study_folder::journal::Journal;
use occupant_jobs::files::study_folder::problem::Problem;
use occupant_jobs::files::study_folder::waiting::Waiting;
use occupant_jobs::sweep::results::refuse_gaps;
use occupant_jobs::sweep::stored::{MadeBy, Stored, open_with};
use occupant_jobs::sweep::words::{judged, tell, tell_damaged};
use occupant_jobs::sweep::{kept, rating, results};

/// Merge the parts of a sweep into one table
///
/// Lists missing samples, if any. Of samples that stand in two parts the first counts.
#[derive(Debug, clap::Args)]
pub(crate) struct MergeArgs {
    /// The folder of the sweep, or several folders with parts of one sweep, or addresses of object stores
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

    /// Wait while another process writes the table, instead of ending with exit code 75
    #[arg(long)]
    wait: bool,

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
    let Some(target) = args.output.as_ref().or(args.folders.first()) else {
        return Err(Failure::plain("give the folder of a sweep"));
    };
    if is_address(target) {
        let found = format!("the table is not written to {}", target.display());
        return Err(Failure::with_help(found, "give -o FOLDER"));
    }
    let opened = open_with(&args.folders, MadeBy::ThisProgram, Journal::read_parts)?;
    let Stored { manifest, plan, journal, .. } = opened;
    refuse_gaps(&journal, &manifest)?;
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
    let waiting = Waiting { wait: args.wait, quiet: args.quiet, interrupt: &Interrupt::default() };
    let csv = args.csv || plan.study.csv;
    let mut found = results::write((&target, &sums), &journal, &manifest, (&keep, csv), &waiting)?;
    let others = if plan.rating.is_some() { others(&args.folders, &target, &journal)? } else { Vec::new() };
    let places = || std::iter::once((&target, &sums)).chain(others.iter().map(|(folder, sums)| (folder, sums)));
    let run_of = |index| places().find_map(|(at, sums)| Some(at.run(index)).filter(|path| sums.holds(path)));
    let lacking = rating::lacking(&plan, &journal, &run_of)?;
    let wanted = found.worst.iter().copied().chain(runs).chain(lacking);
    let engine = engine(args.threads, Kernel::best())?;
    kept::write_missing(&plan, (&target, &sums), &journal, wanted, &engine, &AtomicBool::new(false))?;
    let rated = rating::rate(&plan, (&target, &sums), &journal, &run_of, (&engine, &waiting))?;
    found.files.extend(rated.files);
    sums.close()?;
    target.clear_journals_if_alone()?;
    let next = format!("occupant study report {}", quoted(target.path.display()));
    if !args.quiet {
        rated.notes.iter().for_each(note);
        print(&(tell(&found, None, &next, args.units.or(Some(plan.study.base.units()))) + &rated.text))?;
    }
    Ok(judged(&found.census))
}

/// The other folders, with the hashes of their whole runs.
fn others(folders: &[PathBuf], target: &Folder, journal: &Journal) -> Result<Vec<(Folder, Checksums)>, Failure> {
    let opened = |folder: Folder| {
        let sums = Checksums::open(&folder.path, |name| sample_of(name).is_some())?;
        journal.runs_in(&folder).for_each(|(name, sum)| sums.learn(name, sum, true));
        Ok((folder, sums))
    };
    folders
        .iter()
        .filter(|path| **path != target.path && !is_address(path))
        .map(|path| opened(Folder::at(path)))
        .collect()
}

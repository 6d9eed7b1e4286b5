//! `occupant sweep merge`.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use occupant_core::run::batch::Kernel;
use occupant_study::Keep;

use super::words::{ensembles, tell};
use crate::base::failure::{Done, Failure};
use crate::base::names::program;
use crate::commands::flags::sweep::{engine, keep};
use crate::files::study_folder::folder::{Folder, Holds};
use crate::files::study_folder::manifest::Manifest;
use crate::files::study_folder::problem::Problem;
use crate::files::study_folder::texts::Texts;
use crate::jobs::sweep::parts::{common_manifest, read_journal, sha256_of};
use crate::jobs::sweep::plan::Plan;
use crate::jobs::sweep::results::refuse_gaps;
use crate::jobs::sweep::{kept, results};

/// Make one table of a sweep's shards
///
/// Says which samples are missing, if any are.
#[derive(Debug, clap::Args)]
pub(crate) struct MergeArgs {
    /// The folder of the sweep, or several with parts of one sweep
    #[arg(value_name = "FOLDER", required = true)]
    folders: Vec<PathBuf>,

    /// The folder that the table is written into; the first FOLDER if absent
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,

    /// Which whole runs to write, if the sweep was given --keep 'worst 5 by head.peak'
    #[arg(long, value_name = "WHICH")]
    keep: Option<String>,

    /// Number of threads for the worst runs; one for each core if absent
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,

    /// Write the table as results.csv too, with the units in columns.csv
    #[arg(long)]
    csv: bool,

    /// No table of what it came to
    #[arg(short, long)]
    quiet: bool,
}

/// Makes one table of shards.
pub(crate) fn merge(args: &MergeArgs) -> Result<Done, Failure> {
    let folders: Vec<Folder> = args.folders.iter().map(|f| Folder::at(f)).collect();
    let manifest = common_manifest(&folders)?;
    let journal = read_journal(&folders, &sha256_of(&manifest)?, &manifest)?;
    refuse_gaps(&journal, &manifest)?;
    let target = match (&args.output, folders.first()) {
        (Some(output), _) => Folder::at(output),
        (None, Some(first)) => first.clone(),
        (None, None) => return Err(Failure::plain("no folder was given")),
    };
    std::fs::create_dir_all(target.path()).map_err(Problem::io("create", target.path()))?;
    target.refuse_other_results(&manifest)?;
    let (plan, keep) = stored_plan(args, &folders, &manifest)?;
    kept::prepare(&keep, &target)?;
    let csv = args.csv || plan.study().csv();
    let (census, files) = results::write(&target, &journal, &manifest, &keep, csv)?;
    let lacking = kept::missing(&target, &journal, census.worst())?;
    let engine = engine(args.threads, Kernel::best())?;
    kept::write(&plan, &target, &lacking, &engine, &AtomicBool::new(false))?;
    let ensembles = ensembles(&target, &manifest, csv)?;
    if args.quiet { Ok(Done::Well) } else { tell(&census, &files, None, ensembles.as_ref()) }
}

/// The plan as the first folder holds it, and what is to be kept.
fn stored_plan(args: &MergeArgs, folders: &[Folder], manifest: &Manifest) -> Result<(Plan, Keep), Failure> {
    let (Some(folder), Some(study)) = (folders.first(), manifest.texts.first()) else {
        return Err(Failure::plain("the folder holds no study"));
    };
    let texts = Texts::of_copies(folder, manifest);
    let study = Path::new(&study.name);
    let plan = Plan::open(study, &manifest.overrides, &texts, program())?;
    if plan.manifest != *manifest {
        return Err(Failure::from(Problem::Differs {
            folder: folder.path().to_owned(),
            holds: Holds::Sweep,
            differences: manifest.differences(&plan.manifest, |_| None, |_| None),
        }));
    }
    let keep = keep(args.keep.as_deref(), &plan)?;
    Ok((plan, keep))
}

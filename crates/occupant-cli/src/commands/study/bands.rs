//! `occupant study bands`.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use occupant_core::run::batch::Kernel;

use crate::base::{Existing, Failure, listen, progress, say};
use crate::commands::flags::sweep::engine;
use occupant_jobs::ensemble::bands::choose;
use occupant_jobs::files::store::is_address;
use occupant_jobs::files::study_folder::checksums::Checksums;
use occupant_jobs::study::bands::StudyBands;
use occupant_jobs::sweep::stored::{MadeBy, open};

/// Write the bands over time of each sample's ensemble
///
/// A sweep keeps no time histories, so the ensemble of each sample is run again. Writes FOLDER/bands/SAMPLE.parquet: sample,
/// channel, time, quantiles, and the time at which the runs diverge. Run the same command again to resume.
#[derive(Debug, clap::Args)]
pub(crate) struct BandsArgs {
    /// The folder of `occupant sweep`, finished or still running
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,

    /// Channels, such as head.acceleration.resultant,belt.*.force; the main channels if absent
    #[arg(long = "channel", alias = "channels", value_name = "NAMES", value_delimiter = ',')]
    channels: Vec<String>,

    /// Number of threads; one per core if absent
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,

    /// Replace bands of other channels or of an earlier sweep
    #[arg(short, long)]
    force: bool,

    /// Print no progress
    #[arg(short, long)]
    quiet: bool,
}

/// Writes the bands of all samples that have none yet.
pub(crate) fn bands(args: &BandsArgs) -> Result<(), Failure> {
    if is_address(&args.folder) {
        let found = format!("{} is no folder of this machine", args.folder.display());
        return Err(Failure::with_help(found, "merge it into one: occupant sweep merge ADDRESS -o FOLDER"));
    }
    let opened = open(std::slice::from_ref(&args.folder), MadeBy::AnyProgram)?;
    let study = &opened.plan.study;
    if study.ensemble.is_none() {
        return Err(Failure::with_help(
            format!("the study of {} has no ensemble", args.folder.display()),
            "add [ensemble] to the study, to repeat each sample with small changes",
        ));
    }
    // names that are none are refused before anything is run
    if let Ok(first) = opened.plan.open_sample(0) {
        choose(&first.model, &args.channels)?;
    }
    for note in &opened.notes {
        say(note);
    }
    let interrupt = listen("stopping; press Ctrl-C again to stop at once");
    let bands = StudyBands {
        plan: &opened.plan,
        manifest_sha256: &opened.manifest_sha256,
        channels: &args.channels,
        folder: args.folder.join("bands"),
        engine: &engine(args.threads, Kernel::best())?,
        interrupt: &interrupt,
        sums: Checksums::open(&args.folder, |name| name.starts_with("bands/"))?,
        show: progress::show(args.quiet),
    };
    bands.write_all(Existing::by(args.force))
}

//! `occupant study bands`.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use occupant_core::run::batch::Kernel;

use crate::base::{Existing, Failure, listen, say};
use crate::commands::flags::sweep::engine;
use occupant_jobs::ensemble::bands::choose;
use occupant_jobs::files::study_folder::checksums::Checksums;
use occupant_jobs::study::bands::StudyBands;
use occupant_jobs::sweep::stored::{MadeBy, open};

/// Write the bands over time of a study with an ensemble: within which the members of each sample lie, and when they part
///
/// A sweep keeps no histories: the members of every sample are run once more, one sample after the other, and leave
/// FOLDER/bands/SAMPLE.parquet (sample, channel, time, quantiles, and the time from which on the members are parted). The same
/// command resumes what was interrupted or killed.
#[derive(Debug, clap::Args)]
pub(crate) struct BandsArgs {
    /// The folder that `occupant sweep` has written or still writes
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,

    /// Channels, such as head.acceleration.resultant,belt.*.force; the main ones if absent
    #[arg(long = "channel", alias = "channels", value_name = "NAMES", value_delimiter = ',')]
    channels: Vec<String>,

    /// Number of threads; one for each core if absent
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,

    /// Replace the bands of other channels, or of what the folder held before
    #[arg(short, long)]
    force: bool,

    /// No word on how far it is
    #[arg(short, long)]
    quiet: bool,
}

/// Writes the bands of all samples that have none yet.
pub(crate) fn bands(args: &BandsArgs) -> Result<(), Failure> {
    let opened = open(std::slice::from_ref(&args.folder), MadeBy::AnyProgram)?;
    let study = &opened.plan.study;
    if study.ensemble.is_none() {
        return Err(Failure::with_help(
            format!("the study of {} has no ensemble", args.folder.display()),
            "an [ensemble] in the study repeats every sample with small changes",
        ));
    }
    // names that are none are refused before anything is run
    if let Ok(first) = opened.plan.open_sample(0) {
        choose(&first.model, &args.channels)?;
    }
    for note in &opened.notes {
        say(note);
    }
    let interrupt = listen("stopping; once more to stop at once");
    let bands = StudyBands {
        plan: &opened.plan,
        manifest_sha256: &opened.manifest_sha256,
        channels: &args.channels,
        folder: args.folder.join("bands"),
        engine: &engine(args.threads, Kernel::best())?,
        interrupt: &interrupt,
        sums: Checksums::open(&args.folder, |name| name.starts_with("bands/"))?,
    };
    bands.write_all(Existing::by(args.force), args.quiet)
}

//! Choices of flags and environment for a sweep.

use std::ffi::OsStr;
use std::num::NonZeroUsize;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::thread::available_parallelism;

use occupant_core::run::batch::Kernel;
use occupant_study::engine::Engine;

use crate::base::Failure;
use occupant_jobs::files::study_folder::block::Block;
use occupant_jobs::files::study_folder::shard::Shard;

/// The shard to compute, from the flag or the environment variable.
pub(crate) fn shard(given: Option<&str>) -> Result<(Shard, Option<&'static str>), Failure> {
    let refused = |found: String| {
        Failure::with_help(found, "use --shard 1/1 to compute everything, regardless of the environment")
    };
    if let Some(text) = given {
        let shard = Shard::parse(text).map_err(|e| refused(format!("--shard: {e}")))?;
        return Ok((shard, None));
    }
    let shard = Shard::from_environment(|name| std::env::var(name).ok()).map_err(refused)?;
    Ok(match shard {
        Some((shard, variable)) => (shard, Some(variable)),
        None => (Shard::WHOLE, None),
    })
}

/// The samples to choose from: a range, or all of the study.
pub(crate) fn range(given: Option<&str>, samples: u64) -> Result<Range<u64>, Failure> {
    let block = given.map(|text| Block::parse(text, samples)).transpose();
    let block = block.map_err(|found| Failure::plain(format!("--range: {found}")))?;
    Ok(block.map_or(0..samples, |block| block.samples))
}

/// Largest number of threads; more only cost memory.
const MOST_THREADS: usize = 1024;

/// An engine with the given number of threads, or one per core.
pub(crate) fn engine(threads: Option<NonZeroUsize>, kernel: Kernel) -> Result<Engine, Failure> {
    let cores = || available_parallelism().unwrap_or(NonZeroUsize::MIN);
    let threads = threads.unwrap_or_else(cores).get();
    if threads > MOST_THREADS {
        let found = format!("--threads {threads}: too many");
        return Err(Failure::with_help(found, &format!("give at most {MOST_THREADS}, or leave it out")));
    }
    Engine::new(threads, kernel).map_err(|e| Failure::plain(format!("no thread can be started: {e}")))
}

/// Threads and kernel of many runs.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct EngineArgs {
    /// Number of threads; one per core if absent
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,

    /// How runs are computed: scalar, lanes4 or lanes8; the fastest for this processor if absent. Results are the same
    #[arg(long, value_name = "KERNEL")]
    pub(crate) kernel: Option<String>,
}

impl EngineArgs {
    pub(crate) fn engine(&self) -> Result<Engine, Failure> {
        let Some(name) = &self.kernel else {
            return engine(self.threads, Kernel::best());
        };
        let found = Kernel::named(name).filter(|kernel| kernel.is_available());
        let kernel = found.ok_or_else(|| {
            Failure::with_help(
                format!("--kernel {name}: this processor has no such kernel"),
                "give scalar, or leave it out for the fastest",
            )
        })?;
        engine(self.threads, kernel)
    }
}

/// Default result folder of a study: its name without extension, in the current folder.
///
/// # Errors
/// A study without a name.
pub(crate) fn folder_of(study: &Path) -> Result<PathBuf, Failure> {
    let is_named = |name: &&OsStr| *name != "-" && study.extension().is_some();
    let nameless = || Failure::with_help("the results cannot be named after the study", "use -o FOLDER");
    study.file_stem().filter(is_named).map(PathBuf::from).ok_or_else(nameless)
}

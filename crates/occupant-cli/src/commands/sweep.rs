//! `occupant sweep`.

mod merge;
mod words;

use std::num::NonZeroUsize;
use std::ops::Range;
use std::path::{Path, PathBuf};

use clap::Subcommand;
use occupant_study::Keep;
use occupant_study::engine::Engine;

use super::flags::sweep as flags;
use crate::base::failure::{Done, Failure};
use crate::base::interrupt::Interrupt;
use crate::base::names::program;
use crate::base::talk::say;
use crate::files::study_folder::finished::Finished;
use crate::files::study_folder::folder::Folder;
use crate::files::study_folder::journal::{Journal, JournalWriter};
use crate::files::study_folder::shard::Shard;
use crate::files::study_folder::texts::Texts;
use crate::jobs::sweep::parts::{read_journal, sha256_of};
use crate::jobs::sweep::plan::Plan;
use crate::jobs::sweep::progress::Progress;
use crate::jobs::sweep::simulation::Simulation;
use crate::jobs::sweep::{kept, results};
use words::{ensembles, tell};

/// Run every sample of a study and write one table
///
/// Writes FOLDER/results.parquet: a row for each sample with its inputs, all measures of the run and how it ended. A sample
/// that fails is a row with its reason. A sweep that was interrupted or killed goes on with the same command: every finished
/// sample is kept. On several machines, each computes a part of the study into the same folder (--shard, or a Slurm job
/// array), and `occupant sweep merge FOLDER` makes the table.
#[derive(Debug, clap::Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub(crate) struct Args {
    #[command(subcommand)]
    command: Option<Step>,

    /// The study, TOML or JSON
    #[arg(value_name = "STUDY", required = true)]
    study: Option<PathBuf>,

    /// The folder of the results; made if absent
    #[arg(short, long, value_name = "FOLDER", required = true)]
    output: Option<PathBuf>,

    /// Change a value in all samples, such as --set time.end='250 ms'; may be repeated
    #[arg(long = "set", value_name = "PATH.TO.KEY=VALUE")]
    overrides: Vec<String>,

    /// Number of threads; one for each core if absent
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,

    /// How runs are computed: scalar, lanes4 or lanes8, the fastest of this processor if absent; all give the same bits
    #[arg(long, value_name = "KERNEL")]
    kernel: Option<String>,

    /// Compute one part of the study only, such as 3/8; else OCCUPANT_SHARD says which, else the Slurm job array that this
    /// is a task of
    #[arg(long, value_name = "I/N")]
    shard: Option<String>,

    /// Write whole runs as runs/NUMBER.mcap instead of those that the study says: all, none, '3, 17' or
    /// 'worst 5 by head.peak'
    #[arg(long, value_name = "WHICH")]
    keep: Option<String>,

    /// Write the table as results.csv too, with the units in columns.csv
    #[arg(long)]
    csv: bool,

    /// Remove the results that the folder holds and begin anew
    #[arg(long)]
    restart: bool,

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
    match (&args.command, &args.study, &args.output) {
        (Some(Step::Merge(args)), _, _) => merge::merge(args),
        (None, Some(study), Some(output)) => Sweep::open(args, study, output)?.go(args),
        (None, _, _) => Err(Failure::plain("a sweep needs a study and -o FOLDER")),
    }
}

/// A sweep in its folder.
struct Sweep {
    plan: Plan,
    folder: Folder,
    shard: Shard,
    keep: Keep,
    csv: bool,
    engine: Engine,
    interrupt: Interrupt,
}

impl Sweep {
    fn open(args: &Args, study: &Path, output: &Path) -> Result<Self, Failure> {
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
            if !plan.warnings.is_empty() {
                say(&format!("{}\n", plan.warnings));
            }
            if let Some(variable) = told_by {
                say(&format!("shard {shard}, as {variable} says"));
            }
        }
        Ok(Sweep {
            csv: args.csv || (plan.study().csv() && shard.is_whole()),
            folder: Folder::at(output),
            engine: flags::engine(args.threads, flags::kernel(args.kernel.as_deref())?)?,
            interrupt: Interrupt::listen_for("stopping; once more to stop at once"),
            plan,
            shard,
            keep,
        })
    }

    fn go(&self, args: &Args) -> Result<Done, Failure> {
        let Sweep { plan, folder, .. } = self;
        let manifest = &plan.manifest;
        let held = folder.claim(manifest, &plan.texts, self.shard, args.restart)?;
        if let (Some(reason), false) = (&held.unlocked, args.quiet) {
            say(&format!(
                "warning: this file system has no locks ({reason}): nothing but you keeps two processes from computing the same shard"
            ));
        }
        kept::prepare(&self.keep, folder)?;
        let samples = self.shard.range(manifest.samples);
        let sha256 = sha256_of(manifest)?;
        let journal = read_journal(std::slice::from_ref(folder), &sha256, manifest)?;
        let progress = self.compute(&journal.finished, &samples, &sha256, args.quiet)?;
        let journal = read_journal(std::slice::from_ref(folder), &sha256, manifest)?;
        let wanted = kept::wanted(&self.keep, samples.clone());
        let lacking = kept::missing(folder, &journal, wanted)?;
        self.write_kept(&lacking)?;
        if self.shard.is_whole() {
            return self.finish(&journal, &progress, args.quiet);
        }
        if !args.quiet {
            say(&format!(
                "shard {}: all {} samples are there, {} of them computed now; `occupant sweep merge {}` makes the table when all shards are",
                self.shard,
                samples.end - samples.start,
                progress.computed(),
                folder.path().display()
            ));
        }
        Ok(Done::Well)
    }

    /// Computes what is not finished.
    fn compute(
        &self,
        finished: &Finished,
        samples: &Range<u64>,
        sha256: &str,
        quiet: bool,
    ) -> Result<Progress, Failure> {
        let before = finished.count(samples.clone());
        let count = samples.end - samples.start;
        if before > 0 && before < count && !quiet {
            say(&format!("going on: {before} of {count} samples are there"));
        }
        let mut progress = Progress::new(count, before, quiet);
        let mut journal = JournalWriter::new(&self.folder, sha256, self.shard)?;
        let simulation = Simulation { plan: &self.plan, keep: &self.keep, folder: &self.folder };
        let missing = samples.clone().filter(|index| !finished.has(*index));
        let ended = self.engine.run(&simulation, missing, self.interrupt.flag(), |row| {
            journal.append(&row)?;
            progress.see(&row);
            Ok(())
        });
        progress.end();
        let ended = ended.and_then(|()| Ok(journal.close()?));
        let done = before + progress.computed();
        let kept = format!("{done} of {count} samples are finished and kept; the same command goes on from there");
        ended.map_err(|failure| failure.with_done(&kept))?;
        self.refuse_interrupted(&kept)?;
        Ok(progress)
    }

    /// Writes whole runs of finished samples.
    fn write_kept(&self, samples: &[u64]) -> Result<(), Failure> {
        kept::write(&self.plan, &self.folder, samples, &self.engine, self.interrupt.flag())?;
        self.refuse_interrupted("all samples are finished; the same command goes on from there")
    }

    fn refuse_interrupted(&self, done: &str) -> Result<(), Failure> {
        if self.interrupt.is_asked() {
            return Err(Failure::BrokeOff("error: interrupted".to_owned()).with_done(done));
        }
        Ok(())
    }

    /// The table, and the worst.
    fn finish(&self, journal: &Journal, progress: &Progress, quiet: bool) -> Result<Done, Failure> {
        let manifest = &self.plan.manifest;
        let (census, files) = results::write(&self.folder, journal, manifest, &self.keep, self.csv)?;
        let lacking = kept::missing(&self.folder, journal, census.worst())?;
        self.write_kept(&lacking)?;
        let ensembles = ensembles(&self.folder, manifest, self.csv)?;
        if quiet {
            return Ok(Done::Well);
        }
        let work = format!(
            "{} samples in {:.1} s, {} threads",
            progress.computed(),
            progress.elapsed_s(),
            self.engine.threads()
        );
        tell(&census, &files, Some(work), ensembles.as_ref())
    }
}

//! `occupant sweep` and `occupant sweep merge`.

use std::num::NonZeroUsize;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::thread;

use clap::Subcommand;
use occupant_core::lanes::Kernel;
use occupant_core::study::Keep;

use super::exit::{Done, Failure};
use super::interrupt::Interrupt;
use super::run::program;
use super::speak::{self, say};
use super::table::facts;
use crate::ensemble::of_table::{self, Ensembles};
use crate::ensemble::text::of_study;
use crate::sweep::census::Census;
use crate::sweep::engine::{self, Job};
use crate::sweep::finished::Finished;
use crate::sweep::folder::Folder;
use crate::sweep::journal::{Journal, JournalWriter};
use crate::sweep::manifest::{Manifest, Role};
use crate::sweep::plan::{NoPlan, Plan};
use crate::sweep::problem::Problem;
use crate::sweep::progress::Progress;
use crate::sweep::shard::Shard;
use crate::sweep::simulation::Simulation;
use crate::sweep::texts::Texts;
use crate::sweep::{kept, results};

/// Run every sample of a study and write one table
///
/// Writes FOLDER/results.parquet: a row for each sample with its inputs, all measures of the run and how it ended. A sample
/// that fails is a row with its reason. A sweep that was interrupted or killed goes on with the same command: every finished
/// sample is kept. On several machines, each computes a part of the study into the same folder (--shard, or a Slurm job
/// array), and `occupant sweep merge FOLDER` makes the table.
#[derive(Debug, clap::Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct Args {
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
    Merge(MergeArgs),
}

/// Make one table of a sweep's shards
///
/// Says which samples are missing, if any are.
#[derive(Debug, clap::Args)]
struct MergeArgs {
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

/// Runs a sweep, or merges one.
pub fn sweep(args: &Args) -> Result<Done, Failure> {
    match (&args.command, &args.study, &args.output) {
        (Some(Step::Merge(merge_args)), _, _) => merge(merge_args),
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
    threads: usize,
    interrupt: Interrupt,
}

impl Sweep {
    fn open(args: &Args, study: &Path, output: &Path) -> Result<Self, Failure> {
        let (shard, told_by) = shard(args)?;
        let texts = Texts::of_files(study);
        let plan = Plan::open(study, &args.overrides, &texts, program()).map_err(no_plan)?;
        let keep = keep(args.keep.as_deref(), &plan)?;
        if args.restart && !shard.is_whole() {
            return Err(Failure::with_help(
                "--restart of one shard would remove the results of the others",
                "remove the folder before the first shard begins",
            ));
        }
        if args.csv && !shard.is_whole() {
            return Err(Failure::with_help(
                "a shard writes no table",
                "give --csv to `occupant sweep merge`",
            ));
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
            threads: threads(args.threads),
            interrupt: Interrupt::listen_for("stopping; once more to stop at once"),
            plan,
            shard,
            keep,
        })
    }

    fn go(&self, args: &Args) -> Result<Done, Failure> {
        let Sweep { plan, folder, .. } = self;
        let manifest = &plan.manifest;
        let held = folder.claim(manifest, &plan.texts, self.shard, args.restart);
        let held = held.map_err(told)?;
        if let (Some(reason), false) = (&held.unlocked, args.quiet) {
            say(&format!(
                "warning: this file system has no locks ({reason}): nothing but you keeps two processes from computing the same shard"
            ));
        }
        kept::prepare(&self.keep, folder).map_err(told)?;
        let samples = self.shard.range(manifest.samples);
        let sha256 = sha256_of(manifest)?;
        let journal = read_journal(std::slice::from_ref(folder), &sha256, manifest)?;
        let progress = self.compute(&journal.finished, &samples, &sha256, args.quiet)?;
        let lacking = kept::missing(folder, kept::wanted(&self.keep, samples.clone()));
        kept::write(plan, folder, &lacking, self.threads, self.interrupt.flag())?;
        self.refuse_interrupted()?;
        if !self.shard.is_whole() {
            if !args.quiet {
                say(&format!(
                    "shard {}: all {} samples are there, {} of them computed now; `occupant sweep merge {}` makes the table when all shards are",
                    self.shard,
                    samples.end - samples.start,
                    progress.computed(),
                    folder.path().display()
                ));
            }
            return Ok(Done::Well);
        }
        let journal = read_journal(std::slice::from_ref(folder), &sha256, manifest)?;
        self.finish(&journal, &progress, args.quiet)
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
        let mut journal = JournalWriter::new(&self.folder, sha256, self.shard).map_err(told)?;
        let simulation = Simulation {
            plan: &self.plan,
            keep: &self.keep,
            folder: &self.folder,
            stop: self.interrupt.flag(),
            kernel: Kernel::best(),
        };
        let job = Job {
            samples,
            finished,
            threads: self.threads,
            stop: self.interrupt.flag(),
        };
        let ended = engine::run(job, &simulation, &mut |row| {
            journal.append(&row).map_err(told)?;
            progress.see(&row);
            Ok(())
        });
        progress.end();
        let ended = ended.and_then(|()| journal.close().map_err(told));
        let done = before + progress.computed();
        ended.map_err(|failure| {
            failure.with_done(&format!(
                "{done} of {count} samples are finished and kept; the same command goes on from there"
            ))
        })?;
        match self.interrupt.is_asked() {
            true => Err(Failure::BrokeOff(format!(
                "error: interrupted\n = done: {done} of {count} samples are finished and kept; the same command goes on from there"
            ))),
            false => Ok(progress),
        }
    }

    fn refuse_interrupted(&self) -> Result<(), Failure> {
        match self.interrupt.is_asked() {
            true => Err(Failure::BrokeOff(
                "error: interrupted\n = done: all samples are finished; the same command goes on from there"
                    .to_owned(),
            )),
            false => Ok(()),
        }
    }

    /// The table, and the worst.
    fn finish(&self, journal: &Journal, progress: &Progress, quiet: bool) -> Result<Done, Failure> {
        let manifest = &self.plan.manifest;
        let (census, files) =
            results::write(&self.folder, journal, manifest, &self.keep, self.csv).map_err(told)?;
        let lacking = kept::missing(&self.folder, census.worst().into_iter());
        kept::write(
            &self.plan,
            &self.folder,
            &lacking,
            self.threads,
            self.interrupt.flag(),
        )?;
        self.refuse_interrupted()?;
        let ensembles = ensembles(&self.folder, manifest, self.csv)?;
        if quiet {
            return Ok(Done::Well);
        }
        let work = format!(
            "{} samples in {:.1} s, {} threads",
            progress.computed(),
            progress.elapsed_s(),
            self.threads
        );
        tell(&census, &files, Some(work), ensembles.as_ref())
    }
}

/// Makes one table of shards.
fn merge(args: &MergeArgs) -> Result<Done, Failure> {
    let folders: Vec<Folder> = args.folders.iter().map(|f| Folder::at(f)).collect();
    let manifest = common_manifest(&folders)?;
    let journal = read_journal(&folders, &sha256_of(&manifest)?, &manifest)?;
    let gaps = journal.finished.gaps(0..manifest.samples);
    if !gaps.is_empty() {
        let shards = journal.lacking(manifest.samples);
        return Err(told(Problem::Incomplete {
            gaps,
            samples: manifest.samples,
            shards,
        }));
    }
    let target = match (&args.output, folders.first()) {
        (Some(output), _) => Folder::at(output),
        (None, Some(first)) => first.clone(),
        (None, None) => return Err(Failure::plain("no folder was given")),
    };
    std::fs::create_dir_all(target.path())
        .map_err(Problem::io("create", target.path()))
        .map_err(told)?;
    let (plan, keep) = stored_plan(args, &folders, &manifest)?;
    kept::prepare(&keep, &target).map_err(told)?;
    let csv = args.csv || plan.study().csv();
    let (census, files) = results::write(&target, &journal, &manifest, &keep, csv).map_err(told)?;
    let lacking = kept::missing(&target, census.worst().into_iter());
    let stop = AtomicBool::new(false);
    kept::write(&plan, &target, &lacking, threads(args.threads), &stop)?;
    let ensembles = ensembles(&target, &manifest, csv)?;
    match args.quiet {
        true => Ok(Done::Well),
        false => tell(&census, &files, None, ensembles.as_ref()),
    }
}

/// The plan as the first folder holds it, and what is to be kept.
fn stored_plan(
    args: &MergeArgs,
    folders: &[Folder],
    manifest: &Manifest,
) -> Result<(Plan, Keep), Failure> {
    let (Some(folder), Some(study)) = (folders.first(), manifest.texts.first()) else {
        return Err(Failure::plain("the folder holds no study"));
    };
    let texts = Texts::of_copies(folder, manifest);
    let study = Path::new(&study.name);
    let plan = Plan::open(study, &manifest.overrides, &texts, program()).map_err(no_plan)?;
    if plan.manifest != *manifest {
        return Err(told(Problem::Differs {
            folder: folder.path().to_owned(),
            differences: manifest.differences(&plan.manifest, |_| None, |_| None),
        }));
    }
    let keep = keep(args.keep.as_deref(), &plan)?;
    Ok((plan, keep))
}

/// The manifest that all folders share.
fn common_manifest(folders: &[Folder]) -> Result<Manifest, Failure> {
    let mut common: Option<(&Folder, Manifest)> = None;
    for folder in folders {
        let found = folder.manifest().map_err(told)?;
        let shown = folder.path().display();
        let found = found.ok_or_else(|| {
            Failure::with_help(
                format!("{shown} holds no sweep"),
                "give the folder that `occupant sweep STUDY -o FOLDER` has written",
            )
        })?;
        match &common {
            None => common = Some((folder, found)),
            Some((_, first)) if *first == found => {}
            Some((there, first)) => {
                let text = |f: &Folder, t: &crate::sweep::manifest::Text| f.copy_of(t).ok();
                let lines = first.differences(&found, |t| text(there, t), |t| text(folder, t));
                return Err(Failure::plain(format!(
                    "{} and {shown} hold parts of different sweeps:\n   {}",
                    there.path().display(),
                    lines.join("\n   ")
                )));
            }
        }
    }
    let common = common.map(|(_, manifest)| manifest);
    common.ok_or_else(|| Failure::plain("no folder was given"))
}

/// The part to compute, and the variable that says so.
fn shard(args: &Args) -> Result<(Shard, Option<&'static str>), Failure> {
    let refused = |found: String| {
        Failure::with_help(
            found,
            "--shard 1/1 computes everything, whatever the environment says",
        )
    };
    if let Some(text) = &args.shard {
        let shard = Shard::parse(text).map_err(|e| refused(format!("--shard: {e}")))?;
        return Ok((shard, None));
    }
    let told = Shard::from_environment(|name| std::env::var(name).ok()).map_err(refused)?;
    Ok(match told {
        Some((shard, variable)) => (shard, Some(variable)),
        None => (Shard::WHOLE, None),
    })
}

/// Which runs to write: as the command line says, or else the study.
fn keep(given: Option<&str>, plan: &Plan) -> Result<Keep, Failure> {
    let keep = match given {
        Some(text) => kept::parse(text).ok_or_else(|| {
            Failure::with_help(
                format!("--keep {text}: it does not say which runs to write"),
                "give all, none, numbers of samples such as '3, 17', or 'worst 5 by head.peak'",
            )
        })?,
        None => plan.study().keep().clone(),
    };
    let manifest = &plan.manifest;
    match &keep {
        Keep::Indices(numbers) => match numbers.iter().find(|n| **n >= manifest.samples) {
            Some(number) => Err(Failure::plain(format!(
                "keep: there is no sample {number}; the study has {}, counted from 0",
                manifest.samples
            ))),
            None => Ok(keep),
        },
        Keep::Worst { measure, .. } => {
            let figures = manifest.columns.iter().filter(|c| c.role == Role::Figure);
            let names: Vec<&str> = figures.map(|c| c.name.as_str()).collect();
            match names.contains(&measure.as_str()) {
                true => Ok(keep),
                false => Err(Failure::with_help(
                    format!("keep: no measure is named `{measure}`"),
                    &format!("the measures are {}", names.join(", ")),
                )),
            }
        }
        Keep::All | Keep::None => Ok(keep),
    }
}

fn threads(given: Option<NonZeroUsize>) -> usize {
    let cores = || thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
    given.unwrap_or_else(cores).get()
}

fn read_journal(folders: &[Folder], sha256: &str, manifest: &Manifest) -> Result<Journal, Failure> {
    Journal::read(folders, sha256, manifest.samples).map_err(told)
}

fn sha256_of(manifest: &Manifest) -> Result<String, Failure> {
    let sha256 = manifest.sha256();
    sha256.map_err(|error| Failure::plain(format!("the manifest cannot be written: {error}")))
}

/// What is stable, where the study has ensembles.
fn ensembles(
    folder: &Folder,
    manifest: &Manifest,
    csv: bool,
) -> Result<Option<Ensembles>, Failure> {
    if !of_table::has_ensembles(manifest) {
        return Ok(None);
    }
    let found = of_table::write(&folder.parquet(), manifest, csv);
    found
        .map(Some)
        .map_err(|reason| Failure::BrokeOff(format!("error: {reason}")))
}

/// What it came to.
fn tell(
    census: &Census,
    files: &[PathBuf],
    work: Option<String>,
    ensembles: Option<&Ensembles>,
) -> Result<Done, Failure> {
    let mut ended = vec![format!("{} completed", census.completed)];
    for (count, word) in [
        (census.failed, "failed"),
        (census.refused, "refused"),
        (census.broken, "on which the program broke off"),
    ] {
        if count > 0 {
            ended.push(format!("{count} {word}"));
        }
    }
    let mut lines = vec![("samples", ended.join(", "))];
    for (index, reason) in &census.reasons {
        lines.push(("", format!("{index}: {reason}")));
    }
    if census.unbalanced > 0 {
        let found =
            "samples whose energy balance is off by more than 10 %: their figures mean nothing";
        lines.push(("doubtful", format!("{} {found}", census.unbalanced)));
    }
    lines.extend(work.map(|work| ("computed", work)));
    let more = ensembles.iter().flat_map(|e| &e.files);
    let names: Vec<String> = files
        .iter()
        .chain(more)
        .map(|f| f.display().to_string())
        .collect();
    lines.push(("written", names.join(", ")));
    let stable = ensembles.map(|e| format!("\n{}", of_study(e)));
    speak::print(&(facts(&lines) + &stable.unwrap_or_default()))?;
    Ok(Done::Well)
}

fn no_plan(reason: NoPlan) -> Failure {
    match reason.0.starts_with("error") {
        true => Failure::CouldNotRun(reason.0),
        false => Failure::plain(reason.0),
    }
}

/// A problem of the folder, in words.
fn told(problem: Problem) -> Failure {
    let help = problem.help();
    let broke_off = matches!(
        problem,
        Problem::Io { doing: "write", .. } | Problem::Table { .. } | Problem::Incomplete { .. }
    );
    let help = help.map(|h| format!("\n = help: {h}")).unwrap_or_default();
    let message = format!("error: {problem}{help}");
    match broke_off {
        true => Failure::BrokeOff(message),
        false => Failure::CouldNotRun(message),
    }
}

//! `occupant run`.

use std::path::{Path, PathBuf};
use std::time::Instant;

use occupant_core::diagnosis::{FrictionWatch, UnstableFriction};
use occupant_core::scenario::Diagnostics;
use occupant_core::simulate::{Status, simulate};
use occupant_core::summary::{RunStatus, Summarizer, Summary};
use serde::Serialize;

use super::exit::{Done, Failure};
use super::interrupt::Interrupt;
use super::output_file::Existing;
use super::progress::Progress;
use super::recording::{Recording, Written};
use super::scenario::{self, Opened, ScenarioArgs};
use super::speak::{self, say};
use super::summary_table::summary_table;

/// Simulate the occupant and write what happened
///
/// Writes an MCAP file (by default SCENARIO.mcap in the present folder) and ends with a short table. While the run goes
/// on, and if it does not complete, the file is called SCENARIO.partial.mcap.
#[derive(Debug, clap::Args)]
pub struct Args {
    #[command(flatten)]
    scenario: ScenarioArgs,

    /// The file to write
    #[arg(short, long, value_name = "FILE.mcap")]
    output: Option<PathBuf>,

    /// Write no file, only the summary
    #[arg(long, conflicts_with_all = ["output", "force"])]
    no_mcap: bool,

    /// Replace files that exist
    #[arg(short, long)]
    force: bool,

    /// Print the summary as JSON instead of a table
    #[arg(long)]
    json: bool,

    /// No table, no warnings, no progress bar; errors and --json remain
    #[arg(short, long)]
    quiet: bool,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Answer<'a> {
    program: String,
    scenario: String,
    overrides: &'a [String],
    /// The file written; absent with `--no-mcap`.
    file: Option<String>,
    #[serde(flatten)]
    summary: &'a Summary,
    unstable_friction: Vec<UnstableFriction>,
    warnings: Vec<String>,
}

/// Runs a scenario.
pub fn run(args: &Args) -> Result<Done, Failure> {
    let opened = scenario::open(&args.scenario)?;
    if !args.quiet && !opened.warnings.is_empty() {
        say(&format!("{}\n", opened.warnings));
    }
    let mut recording = match output_name(args)? {
        Some(name) => Recording::begin(&name, existing(args), &args.scenario, &opened)?,
        None => Recording::none(),
    };
    let mut summarizer = Summarizer::new();
    let mut friction = FrictionWatch::new();
    let watchers = (Interrupt::listen(), Progress::new(args.quiet));
    let keepers = (&mut summarizer, (&mut friction, &mut recording));
    let began = Instant::now();
    let ended = simulate(&opened.model, (watchers, keepers));
    let outcome = ended.map_err(|error| {
        let left = recording.left();
        Failure::BrokeOff(format!("error: {error}{left}"))
    })?;
    let wall_time_s = began.elapsed().as_secs_f64();
    let completed = outcome.status == Status::Completed;
    let written = recording.close(completed)?;
    let summary = summarizer.summary(Some(wall_time_s));
    let summary = summary.ok_or_else(|| Failure::plain("the run left no summary"))?;
    tell(args, &opened, &summary, &friction, &written)?;
    match completed {
        true => Ok(Done::Well),
        false => Err(Failure::BrokeOff(broke_off(&summary, &written))),
    }
}

/// The file to write: as given, or the scenario's name in the present folder.
fn output_name(args: &Args) -> Result<Option<PathBuf>, Failure> {
    if args.no_mcap {
        return Ok(None);
    }
    if let Some(name) = &args.output {
        return Ok(Some(name.clone()));
    }
    let stem = args.scenario.scenario.file_stem().map(Path::new);
    let stem = stem.ok_or_else(|| {
        Failure::with_help(
            "the scenario's name gives no name to its results",
            "use -o FILE.mcap",
        )
    })?;
    let mut name = stem.as_os_str().to_owned();
    name.push(".mcap");
    Ok(Some(PathBuf::from(name)))
}

fn existing(args: &Args) -> Existing {
    match args.force {
        true => Existing::Replace,
        false => Existing::Keep,
    }
}

/// Prints the results, and what to know of them.
fn tell(
    args: &Args,
    opened: &Opened,
    summary: &Summary,
    friction: &FrictionWatch,
    written: &Written,
) -> Result<(), Failure> {
    // the forces of a run that has failed say nothing about its friction
    let unstable = match summary.status {
        RunStatus::Failed => Diagnostics::new(),
        _ => opened.loaded.diagnose(&friction.warnings(&opened.model)),
    };
    if !args.quiet && !unstable.is_empty() {
        say(&format!("{unstable}\n"));
    }
    if args.json {
        let warnings = opened.warnings.iter().chain(unstable.iter());
        let answer = Answer {
            program: program(),
            scenario: args.scenario.scenario.display().to_string(),
            overrides: &args.scenario.overrides,
            file: written.name(),
            summary,
            unstable_friction: friction.found(&opened.model),
            warnings: warnings.map(ToString::to_string).collect(),
        };
        return speak::print(&speak::json(&answer)?);
    }
    if args.quiet {
        return Ok(());
    }
    speak::print(&summary_table(summary, written))
}

/// Name and version of this program.
pub fn program() -> String {
    format!("occupant {}", env!("CARGO_PKG_VERSION"))
}

fn broke_off(summary: &Summary, written: &Written) -> String {
    let reason = summary.reason.as_deref().unwrap_or("it did not complete");
    let reached = format!(
        "{:.1} ms of {:.1} ms",
        (summary.reached_s - summary.start_s) * 1e3,
        (summary.end_s - summary.start_s) * 1e3
    );
    let file = match written {
        Written::Partial(path) => format!(
            "; these are in {}, which says that it is partial",
            path.display()
        ),
        _ => String::new(),
    };
    format!("error: the run was not completed: {reason}\n = done: {reached}{file}")
}

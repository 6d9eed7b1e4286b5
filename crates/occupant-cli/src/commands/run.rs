//! `occupant run`.

use std::path::{Path, PathBuf};
use std::time::Instant;

use occupant_core::diagnosis::{FrictionWatch, UnstableFriction};
use occupant_core::results::channel::Series;
use occupant_core::results::outcome::{ResumeError, Status};
use occupant_core::results::summary::{RunStatus, Summarizer, Summary};
use occupant_core::run::simulate::{resume, simulate};
use occupant_core::scenario::Diagnostics;
use occupant_study::ending::Balance;
use serde::Serialize;

use super::flags::ensemble::EnsembleArgs;
use super::tables::summary::{Marks, summary_table};
use crate::base::failure::{Done, Failure};
use crate::base::interrupt::Interrupt;
use crate::base::names::program;
use crate::base::output_file::Existing;
use crate::base::progress::Progress;
use crate::base::talk::{self, say};
use crate::files::scenario::{self, Opened, ScenarioArgs};
use crate::jobs::ensemble::report::Report;
use crate::jobs::ensemble::text::text as ensemble_text;
use crate::jobs::run::recording::{Recording, Written};
use crate::jobs::run::resume::{Resumed, Resumption, Retold};

/// Simulate the occupant and write what happened
///
/// Writes an MCAP file (by default SCENARIO.mcap in the present folder) and ends with a short table. While the run goes
/// on, and if it does not complete, the file is called SCENARIO.partial.mcap. With --resume it goes on from what another
/// run has left, with the same states as one run to the new end, and writes SCENARIO.resumed.mcap. With --ensemble it is
/// run many times with small changes, and the table says which of its figures are stable.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    scenario: ScenarioArgs,

    /// The file to write
    #[arg(short, long, value_name = "FILE.mcap")]
    output: Option<PathBuf>,

    /// End at this time instead of the scenario's time.end, such as 0.4 or '400 ms'
    #[arg(long, value_name = "TIME")]
    until: Option<String>,

    /// Go on from the last checkpoint of this file, of a run of the same scenario that ended, was interrupted or killed
    #[arg(long, value_name = "FILE.mcap")]
    resume: Option<PathBuf>,

    /// Write no file, only the summary
    #[arg(long, conflicts_with = "output")]
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

    #[command(flatten)]
    ensemble: EnsembleArgs,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Answer<'a> {
    program: String,
    scenario: String,
    overrides: &'a [String],
    /// What it goes on from; absent without `--resume`.
    #[serde(skip_serializing_if = "Option::is_none")]
    resumed: Option<Resumed>,
    /// The file written; absent with `--no-mcap`.
    file: Option<String>,
    #[serde(flatten)]
    summary: &'a Summary,
    unstable_friction: Vec<UnstableFriction>,
    /// Absent without `--ensemble`, and where the run itself did not complete.
    #[serde(skip_serializing_if = "Option::is_none")]
    ensemble: Option<&'a Report>,
    warnings: Vec<String>,
}

pub(crate) fn run(args: &Args) -> Result<Done, Failure> {
    let chosen = chosen(args);
    let (bytes, draft) = scenario::draft(&chosen)?;
    let opened = scenario::open_draft(&chosen, bytes, draft.clone())?;
    let existing = Existing::by(args.force);
    let ensemble = (args.ensemble).wanted(&draft, &opened, &chosen.scenario, existing)?;
    let from = args.resume.as_deref();
    let from = from.map(|f| Resumption::find(f, &opened)).transpose()?;
    if !args.quiet && !opened.warnings.is_empty() {
        say(&format!("{}\n", opened.warnings));
    }
    let mut recording = match output_name(args)? {
        Some(name) => Recording::begin(&name, existing, &chosen, &opened, from.as_ref())?,
        None => Recording::none(),
    };
    if let (Some(from), false) = (&from, args.quiet) {
        from.announce();
    }
    let mut summarizer = Summarizer::new();
    let mut friction = FrictionWatch::new();
    let followed = ensemble.as_ref().map(|e| e.channels.clone());
    let mut histories = Series::new(followed.unwrap_or_default());
    let interrupt = Interrupt::listen();
    let watchers = (interrupt.clone(), Progress::new(args.quiet));
    let told = Retold {
        earlier: from.as_ref().map(|f| f.earlier.clone()).unwrap_or_default(),
        to: (&mut summarizer, &mut friction),
    };
    let recorders = (watchers, (told, (&mut histories, &mut recording)));
    let began = Instant::now();
    let ended = match &from {
        Some(from) => resume(&opened.model, &from.checkpoint, recorders),
        None => simulate(&opened.model, recorders).map_err(ResumeError::Recording),
    };
    let outcome = ended.map_err(|error| {
        let left = recording.left();
        Failure::BrokeOff(format!("error: {error}{left}"))
    })?;
    let wall_time_s = began.elapsed().as_secs_f64();
    let completed = outcome.status == Status::Completed;
    let written = recording.close(completed)?;
    let summary = summarizer.summary(Some(wall_time_s));
    let summary = summary.ok_or_else(|| Failure::plain("the run left no summary"))?;
    let energy = Balance::of(summary.energy.balance_error);
    let ran = match ensemble {
        Some(wanted) if completed && energy != Balance::Lost => {
            let left = written.left();
            let ran = wanted.run(&opened, &summary, histories, &interrupt, args.quiet);
            Some(ran.map_err(|failure| failure.with_done(&left))?)
        }
        _ => None,
    };
    let answer = Answer {
        program: program(),
        scenario: chosen.scenario.display().to_string(),
        overrides: &chosen.overrides,
        resumed: from.as_ref().map(Resumption::describe),
        file: written.name(),
        summary: &summary,
        unstable_friction: friction.found(&opened.model),
        ensemble: ran.as_ref(),
        warnings: Vec::new(),
    };
    tell(args, &opened, answer, &friction, &written, ran.as_ref())?;
    if !args.quiet || energy == Balance::Lost {
        tell_balance(energy, &summary);
    }
    match completed {
        true if energy == Balance::Lost => Ok(Done::Unwell),
        true => Ok(Done::Well),
        false => Err(Failure::BrokeOff(broke_off(&summary, &written))),
    }
}

fn tell_balance(balance: Balance, summary: &Summary) {
    let percent = 100.0 * summary.energy.balance_error.abs();
    let (word, means) = match balance {
        Balance::Kept => return,
        Balance::Doubtful => ("warning", "the figures are doubtful"),
        Balance::Lost => ("error", "the figures mean nothing"),
    };
    say(&format!(
        "{word}: the energy balance is off by {percent:.1} %: {means}\n = help: a smaller step or tolerance; `occupant check` shows the fastest time scale"
    ));
}

/// The scenario with its end as `--until` has it.
fn chosen(args: &Args) -> ScenarioArgs {
    let mut chosen = args.scenario.clone();
    let until = args.until.as_ref().map(|time| format!("time.end={time}"));
    chosen.overrides.extend(until);
    chosen
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
    let stem =
        stem.ok_or_else(|| Failure::with_help("the scenario's name gives no name to its results", "use -o FILE.mcap"))?;
    let mut name = stem.as_os_str().to_owned();
    name.push(match args.resume {
        Some(_) => ".resumed.mcap",
        None => ".mcap",
    });
    Ok(Some(PathBuf::from(name)))
}

/// Prints the results, and what to know of them.
fn tell(
    args: &Args,
    opened: &Opened,
    mut answer: Answer<'_>,
    friction: &FrictionWatch,
    written: &Written,
    ran: Option<&Report>,
) -> Result<(), Failure> {
    // the forces of a run that has failed say nothing about its friction
    let unstable = match answer.summary.status {
        RunStatus::Failed => Diagnostics::new(),
        _ => opened.loaded.diagnose(&friction.warnings(&opened.model)),
    };
    if !args.quiet && !unstable.is_empty() {
        say(&format!("{unstable}\n"));
    }
    if args.json {
        let warnings = opened.warnings.iter().chain(unstable.iter());
        answer.warnings = warnings.map(ToString::to_string).collect();
        return talk::print(&talk::json(&answer)?);
    }
    if args.quiet {
        return Ok(());
    }
    let Some(ran) = ran else {
        return talk::print(&summary_table(answer.summary, written, &Marks::none()));
    };
    let marks = Marks::of(ran.unstable());
    let summary = summary_table(answer.summary, written, &marks);
    let files: String = ran.files.iter().map(|f| format!("written   {f}\n")).collect();
    talk::print(&format!("{summary}\n{}{files}", ensemble_text(ran)))
}

fn broke_off(summary: &Summary, written: &Written) -> String {
    let reason = summary.reason.as_deref().unwrap_or("it did not complete");
    let reached = format!(
        "{:.1} ms of {:.1} ms",
        (summary.reached_s - summary.start_s) * 1e3,
        (summary.end_s - summary.start_s) * 1e3
    );
    let file = match written {
        Written::Partial(path) => format!("; these are in {}, which says that it is partial", path.display()),
        _ => String::new(),
    };
    format!("error: the run was not completed: {reason}\n = done: {reached}{file}")
}

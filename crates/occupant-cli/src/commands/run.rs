//! `occupant run`.

use std::path::{Path, PathBuf};

use occupant_core::diagnosis::{UnstableFriction, diagnose};
use occupant_core::model::setup::Integrator;
use occupant_core::results::summary::{Caveat, RunStatus, Summary};
use occupant_scenario::Diagnostics;
use occupant_scenario::ending::Balance;
use serde::Serialize;

use super::check::too_long;
use super::flags::ensemble::EnsembleArgs;
use super::tables::measures::side_by_side;
use super::tables::summary::{Marks, summary_table};
use super::{plot, report};
use crate::base::input_file::is_input;
use crate::base::progress::Progress;
use crate::base::{
    Done, Existing, Failure, Units, UnitsArg, ending, is_page, json, listen, print, program, progress, say, with_word,
};
use occupant_files::steps;
use occupant_jobs::ensemble::report::Report;
use occupant_jobs::ensemble::text::text as ensemble_text;
use occupant_jobs::files::scenario::{self, Opened, ScenarioArgs, warn_of};
use occupant_jobs::report::MOST_RUNS;
use occupant_jobs::run::earlier::is_earlier;
use occupant_jobs::run::estimate::{ErrorEstimate, estimate};
use occupant_jobs::run::recording::{Recording, Written};
use occupant_jobs::run::resume::{Resumed, Resumption};
use occupant_jobs::run::{Simulated, run as simulate};

/// Simulate a scenario
///
/// Prints a summary and writes SCENARIO.mcap into the current folder. An earlier run of the same scenario is replaced;
/// any other file only with --force. While it runs, the file is named SCENARIO.partial.mcap.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    scenario: ScenarioArgs,

    /// More scenarios: they run in turn, and their measures are printed side by side
    #[arg(value_name = "MORE", conflicts_with_all = ["resume", "json"])]
    more: Vec<PathBuf>,

    /// The file to write. With several scenarios: FILE.html, a page that compares up to four of them
    #[arg(short, long, value_name = "FILE.mcap")]
    output: Option<PathBuf>,

    /// End the run at this time instead of time.end, such as 0.4 or '400 ms'
    #[arg(long, value_name = "TIME")]
    until: Option<String>,

    /// Continue a run of the same scenario from its last checkpoint, with the same states as one uninterrupted run. Writes
    /// SCENARIO.resumed.mcap. A killed run has a checkpoint every 50 outputs
    #[arg(long, value_name = "FILE.mcap")]
    resume: Option<PathBuf>,

    /// Print the summary and write no file
    #[arg(long, conflicts_with = "output")]
    no_mcap: bool,

    /// Estimate the integration error: run again with a quarter of the step or a tenth of the tolerances, and compare
    #[arg(long, conflicts_with = "resume")]
    estimate_error: bool,

    /// Replace existing files
    #[arg(short, long)]
    force: bool,

    #[command(flatten)]
    units: UnitsArg,

    /// Print the summary as JSON, in SI units
    #[arg(long)]
    json: bool,

    /// Print no table, no warnings and no progress; errors and --json remain
    #[arg(short, long)]
    quiet: bool,

    #[command(flatten)]
    ensemble: EnsembleArgs,

    /// Whether it is one of several scenarios, whose tables are printed together.
    #[arg(skip)]
    is_one_of_several: bool,
}

/// The JSON answer.
#[derive(Serialize)]
struct Answer<'a> {
    program: String,
    scenario: String,
    overrides: &'a [String],
    /// The run it continues; absent without `--resume`.
    #[serde(skip_serializing_if = "Option::is_none")]
    resumed: Option<Resumed>,
    /// The file written; absent with `--no-mcap`.
    file: Option<String>,
    #[serde(flatten)]
    summary: &'a Summary,
    unstable_friction: Vec<UnstableFriction>,
    /// Absent without `--ensemble`, or if the run itself did not complete.
    #[serde(skip_serializing_if = "Option::is_none")]
    ensemble: Option<&'a Report>,
    /// Absent without `--estimate-error`, or if the run itself did not complete.
    #[serde(skip_serializing_if = "Option::is_none")]
    error_estimate: Option<&'a ErrorEstimate>,
    warnings: Vec<String>,
}

pub(crate) fn run(args: &Args) -> Result<Done, Failure> {
    if args.more.is_empty() { Ok(one(args)?.0) } else { several(args) }
}

/// Runs the scenarios in turn and prints their measures side by side.
fn several(args: &Args) -> Result<Done, Failure> {
    let mut done = Done::Well;
    let mut runs: Vec<(PathBuf, Summary, Units)> = Vec::new();
    let scenarios = std::iter::once(&args.scenario.scenario).chain(&args.more);
    let of = |scenario: &PathBuf| ScenarioArgs { scenario: scenario.clone(), ..args.scenario.clone() };
    let all: Vec<ScenarioArgs> = scenarios.map(of).collect();
    refuse_before(args, &all)?;
    let mut files = Vec::new();
    for own in all {
        let scenario = own.scenario.clone();
        if !args.quiet {
            say(&format!("{}: running", scenario.display()));
        }
        let own = Args { scenario: own, more: Vec::new(), output: None, is_one_of_several: true, ..args.clone() };
        files.extend(output_name(&own)?);
        let ran = one(&own);
        let (ended, summary, units) = match ran {
            Ok(ran) => ran,
            Err(failure) if runs.is_empty() => return Err(failure),
            Err(failure) => return beside(&runs).and(Err(failure)),
        };
        if ended == Done::Unwell {
            done = ended;
        }
        runs.push((scenario, summary, units));
    }
    beside(&runs)?;
    if let Some(page) = &args.output {
        report::write(&files, page, (args.force, true, false), (&[], false), args.units)?;
    }
    Ok(done)
}

/// Refuses, before any run, scenarios that would fail or would replace the results of an earlier one.
fn refuse_before(args: &Args, all: &[ScenarioArgs]) -> Result<(), Failure> {
    if let Some(page) = &args.output {
        if !is_page(page) {
            return Err(Failure::with_help(
                format!("{} for {} scenarios", page.display(), all.len()),
                "with several scenarios, -o takes FILE.html, a page that compares them; each run still writes its own .mcap",
            ));
        }
        if all.len() > MOST_RUNS {
            let found = format!("{} scenarios on one page", all.len());
            return Err(Failure::with_help(found, &format!("give at most {MOST_RUNS}")));
        }
    }
    for (i, own) in all.iter().enumerate() {
        let name = own.scenario.file_stem();
        let twin = all[..i].iter().find(|other| other.scenario.file_stem() == name).filter(|_| !args.no_mcap);
        if let Some(twin) = twin {
            let found = format!("{} and {} would write the same file", twin.scenario.display(), own.scenario.display());
            return Err(Failure::with_help(found, "run them one by one with -o, or use --no-mcap"));
        }
        if !is_input(&own.scenario) {
            scenario::source(own)?;
        }
    }
    Ok(())
}

/// Prints the measures of runs side by side, in the units of the first.
fn beside(runs: &[(PathBuf, Summary, Units)]) -> Result<(), Failure> {
    let names = runs.iter().enumerate().map(|(i, (name, ..))| format!("{}   {}\n", i + 1, name.display()));
    let marks: Vec<Marks> = runs.iter().map(|(_, summary, _)| Marks::of(&summary.caveats)).collect();
    let columns = runs.iter().zip(&marks).map(|((_, summary, _), marks)| (&summary.measures[..], marks));
    let units = runs.first().map_or(Units::default(), |(.., units)| *units);
    let table = side_by_side(&columns.collect::<Vec<_>>(), units);
    let caveats = runs
        .iter()
        .enumerate()
        .flat_map(|(i, (_, s, _))| s.caveats.iter().map(move |c| format!("{}! {}\n", i + 1, c.text)));
    print(&format!("{}\n{table}\n{}", names.collect::<String>(), caveats.collect::<String>()))
}

/// End of a scenario, its summary, and the units of its tables.
fn one(args: &Args) -> Result<(Done, Summary, Units), Failure> {
    let chosen = chosen(args);
    let source = scenario::source(&chosen)?;
    let draft = source.draft.clone();
    let opened = scenario::open_source(&chosen, source)?;
    let (existing, units) = (Existing::by(args.force), args.units.or(opened.loaded.scenario.units));
    let ensemble = args.ensemble.wanted(&draft, &opened, &chosen.scenario, (existing, units))?;
    let from = args.resume.as_deref().map(|file| Resumption::find(file, &opened)).transpose()?;
    if !args.quiet {
        warn_of(&opened);
    }
    let recording = output_name(args)?.map(|name| {
        Recording::begin(&name, existing_at(args, &name, &chosen, &opened), &chosen, &opened, from.as_ref())
    });
    let recording = recording.transpose()?.unwrap_or(Recording::none());
    from.iter().filter(|_| !args.quiet).for_each(Resumption::announce);
    let channels = ensemble.as_ref().map(|e| e.channels.clone()).unwrap_or_default();
    let interrupt = listen("stopping at the next output; press Ctrl-C again to stop at once");
    let diagnosis = matches!(opened.model.setup().integrator, Integrator::Rk4 { .. }).then(|| diagnose(&opened.model));
    if let Some(message) = diagnosis.as_ref().and_then(too_long).filter(|_| !args.quiet) {
        say(&format!("warning: {message}"));
    }
    let mut run =
        simulate(&opened, from.as_ref(), recording, channels, (interrupt.clone(), Progress::new(args.quiet)))?;
    if run.completed {
        let caveats = steps::caveats(&opened.model, &run.friction, &run.summary);
        run.summary.caveats.extend(caveats);
    }
    let balance = run.summary.energy.balance;
    let histories = std::mem::take(&mut run.histories);
    let ensemble = ensemble.filter(|_| run.completed && balance != Balance::Lost);
    let ensemble =
        ensemble.map(|wanted| wanted.run(&opened, &run.summary, histories, &interrupt, progress::show(args.quiet)));
    let estimate = (args.estimate_error && run.completed && !interrupt.is_asked())
        .then(|| estimate(&opened, &run.summary, &run.head, &interrupt, progress::show(args.quiet)));
    if let Some(estimate) = estimate.as_ref().and_then(told) {
        // what may be chance is now known
        run.summary.caveats.retain(|caveat| caveat.name != Caveat::CHANCE);
        run.summary.caveats.extend(estimate.caveat(&run.summary));
    }
    if !args.is_one_of_several {
        // the run itself is told also where what was to come after it has failed
        let more = (ensemble.as_ref().and_then(told), estimate.as_ref().and_then(told));
        show(args, &chosen, &opened, from.as_ref(), &run, more)?;
    }
    draw(args, &opened, &run)?;
    let unmade = ensemble.and_then(Result::err).or(estimate.and_then(Result::err));
    unmade.map_or(Ok(()), |failure| Err(failure.with_done(&run.written.left())))?;
    if !args.quiet || balance == Balance::Lost {
        say_balance(balance, &run.summary);
    }
    if !run.completed {
        return Err(Failure::BrokeOff(broke_off(&run)));
    }
    let done = if balance == Balance::Lost { Done::Unwell } else { Done::Well };
    Ok((done, run.summary, units))
}

/// Draws the standard plots of a complete run if the plot card of its deck asks for them; earlier plots of the deck are
/// replaced.
fn draw(args: &Args, opened: &Opened, run: &Simulated) -> Result<(), Failure> {
    match (&opened.deck, &run.written) {
        (Some(deck), Written::Complete(file)) if deck.wants_plots => {
            let is_ours = args.output.is_none() && is_page_of_plots(&with_word(&file.with_extension("svg"), "-plot"));
            plot::draw_standard(file, args.force || is_ours)
        }
        _ => Ok(()),
    }
}

/// Whether a file is a sheet of plots that this program drew.
fn is_page_of_plots(path: &Path) -> bool {
    std::fs::read_to_string(path).is_ok_and(|text| text.contains("<svg") && text.contains("segment axes: X"))
}

/// The value of a result, if any.
fn told<T>(of: &Result<T, Failure>) -> Option<&T> {
    of.as_ref().ok()
}

/// Handling of an existing file: one with the default name from an earlier run of this scenario is replaced, with a
/// message.
fn existing_at(args: &Args, name: &Path, chosen: &ScenarioArgs, opened: &Opened) -> Existing {
    let unasked = args.output.is_none() && args.resume.is_none() && !args.force;
    let is_earlier = unasked && is_earlier(name, chosen, opened);
    if is_earlier {
        say(&format!("note: replacing {}, an earlier run of this scenario (use -o to keep it)", name.display()));
    }
    Existing::by(args.force || is_earlier)
}

fn say_balance(balance: Balance, summary: &Summary) {
    let word = if balance == Balance::Lost { "error" } else { "warning" };
    let help = "use a smaller step or tolerance; `occupant check` shows the fastest time scale";
    for caveat in summary.caveats.iter().filter(|caveat| caveat.name.starts_with("energy_balance")) {
        say(&format!("{word}: {}\n = help: {help}", caveat.text));
    }
}

/// The scenario with the end time of `--until`.
fn chosen(args: &Args) -> ScenarioArgs {
    let mut chosen = args.scenario.clone();
    let until = args.until.as_ref().map(|time| format!("time.end={time}"));
    chosen.overrides.extend(until);
    chosen
}

/// The file to write: as given, or the scenario's name in the current folder.
fn output_name(args: &Args) -> Result<Option<PathBuf>, Failure> {
    if args.no_mcap {
        return Ok(None);
    }
    if let Some(name) = &args.output {
        let is_ours = ending(name) == "mcap";
        return is_ours.then(|| Some(name.clone())).ok_or_else(|| Failure::ending(name, ".mcap"));
    }
    let nameless = || Failure::with_help("the results cannot be named after the scenario", "use -o FILE.mcap");
    let own = args.scenario.scenario.file_stem().filter(|_| !is_input(&args.scenario.scenario));
    let mut name = own.ok_or_else(nameless)?.to_owned();
    name.push(if args.resume.is_some() { ".resumed.mcap" } else { ".mcap" });
    Ok(Some(PathBuf::from(name)))
}

/// Prints results and caveats.
fn show(
    args: &Args,
    chosen: &ScenarioArgs,
    opened: &Opened,
    from: Option<&Resumption>,
    run: &Simulated,
    (ensemble, estimate): (Option<&Report>, Option<&ErrorEstimate>),
) -> Result<(), Failure> {
    // the forces of a run that has failed say nothing about its friction
    let unstable = match run.summary.status {
        RunStatus::Failed => Diagnostics::new(),
        _ => opened.loaded.diagnose(&run.friction.warnings(&opened.model)),
    };
    if !args.quiet {
        scenario::warn(&unstable);
    }
    if args.json {
        return print(&json(&Answer {
            program: program(),
            scenario: chosen.scenario.display().to_string(),
            overrides: &chosen.overrides,
            resumed: from.map(Resumption::describe),
            file: run.written.name(),
            summary: &run.summary,
            unstable_friction: run.friction.unstable(&opened.model),
            ensemble,
            error_estimate: estimate,
            warnings: opened.warnings.iter().chain(unstable.iter()).map(ToString::to_string).collect(),
        })?);
    }
    if args.quiet {
        return Ok(());
    }
    let units = args.units.or(opened.loaded.scenario.units);
    let error = estimate.map(|estimate| estimate.text(units)).unwrap_or_default();
    let dummies = opened.loaded.dummies();
    let Some(ensemble) = ensemble else {
        let table = summary_table(&run.summary, &run.written, &Marks::of(&run.summary.caveats), units, &dummies);
        return print(&(table + &error));
    };
    let marks = Marks::of(&run.summary.caveats).and_unstable(ensemble.unstable());
    let summary = summary_table(&run.summary, &run.written, &marks, units, &dummies);
    let files: String = ensemble.files.iter().map(|f| format!("written   {f}\n")).collect();
    print(&format!("{summary}{error}\n{}{files}", ensemble_text(ensemble, units)))
}

fn broke_off(run: &Simulated) -> String {
    let summary = &run.summary;
    let reason = summary.reason.as_deref().unwrap_or("it did not complete");
    let [reached_ms, end_ms] = [summary.reached_s, summary.end_s].map(|t| (t - summary.start_s) * 1e3);
    let file = match &run.written {
        Written::Partial(path) => format!("; they are in {}, marked as partial", path.display()),
        _ => String::new(),
    };
    format!("error: the run did not complete: {reason}\n = done: {reached_ms:.1} ms of {end_ms:.1} ms{file}")
}

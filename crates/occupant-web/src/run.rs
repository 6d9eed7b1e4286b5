//! Runs of a case.

use std::io::Cursor;
use std::path::Path;

use occupant_core::diagnosis::{FrictionWatch, UnstableFriction};
use occupant_core::model::Model;
use occupant_core::results::channel::channels;
use occupant_core::results::outcome::Status;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::{RunStatus, Summarizer, Summary};
use occupant_core::run::simulate::attempt;
use occupant_files::base::program;
use occupant_files::mcap::{McapOptions, McapRecorder};
use occupant_files::results::Results;
use occupant_files::steps;
use occupant_jobs::base::{Failure, Units};
use occupant_jobs::judged::Impact;
use occupant_jobs::report::{PageRecorder, Run, Source};
use occupant_jobs::run::recording::{about, document};
use serde::Serialize;

use crate::case::{Case, Opened, Problem, Refused, problems};

/// A run, as the page shows it.
#[derive(Serialize)]
pub struct Ran {
    program: String,
    /// As on the page of a report.
    run: Run,
    /// As the command prints it, in SI units.
    summary: Summary,
    unstable_friction: Vec<UnstableFriction>,
    warnings: Vec<Problem>,
    /// Names of all channels that can be plotted.
    channels: Vec<String>,
}

/// Tells how much of a run is done.
struct Progress<'a> {
    told: &'a mut dyn FnMut(f64),
    span_s: [f64; 2],
}

impl Recorder for Progress<'_> {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        let time = &model.setup().time;
        self.span_s = [time.start_s, time.end_s - time.start_s];
        Ok(())
    }

    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        (self.told)((sample.time_s - self.span_s[0]) / self.span_s[1]);
        Ok(Flow::Continue)
    }
}

/// Runs a case, and plots these channels before the others.
///
/// # Errors
/// All that is wrong with it; a name or pattern that fits no channel.
pub fn run(case: &Case, plotted: &[String], told: &mut dyn FnMut(f64)) -> Result<Ran, Refused> {
    let Opened { loaded, model, mut warnings } = case.open()?;
    let (mut summarizer, mut friction, mut impact) = (Summarizer::new(), FrictionWatch::new(), Impact::default());
    let mut gathered = PageRecorder::new(&model, plotted)?;
    let progress = Progress { told, span_s: [0.0, 1.0] };
    let seen = (progress, (((&mut summarizer, &mut friction), &mut impact), &mut gathered));
    let outcome = attempt(&model, seen).map_err(Failure::broke_off)?;
    let mut summary = summarizer.summary(None).ok_or_else(|| Failure::plain("the run has no summary"))?;
    impact.judge(&mut summary, &model);
    if outcome.status == Status::Completed {
        summary.caveats.extend(steps::caveats(&model, &friction, &summary));
    }
    if summary.status != RunStatus::Failed {
        warnings.extend(loaded.diagnose(&friction.warnings(&model)));
    }
    let reason = summary.reason.as_ref().map(|reason| format!("the run did not complete: {reason}"));
    let told = Source {
        label: case.name.clone(),
        notes: reason.into_iter().collect(),
        origin: origin(case),
        scenario: case.text.clone(),
        judged: loaded.dummies(),
    };
    let units = Units::of_scenario(loaded.scenario.units.unwrap_or_default());
    Ok(Ran {
        program: program(),
        run: gathered.run(&model, &summary, told, units),
        unstable_friction: friction.unstable(&model),
        summary,
        warnings: problems(&warnings),
        channels: channels(&model).into_iter().map(|channel| channel.name).collect(),
    })
}

/// A run that was saved, and its case.
#[derive(Serialize)]
pub struct Saved {
    run: Run,
    summary: Summary,
    case: Case,
}

/// The run in a result file.
///
/// # Errors
/// A file that holds no run which this program can read.
pub fn opened(name: &str, bytes: &[u8]) -> Result<Saved, Refused> {
    let results = Results::of_bytes(Path::new(name), bytes)?;
    let units = Units::of_scenario(results.loaded.scenario.units.unwrap_or_default());
    let tables = results.loaded.tables().into_iter().map(|(table, text)| (table.to_owned(), text.to_owned()));
    let set = results.run.get("overrides").map(|lines| lines.lines().map(str::to_owned).collect());
    let case = Case {
        name: results.run.get("scenario").cloned().unwrap_or_default(),
        text: results.scenario_text.clone().unwrap_or_default(),
        set: set.unwrap_or_default(),
        tables: tables.collect(),
    };
    Ok(Saved { run: Run::of(&results, &[], units)?, summary: results.summary()?, case })
}

/// What is known of a run that has no file.
fn origin(case: &Case) -> Vec<[String; 2]> {
    let mut lines = vec![["program".to_owned(), program()], ["scenario".to_owned(), case.name.clone()]];
    if !case.set.is_empty() {
        lines.push(["overrides".to_owned(), case.set.join("\n")]);
    }
    lines
}

/// The result file of a case.
///
/// # Errors
/// All that is wrong with it.
pub fn saved(case: &Case, told: &mut dyn FnMut(f64)) -> Result<Vec<u8>, Refused> {
    let Opened { loaded, model, .. } = case.open()?;
    let about = about(&case.name, case.text.as_bytes(), &case.set, &loaded)?;
    let unwritten = |e: &dyn std::fmt::Display| Failure::broke_off(format!("the file cannot be written: {e}"));
    let recorder = McapRecorder::new(Cursor::new(Vec::new()), about, McapOptions::default());
    let mut recorder = recorder.map_err(|e| unwritten(&e))?;
    for (name, text) in &case.tables {
        recorder = recorder.with_table(document(name, "text/csv", text.clone().into_bytes()));
    }
    let progress = Progress { told, span_s: [0.0, 1.0] };
    attempt(&model, (progress, &mut recorder)).map_err(|e| unwritten(&e))?;
    let bytes = recorder.into_inner().map_err(|e| unwritten(&e))?.into_inner();
    Ok(bytes)
}

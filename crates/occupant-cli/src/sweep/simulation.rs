//! One sample: scenario, model, run, figures, row.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use occupant_core::problem::Severity;
use occupant_core::recorder::{Flow, Recorder, RecorderError};
use occupant_core::sample::Sample;
use occupant_core::scenario::Diagnostics;
use occupant_core::simulate::simulate;
use occupant_core::study::Keep;
use occupant_core::summary::{RunStatus, Summarizer, Summary};

use super::engine::Worker;
use super::folder::Folder;
use super::manifest::Role;
use super::plan::Plan;
use super::row::{Cell, Row, Status};
use crate::cli::exit::Failure;
use crate::cli::output_file::Existing;
use crate::cli::recording::Recording;
use crate::cli::scenario::Opened;

/// The form of the kernel that runs samples.
const KERNEL: &str = "scalar";

/// Runs the samples of a plan.
pub struct Simulation<'a> {
    /// The plan.
    pub plan: &'a Plan,
    /// Of which samples the whole run is written.
    pub keep: &'a Keep,
    /// Where to.
    pub folder: &'a Folder,
    /// Once true, runs end at their next output and leave no row.
    pub stop: &'a AtomicBool,
}

/// Whether a keep says, beforehand, that the run of a sample is written.
pub fn is_kept(keep: &Keep, index: u64) -> bool {
    match keep {
        Keep::All => true,
        Keep::Indices(numbers) => numbers.binary_search(&index).is_ok(),
        Keep::None | Keep::Worst { .. } => false,
    }
}

impl Worker for Simulation<'_> {
    type Error = Failure;

    fn compute(&self, samples: &[u64]) -> Result<Vec<Row>, Failure> {
        let mut rows = Vec::with_capacity(samples.len());
        for index in samples {
            let began = Instant::now();
            // a defect of the program costs one sample, not the sweep
            let row = catch_unwind(AssertUnwindSafe(|| self.row(*index)));
            let row = row.unwrap_or_else(|panic| {
                let reason = format!("the program broke off: {}", words_of(&*panic));
                Ok(Some(self.without_figures(*index, Status::Broken, reason)))
            });
            rows.extend(row?.map(|row| Row {
                wall_time_s: began.elapsed().as_secs_f64(),
                ..row
            }));
        }
        Ok(rows)
    }
}

impl Simulation<'_> {
    /// The row of a sample, unless it was stopped.
    fn row(&self, index: u64) -> Result<Option<Row>, Failure> {
        let mut opened = match self.plan.open_sample(index) {
            Ok(opened) => opened,
            Err(problems) => {
                let reason = reason(&problems);
                return Ok(Some(self.without_figures(index, Status::Refused, reason)));
            }
        };
        let Some(summary) = self.run(index, &mut opened)? else {
            return Ok(None);
        };
        let status = match summary.status {
            RunStatus::Completed => Status::Completed,
            RunStatus::Failed => Status::Failed,
            RunStatus::Interrupted => return Ok(None),
        };
        let reason = summary.reason.clone().unwrap_or_default();
        let mut row = self.without_figures(index, status, reason);
        self.fill(&mut row, &summary, &opened);
        Ok(Some(row))
    }

    /// Runs a sample, and writes the run where it is kept.
    fn run(&self, index: u64, opened: &mut Opened) -> Result<Option<Summary>, Failure> {
        let mut summarizer = Summarizer::new();
        let stop = Stop(self.stop);
        let failed = |error: &dyn std::fmt::Display| {
            Failure::BrokeOff(format!("error: sample {index}: {error}"))
        };
        if !is_kept(self.keep, index) {
            simulate(&opened.model, (stop, &mut summarizer)).map_err(|e| failed(&e))?;
            return Ok(summarizer.summary(None));
        }
        let (args, bytes) = self.plan.command(index);
        opened.bytes = bytes;
        let name = self.folder.run(index);
        let mut recording = Recording::begin(&name, Existing::Replace, &args, opened, None)?;
        let outcome = simulate(&opened.model, (stop, (&mut summarizer, &mut recording)));
        outcome.map_err(|e| failed(&e))?;
        let summary = summarizer.summary(None);
        let completed = |s: &Summary| s.status == RunStatus::Completed;
        recording.close(summary.as_ref().is_some_and(completed))?;
        Ok(summary)
    }

    fn without_figures(&self, index: u64, status: Status, reason: String) -> Row {
        let mut cells = self.plan.inputs(index);
        cells.resize(self.plan.manifest.columns.len(), Cell::Absent);
        Row {
            index,
            status,
            reason,
            cells,
            wall_time_s: 0.0,
            kernel: KERNEL.to_owned(),
        }
    }

    /// Puts the figures into their columns. A run that failed has only those of its work: its peaks are those of numbers
    /// that ran away.
    fn fill(&self, row: &mut Row, summary: &Summary, opened: &Opened) {
        let figures = summary.figures(&opened.model);
        let columns = &self.plan.manifest.columns;
        let first = columns
            .iter()
            .take_while(|c| c.role != Role::Figure)
            .count();
        for (i, figure) in figures.iter().enumerate() {
            let of_work = figure.name.starts_with("solver.") || figure.name.starts_with("run.");
            if row.status != Status::Completed && !of_work {
                continue;
            }
            // a sample whose belts or spheres are others has its figures in other places
            let here = |at: &usize| columns.get(*at).is_some_and(|c| c.name == figure.name);
            let anywhere = || {
                columns
                    .iter()
                    .position(|c| c.role == Role::Figure && c.name == figure.name)
            };
            let at = Some(first + i).filter(here).or_else(anywhere);
            if let (Some(at), Some(value)) = (at, figure.value) {
                row.cells[at] = Cell::Number(value);
            }
        }
    }
}

/// Stops a run.
struct Stop<'a>(&'a AtomicBool);

impl Recorder for Stop<'_> {
    fn record(&mut self, _sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        Ok(match self.0.load(Ordering::Relaxed) {
            true => Flow::Stop,
            false => Flow::Continue,
        })
    }
}

/// All errors in one line.
fn reason(problems: &Diagnostics) -> String {
    let errors = problems
        .iter()
        .filter(|d| d.problem.severity == Severity::Error);
    let line = |d: &occupant_core::scenario::Diagnostic| {
        let p = &d.problem;
        let at = match p.path.as_str() {
            "" => String::new(),
            path => format!("{path}: "),
        };
        format!("{at}{}; expected {}", p.found, p.expected)
    };
    let lines: Vec<String> = errors.map(line).collect();
    lines.join(" | ").replace(['\n', '\r'], " ")
}

/// What a panic said.
fn words_of(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    text.unwrap_or("without a word").to_owned()
}

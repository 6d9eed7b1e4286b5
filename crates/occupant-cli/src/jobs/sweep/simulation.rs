//! One sample: scenario, model, run, figures, row.

use std::any::Any;
use std::cell::{Cell as Slot, RefCell};
use std::error::Error;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use occupant_core::model::Model;
use occupant_core::problem::Severity;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::{RunStatus, Summarizer, Summary};
use occupant_core::run::batch::{Ended, Job, Kernel, simulate_many_with};
use occupant_core::scenario::Diagnostics;
use occupant_study::Keep;

use super::engine::{HandOn, Worker};
use super::plan::Plan;
use crate::base::failure::Failure;
use crate::base::output_file::Existing;
use crate::files::study_folder::folder::Folder;
use crate::files::study_folder::manifest::Role;
use crate::files::study_folder::row::{Cell, Row, Status};
use crate::jobs::run::recording::Recording;

/// Runs the samples of a plan.
pub(crate) struct Simulation<'a> {
    pub(crate) plan: &'a Plan,
    /// Of which samples the whole run is written.
    pub(crate) keep: &'a Keep,
    pub(crate) folder: &'a Folder,
    /// Once true, runs end at their next output and leave no row.
    pub(crate) stop: &'a AtomicBool,
    /// How many runs a thread computes side by side.
    pub(crate) kernel: Kernel,
}

/// Whether a keep says, beforehand, that the run of a sample is written.
pub(crate) fn is_kept(keep: &Keep, index: u64) -> bool {
    match keep {
        Keep::All => true,
        Keep::Indices(numbers) => numbers.binary_search(&index).is_ok(),
        Keep::None | Keep::Worst { .. } => false,
    }
}

/// What runs carry: the sample, and when it was begun.
type Tag = (u64, Instant);
type Recorders<'a> = (Stop<'a>, (Summarizer, Recording));

impl Worker for Simulation<'_> {
    type Error = Failure;

    fn work(&self, next: &dyn Fn() -> Option<u64>, hand_on: HandOn<'_>) -> Result<(), Failure> {
        let under_way = RefCell::new(Vec::new());
        let taken = || next().inspect(|index| under_way.borrow_mut().push(*index));
        let done = |row: Row| {
            under_way.borrow_mut().retain(|index| *index != row.index);
            hand_on(row)
        };
        // a defect of the program costs one sample, not the sweep
        let ended = catch_unwind(AssertUnwindSafe(|| self.run(self.kernel, &taken, &done)));
        match ended {
            Ok(ended) => ended,
            Err(_) => {
                self.one_by_one(under_way.into_inner(), hand_on)?;
                self.work(next, hand_on)
            }
        }
    }
}

impl Simulation<'_> {
    /// Runs samples that were under way when the program broke off, each for itself, to find out which it was.
    fn one_by_one(&self, samples: Vec<u64>, hand_on: HandOn<'_>) -> Result<(), Failure> {
        for index in samples {
            let only = Slot::new(Some(index));
            let run = || self.run(Kernel::Scalar, &|| only.take(), hand_on);
            match catch_unwind(AssertUnwindSafe(run)) {
                Ok(ended) => ended?,
                Err(panic) => {
                    let reason = format!("the program broke off: {}", words_of(&*panic));
                    let row = self.without_figures((index, Instant::now()), Status::Broken, reason);
                    if hand_on(row).is_break() {
                        return Ok(());
                    }
                }
            }
        }
        Ok(())
    }

    /// Runs the samples that `next` gives, as many side by side as the kernel can.
    fn run(&self, kernel: Kernel, next: &dyn Fn() -> Option<u64>, hand_on: HandOn<'_>) -> Result<(), Failure> {
        let failure = RefCell::new(None);
        let broken_off = Slot::new(false);
        let jobs = std::iter::from_fn(|| {
            while !broken_off.get() {
                let begun = (next()?, Instant::now());
                match self.begin(begun) {
                    Ok(Begun::Job(job)) => return Some(*job),
                    Ok(Begun::Row(row)) => broken_off.set(hand_on(row).is_break()),
                    Err(error) => {
                        failure.replace(Some(error));
                        broken_off.set(true);
                    }
                }
            }
            None
        });
        simulate_many_with(kernel, jobs, |ended| {
            match self.end(ended) {
                Ok(None) => {}
                Ok(Some(row)) => broken_off.set(hand_on(row).is_break()),
                Err(error) => {
                    failure.replace(Some(error));
                    broken_off.set(true);
                }
            }
            match broken_off.get() {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        });
        failure.into_inner().map_or(Ok(()), Err)
    }

    /// The run of a sample, or its row where there is nothing to run.
    fn begin(&self, tag: Tag) -> Result<Begun<'_>, Failure> {
        let (index, _) = tag;
        let mut opened = match self.plan.open_sample(index) {
            Ok(opened) => opened,
            Err(problems) => {
                let row = self.without_figures(tag, Status::Refused, reason(&problems));
                return Ok(Begun::Row(row));
            }
        };
        let recording = match is_kept(self.keep, index) {
            false => Recording::none(),
            true => {
                let (args, bytes) = self.plan.command(index);
                opened.bytes = bytes;
                let name = self.folder.run(index);
                Recording::begin(&name, Existing::Replace, &args, &opened, None)?
            }
        };
        Ok(Begun::Job(Box::new(Job {
            tag,
            model: opened.model,
            recorder: (Stop(self.stop), (Summarizer::new(), recording)),
        })))
    }

    /// The row of a run that has ended, unless it was stopped.
    fn end(&self, ended: Ended<Tag, Recorders<'_>>) -> Result<Option<Row>, Failure> {
        let (index, _) = ended.tag;
        let (_, (summarizer, recording)) = ended.recorder;
        if let Err(error) = &ended.outcome {
            let reason = with_causes(error);
            return Err(Failure::BrokeOff(format!("error: sample {index}: {reason}")));
        }
        let Some(summary) = summarizer.summary(None) else {
            return Ok(None);
        };
        recording.close(summary.status == RunStatus::Completed)?;
        let status = match summary.status {
            RunStatus::Completed => Status::Completed,
            RunStatus::Failed => Status::Failed,
            RunStatus::Interrupted => return Ok(None),
        };
        let reason = summary.reason.clone().unwrap_or_default();
        let mut row = self.without_figures(ended.tag, status, reason);
        row.kernel = ended.kernel.name().to_owned();
        self.fill(&mut row, &summary, &ended.model);
        Ok(Some(row))
    }

    fn without_figures(&self, (index, begun): Tag, status: Status, reason: String) -> Row {
        let mut cells = self.plan.inputs(index);
        cells.resize(self.plan.manifest.columns.len(), Cell::Absent);
        Row { index, status, reason, cells, wall_time_s: begun.elapsed().as_secs_f64(), kernel: String::new() }
    }

    /// Puts the figures into their columns. A run that failed has only those of its work: its peaks are those of numbers
    /// that ran away.
    fn fill(&self, row: &mut Row, summary: &Summary, model: &Model) {
        let columns = &self.plan.manifest.columns;
        let first = columns.iter().take_while(|c| c.role != Role::Figure);
        let first = first.count();
        for (i, figure) in summary.figures(model).iter().enumerate() {
            let of_work = figure.name.starts_with("solver.") || figure.name.starts_with("run.");
            if row.status != Status::Completed && !of_work {
                continue;
            }
            let is_it = |at: &usize| columns.get(*at).is_some_and(|c| c.name == figure.name);
            // a sample whose belts or spheres are others has its figures in other places
            let elsewhere = || (first..columns.len()).find(is_it);
            let at = Some(first + i).filter(is_it).or_else(elsewhere);
            if let (Some(at), Some(value)) = (at, figure.value) {
                row.cells[at] = Cell::Number(value);
            }
        }
    }
}

/// A sample that was taken.
enum Begun<'a> {
    /// It can be run.
    Job(Box<Job<Tag, Recorders<'a>>>),
    /// It cannot.
    Row(Row),
}

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
    let errors = problems.iter().filter(|d| d.problem.severity == Severity::Error);
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

/// An error with what has caused it: the reason of the operating system stands last.
fn with_causes(error: &dyn Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(deeper) = cause {
        let words = deeper.to_string();
        if !text.contains(&words) {
            text.push_str(&format!(": {words}"));
        }
        cause = deeper.source();
    }
    text
}

/// What a panic said.
fn words_of(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    text.unwrap_or("without a word").to_owned()
}

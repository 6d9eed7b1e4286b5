//! Values of candidates: from the journal where it holds them, else by runs on all threads, side by side in lanes.
//!
//! An evaluation is a candidate with all experiments; evaluations are counted from 0, the base scenario, in the order in
//! which the search asks for them. Run e of evaluation i is row i·E + e of the journal. The journal is appended to when a
//! run ends; what a killed process had under way is computed again.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::time::Instant;

use occupant_core::problem::Severity;
use occupant_core::results::channel::Series;
use occupant_core::results::outcome::Status as RunEnd;
use occupant_core::run::batch::{Ended, Job as Run, Kernel, simulate_many_with};
use occupant_core::scenario::Diagnostics;
use occupant_study::search::Stage;

use super::fitting::Fitting;
use super::progress::Progress;
use crate::base::failure::Failure;
use crate::base::interrupt::Interrupt;
use crate::files::study_folder::finished::Finished;
use crate::files::study_folder::folder::Folder;
use crate::files::study_folder::journal::{Journal, JournalWriter};
use crate::files::study_folder::problem::Problem;
use crate::files::study_folder::row::{Cell, Row, Status};
use crate::files::study_folder::shard::Shard;
use crate::jobs::sweep::engine::{self, HandOn, Job, Worker};

/// The score of a candidate that could not be run: worse than any that could.
pub(crate) const WORST: f64 = 1e6;

/// What a candidate came to.
#[derive(Clone, Debug)]
pub(crate) struct Record {
    /// What it was for; none for the base scenario.
    pub(crate) stage: Option<Stage>,
    /// Where it stands between the bounds; none for the base scenario.
    pub(crate) at: Option<Vec<f64>>,
    pub(crate) score: f64,
    /// Misfit of each target, experiment by experiment; empty if it could not be run.
    pub(crate) parts: Vec<f64>,
    /// Why it could not be run.
    pub(crate) reason: Option<String>,
    /// Time that its runs took, s. It differs from fit to fit.
    pub(crate) wall_time_s: f64,
    /// What computed its last run.
    pub(crate) kernel: String,
}

/// How candidates are run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Means {
    pub(crate) threads: usize,
    /// Runs side by side.
    pub(crate) kernel: Kernel,
}

/// Evaluates candidates and remembers them.
pub(crate) struct Evaluator<'a> {
    fitting: &'a Fitting,
    means: Means,
    interrupt: &'a Interrupt,
    known: BTreeMap<u64, Row>,
    journal: JournalWriter,
    progress: Progress,
    /// All evaluations so far.
    pub(crate) records: Vec<Record>,
}

impl<'a> Evaluator<'a> {
    /// Reads what the journal holds. The lock of the folder must be held.
    ///
    /// # Errors
    /// The operating system refuses; a journal of something else.
    pub(crate) fn new(
        fitting: &'a Fitting,
        folder: &Folder,
        sha256: &str,
        means: Means,
        interrupt: &'a Interrupt,
        progress: Progress,
    ) -> Result<Self, Problem> {
        let samples = fitting.manifest.samples;
        let journal = Journal::read(std::slice::from_ref(folder), sha256, samples)?;
        let mut known = BTreeMap::new();
        let mut next = 0;
        let gaps = journal.finished.gaps(0..samples);
        for gap in gaps.into_iter().chain(std::iter::once(samples..samples)) {
            if next < gap.start {
                let rows = journal.rows(next..gap.start)?;
                known.extend(rows.into_iter().map(|row| (row.index, row)));
            }
            next = gap.end;
        }
        Ok(Evaluator {
            fitting,
            means,
            interrupt,
            known,
            journal: JournalWriter::new(folder, sha256, Shard::WHOLE)?,
            progress,
            records: Vec::new(),
        })
    }

    /// How many runs the journal held.
    pub(crate) fn known(&self) -> usize {
        self.known.len()
    }

    /// The scores of a batch of candidates; of the base scenario for `[None]`.
    ///
    /// # Errors
    /// A signal, a full disk, a journal that does not fit the search.
    pub(crate) fn scores(
        &mut self,
        stage: Option<Stage>,
        candidates: Vec<Option<Vec<f64>>>,
    ) -> Result<Vec<f64>, Failure> {
        let experiments = self.fitting.experiments.len() as u64;
        let first = self.records.len() as u64 * experiments;
        let rows = first..first + candidates.len() as u64 * experiments;
        let mut finished = Finished::none(rows.end);
        for index in self.known.range(rows.clone()).map(|(index, _)| *index) {
            finished.add(index);
        }
        let batch = Batch {
            fitting: self.fitting,
            interrupt: self.interrupt,
            kernel: self.means.kernel,
            first,
            candidates: &candidates,
        };
        if finished.count(rows.clone()) < rows.end - rows.start {
            let job =
                Job { samples: &rows, finished: &finished, threads: self.means.threads, stop: self.interrupt.flag() };
            let (journal, known) = (&mut self.journal, &mut self.known);
            engine::run(job, &batch, &mut |row| {
                journal.append(&row).map_err(super::failures::told)?;
                known.insert(row.index, row);
                Ok(())
            })?;
        }
        let before = self.records.len();
        for (i, candidate) in candidates.iter().enumerate() {
            let rows: Option<Vec<&Row>> =
                (0..experiments).map(|e| self.known.get(&(first + i as u64 * experiments + e))).collect();
            let Some(rows) = rows else {
                return Err(self.interrupted());
            };
            self.records.push(record(self.fitting, stage, candidate, &rows)?);
        }
        let new = &self.records[before..];
        self.progress.see(stage, new);
        Ok(new.iter().map(|r| r.score).collect())
    }

    fn interrupted(&self) -> Failure {
        let done = self.records.len();
        Failure::BrokeOff(format!(
            "error: interrupted\n = done: {done} evaluations are kept; the same command goes on from there"
        ))
    }

    /// Makes everything safe against a loss of power, and gives the records.
    ///
    /// # Errors
    /// The operating system refuses.
    pub(crate) fn close(self) -> Result<Vec<Record>, Problem> {
        self.progress.end();
        self.journal.close()?;
        Ok(self.records)
    }
}

/// What the rows of all experiments say of a candidate.
fn record(
    fitting: &Fitting,
    stage: Option<Stage>,
    candidate: &Option<Vec<f64>>,
    rows: &[&Row],
) -> Result<Record, Failure> {
    let mut parts = Vec::new();
    let mut reason = None;
    for row in rows {
        let coordinates = fitting.bounds.len();
        let (at, misfits) = row.cells.split_at(coordinates.min(row.cells.len()));
        let at: Vec<f64> = at.iter().filter_map(Cell::number).collect();
        let bits = |v: &[f64]| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        if bits(&at) != bits(candidate.as_deref().unwrap_or(&[])) {
            return Err(Failure::with_help(
                format!("row {} of the journal is of another candidate", row.index),
                "the journal was written by another program or on a machine that computes differently: begin anew with --restart",
            ));
        }
        parts.extend(misfits.iter().filter_map(Cell::number));
        if row.status != Status::Completed {
            reason.get_or_insert_with(|| row.reason.clone());
        }
    }
    let score = match reason {
        None => fitting.score(&parts).min(0.1 * WORST),
        Some(_) => {
            parts.clear();
            WORST
        }
    };
    Ok(Record {
        stage,
        at: candidate.clone(),
        score,
        parts,
        reason,
        wall_time_s: rows.iter().map(|r| r.wall_time_s).sum(),
        kernel: rows.last().map_or(String::new(), |r| r.kernel.clone()),
    })
}

/// Candidates under way.
struct Batch<'a> {
    fitting: &'a Fitting,
    interrupt: &'a Interrupt,
    kernel: Kernel,
    first: u64,
    candidates: &'a [Option<Vec<f64>>],
}

type Tag = (u64, Instant);
type Recorders = (Interrupt, Series);

impl Worker for Batch<'_> {
    type Error = Failure;

    fn work(&self, next: &dyn Fn() -> Option<u64>, hand_on: HandOn<'_>) -> Result<(), Failure> {
        let refused = RefCell::new(ControlFlow::Continue(()));
        let jobs = std::iter::from_fn(|| {
            while refused.borrow().is_continue() {
                let begun = (next()?, Instant::now());
                match self.begin(begun) {
                    Ok(run) => return Some(run),
                    Err(row) => *refused.borrow_mut() = hand_on(*row),
                }
            }
            None
        });
        simulate_many_with(self.kernel, jobs, |ended| match self.end(ended) {
            Some(row) => hand_on(row),
            None => ControlFlow::Break(()),
        });
        Ok(())
    }
}

impl Batch<'_> {
    fn place(&self, index: u64) -> (&Option<Vec<f64>>, usize) {
        let experiments = self.fitting.experiments.len() as u64;
        let at = index - self.first;
        let candidate = &self.candidates[(at / experiments) as usize];
        (candidate, (at % experiments) as usize)
    }

    fn begin(&self, tag: Tag) -> Result<Run<Tag, Recorders>, Box<Row>> {
        let (candidate, e) = self.place(tag.0);
        let experiment = &self.fitting.experiments[e];
        let values = candidate.as_ref().map(|at| self.fitting.values(at));
        match experiment.model_of(values.as_deref()) {
            Ok(model) => {
                Ok(Run { tag, model, recorder: (self.interrupt.clone(), Series::new(experiment.recorded.clone())) })
            }
            Err(problems) => {
                let mut row = self.row(tag, Status::Refused, reason(&problems));
                row.kernel = String::new();
                Err(Box::new(row))
            }
        }
    }

    /// The row of a run; none of one that was stopped.
    fn end(&self, ended: Ended<Tag, Recorders>) -> Option<Row> {
        let (_, e) = self.place(ended.tag.0);
        let (status, reason) = match &ended.outcome {
            Ok(outcome) => match &outcome.status {
                RunEnd::Completed => (Status::Completed, String::new()),
                RunEnd::Stopped => return None,
                RunEnd::Failed(error) => (Status::Failed, error.to_string()),
            },
            Err(error) => (Status::Failed, error.to_string()),
        };
        let mut row = self.row(ended.tag, status, reason);
        row.kernel = ended.kernel.name().to_owned();
        if status == Status::Completed {
            let (_, series) = &ended.recorder;
            match self.fitting.experiments[e].misfits(self.fitting.fit.misfit, series) {
                Ok(parts) => row.cells.extend(parts.into_iter().map(Cell::Number)),
                Err(reason) => (row.status, row.reason) = (Status::Failed, reason),
            }
        }
        Some(row)
    }

    fn row(&self, (index, begun): Tag, status: Status, reason: String) -> Row {
        let (candidate, _) = self.place(index);
        let cells = match candidate {
            Some(at) => at.iter().map(|u| Cell::Number(*u)).collect(),
            None => vec![Cell::Absent; self.fitting.bounds.len()],
        };
        Row { index, status, reason, cells, wall_time_s: begun.elapsed().as_secs_f64(), kernel: String::new() }
    }
}

/// All errors in one line.
fn reason(problems: &Diagnostics) -> String {
    let errors = problems.iter().filter(|d| d.problem.severity == Severity::Error);
    let line = |d: &occupant_core::scenario::Diagnostic| format!("{}: {}", d.problem.path, d.problem.found);
    errors.map(line).collect::<Vec<_>>().join(" | ")
}

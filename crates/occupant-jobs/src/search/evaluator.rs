//! Values of candidates: from the journal if it has them, otherwise by runs on all threads, in lanes.
//!
//! An evaluation is a candidate with all its runs; evaluations are counted from 0, the base scenario, in the order of the
//! search. Run e of evaluation i is row i·E + e of the journal. A row is appended when a run ends; runs that a
//! killed process had in progress are computed again.

use std::collections::BTreeMap;

use occupant_core::model::Model;
use occupant_scenario::ending::Ending;
use occupant_study::engine::{Engine, Finished, NotBegun, Source};
use occupant_study::search::Stage;

use super::{Objective, Progress};
use crate::base::{Failure, Interrupt};
use crate::files::study_folder::{Block, Checksums, Folder, Journal, JournalWriter, Problem, Row, Status};
use crate::sweep::words::tell_damaged;
use occupant_files::table::Cell;

/// Score of a candidate that could not be run, worse than any other.
pub const WORST: f64 = 1e6;

/// Evaluation of a candidate.
#[derive(Clone, Debug)]
pub struct Record {
    /// Its purpose; none for the base scenario.
    pub stage: Option<Stage>,
    /// Its point in the unit cube; none for the base scenario.
    pub at: Option<Vec<f64>>,
    /// Score; lower is better.
    pub score: f64,
    /// What counts of each of its runs; empty if it could not be run.
    pub parts: Vec<f64>,
    /// Caveats on that, as in the table of a sweep.
    pub caveats: String,
    /// Reason why it could not be run.
    pub reason: Option<String>,
    /// Wall time of its runs, s. It differs from fit to fit.
    pub wall_time_s: f64,
    /// Kernel of its last run.
    pub kernel: String,
}

/// Evaluates and stores candidates.
pub struct Evaluator<'a, O: Objective> {
    objective: &'a O,
    engine: &'a Engine,
    interrupt: &'a Interrupt,
    known: BTreeMap<u64, Row>,
    journal: JournalWriter,
    progress: Progress,
    /// All evaluations so far.
    pub records: Vec<Record>,
}

impl<'a, O: Objective> Evaluator<'a, O> {
    /// Reads the journal. The lock of the folder must be held.
    ///
    /// # Errors
    /// An error of the operating system; a journal of something else.
    pub fn new(
        objective: &'a O,
        (folder, sums): (&Folder, &Checksums),
        all: &Block,
        engine: &'a Engine,
        interrupt: &'a Interrupt,
        progress: Progress,
    ) -> Result<Self, Failure> {
        let manifest = objective.manifest();
        let read = || Journal::of_block(folder, manifest, all);
        let (journal, aside) = Journal::mend(folder, sums, read)?;
        tell_damaged(&aside);
        let mut known = BTreeMap::new();
        journal.each_row(|row| {
            known.insert(row.index, row);
            Ok(())
        })?;
        let progress = progress.from(known.len() as u64 / objective.runs());
        Ok(Evaluator {
            objective,
            engine,
            interrupt,
            known,
            journal: JournalWriter::new(folder, &manifest.identity(), all),
            progress,
            records: Vec::new(),
        })
    }

    /// Number of runs from the journal.
    pub fn known(&self) -> usize {
        self.known.len()
    }

    /// The base scenario, evaluated first.
    ///
    /// # Errors
    /// As [`Evaluator::scores`].
    pub fn base(&mut self) -> Result<Record, Failure> {
        self.evaluate(None, vec![None])?;
        Ok(self.records[0].clone())
    }

    /// The scores of a batch of candidates.
    ///
    /// # Errors
    /// A signal, a full disk, a journal that does not fit the search.
    pub fn scores(&mut self, stage: Stage, points: &[Vec<f64>]) -> Result<Vec<f64>, Failure> {
        self.evaluate(Some(stage), points.iter().cloned().map(Some).collect())
    }

    fn evaluate(&mut self, stage: Option<Stage>, candidates: Vec<Option<Vec<f64>>>) -> Result<Vec<f64>, Failure> {
        let runs = self.objective.runs();
        let first = self.records.len() as u64 * runs;
        let rows = first..first + candidates.len() as u64 * runs;
        let batch = Batch { objective: self.objective, first, candidates: &candidates };
        let missing: Vec<u64> = rows.filter(|index| !self.known.contains_key(index)).collect();
        let (journal, known) = (&mut self.journal, &mut self.known);
        self.engine.run(&batch, missing.into_iter(), &self.interrupt.asked, |row| {
            journal.append(&row)?;
            known.insert(row.index, row);
            Ok(())
        })?;
        let before = self.records.len();
        for (i, candidate) in candidates.iter().enumerate() {
            let rows: Option<Vec<&Row>> = (0..runs).map(|e| self.known.get(&(first + i as u64 * runs + e))).collect();
            let done = self.records.len();
            let word = self.objective.word();
            let kept = || format!("{done} evaluations are kept; run the same command again to resume the {word}");
            let rows = rows.ok_or_else(|| Interrupt::failure(&kept()))?;
            self.records.push(record(self.objective, stage, candidate, &rows)?);
        }
        let new = &self.records[before..];
        self.progress.see(stage, new, &|score| self.objective.told(score));
        Ok(new.iter().map(|r| r.score).collect())
    }

    /// The failure of a search in which no candidate could be run.
    pub fn none_could_be_run(&self) -> Failure {
        let reason = self.records.iter().rev().find_map(|r| r.reason.clone()).unwrap_or_default();
        Failure::broke_off(format!(
            "none of {} candidates could be run; the last one: {reason}\n = help: narrow the parameter ranges, and try the base scenario with `occupant run`",
            self.records.len()
        ))
    }

    /// Syncs everything to disk and returns the records.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn close(self) -> Result<Vec<Record>, Problem> {
        self.progress.end();
        self.journal.close()?;
        Ok(self.records)
    }
}

/// Evaluation of a candidate from the rows of all its runs.
fn record<O: Objective>(
    objective: &O,
    stage: Option<Stage>,
    candidate: &Option<Vec<f64>>,
    rows: &[&Row],
) -> Result<Record, Failure> {
    let mut parts = Vec::new();
    let mut reason = None;
    let mut caveats: Vec<&str> = Vec::new();
    for row in rows {
        let (at, values) = row.cells.split_at(objective.bounds().len().min(row.cells.len()));
        refuse_other(row.index, at, candidate.as_deref().unwrap_or(&[]))?;
        parts.extend(values.iter().filter_map(Cell::number));
        let new = row.caveats.split_whitespace().filter(|word| !caveats.contains(word)).collect::<Vec<_>>();
        caveats.extend(new);
        if row.status != Status::Completed {
            reason.get_or_insert_with(|| row.reason.clone());
        }
    }
    let score = match reason {
        None => {
            let of_move = candidate.as_deref().map_or(0.0, |at| objective.of_move(at));
            (objective.score(&parts, !caveats.is_empty()) + of_move).min(0.1 * WORST)
        }
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
        caveats: caveats.join(" "),
        reason,
        wall_time_s: rows.iter().map(|r| r.wall_time_s).sum(),
        kernel: rows.last().map_or(String::new(), |r| r.kernel.clone()),
    })
}

/// Refuses a row whose candidate differs from the requested one.
fn refuse_other(index: u64, found: &[Cell], asked: &[f64]) -> Result<(), Failure> {
    let found = found.iter().filter_map(Cell::number).map(f64::to_bits);
    if found.eq(asked.iter().map(|x| x.to_bits())) {
        return Ok(());
    }
    Err(Failure::with_help(
        format!("row {index} of the journal belongs to another candidate"),
        "another program version or machine wrote the journal: start again with --restart",
    ))
}

/// Candidates in progress.
struct Batch<'a, O> {
    objective: &'a O,
    first: u64,
    candidates: &'a [Option<Vec<f64>>],
}

impl<O: Objective> Batch<'_, O> {
    /// Candidate of a run, its values, and the number of the run among those of the candidate.
    fn place(&self, index: u64) -> (Option<&[f64]>, Option<Vec<f64>>, u64) {
        let runs = self.objective.runs();
        let at = index - self.first;
        let candidate = self.candidates[(at / runs) as usize].as_deref();
        (candidate, candidate.map(|at| self.objective.values(at)), at % runs)
    }
}

impl<O: Objective> Source for Batch<'_, O> {
    type Recorder = O::Recorder;
    type Row = Row;
    type Error = Failure;

    fn begin(&self, index: u64) -> Result<(Model, O::Recorder), NotBegun<Failure>> {
        let (_, values, run) = self.place(index);
        Ok(self.objective.begin(run, values.as_deref())?)
    }

    fn end(&self, run: Finished<O::Recorder>) -> Result<Row, Failure> {
        let (candidate, values, number) = self.place(run.index);
        let cells = match candidate {
            Some(at) => at.iter().map(|u| Cell::Number(*u)).collect(),
            None => vec![Cell::Absent; self.objective.bounds().len()],
        };
        let mut row = Row::of(&run, cells);
        let counts = match (run.ending, run.ran) {
            (Ending::Completed, Some(ran)) => self.objective.end(number, values.as_deref(), ran),
            // what counts of it means nothing
            (ending @ Ending::OutOfBalance(_), _) => Err(ending.reason().unwrap_or_default()),
            _ => return Ok(row),
        };
        match counts {
            Ok((parts, caveats)) => {
                row.cells.extend(parts.into_iter().map(Cell::Number));
                row.warn_of(&caveats);
            }
            Err(reason) => (row.status, row.reason) = (Status::Failed, reason),
        }
        Ok(row)
    }
}

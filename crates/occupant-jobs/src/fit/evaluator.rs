//! Values of candidates: from the journal if it has them, otherwise by runs on all threads, in lanes.
//!
//! An evaluation is a candidate with all experiments; evaluations are counted from 0, the base scenario, in the order
//! of the search. Run e of evaluation i is row i·E + e of the journal. A row is appended when a run ends; runs that a
//! killed process had in progress are computed again.

use std::collections::BTreeMap;

use occupant_core::model::Model;
use occupant_core::results::channel::Series;
use occupant_scenario::ending::Ending;
use occupant_study::engine::{Engine, Finished, NotBegun, Source};
use occupant_study::search::Stage;

use super::{Experiment, Fitting, Progress};
use crate::base::{Failure, Interrupt};
use crate::files::study_folder::{Checksums, Folder, Journal, JournalWriter, Problem, Row, Shard, Status};
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
    /// Misfit of each target by experiment; empty if it could not be run.
    pub parts: Vec<f64>,
    /// Reason why it could not be run.
    pub reason: Option<String>,
    /// Wall time of its runs, s. It differs from fit to fit.
    pub wall_time_s: f64,
    /// Kernel of its last run.
    pub kernel: String,
}

/// Evaluates and stores candidates.
pub struct Evaluator<'a> {
    fitting: &'a Fitting,
    engine: &'a Engine,
    interrupt: &'a Interrupt,
    known: BTreeMap<u64, Row>,
    journal: JournalWriter,
    progress: Progress,
    /// All evaluations so far.
    pub records: Vec<Record>,
}

impl<'a> Evaluator<'a> {
    /// Reads the journal. The lock of the folder must be held.
    ///
    /// # Errors
    /// An error of the operating system; a journal of something else.
    pub fn new(
        fitting: &'a Fitting,
        (folder, sums): (&Folder, &Checksums),
        sha256: &str,
        engine: &'a Engine,
        interrupt: &'a Interrupt,
        progress: Progress,
    ) -> Result<Self, Failure> {
        let samples = fitting.manifest.samples;
        let (journal, aside) = Journal::mend(folder, (sha256, samples), sums)?;
        tell_damaged(&aside);
        let mut known = BTreeMap::new();
        journal.each_row(|row| {
            known.insert(row.index, row);
            Ok(())
        })?;
        let progress = progress.from(known.len() as u64 / fitting.experiments.len() as u64);
        Ok(Evaluator {
            fitting,
            engine,
            interrupt,
            known,
            journal: JournalWriter::new(folder, sha256, Shard::WHOLE)?,
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
        let experiments = self.fitting.experiments.len() as u64;
        let first = self.records.len() as u64 * experiments;
        let rows = first..first + candidates.len() as u64 * experiments;
        let batch = Batch { fitting: self.fitting, first, candidates: &candidates };
        let missing: Vec<u64> = rows.filter(|index| !self.known.contains_key(index)).collect();
        let (journal, known) = (&mut self.journal, &mut self.known);
        self.engine.run(&batch, missing.into_iter(), &self.interrupt.asked, |row| {
            journal.append(&row)?;
            known.insert(row.index, row);
            Ok(())
        })?;
        let before = self.records.len();
        for (i, candidate) in candidates.iter().enumerate() {
            let rows: Option<Vec<&Row>> =
                (0..experiments).map(|e| self.known.get(&(first + i as u64 * experiments + e))).collect();
            let done = self.records.len();
            let kept = || format!("{done} evaluations are kept; run the same command again to resume the fit");
            let rows = rows.ok_or_else(|| Interrupt::failure(&kept()))?;
            self.records.push(record(self.fitting, stage, candidate, &rows)?);
        }
        let new = &self.records[before..];
        self.progress.see(stage, new);
        Ok(new.iter().map(|r| r.score).collect())
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

/// Evaluation of a candidate from the rows of all experiments.
fn record(
    fitting: &Fitting,
    stage: Option<Stage>,
    candidate: &Option<Vec<f64>>,
    rows: &[&Row],
) -> Result<Record, Failure> {
    let mut parts = Vec::new();
    let mut reason = None;
    for row in rows {
        let (at, misfits) = row.cells.split_at(fitting.bounds.len().min(row.cells.len()));
        refuse_other(row.index, at, candidate.as_deref().unwrap_or(&[]))?;
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
struct Batch<'a> {
    fitting: &'a Fitting,
    first: u64,
    candidates: &'a [Option<Vec<f64>>],
}

impl Batch<'_> {
    /// Candidate and experiment of a run.
    fn place(&self, index: u64) -> (Option<&[f64]>, &Experiment) {
        let experiments = self.fitting.experiments.len() as u64;
        let at = index - self.first;
        let candidate = &self.candidates[(at / experiments) as usize];
        (candidate.as_deref(), &self.fitting.experiments[(at % experiments) as usize])
    }
}

impl Source for Batch<'_> {
    type Recorder = Series;
    type Row = Row;
    type Error = Failure;

    fn begin(&self, index: u64) -> Result<(Model, Series), NotBegun<Failure>> {
        let (candidate, experiment) = self.place(index);
        let values = candidate.map(|at| self.fitting.values(at));
        Ok((experiment.model_of(values.as_deref())?, Series::new(experiment.recorded.clone())))
    }

    fn end(&self, run: Finished<Series>) -> Result<Row, Failure> {
        let (candidate, experiment) = self.place(run.index);
        let cells = match candidate {
            Some(at) => at.iter().map(|u| Cell::Number(*u)).collect(),
            None => vec![Cell::Absent; self.fitting.bounds.len()],
        };
        let mut row = Row::of(&run, cells);
        let misfits = match (run.ending, run.ran) {
            (Ending::Completed, Some(ran)) => {
                let values = candidate.map(|at| self.fitting.values(at));
                let corrections = self.fitting.corrections(values.as_deref());
                experiment.misfits(self.fitting.fit.misfit, &ran.recorder, &corrections)
            }
            // what it would be compared with means nothing
            (ending @ Ending::OutOfBalance(_), _) => Err(ending.reason().unwrap_or_default()),
            _ => return Ok(row),
        };
        match misfits {
            Ok(parts) => row.cells.extend(parts.into_iter().map(Cell::Number)),
            Err(reason) => (row.status, row.reason) = (Status::Failed, reason),
        }
        Ok(row)
    }
}

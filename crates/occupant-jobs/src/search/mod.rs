//! What searches have in common: candidates that are run, journaled, and told about.
//!
//! ```text
//! search ⇄ Evaluator (journal, threads, lanes) ⇄ Objective (models, values of a run, score) ─ records ─ history
//! ```
//!
//! A search requests values of whole generations; the evaluator runs those that the journal lacks. Both depend only on the
//! study, its inputs and the program, so a killed search reaches the same answer when it is resumed.

pub mod evaluator;
pub mod history;
pub mod progress;

pub use evaluator::{Evaluator, Record, WORST};
pub use progress::Progress;

use occupant_core::model::Model;
use occupant_core::results::recorder::Recorder;
use occupant_core::results::summary::Caveat;
use occupant_scenario::Diagnostics;
use occupant_study::engine::{Engine, Ran};
use occupant_study::{Bounds, Parameter, Relation, Within};

use crate::base::{Failure, Interrupt, Show, say};
use crate::files::study_folder::{Block, Checksums, Column, Folder, Journal, Manifest, Waiting};
use crate::sweep::words::{tell_damaged, warn_unlocked};

/// What the candidates of a search are runs of, and what counts.
pub trait Objective: Sync {
    /// Receives the results of a run.
    type Recorder: Recorder + Send;

    /// The search, as in "resume the fit".
    fn word(&self) -> &'static str;

    /// Manifest of the folder.
    fn manifest(&self) -> &Manifest;

    /// The parameters.
    fn parameters(&self) -> &[Parameter];

    /// Bounds of the parameters.
    fn bounds(&self) -> &[Bounds];

    /// The points that keep the constraints of the study; none without constraints.
    fn within(&self) -> Option<&Within>;

    /// Runs per candidate.
    fn runs(&self) -> u64;

    /// Model and recorder of a run with these values of all parameters, or of the base scenario.
    ///
    /// # Errors
    /// Problems of the scenario then.
    fn begin(&self, run: u64, values: Option<&[f64]>) -> Result<(Model, Self::Recorder), Diagnostics>;

    /// What counts of a completed run, the same number of values for each, and the caveats on them.
    ///
    /// # Errors
    /// The reason why nothing does.
    fn end(
        &self,
        run: u64,
        values: Option<&[f64]>,
        ran: Ran<Self::Recorder>,
    ) -> Result<(Vec<f64>, Vec<Caveat>), String>;

    /// Score from the values of all runs, lower is better; `has_caveats`: any of them has caveats.
    fn score(&self, parts: &[f64], has_caveats: bool) -> f64;

    /// What is added to the score of a candidate that was moved to keep the constraints; it grows with the distance.
    fn of_move(&self, _at: &[f64]) -> f64 {
        0.0
    }

    /// A score as words.
    fn told(&self, score: f64) -> String;

    /// Columns of the history that [`Objective::row`] fills, besides score and parameters.
    fn columns(&self) -> Vec<Column>;

    /// Values of those columns from the values of all runs of a candidate; NaN where missing.
    fn row(&self, parts: &[f64]) -> Vec<f64>;

    /// Values of the parameters, SI, at a point of the unit cube; of one that breaks constraints those of the nearest that keeps
    /// them all.
    fn values(&self, at: &[f64]) -> Vec<f64> {
        let values = self.asked(at);
        self.within().map(|within| within.nearest(&values)).unwrap_or(values)
    }

    /// The same, whatever the constraints.
    fn asked(&self, at: &[f64]) -> Vec<f64> {
        self.bounds().iter().zip(at).map(|(b, u)| b.value(*u)).collect()
    }

    /// Start of the search: the base scenario's values where they are between the bounds, else the middle.
    fn start(&self) -> Vec<f64> {
        let start = |(parameter, bounds): (&Parameter, &Bounds)| match parameter.nominal() {
            occupant_study::Value::Number(x) => {
                let u = bounds.part(x);
                if (0.0..=1.0).contains(&u) { u } else { 0.5 }
            }
            _ => 0.5,
        };
        self.parameters().iter().zip(self.bounds()).map(start).collect()
    }
}

/// The points between bounds that keep the constraints of a study, if it has any.
///
/// # Errors
/// Constraints that leave no point.
pub fn within(relations: &[Relation], bounds: &[Bounds]) -> Result<Option<Within>, Failure> {
    let none = || Failure::plain("constraints: no point of the ranges keeps all of them");
    if relations.is_empty() { Ok(None) } else { Within::new(relations, bounds).map(Some).ok_or_else(none) }
}

/// How a search works.
pub struct Work<'a> {
    /// Threads and kernel.
    pub engine: &'a Engine,
    /// Request to stop.
    pub interrupt: &'a Interrupt,
    /// Progress display.
    pub show: Show,
    /// Whether earlier results are removed.
    pub restart: bool,
    /// Whether it waits for another process at work in the folder.
    pub wait: bool,
}

/// Searches in a folder, from where an earlier search of the same has stopped: `search` finds the answer within about
/// `budget` candidates, `write` writes the result. `doing` is for messages.
///
/// # Errors
/// A folder of something else, or in which another process is at work; interrupted; an error of the operating system.
pub fn in_folder<O: Objective, A, T>(
    (objective, texts): (&O, &[Vec<u8>]),
    (budget, doing): (u64, &str),
    folder: &Folder,
    work: &Work<'_>,
    search: impl FnOnce(&mut Evaluator<'_, O>) -> Result<A, Failure>,
    write: impl FnOnce(&A, &[Record], &Checksums) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let (manifest, Work { engine, interrupt, show, restart, wait }) = (objective.manifest(), work);
    let all = Block { samples: 0..manifest.samples };
    let waiting = Waiting { wait: *wait, quiet: show.quiet, interrupt };
    let held = waiting.claim(|| folder.claim(manifest, texts, &all, *restart))?;
    warn_unlocked(&held, doing, show.quiet);
    let sums = Checksums::open(&folder.path, |_| true)?;
    let progress = Progress::new(budget, *show);
    let mut evaluator = Evaluator::new(objective, (folder, &sums), &all, engine, interrupt, progress)?;
    tell_damaged(&[held.mended, sums.damaged()].concat());
    if evaluator.known() > 0 && !show.quiet {
        say(&format!("resuming: {} runs are finished", evaluator.known()));
    }
    let answer = search(&mut evaluator)?;
    let found = write(&answer, &evaluator.close()?, &sums)?;
    Journal::list(folder, &all, &sums)?;
    sums.close()?;
    Ok(found)
}

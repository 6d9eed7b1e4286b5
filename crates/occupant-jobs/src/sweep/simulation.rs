//! One sample: scenario, model, run, figures, row.

use occupant_core::model::Model;
use occupant_core::results::summary::Summarizer;
use occupant_study::Keep;
use occupant_study::engine::{Finished, NotBegun, Source};

use super::Plan;
use crate::base::{Existing, Failure};
use crate::files::study_folder::{Checksums, Folder, Role, Row, Status};
use crate::risk::columns;
use crate::run::recording::{Recording, Written};
use occupant_files::table::Cell;

/// Runs the samples of a plan.
pub struct Simulation<'a> {
    /// The study.
    pub plan: &'a Plan,
    /// Samples whose result file is kept.
    pub keep: &'a Keep,
    /// The folder.
    pub folder: &'a Folder,
    /// Checksums of the inputs.
    pub sums: &'a Checksums,
}

/// Whether `keep` selects a sample before it is run.
pub fn is_kept(keep: &Keep, index: u64) -> bool {
    match keep {
        Keep::All => true,
        Keep::Indices(numbers) => numbers.binary_search(&index).is_ok(),
        Keep::None | Keep::Worst { .. } => false,
    }
}

impl Source for Simulation<'_> {
    type Recorder = (Summarizer, Recording);
    type Row = Row;
    type Error = Failure;

    fn begin(&self, index: u64) -> Result<(Model, Self::Recorder), NotBegun<Failure>> {
        self.plan.refuse_excluded(index)?;
        if !is_kept(self.keep, index) {
            return Ok((self.plan.open_sample(index)?.model, (Summarizer::new(), Recording::none())));
        }
        let (opened, args) = self.plan.open_kept(index)?;
        let name = self.folder.run(index);
        let begun = Recording::begin(&name, Existing::Replace, &args, &opened, None);
        let recording = begun.map_err(NotBegun::Error)?;
        Ok((opened.model, (Summarizer::new(), recording)))
    }

    fn end(&self, run: Finished<Self::Recorder>) -> Result<Row, Failure> {
        let mut row = self.plan.row(&run);
        if let Some(ran) = run.ran {
            let (summarizer, recording) = ran.recorder;
            if let Written::Complete(path) | Written::Partial(path) =
                recording.close(row.status == Status::Completed)?
            {
                self.sums.add(&path)?;
            }
            self.plan.fill(&mut row, &summarizer, &ran.model);
        }
        Ok(row)
    }

    fn stopped(&self, (_, recording): Self::Recorder) -> Result<(), Failure> {
        recording.close(false).map(|_| ())
    }
}

impl Plan {
    /// Leaves out a run that a constraint of the study excludes.
    ///
    /// # Errors
    /// The constraint.
    pub fn refuse_excluded<E>(&self, index: u64) -> Result<(), NotBegun<E>> {
        self.study.excluded(index).map_or(Ok(()), |reason| Err(NotBegun::Excluded(reason)))
    }

    /// The row of a run, still without figures.
    pub fn row<R>(&self, run: &Finished<R>) -> Row {
        let mut cells = self.inputs(run.index);
        cells.resize(self.manifest.columns.len(), Cell::Absent);
        Row::of(run, cells)
    }

    /// Fills in figures and caveats. A failed run has only figures of its cost: its peaks are from diverging numbers.
    pub fn fill(&self, row: &mut Row, summarizer: &Summarizer, model: &Model) {
        let Some(summary) = summarizer.summary(None) else { return };
        row.warn_of(&summary.caveats);
        let kept = &self.manifest.columns;
        let first = kept.iter().take_while(|c| c.role != Role::Figure).count();
        let figures = summary.figures(model).into_iter().chain(columns(model.setup()));
        for (i, figure) in figures.enumerate() {
            if row.status != Status::Completed && !figure.is_of_work() {
                continue;
            }
            let is_it = |at: &usize| kept.get(*at).is_some_and(|c| c.name == figure.name);
            // a sample whose belts or spheres are others has its figures in other places
            let elsewhere = || (first..kept.len()).find(is_it);
            let at = Some(first + i).filter(is_it).or_else(elsewhere);
            if let (Some(at), Some(value)) = (at, figure.value) {
                row.cells[at] = Cell::Number(value);
            }
        }
    }
}

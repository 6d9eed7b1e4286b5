//! Many runs on all cores, in lanes on each, as one table with the columns of `occupant sweep`. Python's lock is free
//! meanwhile.

use std::collections::HashSet;

use numpy::IntoPyArray;
use occupant_core::model::Model;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::batch::Kernel;
use occupant_jobs::base::Failure;
use occupant_jobs::files::study_folder::{Row, Status};
use occupant_jobs::risk::columns;
use occupant_scenario::Diagnostics;
use occupant_study::engine::{Engine, Finished, NotBegun, Source};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::work::{Progress, work};

/// Runs by their number, each of the model that a function makes.
pub(crate) struct Batch<F> {
    pub(crate) model: F,
}

/// A run's row, and its figures by name.
pub(crate) struct OwnRow {
    pub(crate) row: Row,
    figures: Vec<(String, f64)>,
}

impl<F: Fn(u64) -> Result<Model, Diagnostics> + Sync> Source for Batch<F> {
    type Recorder = Summarizer;
    type Row = OwnRow;
    type Error = Failure;

    fn begin(&self, index: u64) -> Result<(Model, Summarizer), NotBegun<Failure>> {
        Ok(((self.model)(index)?, Summarizer::new()))
    }

    fn end(&self, run: Finished<Summarizer>) -> Result<OwnRow, Failure> {
        let mut row = Row::of(&run, Vec::new());
        let Some((summary, model)) = run.ran.and_then(|ran| Some((ran.recorder.summary(None)?, ran.model))) else {
            return Ok(OwnRow { row, figures: Vec::new() });
        };
        row.warn_of(&summary.caveats);
        let all = summary.figures(&model).into_iter().chain(columns(model.setup()));
        // peaks of a run that failed are those of numbers that mean nothing
        let counts = |is_of_work| row.status == Status::Completed || is_of_work;
        let figures = all.map(|one| {
            let value = one.value.filter(|_| counts(one.is_of_work()));
            (one.name, value.unwrap_or(f64::NAN))
        });
        Ok(OwnRow { figures: figures.collect(), row })
    }
}

/// Threads for many runs, one per core if None.
pub(crate) fn engine(threads: Option<usize>) -> Result<Engine, Failure> {
    let threads = threads.or_else(|| std::thread::available_parallelism().ok().map(Into::into)).unwrap_or(1);
    Engine::new(threads, Kernel::best()).map_err(|error| Failure::plain(format!("no thread can be started: {error}")))
}

/// Rows of `count` runs, in their order.
pub(crate) fn many<S: Source<Error = Failure>>(
    py: Python<'_>,
    source: &S,
    count: u64,
    threads: Option<usize>,
    progress: Option<&Bound<'_, PyAny>>,
    index: impl Fn(&S::Row) -> u64 + Sync,
) -> PyResult<Vec<S::Row>> {
    let progress = Progress::of(py, progress, "runs")?;
    let shown = progress.clone();
    work(py, progress, |interrupt| {
        let mut rows = Vec::new();
        engine(threads)?.run(source, 0..count, &interrupt.asked, |row| {
            rows.push(row);
            shown.iter().for_each(|progress| progress.see(rows.len() as u64, count));
            Ok(())
        })?;
        rows.sort_by_key(&index);
        Ok(rows)
    })
}

/// A table by columns in the making.
pub(crate) struct Table<'py>(Bound<'py, PyDict>);

impl<'py> Table<'py> {
    /// A table that begins with the numbers of the runs.
    pub(crate) fn new<'r>(py: Python<'py>, rows: impl Iterator<Item = &'r Row>) -> PyResult<Self> {
        let table = PyDict::new(py);
        table.set_item("index", rows.map(|row| row.index as i64).collect::<Vec<_>>().into_pyarray(py))?;
        Ok(Table(table))
    }

    /// Adds a column: an array if all its values are numbers.
    pub(crate) fn add(&self, name: &str, column: Vec<Bound<'py, PyAny>>) -> PyResult<()> {
        match column.iter().map(|cell| cell.extract().ok()).collect::<Option<Vec<f64>>>() {
            Some(numbers) => self.add_numbers(name, numbers),
            None => self.0.set_item(name, column),
        }
    }

    /// Adds a column of numbers.
    pub(crate) fn add_numbers(&self, name: &str, column: Vec<f64>) -> PyResult<()> {
        self.0.set_item(name, column.into_pyarray(self.0.py()))
    }

    /// Adds how the runs ended; None for an empty text.
    pub(crate) fn add_ends<'r>(&self, rows: impl Iterator<Item = &'r Row> + Clone) -> PyResult<()> {
        let some = |text: &'r str| (!text.is_empty()).then_some(text);
        self.0.set_item("status", rows.clone().map(|row| row.status.word()).collect::<Vec<_>>())?;
        self.0.set_item("reason", rows.clone().map(|row| some(&row.reason)).collect::<Vec<_>>())?;
        self.0.set_item("caveats", rows.map(|row| some(&row.caveats)).collect::<Vec<_>>())
    }

    /// Adds what the runs cost, and gives the table.
    pub(crate) fn finish<'r>(self, rows: impl Iterator<Item = &'r Row> + Clone) -> PyResult<Bound<'py, PyDict>> {
        self.add_numbers("wall_time_s", rows.clone().map(|row| row.wall_time_s).collect())?;
        self.0.set_item("kernel", rows.map(|row| row.kernel.as_str()).collect::<Vec<_>>())?;
        Ok(self.0)
    }

    /// Adds all figures, each once; parameters may add some, such as those of a belt.
    pub(crate) fn add_figures(&self, rows: &[OwnRow]) -> PyResult<()> {
        let mut known = HashSet::new();
        for (name, _) in rows.iter().flat_map(|row| &row.figures).filter(|(name, _)| known.insert(name.as_str())) {
            let value = |row: &OwnRow| row.figures.iter().find(|own| own.0 == *name).map_or(f64::NAN, |own| own.1);
            self.add_numbers(name, rows.iter().map(value).collect())?;
        }
        Ok(())
    }
}

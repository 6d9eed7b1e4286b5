//! Many runs on all cores, in lanes on each, as one table. Python's lock is free meanwhile.

use std::collections::HashSet;
use std::sync::atomic::{AtomicBool, Ordering};

use numpy::IntoPyArray;
use occupant_core::model::Model;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::batch::Kernel;
use occupant_scenario::Diagnostics;
use occupant_scenario::ending::Ending;
use occupant_study::engine::{Engine, Finished, NotBegun, Source, Unrecorded};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::trouble::plain;

/// Runs by their number.
pub(crate) struct Batch<F> {
    /// The model of a run.
    pub(crate) model: F,
    pub(crate) count: u64,
}

/// Row of a run in the table.
pub(crate) struct Row {
    pub(crate) index: u64,
    ending: String,
    figures: Vec<(String, Option<f64>)>,
}

impl Row {
    fn figure(&self, name: &str) -> Option<f64> {
        self.figures.iter().find(|figure| figure.0 == name).and_then(|figure| figure.1)
    }
}

/// Names of all figures, each once; parameters may add some, such as those of a belt.
fn names(rows: &[Row]) -> Vec<&str> {
    let (mut known, mut names) = (HashSet::new(), Vec::new());
    for (name, _) in rows.iter().flat_map(|row| &row.figures) {
        if known.insert(name.as_str()) {
            names.push(name.as_str());
        }
    }
    names
}

/// An error that ends all runs.
pub(crate) struct Failed(String);

impl From<Unrecorded> for Failed {
    fn from(why: Unrecorded) -> Self {
        Failed(why.to_string())
    }
}

impl<F: Fn(u64) -> Result<Model, Diagnostics> + Sync> Batch<F> {
    /// Rows in the order of the runs, computed on `threads` threads, all cores if None; `inputs` adds the columns of
    /// the parameters. Then `ending` and every figure, NaN where missing.
    pub(crate) fn table<'py>(
        &self,
        py: Python<'py>,
        threads: Option<usize>,
        inputs: impl FnOnce(&Bound<'py, PyDict>, &[Row]) -> PyResult<()>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let threads = threads.or_else(|| std::thread::available_parallelism().ok().map(Into::into)).unwrap_or(1);
        let mut rows = py.detach(|| self.rows(threads))?;
        rows.sort_by_key(|row| row.index);
        let table = PyDict::new(py);
        table.set_item("run", rows.iter().map(|row| row.index as i64).collect::<Vec<_>>().into_pyarray(py))?;
        inputs(&table, &rows)?;
        table.set_item("ending", rows.iter().map(|row| row.ending.clone()).collect::<Vec<_>>())?;
        for name in names(&rows) {
            let value = |row: &Row| row.figure(name).unwrap_or(f64::NAN);
            table.set_item(name, rows.iter().map(value).collect::<Vec<_>>().into_pyarray(py))?;
        }
        Ok(table)
    }

    fn rows(&self, threads: usize) -> PyResult<Vec<Row>> {
        let engine = Engine::new(threads, Kernel::best()).map_err(plain)?;
        let (stop, mut rows) = (AtomicBool::new(false), Vec::new());
        let mut interrupted = None;
        let done = engine.run(self, 0..self.count, &stop, |row| {
            rows.push(row);
            if let Err(signal) = Python::attach(|py| py.check_signals()) {
                interrupted = Some(signal);
                stop.store(true, Ordering::Relaxed);
            }
            Ok(())
        });
        match (interrupted, done) {
            (Some(signal), _) => Err(signal),
            (None, Err(Failed(why))) => Err(plain(why)),
            (None, Ok(())) => Ok(rows),
        }
    }
}

impl<F: Fn(u64) -> Result<Model, Diagnostics> + Sync> Source for Batch<F> {
    type Recorder = Summarizer;
    type Row = Row;
    type Error = Failed;

    fn begin(&self, index: u64) -> Result<(Model, Summarizer), NotBegun<Failed>> {
        Ok(((self.model)(index)?, Summarizer::new()))
    }

    fn end(&self, run: Finished<Summarizer>) -> Result<Row, Failed> {
        let is_whole = matches!(run.ending, Ending::Completed);
        let ending = run.ending.reason().unwrap_or_else(|| "completed".to_owned());
        let summary = run.ran.and_then(|ran| Some((ran.recorder.summary(None)?, ran.model)));
        let figures = summary.map_or_else(Vec::new, |(summary, model)| {
            let all = summary.figures(&model).into_iter();
            // peaks of a run that failed are those of numbers that mean nothing
            all.map(|one| (one.name.clone(), one.value.filter(|_| is_whole || one.is_of_work()))).collect()
        });
        Ok(Row { index: run.index, ending, figures })
    }
}

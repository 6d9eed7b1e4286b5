//! Studies: many runs on all cores, as one table.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use numpy::IntoPyArray;
use occupant_core::model::Model;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::batch::Kernel;
use occupant_scenario::Draft;
use occupant_scenario::ending::Ending;
use occupant_study::engine::{Engine, Finished, NotBegun, Source, Unrecorded};
use occupant_study::{StudyText, Value};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::scenario::{Scenario, beside, format_of};
use crate::trouble::{plain, refused};

/// A study: a scenario in which values are varied, from a file as `occupant sweep` takes it.
#[pyclass(module = "occupant", frozen)]
pub(crate) struct Study {
    study: occupant_study::Study,
    folder: PathBuf,
}

#[pymethods]
impl Study {
    /// `path`: the study's file; `changes`: values of its base scenario by their paths.
    #[new]
    #[pyo3(signature = (path, changes=None))]
    fn new(path: PathBuf, changes: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let folder = path.parent().map(Path::to_owned).unwrap_or_default();
        let name = path.display().to_string();
        let text = StudyText::read_bytes(&std::fs::read(&path)?, format_of(&path), &name);
        let text = text.map_err(|wrong| refused(&wrong))?;
        let file = folder.join(text.base());
        let base = Scenario::open(&file)?;
        let mut overrides = Vec::new();
        for (key, value) in changes.into_iter().flatten() {
            overrides.push(format!("{}={}", key.extract::<String>()?, crate::convert::assigned(&value)?));
        }
        let beside_base = file.parent().map(Path::to_owned).unwrap_or_default();
        let study =
            text.bind(base.draft, &overrides, &|name| beside(&folder, name)).map_err(|wrong| refused(&wrong))?;
        Ok(Study { study, folder: beside_base })
    }

    fn __len__(&self) -> usize {
        self.study.len() as usize
    }

    /// The parameters of run `index` by name.
    fn sample<'py>(&self, py: Python<'py>, index: u64) -> PyResult<Bound<'py, PyDict>> {
        self.is_there(index)?;
        let dict = PyDict::new(py);
        for setting in self.study.sample(index) {
            let name = &self.study.parameters[setting.parameter].name;
            match setting.value {
                Value::Number(number) => dict.set_item(name, number)?,
                Value::Text(text) => dict.set_item(name, text)?,
                Value::Truth(truth) => dict.set_item(name, truth)?,
                Value::Base => dict.set_item(name, py.None())?,
            }
        }
        Ok(dict)
    }

    /// The scenario of run `index`.
    fn scenario(&self, index: u64) -> PyResult<Scenario> {
        self.is_there(index)?;
        let draft = self.study.draft(index).map_err(|wrong| refused(&wrong))?;
        Ok(Scenario::of(draft, self.folder.clone()))
    }

    /// Runs all of it on `threads` threads, all cores if None, and gives a table by columns: `run`, the parameters,
    /// `ending` ("completed", or why not) and every figure of a run in its SI unit, NaN where there is none. The rows are
    /// the same to the bit for any number of threads.
    #[pyo3(signature = (threads=None))]
    fn run<'py>(&self, py: Python<'py>, threads: Option<usize>) -> PyResult<Bound<'py, PyDict>> {
        let threads = threads.or_else(|| std::thread::available_parallelism().ok().map(Into::into)).unwrap_or(1);
        let mut rows = py.detach(|| self.rows(threads))?;
        rows.sort_by_key(|row| row.index);
        let names = rows.iter().find(|row| !row.figures.is_empty()).map(|row| row.figures.clone()).unwrap_or_default();
        let table = PyDict::new(py);
        table.set_item("run", rows.iter().map(|row| row.index as i64).collect::<Vec<_>>().into_pyarray(py))?;
        let samples: Vec<_> = rows.iter().map(|row| self.sample(py, row.index)).collect::<PyResult<_>>()?;
        for parameter in &self.study.parameters {
            let column: Vec<_> =
                samples.iter().map(|sample| sample.get_item(&parameter.name)).collect::<PyResult<_>>()?;
            let numbers: Option<Vec<f64>> = column.iter().map(|cell| cell.as_ref()?.extract().ok()).collect();
            match numbers {
                Some(numbers) => table.set_item(&parameter.name, numbers.into_pyarray(py))?,
                None => table.set_item(&parameter.name, column)?,
            }
        }
        table.set_item("ending", rows.iter().map(|row| row.ending.clone()).collect::<Vec<_>>())?;
        for (place, (name, _)) in names.iter().enumerate() {
            let value = |row: &Row| row.figures.get(place).and_then(|(_, value)| *value).unwrap_or(f64::NAN);
            table.set_item(name, rows.iter().map(value).collect::<Vec<_>>().into_pyarray(py))?;
        }
        Ok(table)
    }
}

impl Study {
    fn is_there(&self, index: u64) -> PyResult<()> {
        let length = self.study.len();
        if index < length { Ok(()) } else { Err(PyIndexError::new_err(format!("run {index} of {length}"))) }
    }

    fn rows(&self, threads: usize) -> PyResult<Vec<Row>> {
        let engine = Engine::new(threads, Kernel::best()).map_err(plain)?;
        let (stop, mut rows) = (AtomicBool::new(false), Vec::new());
        let mut interrupted = None;
        let done = engine.run(self, 0..self.study.len(), &stop, |row| {
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

    fn model(&self, index: u64) -> Result<Model, occupant_scenario::Diagnostics> {
        let draft: Draft = self.study.draft(index)?;
        Ok(draft.load(&|file| beside(&self.folder, file))?.model()?.0)
    }
}

/// What a table holds of a run.
pub(crate) struct Row {
    index: u64,
    ending: String,
    figures: Vec<(String, Option<f64>)>,
}

/// What ends all runs.
pub(crate) struct Failed(String);

impl From<Unrecorded> for Failed {
    fn from(why: Unrecorded) -> Self {
        Failed(why.to_string())
    }
}

impl Source for Study {
    type Recorder = Summarizer;
    type Row = Row;
    type Error = Failed;

    fn begin(&self, index: u64) -> Result<(Model, Summarizer), NotBegun<Failed>> {
        Ok((self.model(index)?, Summarizer::new()))
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

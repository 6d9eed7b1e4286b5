//! Studies: many runs on all cores, as one table.

use std::path::{Path, PathBuf};

use numpy::IntoPyArray;
use occupant_core::model::Model;
use occupant_scenario::Draft;
use occupant_study::{StudyText, Value};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::batch::Batch;
use crate::scenario::{Scenario, beside, format_of};
use crate::trouble::refused;

/// A study, from a file as for `occupant sweep`: a scenario with varied values.
#[pyclass(module = "occupant", frozen)]
pub(crate) struct Study {
    study: occupant_study::Study,
    folder: PathBuf,
}

#[pymethods]
impl Study {
    /// `path`: the study's file; `changes`: values of its base scenario by path.
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
        let batch = Batch { model: |index| self.model(index), count: self.study.len() };
        batch.table(py, threads, |table, rows| {
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
            Ok(())
        })
    }
}

impl Study {
    fn is_there(&self, index: u64) -> PyResult<()> {
        let length = self.study.len();
        if index < length { Ok(()) } else { Err(PyIndexError::new_err(format!("run {index} of {length}"))) }
    }

    fn model(&self, index: u64) -> Result<Model, occupant_scenario::Diagnostics> {
        let draft: Draft = self.study.draft(index)?;
        Ok(draft.load(&|file| beside(&self.folder, file))?.model()?.0)
    }
}

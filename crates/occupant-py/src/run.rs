//! Runs and what is read off them.

use numpy::{IntoPyArray, PyArray1};
use occupant_core::model::Model;
use occupant_core::results::channel::{Channel, Series, channels, find, matching};
use occupant_core::results::checkpoint::Checkpoint;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::{Summarizer, Summary};
use occupant_core::run::simulate::{attempt, replay};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use pythonize::pythonize;

use crate::trouble::plain;

/// A completed run.
#[pyclass(module = "occupant", frozen)]
pub(crate) struct Run {
    model: Model,
    checkpoints: Vec<Checkpoint>,
    summary: Summary,
}

/// Keeps all outputs.
struct Keeper(Vec<Checkpoint>);

impl Recorder for Keeper {
    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        self.0.push(sample.checkpoint());
        Ok(Flow::Continue)
    }
}

impl Run {
    pub(crate) fn of(model: Model) -> PyResult<Self> {
        let mut recorders = (Summarizer::new(), Keeper(Vec::with_capacity(model.output_count())));
        attempt(&model, &mut recorders).map_err(plain)?;
        let (summarizer, Keeper(checkpoints)) = recorders;
        let summary = summarizer.summary(None).ok_or_else(|| plain("the run ended before its first output"))?;
        Ok(Run { model, checkpoints, summary })
    }

    fn series(&self, channels: Vec<Channel>) -> PyResult<Series> {
        let mut series = Series::new(channels);
        for checkpoint in &self.checkpoints {
            replay(&self.model, checkpoint, &mut series).map_err(plain)?;
        }
        Ok(series)
    }
}

#[pymethods]
impl Run {
    /// "completed", "interrupted" or "failed".
    #[getter]
    fn status(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        Ok(pythonize(py, &self.summary.status)?.unbind())
    }

    /// The content of `occupant run --json`: peaks, contacts, measures, caveats, energy balance.
    #[getter]
    fn summary(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        Ok(pythonize(py, &self.summary)?.unbind())
    }

    /// Injury measures by name, in the units of the summary; None without a value. With several occupants, names start
    /// with the occupant's name and a dot.
    #[getter]
    fn measures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        for (prefix, person) in self.summary.people() {
            let name = |measure: &str| format!("{prefix}{measure}");
            person.measures.iter().try_for_each(|measure| dict.set_item(name(measure.name), measure.value))?;
        }
        Ok(dict)
    }

    /// Results that should not be quoted, with reasons.
    #[getter]
    fn caveats(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        Ok(pythonize(py, &self.summary.caveats)?.unbind())
    }

    /// Output times, s.
    #[getter]
    fn time<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.checkpoints.iter().map(|at| at.time_s).collect::<Vec<_>>().into_pyarray(py)
    }

    /// Channels that match `pattern`, where `*` matches anything: dicts of `name`, `unit`, `meaning`.
    #[pyo3(signature = (pattern="*"))]
    fn channels<'py>(&self, py: Python<'py>, pattern: &str) -> PyResult<Bound<'py, PyList>> {
        let list = PyList::empty(py);
        for channel in matching(&self.model, pattern) {
            let dict = PyDict::new(py);
            dict.set_item("name", &channel.name)?;
            dict.set_item("unit", channel.unit.symbol())?;
            dict.set_item("meaning", &channel.meaning)?;
            list.append(dict)?;
        }
        Ok(list)
    }

    /// Time history of a channel, a value per output time, in its SI unit.
    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let channel = find(&self.model, name).map_err(|unknown| PyKeyError::new_err(unknown.to_string()))?;
        let series = py.detach(|| self.series(vec![channel]))?;
        Ok(series.values.into_iter().next().unwrap_or_default().into_pyarray(py))
    }

    /// Time histories of all channels that match one of `patterns`, by name, computed together.
    #[pyo3(signature = (*patterns))]
    fn series_of<'py>(&self, py: Python<'py>, patterns: Vec<String>) -> PyResult<Bound<'py, PyDict>> {
        let mut wanted: Vec<Channel> = channels(&self.model);
        let names: Vec<String> =
            patterns.iter().flat_map(|pattern| matching(&self.model, pattern)).map(|channel| channel.name).collect();
        wanted.retain(|channel| names.contains(&channel.name));
        let Series { channels, values, .. } = py.detach(|| self.series(wanted))?;
        let dict = PyDict::new(py);
        for (channel, values) in channels.into_iter().zip(values) {
            dict.set_item(channel.name, values.into_pyarray(py))?;
        }
        Ok(dict)
    }

    fn __repr__(&self) -> String {
        format!("<occupant.Run {:?}, {} outputs>", self.summary.title, self.checkpoints.len())
    }
}

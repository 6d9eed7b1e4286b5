//! Runs and what is read off them.

use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use crash_measures::injury::Options;
use numpy::{IntoPyArray, PyArray1};
use occupant_core::model::Model;
use occupant_core::results::channel::{Channel, Series, channels, find, matching};
use occupant_core::results::checkpoint::Checkpoint;
use occupant_core::results::outcome::Outcome;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::Summary;
use occupant_core::run::simulate::replay;
use occupant_files::base::{ending, file_name, publish};
use occupant_files::history::FAMILIES;
use occupant_files::results::Results;
use occupant_files::scenario::Opened;
use occupant_files::steps;
use occupant_jobs::base::{Failure, Units};
use occupant_jobs::judged::Impact;
use occupant_jobs::measures::{DUMMIES, FILTERS, Judged, options};
use occupant_jobs::run::recording::{Recording, about_run, recorder};
use occupant_jobs::run::run as simulate;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList, PyTuple};

use crate::convert::{json_of, one_of};
use crate::trouble::{failed, plain};
use crate::work::{Progress, Watcher, work};

/// A run that has ended: one that was computed here, or one from a result file.
#[pyclass(module = "occupant", frozen)]
pub(crate) struct Run {
    of: Of,
    summary: Summary,
}

enum Of {
    /// Computed here, and its file once it was asked for.
    Ran(Box<Ran>, OnceLock<Filed>),
    Read(Filed),
}

struct Ran {
    /// Name of its scenario, and the changes to it.
    name: String,
    changes: Vec<String>,
    opened: Opened,
    checkpoints: Vec<Checkpoint>,
    outcome: Outcome,
}

/// A result file.
struct Filed {
    bytes: Vec<u8>,
    results: Results,
}

impl Filed {
    fn of(path: &Path, bytes: Vec<u8>) -> Result<Self, Failure> {
        Ok(Filed { results: Results::of_bytes(path, &bytes)?, bytes })
    }
}

/// Keeps all outputs and the end.
#[derive(Default)]
struct Keeper(Vec<Checkpoint>, Option<Outcome>);

impl Recorder for Keeper {
    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        self.0.push(sample.checkpoint());
        Ok(Flow::Continue)
    }

    fn end(&mut self, outcome: &Outcome) -> Result<(), RecorderError> {
        self.1 = Some(outcome.clone());
        Ok(())
    }
}

impl Ran {
    /// The bytes that `occupant run -o` writes.
    fn bytes(&self) -> Result<Vec<u8>, Failure> {
        let unwritten = |error: &dyn std::fmt::Display| Failure::plain(format!("the run cannot be written: {error}"));
        let (opened, name) = (&self.opened, file_name(Path::new(&self.name)));
        if !opened.model.setup().own_forces.is_empty() {
            let found = "a run with forces of Python's, which no result file can describe";
            return Err(Failure::with_help(found, "read its channels and its summary"));
        }
        let about = about_run(&name, &self.changes, opened)?;
        let mut file = recorder(Cursor::new(Vec::new()), about, &opened.loaded).map_err(|e| unwritten(&e))?;
        file.begin(&opened.model).map_err(|e| unwritten(&e))?;
        for checkpoint in &self.checkpoints {
            replay(&opened.model, checkpoint, &mut file).map_err(|e| unwritten(&e))?;
        }
        file.end(&self.outcome).map_err(|e| unwritten(&e))?;
        Ok(file.into_inner().map_err(|e| unwritten(&e))?.into_inner())
    }

    fn filed(&self) -> Result<Filed, Failure> {
        let path = Path::new(&file_name(Path::new(&self.name))).with_extension("mcap");
        Filed::of(&path, self.bytes()?)
    }
}

impl Run {
    /// Computes it.
    pub(crate) fn of(
        opened: Opened,
        name: String,
        changes: Vec<String>,
        progress: Option<Arc<Progress>>,
    ) -> PyResult<Self> {
        let (mut keeper, mut watcher) = (Keeper::default(), Watcher::new(progress, opened.model.output_count()));
        let run = simulate(&opened, None, Recording::none(), Vec::new(), (&mut keeper, &mut watcher));
        if let Some(raised) = watcher.raised() {
            return Err(raised);
        }
        let mut run = run.map_err(failed)?;
        if run.completed {
            let caveats = steps::caveats(&opened.model, &run.friction, &run.summary);
            run.summary.caveats.extend(caveats);
        }
        let Keeper(checkpoints, Some(outcome)) = keeper else {
            return Err(plain("the run ended before its first output"));
        };
        let ran = Ran { name, changes, opened, checkpoints, outcome };
        Ok(Run { of: Of::Ran(Box::new(ran), OnceLock::new()), summary: run.summary })
    }

    /// Reads it.
    pub(crate) fn read(path: &Path, bytes: Vec<u8>) -> Result<Self, Failure> {
        let filed = Filed::of(path, bytes)?;
        let mut impact = Impact::default();
        let mut summary = filed.results.summary_judged(Options::default(), &mut impact)?;
        impact.judge(&mut summary, &filed.results.model);
        Ok(Run { of: Of::Read(filed), summary })
    }

    fn model(&self) -> &Model {
        match &self.of {
            Of::Ran(ran, _) => &ran.opened.model,
            Of::Read(filed) => &filed.results.model,
        }
    }

    fn checkpoints(&self) -> &[Checkpoint] {
        match &self.of {
            Of::Ran(ran, _) => &ran.checkpoints,
            Of::Read(filed) => &filed.results.checkpoints,
        }
    }

    fn filed(&self) -> Result<&Filed, Failure> {
        match &self.of {
            Of::Read(filed) => Ok(filed),
            Of::Ran(ran, whole) => match whole.get() {
                Some(filed) => Ok(filed),
                None => {
                    let filed = ran.filed()?;
                    Ok(whole.get_or_init(|| filed))
                }
            },
        }
    }

    /// It as an opened result file.
    pub(crate) fn results(&self) -> Result<&Results, Failure> {
        Ok(&self.filed()?.results)
    }

    /// It as a result file opened once more.
    pub(crate) fn opened_again(&self) -> Result<Results, Failure> {
        let filed = self.filed()?;
        Results::of_bytes(&filed.results.path, &filed.bytes)
    }

    /// Writes its file into a folder, under its name.
    pub(crate) fn write_into(&self, folder: &Path) -> Result<PathBuf, Failure> {
        let filed = self.filed()?;
        let path = folder.join(file_name(&filed.results.path));
        publish(&path, false, &filed.bytes)?;
        Ok(path)
    }

    fn series(&self, channels: Vec<Channel>) -> PyResult<Series> {
        let mut series = Series::new(channels);
        for checkpoint in self.checkpoints() {
            replay(self.model(), checkpoint, &mut series).map_err(plain)?;
        }
        Ok(series)
    }

    /// Channels that match one of the patterns, in the order of the list.
    fn wanted(&self, patterns: &[String]) -> Vec<Channel> {
        let mut wanted: Vec<Channel> = channels(self.model());
        let names: Vec<String> =
            patterns.iter().flat_map(|pattern| matching(self.model(), pattern)).map(|channel| channel.name).collect();
        wanted.retain(|channel| names.contains(&channel.name));
        wanted
    }
}

#[pymethods]
impl Run {
    /// A run from the `bytes` of a result file; `name` is for messages.
    #[staticmethod]
    #[pyo3(signature = (bytes, name="run.mcap"))]
    fn from_bytes(py: Python<'_>, bytes: Vec<u8>, name: &str) -> PyResult<Self> {
        py.detach(|| Run::read(Path::new(name), bytes)).map_err(failed)
    }

    /// The bytes of a result file (MCAP), those that `occupant run -o` writes.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let filed = py.detach(|| self.filed()).map_err(failed)?;
        Ok(PyBytes::new(py, &filed.bytes))
    }

    /// Writes a result file (MCAP) as `occupant run -o` to `path`; one that exists is replaced only with `force`.
    #[pyo3(signature = (path, force=false))]
    fn save(&self, py: Python<'_>, path: PathBuf, force: bool) -> PyResult<()> {
        py.detach(|| {
            if ending(&path) != "mcap" {
                return Err(Failure::ending(&path, ".mcap"));
            }
            publish(&path, force, &self.filed()?.bytes)
        })
        .map_err(failed)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, own) = (slf.py(), slf.get());
        let bytes = own.to_bytes(py)?;
        let name = own.results().map_err(failed)?.path.display().to_string();
        Ok((slf.get_type().getattr("from_bytes")?, (bytes, name).into_pyobject(py)?))
    }

    /// "completed", "interrupted" or "failed".
    #[getter]
    fn status(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        json_of(&self.summary.status, py)
    }

    /// The content of `occupant run --json`: peaks, contacts, measures, caveats, energy balance.
    #[getter]
    fn summary(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        json_of(&self.summary, py)
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
        json_of(&self.summary.caveats, py)
    }

    /// Remarks to read before using a run from a file.
    #[getter]
    fn notes(&self) -> Vec<String> {
        match &self.of {
            Of::Ran(..) => Vec::new(),
            Of::Read(filed) => filed.results.notes(),
        }
    }

    /// Measures with limits, risks and caveats, as `occupant measures --json` prints them. `filter`: "none" or "j211";
    /// `coefficients`: "iso6487" or "sae-j211"; `dummy`: whose limits and risk curves apply, such as "thor-50m", that
    /// nearest in size if None; `interval`: the run is computed again with readings at this interval, s.
    #[pyo3(signature = (filter="none", coefficients="iso6487", dummy=None, interval=None))]
    fn judge(
        &self,
        py: Python<'_>,
        filter: &str,
        coefficients: &str,
        dummy: Option<&str>,
        interval: Option<f64>,
    ) -> PyResult<Py<PyAny>> {
        let (filter, family) = (one_of("filter", filter, &FILTERS)?, one_of("coefficients", coefficients, &FAMILIES)?);
        let dummy = dummy.map(|name| one_of("dummy", name, &DUMMIES)).transpose()?;
        if let Some(wrong) = interval.filter(|s| !(s.is_finite() && *s > 0.0)) {
            return Err(plain(format!("interval {wrong} s; expected a time above zero, such as 1e-4")));
        }
        let judged = work(py, None, |interrupt| {
            let options = options(filter, family, dummy);
            let results = self.opened_again()?;
            let judged = Judged::of(results, interval, options, Units::default(), interrupt.clone());
            interrupt.refuse("nothing was judged")?;
            judged
        })?;
        json_of(&judged.answer(), py)
    }

    /// Output times, s.
    #[getter]
    fn time<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.checkpoints().iter().map(|at| at.time_s).collect::<Vec<_>>().into_pyarray(py)
    }

    /// Channels that match `pattern`, where `*` matches anything: dicts of `name`, `unit`, `meaning`.
    #[pyo3(signature = (pattern="*"))]
    fn channels<'py>(&self, py: Python<'py>, pattern: &str) -> PyResult<Bound<'py, PyList>> {
        let list = PyList::empty(py);
        for channel in matching(self.model(), pattern) {
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
        let channel = find(self.model(), name).map_err(|unknown| PyKeyError::new_err(unknown.to_string()))?;
        let series = py.detach(|| self.series(vec![channel]))?;
        Ok(series.values.into_iter().next().unwrap_or_default().into_pyarray(py))
    }

    /// Time histories of all channels that match one of `patterns`, by name, computed together.
    #[pyo3(signature = (*patterns))]
    fn series_of<'py>(&self, py: Python<'py>, patterns: Vec<String>) -> PyResult<Bound<'py, PyDict>> {
        let wanted = self.wanted(&patterns);
        let Series { channels, values, .. } = py.detach(|| self.series(wanted))?;
        let dict = PyDict::new(py);
        for (channel, values) in channels.into_iter().zip(values) {
            dict.set_item(channel.name, values.into_pyarray(py))?;
        }
        Ok(dict)
    }

    /// Time histories as a pandas.DataFrame with the time, s, as its index; all channels without patterns. Its `attrs`
    /// hold units and meanings. Needs pandas.
    #[pyo3(signature = (*patterns))]
    fn to_pandas<'py>(&self, py: Python<'py>, patterns: Vec<String>) -> PyResult<Bound<'py, PyAny>> {
        let (patterns, pandas) = (all_of(patterns), installed(py, "pandas")?);
        let time = PyDict::new(py);
        time.set_item("name", "time_s")?;
        let index = pandas.getattr("Index")?.call((self.time(py),), Some(&time))?;
        let options = PyDict::new(py);
        options.set_item("index", index)?;
        let wanted = self.wanted(&patterns);
        let frame = pandas.getattr("DataFrame")?.call((self.series_of(py, patterns)?,), Some(&options))?;
        let attrs = frame.getattr("attrs")?;
        let (units, meanings) = (PyDict::new(py), PyDict::new(py));
        for channel in &wanted {
            units.set_item(&channel.name, channel.unit.symbol())?;
            meanings.set_item(&channel.name, &channel.meaning)?;
        }
        attrs.set_item("units", units)?;
        attrs.set_item("meanings", meanings)?;
        Ok(frame)
    }

    /// Time histories as an xarray.Dataset over `time`; all channels without patterns. Each has its unit and meaning as
    /// attributes `units` and `long_name`. Needs xarray.
    #[pyo3(signature = (*patterns))]
    fn to_xarray<'py>(&self, py: Python<'py>, patterns: Vec<String>) -> PyResult<Bound<'py, PyAny>> {
        let (patterns, xarray) = (all_of(patterns), installed(py, "xarray")?);
        let series = self.series_of(py, patterns.clone())?;
        let (variables, coordinates) = (PyDict::new(py), PyDict::new(py));
        let attributes = |unit: &str, meaning: &str| {
            let dict = PyDict::new(py);
            dict.set_item("units", unit)?;
            dict.set_item("long_name", meaning)?;
            Ok::<_, PyErr>(dict)
        };
        for channel in self.wanted(&patterns) {
            let about = attributes(channel.unit.symbol(), &channel.meaning)?;
            variables.set_item(&channel.name, ("time", series.get_item(&channel.name)?, about))?;
        }
        coordinates.set_item("time", ("time", self.time(py), attributes("s", "time of the output")?))?;
        let about = PyDict::new(py);
        about.set_item("title", &self.model().setup().title)?;
        xarray.getattr("Dataset")?.call1((variables, coordinates, about))
    }

    fn __repr__(&self) -> String {
        format!("<occupant.Run {:?}, {} outputs>", self.model().setup().title, self.checkpoints().len())
    }
}

/// All channels, if none are chosen.
fn all_of(patterns: Vec<String>) -> Vec<String> {
    if patterns.is_empty() { vec!["*".to_owned()] } else { patterns }
}

/// A package that Occupant does without unless it is asked for.
fn installed<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyModule>> {
    py.import(name).map_err(|_| plain(format!("{name} is not installed; expected `pip install {name}`")))
}

//! Scenarios.

use std::path::{Path, PathBuf};
use std::sync::{Arc, PoisonError};

use occupant_core::model::Model;
use occupant_core::vehicle::{VehiclePath, VehicleState};
use occupant_files::base::file_name;
use occupant_files::deck::{FromDeck, from_deck, is_deck};
use occupant_files::scenario::{Opened, ScenarioArgs, files_beside, format_of, retitle, source};
use occupant_jobs::keys::values;
use occupant_jobs::sensitivity::{Words, analyse, answer, ask};
use occupant_scenario::{Diagnostics, Draft, Format, Loaded};
use placed_text::Value;
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList, PyTuple};

use crate::batch::{Batch, OwnRow, Table, many};
use crate::convert::{assigned, change, changes, json, json_of};
use crate::force::{Brought, Where};
use crate::live::{LiveRun, Trouble, state};
use crate::run::Run;
use crate::trouble::{failed, plain, problems, refused};
use crate::work::{Progress, SHOW, work};

/// A scenario: a TOML or JSON file, a card deck, or a dict of its keys. Files that it refers to are searched in its
/// folder.
#[pyclass(module = "occupant", skip_from_py_object)]
#[derive(Clone)]
pub(crate) struct Scenario {
    pub(crate) draft: Draft,
    /// Its text before the changes.
    pub(crate) text: Arc<Text>,
    /// Changes to it, as `--set` has them.
    pub(crate) changes: Vec<String>,
    /// Forces defined in Python.
    forces: Vec<Arc<Brought>>,
}

/// The text of a scenario, and its file, which need not exist.
pub(crate) struct Text {
    pub(crate) path: PathBuf,
    pub(crate) bytes: Vec<u8>,
    deck: Option<FromDeck>,
}

impl Text {
    pub(crate) fn new(path: PathBuf, bytes: Vec<u8>) -> Self {
        Text { path, bytes, deck: None }
    }

    fn name(&self) -> String {
        self.path.display().to_string()
    }

    /// A file beside it.
    fn beside(&self, file: &str) -> Result<Vec<u8>, String> {
        files_beside(&self.path)(file)
    }
}

#[pymethods]
impl Scenario {
    /// `source`: the path of a file, or a dict. Files of a dict are searched in the working folder.
    #[new]
    pub(crate) fn new(source: &Bound<'_, PyAny>) -> PyResult<Self> {
        if source.is_instance_of::<PyDict>() {
            return Self::from_text(&json(source)?, "json", PathBuf::new());
        }
        let path: PathBuf = source.extract()?;
        Self::open(&path)
    }

    /// A scenario from `text`, `format` "toml" or "json"; files that it refers to are searched in `folder`.
    #[staticmethod]
    #[pyo3(signature = (text, format="toml", folder=PathBuf::new()))]
    fn from_text(text: &str, format: &str, folder: PathBuf) -> PyResult<Self> {
        Scenario::of(Text::new(folder.join(named("text", format)?), text.as_bytes().to_vec()), Vec::new())
    }

    /// All values whose paths match `pattern`, where `*` matches anything, presets included: dicts of `path`, `value`,
    /// `unit` (that of a bare number there, empty if none) and `meaning`.
    #[pyo3(signature = (pattern="*"))]
    fn paths<'py>(&self, py: Python<'py>, pattern: &str) -> PyResult<Bound<'py, PyList>> {
        let list = PyList::empty(py);
        for one in py.detach(|| values(&self.draft, pattern)) {
            let dict = PyDict::new(py);
            dict.set_item("path", one.path)?;
            dict.set_item("value", written(py, &one.value)?)?;
            dict.set_item("unit", one.unit)?;
            dict.set_item("meaning", one.meaning)?;
            list.append(dict)?;
        }
        Ok(list)
    }

    /// The value at a path, `scenario["joints.neck.damping"]`, presets included: a number, a text with its unit, a
    /// list, or for a path with `*` a dict of all matches.
    fn __getitem__<'py>(&self, py: Python<'py>, path: &str) -> PyResult<Bound<'py, PyAny>> {
        let mut found = self.draft.clone().get(path).map_err(|wrong| PyKeyError::new_err(wrong.to_string()))?;
        if !path.contains('*') && found.len() == 1 {
            let (_, value) = found.swap_remove(0);
            return written(py, &value);
        }
        let dict = PyDict::new(py);
        for (place, value) in found {
            dict.set_item(place, written(py, &value)?)?;
        }
        Ok(dict.into_any())
    }

    /// Adds a force of your own, called `name`: `function`, of time, places and velocities, gives a force for each of
    /// `places`, N. Places are spheres by name, or points `("head", [x, y, z])` of a segment, of "vehicle" or of
    /// "space", m. The function sees and says all in space axes: x forward, y left, z up. It must follow from what it
    /// is given.
    fn add_force(&mut self, name: String, places: Vec<Bound<'_, PyAny>>, function: Py<PyAny>) -> PyResult<()> {
        let places = places.iter().map(Where::of).collect::<PyResult<Vec<_>>>()?;
        self.forces.push(Arc::new(Brought { name, places, function }));
        Ok(())
    }

    /// A run that is stepped from outside. With `velocity` the vehicle begins with it, m/s, at `place`, m, turned by
    /// `attitude`, rad, with `rates`, rad/s, and is told from then on how it moves: `LiveRun.push`.
    #[pyo3(signature = (velocity=None, place=[0.0; 3], attitude=[0.0; 3], rates=[0.0; 3]))]
    fn live(
        &self,
        py: Python<'_>,
        velocity: Option<[f64; 3]>,
        place: [f64; 3],
        attitude: [f64; 3],
        rates: [f64; 3],
    ) -> PyResult<LiveRun> {
        let start = velocity.map(|velocity| state(place, attitude, velocity, rates));
        let (opened, trouble) = self.opened(py, start)?;
        Ok(LiveRun::of(opened.model, trouble))
    }

    /// Changes a value, `scenario["path.speed"] = "30 mph"`: a number in the scenario's units, a text with its unit, a
    /// list, a dict; None removes it. `*` in the path matches any name.
    fn __setitem__(&mut self, path: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
        self.change(change(path, value)?)
    }

    /// Removes a value.
    fn __delitem__(&mut self, path: &str) -> PyResult<()> {
        self.change(format!("{path}=null"))
    }

    /// An independent copy of the scenario.
    fn copy(&self) -> Self {
        self.clone()
    }

    fn __copy__(&self) -> Self {
        self.clone()
    }

    fn __deepcopy__(&self, _memo: &Bound<'_, PyAny>) -> Self {
        self.clone()
    }

    /// Warnings, in the form of `OccupantError.problems`; raises OccupantError for errors.
    fn check<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let (_, warnings) = self.model().map_err(|wrong| refused(&wrong))?;
        problems(py, &warnings)
    }

    /// The scenario with all changes and expansions, in TOML.
    fn to_toml(&self) -> PyResult<String> {
        self.loaded().map_err(|wrong| refused(&wrong))?.scenario.to_toml().map_err(plain)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, own) = (slf.py(), slf.borrow());
        let forces = PyList::empty(py);
        own.forces.iter().try_for_each(|force| forces.append(force.parts(py)?))?;
        let path = std::path::absolute(&own.text.path)?;
        let parts = (path, PyBytes::new(py, &own.text.bytes), own.changes.clone(), forces).into_pyobject(py)?;
        Ok((slf.get_type().getattr("_restored")?, parts))
    }

    #[staticmethod]
    fn _restored(
        path: PathBuf,
        bytes: Vec<u8>,
        changes: Vec<String>,
        forces: Vec<Bound<'_, PyTuple>>,
    ) -> PyResult<Self> {
        let mut scenario = Scenario::of(read(path, bytes)?, changes)?;
        for force in forces {
            let (name, places, function) = force.extract()?;
            scenario.add_force(name, places, function)?;
        }
        Ok(scenario)
    }

    fn __repr__(&self) -> String {
        format!("<occupant.Scenario {:?}, {} changes>", self.text.name(), self.changes.len())
    }

    /// Runs it once for each row of `matrix`, an array or a list of lists, with the values of the row at `paths`:
    /// numbers in the scenario's units, texts with their unit. On `threads` threads, all cores if None, in lanes on
    /// each. Gives a table by columns, those of `occupant sweep`: `index`, what was put at each path as `input.PATH`,
    /// `status`, `reason`, `caveats`, every figure of a run in its SI unit, NaN where there is none, `wall_time_s`,
    /// `kernel`. The rows are the same to the bit for any number of threads. `progress`: True for a bar of tqdm, or a
    /// function of the number of runs done and of all. Raises OccupantError where a row has not as many values as there
    /// are paths, a path is given twice, or the scenario has forces of Python's.
    #[pyo3(signature = (paths, matrix, threads=None, progress=None))]
    fn batch<'py>(
        &self,
        py: Python<'py>,
        paths: Vec<String>,
        matrix: &Bound<'py, PyAny>,
        threads: Option<usize>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        if self.has_forces() {
            return Err(plain(
                "a batch of a scenario with forces of Python's; expected one without, or `run` for each",
            ));
        }
        if let Some(twice) = paths.iter().enumerate().find_map(|(i, path)| paths[..i].contains(path).then_some(path)) {
            return Err(plain(format!("path \"{twice}\" is given twice; expected each path once")));
        }
        let rows = matrix.try_iter()?.map(|row| cells(&row?, &paths)).collect::<PyResult<Vec<_>>>()?;
        let texts =
            rows.iter().map(|row| row.iter().map(assigned).collect()).collect::<PyResult<Vec<Vec<String>>>>()?;
        let base = self.draft.clone().prepared();
        let model = |index: u64| {
            let mut draft = base.clone();
            let row = paths.iter().zip(&texts[index as usize]);
            row.into_iter().try_for_each(|(path, text)| draft.set_value(path, text))?;
            Ok(draft.load(&|file| self.text.beside(file))?.model()?.0)
        };
        let count = rows.len() as u64;
        let runs = many(py, &Batch { model }, count, threads, progress, |run: &OwnRow| run.row.index)?;
        let of_runs = runs.iter().map(|run| &run.row);
        let table = Table::new(py, of_runs.clone())?;
        for (place, path) in paths.iter().enumerate() {
            table.add(&format!("input.{path}"), rows.iter().map(|row| row[place].clone()).collect())?;
        }
        table.add_ends(of_runs.clone())?;
        table.add_figures(&runs)?;
        table.finish(of_runs)
    }

    /// Runs the scenario, up to `until` instead of `time.end`, and with other values: `overrides`, a dict of values by
    /// path or a list of texts as `--set` has them. Other Python threads continue meanwhile. `progress`: True for a bar
    /// of tqdm, or a function of the number of outputs done and of all.
    #[pyo3(signature = (until=None, overrides=None, progress=None))]
    fn run(
        &self,
        py: Python<'_>,
        until: Option<&Bound<'_, PyAny>>,
        overrides: Option<&Bound<'_, PyAny>>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Run> {
        let mut scenario = self.clone();
        let until = until.map(|time| change("time.end", time)).transpose()?;
        changes(overrides)?.into_iter().chain(until).try_for_each(|change| scenario.change(change))?;
        let progress = Progress::of(py, progress, "outputs")?;
        retitle(&mut scenario.draft, &scenario.changes);
        let (opened, trouble) = scenario.opened(py, None)?;
        let run = py.detach(|| Run::of(opened, scenario.text.name(), scenario.changes, progress));
        let raised = trouble.lock().unwrap_or_else(PoisonError::into_inner).take();
        raised.map_or(run, Err)
    }

    /// How measures and channels change with numbers of the scenario, as `occupant sensitivity --json` prints it: exact
    /// derivatives of the measures `to` by the values at the paths `of`, each checked by runs beside it. `progress` as
    /// of `run`.
    #[pyo3(signature = (to, of, progress=None))]
    fn sensitivity(
        &self,
        py: Python<'_>,
        to: Vec<String>,
        of: Vec<String>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Py<PyAny>> {
        let progress = Progress::of(py, progress, "steps")?;
        let (opened, _) = self.opened(py, None)?;
        let answer = work(py, progress, |_| {
            let resolver = |file: &str| self.text.beside(file);
            let words = Words { to: &to, of: &of, channels: &[] };
            let asked = ask(&self.draft, &opened.model, &resolver, &words)?;
            let analysis = analyse(&opened.model, &asked, SHOW)?;
            Ok(answer(&file_name(&self.text.path), &opened.model, &asked, &analysis))
        });
        json_of(&answer?, py)
    }
}

impl Scenario {
    pub(crate) fn open(path: &Path) -> PyResult<Self> {
        // an error of the operating system is one of Python's
        let bytes = std::fs::read(path)?;
        let args = ScenarioArgs { scenario: path.to_owned(), overrides: Vec::new() };
        let source = source(&args).map_err(|failure| {
            let draft = Draft::read_bytes(&bytes, format_of(path), &path.display().to_string());
            draft.err().map_or_else(|| failed(failure), |wrong| refused(&wrong))
        })?;
        let text = Text { path: path.to_owned(), bytes: source.bytes, deck: source.deck };
        Ok(Scenario { draft: source.draft, text: Arc::new(text), changes: Vec::new(), forces: Vec::new() })
    }

    /// The scenario of a text with changes.
    pub(crate) fn of(text: Text, changes: Vec<String>) -> PyResult<Self> {
        let draft = match &text.deck {
            Some(deck) => Draft::read(&deck.toml, Format::Toml, &text.name()),
            None => Draft::read_bytes(&text.bytes, format_of(&text.path), &text.name()),
        };
        let draft = draft.map_err(|wrong| refused(&wrong))?;
        let mut scenario = Scenario { draft, text: Arc::new(text), changes: Vec::new(), forces: Vec::new() };
        changes.into_iter().try_for_each(|change| scenario.change(change))?;
        Ok(scenario)
    }

    pub(crate) fn has_forces(&self) -> bool {
        !self.forces.is_empty()
    }

    /// Everything that its run needs.
    pub(crate) fn to_run(&self, py: Python<'_>) -> PyResult<Opened> {
        Ok(self.opened(py, None)?.0)
    }

    fn change(&mut self, change: String) -> PyResult<()> {
        self.draft.set(&change).map_err(|wrong| refused(&wrong))?;
        self.changes.push(change);
        Ok(())
    }

    fn loaded(&self) -> Result<Loaded, Diagnostics> {
        self.draft.clone().load(&|file| self.text.beside(file))
    }

    fn model(&self) -> Result<(Model, Diagnostics), Diagnostics> {
        self.loaded()?.model()
    }

    /// Everything that a run needs, with Python forces; if it begins with `start`, the vehicle's motion is given during
    /// the run.
    fn opened(&self, py: Python<'_>, start: Option<VehicleState>) -> PyResult<(Opened, Trouble)> {
        let trouble = Trouble::default();
        let loaded = py.detach(|| self.loaded()).map_err(|wrong| refused(&wrong))?;
        let (model, warnings) = if self.forces.is_empty() && start.is_none() {
            py.detach(|| loaded.model()).map_err(|wrong| refused(&wrong))?
        } else {
            self.own_model(py, &loaded, start, &trouble)?
        };
        let (bytes, deck) = (self.text.bytes.clone(), self.text.deck.clone());
        Ok((Opened { bytes, loaded, model, warnings, deck }, trouble))
    }

    fn own_model(
        &self,
        py: Python<'_>,
        loaded: &Loaded,
        start: Option<VehicleState>,
        trouble: &Trouble,
    ) -> PyResult<(Model, Diagnostics)> {
        let (mut setup, warnings) = loaded.build().map_err(|wrong| refused(&wrong))?;
        if let Some(start) = start {
            let ahead = loaded.triggers_of_path();
            if !ahead.is_empty() {
                let names: Vec<String> = ahead.iter().map(|name| format!("triggers.{name}")).collect();
                let found = "triggers that need the path in advance, but it is given during the run";
                let expected = "triggers by time or by what a belt does";
                return Err(plain(format!("{}: {found}; expected {expected}", names.join(", "))));
            }
            setup.path = VehiclePath::live(start);
        }
        for force in &self.forces {
            setup.own_forces.push(force.own(py, &setup, trouble.clone())?);
        }
        let model = py.detach(|| Model::new(setup)).map_err(|problems| refused(&loaded.diagnose(&problems)))?;
        Ok((model, warnings))
    }
}

/// A name for a text of this format.
pub(crate) fn named(name: &str, format: &str) -> PyResult<String> {
    match format {
        "toml" | "json" => Ok(format!("{name}.{format}")),
        other => Err(plain(format!("format \"{other}\"; expected \"toml\" or \"json\""))),
    }
}

/// A text that was kept, converted again if it is a deck.
fn read(path: PathBuf, bytes: Vec<u8>) -> PyResult<Text> {
    let deck = (format_of(&path).is_none() && is_deck(&bytes)).then(|| from_deck(&path, &bytes));
    Ok(Text { deck: deck.transpose().map_err(failed)?, path, bytes })
}

/// Values of a row, one per path.
fn cells<'py>(row: &Bound<'py, PyAny>, paths: &[String]) -> PyResult<Vec<Bound<'py, PyAny>>> {
    let cells = row.try_iter()?.collect::<PyResult<Vec<_>>>()?;
    if cells.len() != paths.len() {
        return Err(plain(format!("a row of {} values for {} paths; expected one for each", cells.len(), paths.len())));
    }
    Ok(cells)
}

/// A value as a Python object.
fn written<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::Null => py.None().into_bound(py),
        Value::Bool(is) => is.into_bound_py_any(py)?,
        Value::Integer(whole) => whole.into_bound_py_any(py)?,
        Value::Float(number) => number.into_bound_py_any(py)?,
        Value::String(text) => text.into_bound_py_any(py)?,
        Value::Array(items) => {
            let items = items.iter().map(|item| written(py, &item.value)).collect::<PyResult<Vec<_>>>()?;
            PyList::new(py, items)?.into_any()
        }
        Value::Table(table) => {
            let dict = PyDict::new(py);
            for (key, entry) in table.iter() {
                dict.set_item(key, written(py, &entry.node.value)?)?;
            }
            dict.into_any()
        }
    })
}

//! Scenarios.

use std::path::{Path, PathBuf};
use std::sync::{Arc, PoisonError};

use numpy::IntoPyArray;
use occupant_core::model::Model;
use occupant_core::vehicle::{VehiclePath, VehicleState};
use occupant_scenario::{Diagnostics, Draft, Format};
use placed_text::Value;
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::batch::Batch;
use crate::convert::{assigned, json};
use crate::force::{Brought, Where};
use crate::live::{LiveRun, Trouble, state};
use crate::run::Run;
use crate::trouble::{plain, problems, refused};

/// A scenario: a TOML or JSON file, or a dict of its keys. Files that it refers to are searched in its folder.
#[pyclass(module = "occupant", skip_from_py_object)]
#[derive(Clone)]
pub(crate) struct Scenario {
    pub(crate) draft: Draft,
    folder: PathBuf,
    /// Forces defined in Python.
    forces: Vec<Arc<Brought>>,
}

#[pymethods]
impl Scenario {
    /// `source`: the path of a file, or a dict. Files of a dict are searched in the working folder.
    #[new]
    fn new(source: &Bound<'_, PyAny>) -> PyResult<Self> {
        if source.is_instance_of::<PyDict>() {
            return Self::from_text(&json(source)?, "json", PathBuf::new());
        }
        let path: PathBuf = source.extract()?;
        Self::open(&path)
    }

    /// A scenario from its text, `format` "toml" or "json"; files that it refers to are searched in `folder`.
    #[staticmethod]
    #[pyo3(signature = (text, format="toml", folder=PathBuf::new()))]
    fn from_text(text: &str, format: &str, folder: PathBuf) -> PyResult<Self> {
        let format = match format {
            "toml" => Format::Toml,
            "json" => Format::Json,
            other => return Err(plain(format!("format \"{other}\"; expected \"toml\" or \"json\""))),
        };
        let draft = Draft::read(text, format, "text").map_err(|wrong| refused(&wrong))?;
        Ok(Scenario::of(draft, folder))
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

    /// Adds a force of your own: `function(t, places, velocities)` gives a force for each of `places`, N. Places are spheres by name, or
    /// points `("head", [x, y, z])` of a segment, of "vehicle" or of "space", m. The function sees and says all in space axes: x
    /// forward, y left, z up. It must follow from what it is given.
    fn add_force(&mut self, name: String, places: Vec<Bound<'_, PyAny>>, function: Py<PyAny>) -> PyResult<()> {
        let places = places.iter().map(Where::of).collect::<PyResult<Vec<_>>>()?;
        self.forces.push(Arc::new(Brought { name, places, function }));
        Ok(())
    }

    /// A run that is stepped from outside. With `velocity` the vehicle begins with it, m/s, at `place`, m, turned by `attitude`, rad, and
    /// is told from then on how it moves: `LiveRun.push`.
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
        let (model, trouble) = self.own_model(py, start)?;
        Ok(LiveRun::of(model, trouble))
    }

    /// Changes a value, `scenario["path.speed"] = "30 mph"`: a number in the scenario's units, a text with its unit, a
    /// list, a dict; None removes it. `*` in the path matches any name.
    fn __setitem__(&mut self, path: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
        self.draft.set_value(path, &assigned(value)?).map_err(|wrong| refused(&wrong))
    }

    /// Removes a value.
    fn __delitem__(&mut self, path: &str) -> PyResult<()> {
        self.draft.set_value(path, "null").map_err(|wrong| refused(&wrong))
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
        let loaded = self.draft.clone().load(&|file| beside(&self.folder, file)).map_err(|wrong| refused(&wrong))?;
        loaded.scenario.to_toml().map_err(plain)
    }

    /// Runs it once for each row of `matrix`, an array or a list of lists, with the values of the row at `paths`: numbers in the
    /// scenario's units, texts with their unit. On `threads` threads, all cores if None, in lanes on each. Gives a table by columns: `run`,
    /// what was put at each path, `ending` ("completed", or why not) and every figure of a run in its SI unit, NaN where
    /// there is none. The rows are the same to the bit for any number of threads. Raises OccupantError where a row has not as many
    /// values as there are paths, a path is given twice, or the scenario has forces of Python's.
    #[pyo3(signature = (paths, matrix, threads=None))]
    fn batch<'py>(
        &self,
        py: Python<'py>,
        paths: Vec<String>,
        matrix: &Bound<'py, PyAny>,
        threads: Option<usize>,
    ) -> PyResult<Bound<'py, PyDict>> {
        if !self.forces.is_empty() {
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
            Ok(draft.load(&|file| beside(&self.folder, file))?.model()?.0)
        };
        Batch { model, count: rows.len() as u64 }.table(py, threads, |table, _| {
            for (place, path) in paths.iter().enumerate() {
                let column: Vec<_> = rows.iter().map(|row| &row[place]).collect();
                match column.iter().map(|cell| cell.extract().ok()).collect::<Option<Vec<f64>>>() {
                    Some(numbers) => table.set_item(path, numbers.into_pyarray(py))?,
                    None => table.set_item(path, column)?,
                }
            }
            Ok(())
        })
    }

    /// Runs the scenario. Other Python threads continue meanwhile.
    fn run(&self, py: Python<'_>) -> PyResult<Run> {
        if self.forces.is_empty() {
            return py.detach(|| Run::of(self.model().map_err(|wrong| refused(&wrong))?.0));
        }
        let (model, trouble) = self.own_model(py, None)?;
        let run = py.detach(|| Run::of(model))?;
        match trouble.lock().unwrap_or_else(PoisonError::into_inner).take() {
            Some(error) => Err(error),
            None => Ok(run),
        }
    }
}

impl Scenario {
    pub(crate) fn open(path: &Path) -> PyResult<Self> {
        let name = path.display().to_string();
        let bytes = std::fs::read(path)?;
        let draft = Draft::read_bytes(&bytes, format_of(path), &name).map_err(|wrong| refused(&wrong))?;
        Ok(Scenario::of(draft, path.parent().map(Path::to_owned).unwrap_or_default()))
    }

    pub(crate) fn of(draft: Draft, folder: PathBuf) -> Self {
        Scenario { draft, folder, forces: Vec::new() }
    }

    /// The model with Python forces; if it begins with `start`, the vehicle's motion is given during the run.
    fn own_model(&self, py: Python<'_>, start: Option<VehicleState>) -> PyResult<(Model, Trouble)> {
        let loaded = self.draft.clone().load(&|file| beside(&self.folder, file)).map_err(|wrong| refused(&wrong))?;
        let (mut setup, _) = loaded.build().map_err(|wrong| refused(&wrong))?;
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
        let trouble = Trouble::default();
        for force in &self.forces {
            setup.own_forces.push(force.own(py, &setup, trouble.clone())?);
        }
        let model = py.detach(|| Model::new(setup)).map_err(|problems| refused(&loaded.diagnose(&problems)))?;
        Ok((model, trouble))
    }

    fn model(&self) -> Result<(Model, Diagnostics), Diagnostics> {
        self.draft.clone().load(&|file| beside(&self.folder, file))?.model()
    }
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

/// The format for a file's extension, if any.
pub(crate) fn format_of(path: &Path) -> Option<Format> {
    match path.extension()?.to_str()? {
        "toml" => Some(Format::Toml),
        "json" => Some(Format::Json),
        _ => None,
    }
}

/// A file in the folder of a scenario.
pub(crate) fn beside(folder: &Path, file: &str) -> Result<Vec<u8>, String> {
    std::fs::read(folder.join(file)).map_err(|error| error.to_string())
}

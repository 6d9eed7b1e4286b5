//! Scenarios.

use std::path::{Path, PathBuf};

use occupant_core::model::Model;
use occupant_scenario::{Diagnostics, Draft, Format};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::convert::{assigned, json};
use crate::run::Run;
use crate::trouble::{plain, problems, refused};

/// A scenario: a file in TOML or JSON, or a dict of its keys. Files that it names are looked for beside it.
#[pyclass(module = "occupant", skip_from_py_object)]
#[derive(Clone)]
pub(crate) struct Scenario {
    pub(crate) draft: Draft,
    folder: PathBuf,
}

#[pymethods]
impl Scenario {
    /// `source`: the path of a file, or a dict. A dict's files are looked for in the working folder.
    #[new]
    fn new(source: &Bound<'_, PyAny>) -> PyResult<Self> {
        if source.is_instance_of::<PyDict>() {
            return Self::from_text(&json(source)?, "json", PathBuf::new());
        }
        let path: PathBuf = source.extract()?;
        Self::open(&path)
    }

    /// A scenario from its text, `format` "toml" or "json"; files that it names are looked for in `folder`.
    #[staticmethod]
    #[pyo3(signature = (text, format="toml", folder=PathBuf::new()))]
    fn from_text(text: &str, format: &str, folder: PathBuf) -> PyResult<Self> {
        let format = match format {
            "toml" => Format::Toml,
            "json" => Format::Json,
            other => return Err(plain(format!("format \"{other}\"; expected \"toml\" or \"json\""))),
        };
        let draft = Draft::read(text, format, "text").map_err(|wrong| refused(&wrong))?;
        Ok(Scenario { draft, folder })
    }

    /// Changes a value, `scenario["path.speed"] = "30 mph"`: a number in the scenario's units, a text with its unit, a list,
    /// a dict; None takes it away. A star in the path stands for any name.
    fn __setitem__(&mut self, path: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
        self.draft.set_value(path, &assigned(value)?).map_err(|wrong| refused(&wrong))
    }

    /// Takes a value away.
    fn __delitem__(&mut self, path: &str) -> PyResult<()> {
        self.draft.set_value(path, "null").map_err(|wrong| refused(&wrong))
    }

    /// The same scenario, to be changed apart.
    fn copy(&self) -> Self {
        self.clone()
    }

    fn __copy__(&self) -> Self {
        self.clone()
    }

    fn __deepcopy__(&self, _memo: &Bound<'_, PyAny>) -> Self {
        self.clone()
    }

    /// What there is to warn of, as `OccupantError.problems`; raises OccupantError if anything is wrong.
    fn check<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let (_, warnings) = self.model().map_err(|wrong| refused(&wrong))?;
        problems(py, &warnings)
    }

    /// The scenario with all that is changed and expanded, in TOML.
    fn to_toml(&self) -> PyResult<String> {
        let loaded = self.draft.clone().load(&|file| beside(&self.folder, file)).map_err(|wrong| refused(&wrong))?;
        loaded.scenario.to_toml().map_err(plain)
    }

    /// Simulates it. Other threads of Python go on meanwhile.
    fn run(&self, py: Python<'_>) -> PyResult<Run> {
        py.detach(|| Run::of(self.model().map_err(|wrong| refused(&wrong))?.0))
    }
}

impl Scenario {
    pub(crate) fn open(path: &Path) -> PyResult<Self> {
        let name = path.display().to_string();
        let bytes = std::fs::read(path)?;
        let draft = Draft::read_bytes(&bytes, format_of(path), &name).map_err(|wrong| refused(&wrong))?;
        Ok(Scenario { draft, folder: path.parent().map(Path::to_owned).unwrap_or_default() })
    }

    pub(crate) fn of(draft: Draft, folder: PathBuf) -> Self {
        Scenario { draft, folder }
    }

    fn model(&self) -> Result<(Model, Diagnostics), Diagnostics> {
        self.draft.clone().load(&|file| beside(&self.folder, file))?.model()
    }
}

/// The format that a file's ending says, if it says one.
pub(crate) fn format_of(path: &Path) -> Option<Format> {
    match path.extension()?.to_str()? {
        "toml" => Some(Format::Toml),
        "json" => Some(Format::Json),
        _ => None,
    }
}

/// A file that stands beside a scenario.
pub(crate) fn beside(folder: &Path, file: &str) -> Result<Vec<u8>, String> {
    std::fs::read(folder.join(file)).map_err(|error| error.to_string())
}

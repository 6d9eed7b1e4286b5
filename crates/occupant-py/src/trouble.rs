//! Errors as exceptions.

use occupant_jobs::base::Failure;
use occupant_scenario::Diagnostics;
use placed_text::Severity;
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

create_exception!(
    occupant,
    OccupantError,
    PyValueError,
    "A scenario or study that is wrong, or a run that failed. `problems` lists what is wrong: dicts of `severity`, `path`, \
     `found`, `expected`, `source`, `line` and `column`."
);

/// A one-line problem.
pub(crate) fn plain(message: impl std::fmt::Display) -> PyErr {
    told(message.to_string(), &Diagnostics::new())
}

/// All problems, with their positions.
pub(crate) fn refused(diagnostics: &Diagnostics) -> PyErr {
    told(diagnostics.to_string(), diagnostics)
}

/// The failure of a job, with the message of the command.
pub(crate) fn failed(failure: Failure) -> PyErr {
    plain(failure.words())
}

fn told(message: String, diagnostics: &Diagnostics) -> PyErr {
    let error = OccupantError::new_err(message);
    Python::attach(|py| {
        // an exception takes any attribute
        let _ = problems(py, diagnostics).and_then(|list| error.value(py).setattr("problems", list));
    });
    error
}

/// Problems as a list of dicts.
pub(crate) fn problems<'py>(py: Python<'py>, diagnostics: &Diagnostics) -> PyResult<Bound<'py, PyList>> {
    let list = PyList::empty(py);
    for one in diagnostics.iter() {
        let dict = PyDict::new(py);
        let severity = if one.problem.severity == Severity::Error { "error" } else { "warning" };
        dict.set_item("severity", severity)?;
        dict.set_item("path", &one.problem.path)?;
        dict.set_item("found", &one.problem.found)?;
        dict.set_item("expected", &one.problem.expected)?;
        dict.set_item("source", &one.source)?;
        dict.set_item("line", one.position.map(|at| at.line))?;
        dict.set_item("column", one.position.map(|at| at.column))?;
        list.append(dict)?;
    }
    Ok(list)
}

//! Python's values as texts of scenarios.

use pyo3::prelude::*;
use pyo3::types::PyString;
use pythonize::depythonize;

use crate::trouble::plain;

/// A value as an override is written: TOML, or `null`, which takes away.
pub(crate) fn assigned(value: &Bound<'_, PyAny>) -> PyResult<String> {
    if value.is_none() {
        return Ok("null".to_owned());
    }
    if value.is_instance_of::<PyString>() {
        // a text is one, whatever it looks like
        return Ok(toml::Value::String(value.extract()?).to_string());
    }
    let value: toml::Value = depythonize(&plainly(value)?)?;
    Ok(value.to_string())
}

/// A dict as the text of a scenario.
pub(crate) fn json(dict: &Bound<'_, PyAny>) -> PyResult<String> {
    let value: serde_json::Value = depythonize(&plainly(dict)?)?;
    serde_json::to_string_pretty(&value).map_err(plain)
}

/// NumPy's numbers and arrays as Python's.
fn plainly<'py>(value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    if value.hasattr("tolist")? { value.call_method0("tolist") } else { Ok(value.clone()) }
}

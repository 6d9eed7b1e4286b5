//! Python's values as texts of scenarios.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyString, PyTuple};
use pythonize::depythonize;

use crate::trouble::plain;

/// A value as an override: TOML, or `null`, which removes it.
pub(crate) fn assigned(value: &Bound<'_, PyAny>) -> PyResult<String> {
    if value.is_none() {
        return Ok("null".to_owned());
    }
    if value.is_instance_of::<PyString>() {
        // a text is one, whatever it looks like
        return Ok(toml::Value::String(value.extract()?).to_string());
    }
    bounded(value, &mut Vec::new())?;
    let value: toml::Value = depythonize(&plainly(value)?)?;
    Ok(value.to_string())
}

/// A dict as the text of a scenario.
pub(crate) fn json(dict: &Bound<'_, PyAny>) -> PyResult<String> {
    bounded(dict, &mut Vec::new())?;
    let value: serde_json::Value = depythonize(&plainly(dict)?)?;
    serde_json::to_string_pretty(&value).map_err(plain)
}

/// Largest nesting depth of a scenario.
const DEEPEST: usize = 64;

/// Refuses recursive and deeply nested values.
fn bounded(value: &Bound<'_, PyAny>, within: &mut Vec<usize>) -> PyResult<()> {
    let id = value.as_ptr() as usize;
    if within.contains(&id) {
        return Err(plain("a dict or list that contains itself; expected one that ends"));
    }
    if within.len() > DEEPEST {
        return Err(plain(format!("dicts and lists nested deeper than {DEEPEST}; expected a scenario")));
    }
    within.push(id);
    if let Ok(dict) = value.cast::<PyDict>() {
        dict.iter().try_for_each(|(_, item)| bounded(&item, within))?;
    } else if let Ok(list) = value.cast::<PyList>() {
        list.iter().try_for_each(|item| bounded(&item, within))?;
    } else if let Ok(tuple) = value.cast::<PyTuple>() {
        tuple.iter().try_for_each(|item| bounded(&item, within))?;
    }
    within.pop();
    Ok(())
}

/// NumPy numbers and arrays as Python's.
fn plainly<'py>(value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    if value.hasattr("tolist")? { value.call_method0("tolist") } else { Ok(value.clone()) }
}

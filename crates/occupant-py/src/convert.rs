//! Python's values as texts of scenarios.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyFloat, PyList, PyString, PyTuple};
use pythonize::depythonize;

use crate::trouble::plain;

/// A value as an override: TOML, or `null`, which removes it.
pub(crate) fn assigned(value: &Bound<'_, PyAny>) -> PyResult<String> {
    if value.is_none() {
        return Ok("null".to_owned());
    }
    if value.is_instance_of::<PyString>() {
        // a text is one, whatever it looks like, and in one line
        let text: String = value.extract()?;
        let quoted = toml::Value::String(text.replace('\n', " ")).to_string();
        return Ok(if text.contains('\n') { serde_json::Value::from(text).to_string() } else { quoted });
    }
    bounded(value, &mut Vec::new(), &|_| Ok(()))?;
    let value = plainly(value)?;
    bounded(&value, &mut Vec::new(), &|_| Ok(()))?;
    let value: toml::Value = depythonize(&value)?;
    Ok(value.to_string())
}

/// A value as the command line has it: a text without quotes where it stays one.
pub(crate) fn spoken(value: &Bound<'_, PyAny>) -> PyResult<String> {
    match value.extract::<String>() {
        Ok(text) if is_text(&text) => Ok(text),
        _ => assigned(value),
    }
}

/// Whether a text without quotes is read as itself, not as a value of TOML.
fn is_text(text: &str) -> bool {
    let is_value = toml::from_str::<toml::Table>(&format!("a = {text}")).is_ok();
    let is_plain = !text.is_empty() && text == text.trim() && !text.contains(char::is_control);
    is_plain && !is_value && text != "null" && text.parse::<f64>().is_err()
}

/// Changes as `--set` has them: a dict of values by path, or texts `path=value`.
pub(crate) fn changes(given: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<String>> {
    let Some(given) = given else { return Ok(Vec::new()) };
    if let Ok(dict) = given.cast::<PyDict>() {
        let change = |(path, value): (Bound<'_, PyAny>, _)| change(&path.extract::<String>()?, &value);
        return dict.iter().map(change).collect();
    }
    if given.is_instance_of::<PyString>() {
        return Err(plain("overrides as one text; expected a dict {path: value} or a list [\"path=value\"]"));
    }
    given.try_iter()?.map(|text| text?.extract::<String>()).collect()
}

/// One of them.
pub(crate) fn change(path: &str, value: &Bound<'_, PyAny>) -> PyResult<String> {
    if path.contains('=') {
        return Err(plain(format!("path {path:?} has a `=`; expected a path such as belts.lap.slack")));
    }
    Ok(format!("{path}={}", spoken(value)?))
}

/// What `--json` prints, as dicts and lists.
pub(crate) fn json_of(value: &impl serde::Serialize, py: Python<'_>) -> PyResult<Py<PyAny>> {
    Ok(pythonize::pythonize(py, value)?.unbind())
}

/// One of the names of a table.
pub(crate) fn one_of<T: Copy>(what: &str, name: &str, table: &[(&str, &str, T)]) -> PyResult<T> {
    let names = || table.iter().map(|row| row.0).collect::<Vec<_>>();
    let found = table.iter().find(|row| row.0 == name).map(|row| row.2);
    found.ok_or_else(|| plain(format!("{what} {name:?}; expected one of {}", names().join(", "))))
}

/// A dict as the text of a scenario.
pub(crate) fn json(dict: &Bound<'_, PyAny>) -> PyResult<String> {
    bounded(dict, &mut Vec::new(), &|_| Ok(()))?;
    let dict = plainly(dict)?;
    // JSON would leave it out
    bounded(&dict, &mut Vec::new(), &|leaf| match leaf.cast::<PyFloat>() {
        Ok(number) if !number.value().is_finite() => {
            let found = number.value();
            Err(plain(format!("{found} in a dict; expected finite numbers")))
        }
        _ => Ok(()),
    })?;
    let value: serde_json::Value = depythonize(&dict)?;
    serde_json::to_string_pretty(&value).map_err(plain)
}

/// Largest nesting depth of a scenario.
const DEEPEST: usize = 64;

/// Refuses recursive and deeply nested values, and leaves that `check` refuses.
fn bounded(
    value: &Bound<'_, PyAny>,
    within: &mut Vec<usize>,
    check: &dyn Fn(&Bound<'_, PyAny>) -> PyResult<()>,
) -> PyResult<()> {
    let id = value.as_ptr() as usize;
    if within.contains(&id) {
        return Err(plain("a dict or list that contains itself; expected one that ends"));
    }
    if within.len() > DEEPEST {
        return Err(plain(format!("dicts and lists nested deeper than {DEEPEST}; expected a scenario")));
    }
    within.push(id);
    if let Ok(dict) = value.cast::<PyDict>() {
        dict.iter().try_for_each(|(_, item)| bounded(&item, within, check))?;
    } else if let Ok(list) = value.cast::<PyList>() {
        list.iter().try_for_each(|item| bounded(&item, within, check))?;
    } else if let Ok(tuple) = value.cast::<PyTuple>() {
        tuple.iter().try_for_each(|item| bounded(&item, within, check))?;
    } else {
        check(value)?;
    }
    within.pop();
    Ok(())
}

/// NumPy's numbers and arrays as Python's and paths as texts, also within dicts and lists.
fn plainly<'py>(value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let py = value.py();
    if let Ok(dict) = value.cast::<PyDict>() {
        let plain = PyDict::new(py);
        dict.iter().try_for_each(|(key, item)| plain.set_item(key, plainly(&item)?))?;
        return Ok(plain.into_any());
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        let items = value.try_iter()?.map(|item| plainly(&item?)).collect::<PyResult<Vec<_>>>()?;
        return Ok(PyList::new(py, items)?.into_any());
    }
    match ["tolist", "__fspath__"].into_iter().find(|name| value.hasattr(*name).unwrap_or_default()) {
        Some(name) => value.call_method0(name),
        None => Ok(value.clone()),
    }
}

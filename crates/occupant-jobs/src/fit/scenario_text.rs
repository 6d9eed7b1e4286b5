//! The scenario with the numbers of a fit, as its author would have written it: comments, order and units stay.
//!
//! The numbers are inserted into the text. The text is used only if it gives the same scenario as the program's own
//! changes; otherwise (a list that only a preset has, a text in JSON) the scenario is written anew.

use occupant_scenario::{Draft, Format, Scenario};
use occupant_study::{Assignment, Parameter};
use serde::Serialize;
use toml_edit::{Item, Table, value};

use super::Experiment;
use crate::files::edited::with_changes;
use crate::files::scenario::format_of;

/// Significant digits of fitted numbers.
const DIGITS: usize = 6;

/// A fitted value written to a scenario.
#[derive(Clone, Debug, Serialize)]
pub struct Fitted {
    /// The file of that scenario.
    pub fitted: String,
    /// The path.
    pub path: String,
    /// Its text.
    pub text: String,
    /// Index of its parameter.
    #[serde(skip)]
    pub parameter: usize,
}

/// Values that the parameters (SI) set in the scenario of an experiment, rounded, each in the unit of its path.
///
/// # Errors
/// A place at which no number can be written.
pub fn numbers(experiment: &Experiment, values: &[f64]) -> Result<Vec<Fitted>, String> {
    let study = &experiment.study;
    let of = |path: &str| {
        let acts = |p: &Parameter| p.targets.iter().any(|t| t.path == path);
        study.parameters.iter().rposition(acts).unwrap_or(0)
    };
    let number = |Assignment { path, value, .. }: Assignment| {
        let occupant_study::Value::Number(si) = value else {
            return Err(format!("`{path}` is not a number"));
        };
        let text = study.base.written(&path, si, DIGITS);
        let text = text.ok_or_else(|| format!("`{path}` cannot be a number"))?;
        Ok(Fitted { fitted: experiment.fitted.clone(), parameter: of(&path), path, text })
    };
    study.assignments_of(values).into_iter().map(number).collect()
}

/// The scenario of an experiment with these values and their provenance, TOML, and whether the author's text was kept.
///
/// # Errors
/// Numbers that the scenario refuses.
pub fn fitted(
    experiment: &Experiment,
    numbers: &[&Fitted],
    provenance: &[(String, String)],
    head: &str,
) -> Result<(String, bool), String> {
    let changes = numbers.iter().map(|n| (&n.path, &n.text));
    let (loaded, ..) = experiment.scenario_with(changes).map_err(|e| e.to_string())?;
    let mut wanted = loaded.scenario;
    wanted.provenance.extend(provenance.iter().cloned());
    let format = format_of(&experiment.scenario);
    let is_toml = format.unwrap_or_else(|| Format::of_text(&experiment.text)) == Format::Toml;
    let edited = is_toml.then(|| edited(experiment, numbers, provenance)).flatten();
    let (text, kept) = match edited.filter(|text| says(experiment, text, &wanted)) {
        Some(text) => (text, true),
        None => (wanted.to_toml().map_err(|e| e.to_string())?, false),
    };
    Ok((format!("{head}{text}"), kept))
}

/// Whether a text defines this scenario.
fn says(experiment: &Experiment, text: &str, wanted: &Scenario) -> bool {
    let draft = Draft::read(text, Format::Toml, "fitted");
    let found = draft.and_then(|draft| experiment.tables.open(draft));
    found.is_ok_and(|(loaded, ..)| loaded.scenario == *wanted)
}

/// The author's text with all changes by the study, the command line and the fit.
fn edited(experiment: &Experiment, numbers: &[&Fitted], provenance: &[(String, String)]) -> Option<String> {
    let changes = experiment.study.changes.iter().map(|(path, text)| (path.as_str(), text.as_str()));
    let numbers = numbers.iter().map(|n| (n.path.as_str(), n.text.as_str()));
    let mut document = with_changes(&experiment.text, changes.chain(numbers), &experiment.study.base)?;
    if !provenance.is_empty() {
        let table = document.entry("provenance");
        let table = table.or_insert(Item::Table(Table::new())).as_table_like_mut()?;
        for (path, words) in provenance {
            table.insert(path, value(words.as_str()));
        }
    }
    Some(document.to_string())
}

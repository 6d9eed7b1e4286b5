//! The scenario with the numbers of a fit, as its author would have written it: comments, order and units stay.
//!
//! The numbers are put into the text itself. The text counts only if it says the same scenario as the program's own
//! changes do; where it cannot (a list that only a preset has, a text in JSON), the scenario is written anew.

use occupant_core::scenario::text::{Step, parse_path};
use occupant_core::scenario::{Draft, Format, Scenario};
use occupant_study::Parameter;
use toml_edit::{DocumentMut, InlineTable, Item, Table, TableLike, Value, value};

use super::experiment::{Experiment, opened};
use crate::files::scenario::format_of;

/// Significant digits of fitted numbers.
const DIGITS: usize = 6;

/// A number that a fit has put into a scenario.
#[derive(Clone, Debug)]
pub(crate) struct Fitted {
    pub(crate) path: String,
    /// As it is written.
    pub(crate) text: String,
    /// Which parameter it comes from.
    pub(crate) parameter: usize,
}

#[derive(Clone, Debug)]
pub(crate) struct FittedText {
    /// The text, TOML.
    pub(crate) text: String,
    /// Whether the author's words were kept.
    pub(crate) kept: bool,
}

/// The numbers that values of the parameters (SI) put into the scenario of an experiment, each in the unit of its place and
/// rounded.
///
/// # Errors
/// A place at which no number can be written.
pub(crate) fn numbers(experiment: &Experiment, values: &[f64]) -> Result<Vec<Fitted>, String> {
    let study = &experiment.study;
    let of = |path: &str| {
        let acts = |p: &Parameter| p.targets.iter().any(|t| t.path == path);
        let last = study.parameters().iter().rposition(acts);
        last.unwrap_or(0)
    };
    study
        .assignments_of(values)
        .into_iter()
        .map(|assignment| {
            let occupant_study::Value::Number(si) = assignment.value else {
                return Err(format!("`{}` is no number", assignment.path));
            };
            let text = study.base().written(&assignment.path, si, DIGITS);
            let text = text.ok_or_else(|| format!("no number can stand at `{}`", assignment.path))?;
            Ok(Fitted { parameter: of(&assignment.path), path: assignment.path, text })
        })
        .collect()
}

/// The scenario of an experiment with these numbers and their provenance.
///
/// # Errors
/// Numbers that the scenario refuses.
pub(crate) fn fitted(
    experiment: &Experiment,
    numbers: &[Fitted],
    provenance: &[(String, String)],
    head: &str,
) -> Result<FittedText, String> {
    let mut draft = experiment.study.base().clone();
    for number in numbers {
        let set = draft.set_value(&number.path, &number.text);
        set.map_err(|e| e.to_string())?;
    }
    let (loaded, ..) = opened(draft, &experiment.tables).map_err(|e| e.to_string())?;
    let mut wanted = loaded.scenario;
    for (path, words) in provenance {
        wanted.provenance.insert(path.clone(), words.clone());
    }
    let format = format_of(&experiment.scenario);
    let is_toml = format.unwrap_or_else(|| Format::of_text(&experiment.text)) == Format::Toml;
    let edited = is_toml.then(|| edited(experiment, numbers, provenance)).flatten();
    if let Some(text) = edited.filter(|text| says(experiment, text, &wanted)) {
        return Ok(FittedText { text: format!("{head}{text}"), kept: true });
    }
    let text = wanted.to_toml().map_err(|e| e.to_string())?;
    Ok(FittedText { text: format!("{head}{text}"), kept: false })
}

/// Whether a text says this scenario.
fn says(experiment: &Experiment, text: &str, wanted: &Scenario) -> bool {
    let draft = Draft::read(text, Format::Toml, "fitted");
    let found = draft.and_then(|draft| opened(draft, &experiment.tables));
    found.is_ok_and(|(loaded, ..)| loaded.scenario == *wanted)
}

/// The author's text with everything put in that the study, the command line and the fit have changed.
fn edited(experiment: &Experiment, numbers: &[Fitted], provenance: &[(String, String)]) -> Option<String> {
    let mut document: DocumentMut = experiment.text.parse().ok()?;
    let changes = experiment.study.changes().iter();
    let numbers = numbers.iter().map(|n| (&n.path, &n.text));
    for (path, text) in changes.map(|(p, t)| (p, t)).chain(numbers) {
        let new = text.parse().unwrap_or_else(|_| Value::from(text.as_str()));
        // a path with wildcards stands for many places
        let places = if path.contains('*') { experiment.study.base().places(path).ok()? } else { Vec::new() };
        let mut paths: Vec<&str> = places.iter().map(|p| p.path.as_str()).collect();
        if paths.is_empty() {
            paths.push(path);
        }
        for path in paths {
            put(document.as_item_mut(), &parse_path(path).ok()?, new.clone())?;
        }
    }
    if !provenance.is_empty() {
        let table = document.entry("provenance");
        let table = table.or_insert(Item::Table(Table::new())).as_table_like_mut()?;
        for (path, words) in provenance {
            table.insert(path, value(words.as_str()));
        }
    }
    Some(document.to_string())
}

/// Puts a value at a place; none where the text has no such place and none can be made.
fn put(item: &mut Item, steps: &[Step], new: Value) -> Option<()> {
    let (step, rest) = steps.split_first()?;
    let inline = item.is_inline_table();
    if let Step::Key(key) = step
        && let Some(table) = item.as_table_like_mut()
    {
        return put_in_table(table, inline, key, rest, new);
    }
    match (step, item) {
        (Step::Index(i), Item::Value(Value::Array(array))) => put_in_value(array.get_mut(*i)?, rest, new),
        (Step::Index(i), Item::ArrayOfTables(tables)) => {
            let table = tables.get_mut(*i)?;
            let (Step::Key(key), rest) = rest.split_first()? else {
                return None;
            };
            put_in_table(table, false, key, rest, new)
        }
        (Step::Key(name), Item::ArrayOfTables(tables)) => {
            let named = |t: &&mut Table| t.get("name").and_then(Item::as_str) == Some(name);
            let table = tables.iter_mut().find(named)?;
            let (Step::Key(key), rest) = rest.split_first()? else {
                return None;
            };
            put_in_table(table, false, key, rest, new)
        }
        _ => None,
    }
}

fn put_in_table(table: &mut dyn TableLike, inline: bool, key: &str, rest: &[Step], new: Value) -> Option<()> {
    if !table.contains_key(key) {
        let blank = match (rest.is_empty(), inline) {
            (true, _) => Item::Value(new.clone()),
            (false, true) => value(InlineTable::new()),
            (false, false) => Item::Table(Table::new()),
        };
        table.insert(key, blank);
    }
    let item = table.get_mut(key)?;
    match (rest.is_empty(), item) {
        (false, item) => put(item, rest, new),
        (true, Item::Value(old)) => {
            replace(old, new);
            Some(())
        }
        (true, _) => None,
    }
}

fn put_in_value(old: &mut Value, rest: &[Step], new: Value) -> Option<()> {
    let Some((step, rest)) = rest.split_first() else {
        replace(old, new);
        return Some(());
    };
    match (step, old) {
        (Step::Key(key), Value::InlineTable(table)) => put_in_table(table, true, key, rest, new),
        (Step::Index(i), Value::Array(array)) => put_in_value(array.get_mut(*i)?, rest, new),
        _ => None,
    }
}

/// A new value with the blanks and comments of the old one.
fn replace(old: &mut Value, mut new: Value) {
    *new.decor_mut() = old.decor().clone();
    *old = new;
}

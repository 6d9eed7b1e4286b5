//! Every value that the scenario or a change sets, with its line and the value that holds without it.

use occupant_files::results::Results;
use occupant_scenario::{Draft, Format};
use placed_text::{Document, Node, Step, Value, children, to_text};

/// A value that was set: its key, the value, where it stands, and what would hold without it, if a preset has one.
#[derive(Debug, PartialEq)]
pub(super) struct Input {
    pub path: String,
    pub value: String,
    pub place: String,
    pub default: String,
}

/// The values of the scenario as written, then the changes to it. Nothing for a deck of cards: its expanded scenario is it.
pub(super) fn inputs(results: &Results) -> Vec<Input> {
    let name = results.run.get("scenario").cloned().unwrap_or_default();
    let text = results.scenario_text.clone().unwrap_or_default();
    let format = if name.ends_with(".json") { Format::Json } else { Format::Toml };
    let mut found = Vec::new();
    if let (Ok(document), Ok(draft)) = (Document::read(&text, format, &name), Draft::read(&text, format, &name)) {
        leaves(&document.root, &mut Vec::new(), &mut |steps, node| {
            let path = to_text(steps);
            let line = document.sources.position(node.span).line;
            let value = document.sources.slice(node.span).to_owned();
            found.push(Input { default: without(&draft, &path), path, value, place: format!("{name}:{line}") });
        });
    }
    let changes = results.run.get("overrides").map(String::as_str).unwrap_or_default();
    for (path, value) in changes.lines().filter_map(|change| change.split_once('=')) {
        let (path, value) = (path.trim().to_owned(), value.trim().to_owned());
        let before = found.iter().find(|own| own.path == path).map(|own| own.value.clone());
        found.push(Input { path, value, place: "--set".to_owned(), default: before.unwrap_or_default() });
    }
    found
}

/// The value of a preset that the key replaces; empty if there is none.
fn without(draft: &Draft, path: &str) -> String {
    let mut bare = draft.clone();
    let places = bare.set(&format!("{path}=null")).ok().and_then(|()| bare.places(path).ok());
    let value = places.and_then(|places| places.into_iter().next()).and_then(|place| place.value);
    match value {
        Some(Value::String(text)) => text,
        Some(Value::Float(number)) => number.to_string(),
        Some(Value::Integer(number)) => number.to_string(),
        Some(Value::Bool(truth)) => truth.to_string(),
        _ => String::new(),
    }
}

/// Every value that is no table; a list is one value.
fn leaves(node: &Node, path: &mut Vec<Step>, see: &mut impl FnMut(&[Step], &Node)) {
    if node.as_table().is_none() {
        return see(path, node);
    }
    for (step, below) in children(node) {
        path.push(step);
        leaves(below, path, see);
        path.pop();
    }
}

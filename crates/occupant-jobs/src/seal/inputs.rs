//! Every value that the scenario or a change sets, with its line and the value that holds without it.

use crate::keys::{Key, key_of};
use occupant_files::results::Results;
use occupant_scenario::{Draft, Format, rival_path, schema};
use placed_text::{Document, Node, Step, Value, children, follow, parse_path, to_text};

/// A value that was set: its key, the value, where it stands, and what would hold without it, if a preset has one.
#[derive(Debug, PartialEq)]
pub(super) struct Input {
    pub path: String,
    pub value: String,
    pub place: String,
    pub default: String,
    /// What the key means, and what holds if it is absent.
    pub meaning: String,
}

/// Keys that choose what stands below or beside them: without them there is no preset to speak of.
const CHOOSE: [&str; 5] = ["preset", "kind", "class", "library", "units"];

/// The values of the scenario as written, then the changes to it. Nothing for a deck of cards: its expanded scenario is it.
pub(super) fn inputs(results: &Results) -> Vec<Input> {
    let name = results.run.get("scenario").cloned().unwrap_or_default();
    let text = results.scenario_text.clone().unwrap_or_default();
    let format = if name.ends_with(".json") { Format::Json } else { Format::Toml };
    let mut found = written(&text, format, &name).unwrap_or_default();
    let changes = results.run.get("overrides").map(String::as_str).unwrap_or_default();
    for (path, value) in changes.lines().filter_map(|change| change.split_once('=')) {
        let (path, value) = (path.trim().to_owned(), value.trim().to_owned());
        let before = found.iter().rfind(|own| own.path == path).map(|own| own.value.clone());
        let (place, default) = ("--set".to_owned(), before.unwrap_or_default());
        found.push(Input { path, value, place, default, meaning: String::new() });
    }
    explain(&mut found);
    found
}

/// Adds the meanings of the keys; of keys that a kind of section has, those of the kind that is set.
fn explain(inputs: &mut [Input]) {
    let keys = Key::root(schema()).all();
    let set: Vec<(String, String)> = inputs.iter().map(|own| (own.path.clone(), own.value.clone())).collect();
    for input in inputs {
        let is_set =
            |kind: &str, word: &str| set.iter().any(|(path, value)| path == kind && value.trim_matches('"') == word);
        input.meaning = key_of(&keys, &input.path, &is_set).map(Key::meaning).unwrap_or_default();
    }
}

/// The values of a text, each beside that of the presets alone; the text is expanded once for numbers and lists, once for
/// words.
fn written(text: &str, format: Format, name: &str) -> Option<Vec<Input>> {
    let document = Document::read(text, format, name).ok()?;
    let draft = Draft::read(text, format, name).ok()?;
    let presets = [false, true].map(|words| draft.without(&|steps, node| is_word(node) == words && !chooses(steps)));
    let mut found = Vec::new();
    leaves(&document.root, &mut Vec::new(), &mut |steps, node| {
        let place = format!("{name}:{}", document.sources.position(node.span).line);
        let value = document.sources.slice(node.span).to_owned();
        let of = &presets[usize::from(is_word(node))];
        let default = if chooses(steps) { String::new() } else { preset(of, steps) };
        found.push(Input { path: to_text(steps), value, place, default, meaning: String::new() });
    });
    Some(found)
}

/// Whether a value is a word or true or false, not a number, a quantity or a list.
fn is_word(node: &Node) -> bool {
    match &node.value {
        Value::String(text) => !text.contains(|c: char| c.is_ascii_digit()),
        value => matches!(value, Value::Bool(_)),
    }
}

fn chooses(steps: &[Step]) -> bool {
    matches!(steps.last(), Some(Step::Key(key)) if CHOOSE.contains(&key.as_str()))
}

/// The value that stands at a place without the scenario's, as written in a preset; that of its rival with its key, such as
/// `weight = 10 lbf` for a mass; empty if there is none.
fn preset(of: &Document, steps: &[Step]) -> String {
    let own = follow(&of.root, steps).map(|node| of.sources.slice(node.span).to_owned());
    let rival = || {
        let rival = parse_path(&rival_path(&to_text(steps))?).ok()?;
        let node = follow(&of.root, &rival)?;
        Some(format!("{} = {}", to_text(&rival[rival.len() - 1..]), of.sources.slice(node.span)))
    };
    own.or_else(rival).unwrap_or_default()
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

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r#"
title = "A case"
[body]
preset = "male50"
segments.head = { mass = "5 kg" }
[joints]
preset = "male50"
neck = { friction = 1.5 }
[contact]
skin = "flesh"
[time]
end = 0.1
"#;

    fn of(path: &str) -> Input {
        let found = written(TEXT, Format::Toml, "case.toml").expect("inputs");
        let mut found = found.into_iter().filter(|input| input.path == path);
        found.next().expect("the value is listed")
    }

    #[test]
    fn each_value_has_its_line_and_what_the_preset_has_instead() {
        let preset = of("body.preset");
        assert_eq!((&*preset.value, &*preset.place, &*preset.default), ("\"male50\"", "case.toml:4", ""));
        let mass = of("body.segments.head.mass");
        assert_eq!((&*mass.value, &*mass.place), ("\"5 kg\"", "case.toml:5"));
        assert!(!mass.default.is_empty() && !mass.default.contains("5 kg"), "{}", mass.default);
        // nothing gives it but the scenario
        assert_eq!(of("time.end").default, "");
        let mut found = [of("body.segments.head.mass")];
        explain(&mut found);
        assert!(found[0].meaning.contains("ass"), "{}", found[0].meaning);
    }
}

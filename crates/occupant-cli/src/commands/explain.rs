//! `occupant explain`: the keys of scenarios and studies in words, read off their JSON Schema.

use std::fmt::Write as _;

use placed_text::did_you_mean;
use serde_json::Value as Json;

use crate::base::{Failure, talk};
use crate::commands::schema::Document;
use occupant_jobs::keys::Key;

/// Explain the keys of a scenario or study: meaning, unit, example
///
/// `occupant explain` lists the sections, `occupant explain path` the keys of one section, `occupant explain path.delta_v`
/// explains one key. A single word finds all keys with that name, else all keys that can have that value, such as sensors.
/// NAME stands for a name that you choose.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The key, such as belts.NAME.slack, or its last word alone; all sections if absent
    #[arg(value_name = "KEY")]
    key: Option<String>,

    /// The kind of file
    #[arg(long, value_enum, default_value_t = Document::Scenario)]
    of: Document,

    /// Print all keys as a Markdown page
    #[arg(long, conflicts_with = "key")]
    markdown: bool,
}

/// Explains a key.
pub(crate) fn explain(args: &Args) -> Result<(), Failure> {
    let root = Key::root(args.of.schema());
    if args.markdown {
        return talk::print(&page(&root, args.of));
    }
    let found = match &args.key {
        None => vec![root],
        Some(path) => find(&root, path)?,
    };
    let texts: Vec<String> = found.iter().map(text).collect();
    talk::print(&texts.join("\n"))
}

/// Keys at a path, where names and `*` match the user's own names; else all keys with that name; else all that may
/// have that value.
fn find<'a>(root: &Key<'a>, path: &str) -> Result<Vec<Key<'a>>, Failure> {
    let all = root.all();
    // as --set writes it: the key that may be that word
    if let Some((key, word)) = path.split_once('=') {
        let word = word.trim().trim_matches('"');
        let found = find(root, word)?;
        let own: Vec<Key> = found.iter().filter(|of| of.path == key.trim()).cloned().collect();
        return Ok(if own.is_empty() { found } else { own });
    }
    let found: Vec<Key> = all.iter().filter(|key| key.is_at(path)).cloned().collect();
    let is_one = !path.contains('.');
    let word = path.split('[').next().unwrap_or(path);
    let is_named = |key: &&Key| is_one && key.name() == word;
    // the section before keys elsewhere: `belt` is looked for among belts first
    let is_section = |key: &&Key| is_one && key.path.strip_suffix('s') == Some(word);
    let found = if found.is_empty() {
        all.iter().filter(is_section).chain(all.iter().filter(is_named)).cloned().collect()
    } else {
        found
    };
    let is_word = |key: &&Key| names(key.schema()).contains(&format!("\"{path}\""));
    let found: Vec<Key> = if found.is_empty() { all.iter().filter(is_word).cloned().collect() } else { found };
    if let (true, Some((_, key))) = (found.is_empty(), ALSO.iter().find(|(word, _)| is_called(path, word))) {
        return find(root, key);
    }
    let result = RESULTS.iter().find(|(words, _)| words.iter().any(|word| is_called(path, word)));
    if let (true, Some((_, help))) = (found.is_empty(), result) {
        return Err(Failure::with_help(format!("`{path}` is a result, not a key"), help));
    }
    if found.is_empty() {
        let names: Vec<&str> = all.iter().map(Key::name).collect();
        let hint = did_you_mean(path.rsplit('.').next().unwrap_or_default(), &names, '`');
        let help = hint.unwrap_or_else(|| "`occupant explain` lists the sections".to_owned());
        return Err(Failure::with_help(format!("no key `{path}`"), &help));
    }
    Ok(found)
}

/// Type of its value, as text.
fn kind(key: &Key) -> String {
    let schema = key.schema();
    let mut words = match (schema["x-dimension"].as_str(), names(schema)) {
        (Some(dimension), _) => quantity(dimension, schema),
        (None, names) if !names.is_empty() => format!("one of {}", names.join(", ")),
        _ => plain(key),
    };
    for (limit, sign) in [("minimum", "at least"), ("exclusiveMinimum", "more than"), ("maximum", "at most")] {
        if let Some(value) = schema.get(limit) {
            let _infallible = write!(words, ", {sign} {value}");
        }
    }
    words
}

fn text(key: &Key) -> String {
    let below = key.below();
    let mut text = String::new();
    if !key.path.is_empty() {
        let variant = key.variant.as_ref().map_or(String::new(), |variant| format!("   ({variant})"));
        let needed = if key.needed { "needed; " } else { "" };
        text = format!("{}{variant}\n    {}\n    {needed}{}\n", key.path, key.meaning(), kind(key));
        for (name, meaning) in choices(key.schema()) {
            let _infallible = writeln!(text, "      {name}: {meaning}");
        }
    }
    let mut variant = None;
    for own in &below {
        if own.variant != variant {
            variant.clone_from(&own.variant);
            let _infallible = writeln!(text, "\n  {}", variant.as_deref().unwrap_or_default());
        }
        let needed = if own.needed { ", needed" } else { "" };
        let _infallible = writeln!(text, "  {}: {}{needed}\n      {}", own.path, kind(own), own.meaning());
    }
    text
}

/// Synonyms of keys.
const ALSO: [(&str, &str); 14] = [
    ("airbag", "bags"),
    ("air_bag", "bags"),
    ("seatbelt", "belts"),
    ("seat_belt", "belts"),
    ("webbing", "belts"),
    ("intrusion", "frames"),
    ("pretensioner", "retractors"),
    ("interior", "solids"),
    ("delta_v", "delta_v"),
    ("δv", "delta_v"),
    ("dv", "delta_v"),
    ("pdof", "direction"),
    ("barrier", "barriers"),
    ("guardrail", "barriers"),
];
/// Words looked up as keys that are results, each with where it is found.
const RESULTS: [(&[&str], &str); 3] = [
    (
        &["ejection", "throw", "throw_distance", "searle"],
        "`occupant run` prints ejections, and throws if the scenario has a [ground]: see `occupant explain ground`",
    ),
    (
        &["submarining"],
        "`occupant run` lists it among the events if the lap belt lies on iliac wings: see `occupant explain wing` and `occupant explain lap`",
    ),
    (
        &["hic", "hic15", "hic36", "nij", "nic", "nkm", "bric", "whiplash", "rib_deflection", "chest_deflection"],
        "it is a measure: `occupant run` and `occupant measures RUN.mcap` print it",
    ),
];

/// Whether two spellings mean the same word, ignoring case, blanks and underscores.
fn is_called(said: &str, word: &str) -> bool {
    let said = said.trim().to_lowercase().replace([' ', '-'], "_");
    said == word || said.strip_suffix('s') == Some(word)
}

/// Allowed words, in quotes.
fn names(schema: &Json) -> Vec<String> {
    let listed = schema["enum"].as_array().into_iter().flatten().map(Json::to_string);
    listed
        .chain(choices(schema).into_iter().map(|(name, _)| name))
        .chain(schema.get("const").map(Json::to_string))
        .collect()
}

/// Allowed words with their meanings, if described.
fn choices(schema: &Json) -> Vec<(String, &str)> {
    let all = schema["oneOf"].as_array().into_iter().flatten();
    all.filter_map(|one| Some((one.get("const")?.to_string(), one["description"].as_str().unwrap_or_default())))
        .collect()
}

fn quantity(dimension: &str, schema: &Json) -> String {
    let unit = |system: &str| schema["x-bare-unit"][system].as_str().unwrap_or_default();
    let bare = match (unit("si"), unit("in-lbf-s")) {
        ("", _) => String::new(),
        (si, other) if si == other => format!(", a bare number in {si}"),
        (si, other) => format!(", a bare number in {si} ({other} with units = \"in-lbf-s\")"),
    };
    format!("{dimension}{bare}, such as {}", schema["x-example"].as_str().unwrap_or_default())
}

/// Type names of plain values.
fn plain(key: &Key) -> String {
    let schema = key.schema();
    match schema["type"].as_str() {
        Some("string") => "text".into(),
        Some("boolean") => "true or false".into(),
        Some("integer") => "whole number".into(),
        Some("number") => "number".into(),
        Some("array") => {
            let item = kind(&key.item());
            match (&schema["minItems"], &schema["maxItems"]) {
                (least, most) if least == most && !least.is_null() => format!("list of {least}: {}", item),
                (Json::Null, _) => format!("list: {}", item),
                (least, _) => format!("list of {least} or more: {}", item),
            }
        }
        _ if schema["additionalProperties"].is_object() => "tables with names that you choose".into(),
        _ if schema["oneOf"].is_array() || schema["properties"].is_object() => "table".into(),
        _ => "any value".into(),
    }
}

/// All keys as a Markdown page.
fn page(root: &Key, of: Document) -> String {
    let mut text = format!(
        "# Keys of a {of}\n\nWritten by `occupant explain --of {of} --markdown`. {}\n\nNAME stands for a name that you choose, `[]` for any item of a list.\n",
        root.meaning(),
        of = of.word(),
    );
    for table in std::iter::once(root.clone()).chain(root.all()).filter(|key| !key.below().is_empty()) {
        let heading = if table.path.is_empty() { "Sections".to_owned() } else { format!("`{}`", table.path) };
        let _infallible =
            write!(text, "\n## {heading}\n\n{}\n\n| key | of | is | meaning |\n|---|---|---|---|\n", table.meaning());
        for key in table.below() {
            let needed = if key.needed { ", needed" } else { "" };
            let variant = key.variant.as_ref().map_or(String::new(), |variant| format!("`{variant}`"));
            let cell = |words: String| words.replace('|', "\\|");
            let (kind, meaning) = (cell(kind(&key)), cell(key.meaning()));
            let _infallible = writeln!(text, "| `{}` | {variant} | {kind}{needed} | {meaning} |", key.name());
        }
    }
    text
}

//! Surface files that materials name, laid under what the scenario says itself.

use std::sync::Arc;

use serde::Deserialize;

use super::check::check_words;
use super::expand::laid_over;
use super::sections::{Basis, MaterialSection, Scenario, SurfaceFile, surface_schema};
use placed_text::{Diagnostics, Document, Entry, Node, Problem, Value, with_key};

/// Returns the bytes of a file, or the reason of the failure.
type Resolver<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>, String>;

/// Keys that define unloading.
const BACK: [&str; 5] = ["returned", "returned_each", "unload_slope", "atb", "mu1"];

/// Problems of a surface file; `name` is its name in messages.
///
/// # Errors
/// Bytes that are no text, wrong syntax, wrong words.
pub fn check_surface(bytes: &[u8], name: &str) -> Result<(), Diagnostics> {
    read(bytes, name).map(|_| ())
}

fn read(bytes: &[u8], name: &str) -> Result<(Document, SurfaceFile), Diagnostics> {
    let mut document = Document::read_named(bytes, name)?;
    let mut problems = check_words(&mut document, surface_schema(), "the surface");
    if problems.has_errors() {
        return Err(problems);
    }
    let file: SurfaceFile = document.sections("surface")?;
    let has = |key: &str| document.root.get("material").is_some_and(|material| material.get(key).is_some());
    let mut report = |path: &str, found: &str, expected: &str| {
        problems.add(Problem::error(path, found, expected), |problem| document.place(problem));
    };
    for key in ["library", "file"].into_iter().filter(|key| has(key)) {
        report(
            &format!("material.{key}"),
            "a surface that refers to another",
            "its own numbers: `depth` and `force`, or `k1`",
        );
    }
    if file.measured.loading == Basis::NotMeasured {
        report("measured.loading", "a surface without loading", "\"measured\", \"digitised\" or \"made_up\"");
    }
    match (file.measured.friction, has("friction")) {
        (Basis::NotMeasured, true) => report("material.friction", "`friction` that was not measured", NO_KEY),
        (Basis::NotMeasured, false) | (_, true) => {}
        (_, false) => report("measured.friction", "no `friction` in `material`", "it, or friction = \"not_measured\""),
    }
    let back = BACK.into_iter().find(|key| has(key));
    match (file.measured.unloading, back) {
        (Basis::NotMeasured, Some(key)) => {
            report(&format!("material.{key}"), "a way back that was not measured", NO_KEY);
        }
        (Basis::NotMeasured, None) | (_, Some(_)) => {}
        (_, None) => {
            report("measured.unloading", "no way back in `material`", "`returned`, or unloading = \"not_measured\"")
        }
    }
    if problems.has_errors() { Err(problems) } else { Ok((document, file)) }
}

const NO_KEY: &str = "no such key, so that the scenario gives it; or \"made_up\" in `measured`";

/// Reads the surface files referred to by materials of an explicit scenario, and merges them below these materials.
///
/// # Errors
/// Unreadable files, problems in them, and values neither measured nor given by the scenario.
pub(super) fn lay(document: &mut Document, explicit: &mut Scenario, resolver: Resolver) -> Result<(), Diagnostics> {
    let named = |(name, material): (&String, &MaterialSection)| Some((name.clone(), material.file.clone()?));
    let named: Vec<(String, String)> = explicit.materials.iter().filter_map(named).collect();
    let mut problems = Diagnostics::new();
    for (name, file) in named {
        if let Err(found) = lay_one(document, explicit, (&name, &file), resolver) {
            problems.extend(found);
        }
    }
    if problems.is_empty() { Ok(()) } else { Err(problems) }
}

fn lay_one(
    document: &mut Document,
    explicit: &mut Scenario,
    (name, file): (&str, &str),
    resolver: Resolver,
) -> Result<(), Diagnostics> {
    let path = with_key("materials", name);
    let bytes = resolver(file).map_err(|reason| {
        let found = format!("`{file}` cannot be read: {reason}");
        let expected = "a surface file, its name relative to the scenario";
        Diagnostics::from(document.place(Problem::error(with_key(&path, "file"), found, expected)))
    })?;
    let (read, surface) = read(&bytes, file)?;
    let own = document.root.get("materials").and_then(|all| all.as_table()?.get(name).cloned());
    let (Some(own), Some(base)) = (own, read.root.as_table().and_then(|root| root.get("material"))) else {
        return Ok(());
    };
    not_said(document, (&path, file), &surface, &own.node)?;
    let sources = &mut document.sources;
    let id = sources.named(file).unwrap_or_else(|| sources.add_named(file, read.shared()));
    let base = Entry { node: base.node.moved_to(id), ..base.clone() };
    let mut whole = laid_over(Some(base), own);
    whole.node.as_table_mut().and_then(|table| table.shift_remove("file"));
    let section = MaterialSection::deserialize(&whole.node);
    explicit.materials.insert(name.to_owned(), section.map_err(|error| differs(file, &error.to_string()))?);
    if let Some(entry) = document.root.as_table_mut().and_then(|root| root.get_mut("materials")) {
        entry.node.as_table_mut().and_then(|all| all.insert(name.to_owned(), whole));
    }
    tell(document, explicit, &path, &told(&surface, file));
    Ok(())
}

fn differs(file: &str, error: &str) -> Diagnostics {
    placed_text::refuse(file, format!("the material cannot be read: {error}"), "a material")
}

/// Reports values that were not measured and are missing in the scenario.
fn not_said(
    document: &Document,
    (path, file): (&str, &str),
    surface: &SurfaceFile,
    own: &Node,
) -> Result<(), Diagnostics> {
    let mut problems = Diagnostics::new();
    let says = |keys: &[&str]| keys.iter().any(|key| own.get(key).is_some());
    let parts = [
        ("friction", surface.measured.friction, &["friction"][..], "friction = your estimate, beside `file`"),
        (
            "unloading",
            surface.measured.unloading,
            &BACK[..],
            "returned = your estimate of the share of work that comes back",
        ),
    ];
    for (part, basis, keys, expected) in parts {
        if basis == Basis::NotMeasured && !says(keys) {
            let found = format!("the {part} of {file} was not measured, and the scenario does not say it");
            problems.add(Problem::error(path, found, expected), |problem| document.place(problem));
        }
    }
    if problems.is_empty() { Ok(()) } else { Err(problems) }
}

/// Text of a surface's provenance.
fn told(surface: &SurfaceFile, file: &str) -> String {
    let word = |basis: Basis| match basis {
        Basis::Measured => "measured",
        Basis::Digitised => "digitised",
        Basis::MadeUp => "made up",
        Basis::NotMeasured => "not measured, the scenario's",
    };
    let of = &surface.measured;
    let [loading, unloading, friction] = [of.loading, of.unloading, of.friction].map(word);
    let parts = format!("loading {loading}; unloading {unloading}; friction {friction}");
    format!("{file}: {}; {}; {parts}", surface.title, surface.provenance.source)
}

/// Adds the source of a material if the scenario gives none.
fn tell(document: &mut Document, explicit: &mut Scenario, path: &str, words: &str) {
    explicit.provenance.entry(path.to_owned()).or_insert_with(|| words.to_owned());
    let span = document.sources.start_of(document.main);
    let Some(root) = document.root.as_table_mut() else { return };
    let entry = |node: Node| Entry { key_span: span, node };
    let own = root.entry("provenance".to_owned());
    let own = own.or_insert_with(|| entry(Node::new(span, Value::Table(Arc::default()))));
    let text = entry(Node::new(span, Value::String(words.to_owned())));
    own.node.as_table_mut().map(|table| table.entry(path.to_owned()).or_insert(text));
}

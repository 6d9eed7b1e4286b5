//! Makes a scenario explicit: presets, pairs, `all` and joint sets become one entry for each segment, sphere and joint.
//!
//! Every value keeps its original position. Later layers win: preset, then the scenario; within each `all`, then the
//! pair, then the single name.

use std::sync::Arc;

use super::car;
use super::check::check_words;
use super::living;
use super::presets;
use super::sections::schema;
use occupant_core::body::both_sides;
use occupant_core::body::shape;
use occupant_core::body::tti12::TTI12;
use placed_text::{Document, Entry, Format, Node, Sources, Table, Value};

/// Pairs of keys: one of them in a later layer, or in an override, replaces the other in an earlier layer.
const RIVALS: [[&str; 2]; 9] = [
    ["mass", "weight"],
    ["peak", "delta_v"],
    ["slack", "length"],
    ["angle", "angles"],
    ["pitch", "axis"],
    ["c2", "moments"],
    ["returned", "returned_each"],
    ["returned", "unload_slope"],
    ["returned", "atb"],
];

/// The alternative key for the same quantity.
pub(super) fn rival(key: &str) -> Option<&'static str> {
    let both = RIVALS.iter().find(|both| both.contains(&key))?;
    both.iter().copied().find(|other| *other != key)
}

/// The alternative key for the same quantity, as a path.
pub fn rival_path(path: &str) -> Option<String> {
    let (above, key) = path.rsplit_once('.')?;
    Some(format!("{above}.{}", rival(key)?))
}

/// A built-in or generated text, parsed and checked.
pub(super) fn written(title: &str, text: &str) -> Option<Document> {
    let mut document = Document::read(text, Format::Toml, title).ok()?;
    // it lacks what a whole scenario has; its quantities are read
    check_words(&mut document, schema(), "the preset");
    Some(document)
}

/// The explicit form of a scenario tree that has passed the check.
pub(super) fn expand(sources: &mut Sources, root: &Node) -> Node {
    let whole = car::whole(sources, root, &mut Vec::new());
    written_out(sources, &whole)
}

/// The same for a tree whose car is expanded.
pub(super) fn written_out(sources: &mut Sources, root: &Node) -> Node {
    let mut explicit = root.clone();
    let sets = root.get("joint_sets").cloned();
    if let Some(table) = explicit.as_table_mut() {
        expand_occupant(sources, root, sets.as_ref(), table);
        for (_, occupant) in table.get_mut("occupants").and_then(|all| all.node.as_table_mut()).into_iter().flatten() {
            let written = occupant.node.clone();
            if let Some(own) = occupant.node.as_table_mut() {
                expand_occupant(sources, &written, sets.as_ref(), own);
            }
        }
        from_library(sources, table);
        living::feel(sources, root, table);
    }
    explicit
}

/// Expands body and joints of the occupant with the keys in `written`.
fn expand_occupant(sources: &mut Sources, written: &Node, sets: Option<&Node>, own: &mut Table) {
    let divided = living::divided(written);
    let written = divided.as_ref().unwrap_or(written);
    let body = section(sources, written, "body", |layers| body(&layers));
    let joints = explicit_joints(sources, written, body.as_ref().map(|body| &body.node), sets);
    let rows = body.as_ref().map_or_else(report_joints, |body| joint_rows(&body.node));
    let muscles = living::muscles(sources, written, rows.iter().map(|(name, _)| name.as_str()));
    own.extend(
        [("body", body), ("joints", joints), ("muscles", muscles)]
            .into_iter()
            .filter_map(|(key, e)| Some((key.to_owned(), e?))),
    );
}

/// The joints of an occupant, written out for the joints of an explicit body.
pub(super) fn explicit_joints(
    sources: &mut Sources,
    written: &Node,
    body: Option<&Node>,
    sets: Option<&Node>,
) -> Option<Entry> {
    let rows = body.map_or_else(report_joints, joint_rows);
    section(sources, written, "joints", |layers| joints(&layers, &rows, sets))
}

/// Merges the library's entry under a section that refers to it by `library`, and adds its source if none is given.
pub(super) fn from_library(sources: &mut Sources, root: &mut Table) {
    let Some(library) = presets::library() else { return };
    let mut told = Table::new();
    let mut merge = |entry: &mut Entry, place: &str, from: &[&str]| {
        let named = entry.node.get("library").and_then(Node::as_str).map(str::to_owned);
        let Some(named) = named else { return };
        let at = from.iter().map(|key| if *key == "*" { named.as_str() } else { key });
        let at: Vec<&str> = at.collect();
        let Some(base) = entry_at(&library.root, &at) else { return };
        let id = sources.named(LIBRARY).unwrap_or_else(|| sources.add(LIBRARY, library.shared()));
        let base = Entry { node: base.node.moved_to(id), ..base.clone() };
        let mut whole = laid_over(Some(base), entry.clone());
        whole.node.as_table_mut().and_then(|table| table.shift_remove("library"));
        *entry = whole;
        if let Some(source) = entry_at(&library.root, &["provenance", &at.join(".")]) {
            told.insert(place.to_owned(), Entry { node: source.node.moved_to(id), ..source.clone() });
        }
    };
    for key in presets::IN_LIBRARY {
        for (name, entry) in root.get_mut(key).and_then(|entry| entry.node.as_table_mut()).into_iter().flatten() {
            merge(entry, &format!("{key}.{name}"), &[key, "*"]);
        }
    }
    if let Some(path) = root.get_mut("path") {
        merge(path, "path", &PULSES);
    }
    for (name, own) in root.get_mut("vehicles").and_then(|entry| entry.node.as_table_mut()).into_iter().flatten() {
        if let Some(path) = own.node.as_table_mut().and_then(|own| own.get_mut("path")) {
            merge(path, &format!("vehicles.{name}.path"), &PULSES);
        }
    }
    if told.is_empty() {
        return;
    }
    let span = told[0].node.span;
    let own = root.entry("provenance".to_owned());
    let own = own.or_insert_with(|| Entry { key_span: span, node: Node::new(span, Value::Table(Arc::default())) });
    for (path, source) in told {
        own.node.as_table_mut().map(|table| table.entry(path).or_insert(source));
    }
}

/// The entry at a path of keys.
fn entry_at<'a>(node: &'a Node, path: &[&str]) -> Option<&'a Entry> {
    let (first, rest) = path.split_first()?;
    let entry = node.as_table()?.get(*first)?;
    if rest.is_empty() { Some(entry) } else { entry_at(&entry.node, rest) }
}

/// Name of the library in messages.
const LIBRARY: &str = "library";
/// Path of pulses in the library.
const PULSES: [&str; 3] = ["vehicles", "*", "path"];

/// Name of a joint, and whether it is a hinge.
type JointWord = (String, bool);

fn report_joints() -> Vec<JointWord> {
    TTI12.joint_rows().iter().map(|row| (row.name.to_owned(), row.is_hinge())).collect()
}

/// The joints of an explicit body.
fn joint_rows(body: &Node) -> Vec<JointWord> {
    let is_hinge = |entry: &Entry| matches!(entry.node.get("kind").and_then(Node::as_str), Some("pin" | "universal"));
    let own = body.get("joints").and_then(Node::as_table);
    own.map_or_else(report_joints, |own| own.iter().map(|(name, entry)| (name.clone(), is_hinge(entry))).collect())
}

/// Replaces the table under `key` by the result of `explicit` for its layers.
fn section(sources: &mut Sources, root: &Node, key: &str, explicit: impl FnOnce(Vec<Node>) -> Table) -> Option<Entry> {
    let entry = root.as_table()?.get(key)?.clone();
    entry.node.as_table()?;
    let base = start(sources, &entry.node, key);
    let layers: Vec<Node> = base.into_iter().chain([entry.node.clone()]).collect();
    Some(Entry { node: Node::new(entry.node.span, Value::Table(Arc::new(explicit(layers)))), ..entry })
}

/// The base of a section: the preset that it names, or the body of the person that it describes.
fn start(sources: &mut Sources, section: &Node, key: &str) -> Option<Node> {
    let (title, base) = presets::base(section, key)?;
    let id = sources.named(&title).unwrap_or_else(|| sources.add(title, base.shared()));
    Some(base.root.get(key)?.moved_to(id))
}

fn body(layers: &[Node]) -> Table {
    let mut explicit = plain_keys(layers, &["segments", "joints", "spheres", "plates", "plate_links"]);
    let parts = |key: &str| -> Vec<Node> { layers.iter().filter_map(|l| l.get(key).cloned()).collect() };
    let joints = parts("joints");
    let own: Vec<String> = other_names(&joints, &[]);
    let joined = members(&joints, own.iter().map(String::as_str));
    let names = segment_names(&joined);
    put(&mut explicit, "joints", &joints, joined);
    let segments = parts("segments");
    put(&mut explicit, "segments", &segments, all_members(&segments, &names));
    let spheres = parts("spheres");
    put(&mut explicit, "spheres", &spheres, all_members(&spheres, &shape::names(&TTI12)));
    for key in ["plates", "plate_links"] {
        let own = parts(key);
        put(&mut explicit, key, &own, all_members(&own, &[]));
    }
    explicit
}

/// Names of the segments of a body with these joints; without any it is the report's.
fn segment_names(joints: &Table) -> Vec<String> {
    if joints.is_empty() {
        return TTI12.segment_rows().iter().map(|row| row.name.to_owned()).collect();
    }
    let named = |entry: &Entry| ["proximal", "distal"].map(|key| Some(entry.node.get(key)?.as_str()?.to_owned()));
    let mut names: Vec<String> = Vec::new();
    for name in joints.values().flat_map(named).flatten() {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// One merged entry for each of `names` and for every other one in the layers.
fn all_members(layers: &[Node], names: &[String]) -> Table {
    let known: Vec<&str> = names.iter().map(String::as_str).collect();
    let others = other_names(layers, &known);
    members(layers, known.iter().copied().chain(others.iter().map(String::as_str)))
}

fn joints(layers: &[Node], rows: &[JointWord], sets: Option<&Node>) -> Table {
    let mut explicit = plain_keys(layers, &[]);
    let words_of = |(name, _): &JointWord| -> Vec<String> {
        ["all".to_owned()].into_iter().chain(both_sides(name)).chain([name.clone()]).collect()
    };
    for word in rows.iter().flat_map(words_of) {
        explicit.shift_remove(&word);
    }
    // a preset speaks of joints that this body may not have
    let own = layers.last();
    explicit.retain(|name, entry| entry.node.as_table().is_none() || own.is_some_and(|own| own.get(name).is_some()));
    for row in rows {
        let whole = |word: &str, entry: &Entry| {
            let whole = with_set(entry, sets);
            if word == "all" { fitting(whole, row.1) } else { whole }
        };
        if let Some(entry) = merged(layers, &words_of(row), whole) {
            explicit.insert(row.0.clone(), entry);
        }
    }
    explicit
}

/// The values of the layers under any of `words`; later words and layers override earlier ones.
fn merged(layers: &[Node], words: &[String], whole: impl Fn(&str, &Entry) -> Entry) -> Option<Entry> {
    let tables = layers.iter().filter_map(Node::as_table);
    let entries = tables.flat_map(|table| words.iter().filter_map(|word| Some(whole(word, table.get(word)?))));
    entries.fold(None, |merged, entry| Some(laid_over(merged, entry)))
}

/// The values for all joints, without those that this kind of joint cannot have.
fn fitting(mut entry: Entry, is_hinge: bool) -> Entry {
    let foreign: &[&str] = if is_hinge {
        &["twist_damping", "stop", "stiffness", "rest_angle", "centre", "limit", "twist_limit"]
    } else {
        &["lower_stop", "upper_stop", "angle_limit"]
    };
    if let Some(table) = entry.node.as_table_mut() {
        for key in foreign {
            table.shift_remove(*key);
        }
    }
    entry
}

/// A joint merged over the joint set to which it refers. An unknown reference is kept and reported later.
fn with_set(entry: &Entry, sets: Option<&Node>) -> Entry {
    let name = entry.node.get("set").and_then(Node::as_str);
    let set = name.and_then(|name| sets?.as_table()?.get(name));
    match set {
        None => entry.clone(),
        Some(set) => {
            let mut own = entry.clone();
            if let Some(table) = own.node.as_table_mut() {
                table.shift_remove("set");
            }
            laid_over(Some(set.clone()), own)
        }
    }
}

/// All keys of the layers but `preset` and `except`; later layers win.
fn plain_keys(layers: &[Node], except: &[&str]) -> Table {
    let all = layers.iter().filter_map(Node::as_table).flatten();
    let plain = all.filter(|(key, _)| *key != "preset" && !except.contains(&key.as_str()));
    plain.map(|(key, entry)| (key.clone(), entry.clone())).collect()
}

/// Names in the layers that are neither words for a pair nor among `known`, in order of appearance.
fn other_names(layers: &[Node], known: &[&str]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for key in layers.iter().filter_map(Node::as_table).flat_map(Table::keys) {
        let is_known = known.iter().any(|name| name == key || both_sides(name).as_ref() == Some(key));
        if !is_known && !names.contains(key) {
            names.push(key.clone());
        }
    }
    names
}

/// One merged entry for each of `names` that appears in a layer, itself or through its pair.
fn members<'a>(layers: &[Node], names: impl Iterator<Item = &'a str>) -> Table {
    names
        .filter_map(|name| {
            let words: Vec<String> = both_sides(name).into_iter().chain([name.to_owned()]).collect();
            Some((name.to_owned(), merged(layers, &words, |_, entry| entry.clone())?))
        })
        .collect()
}

fn put(explicit: &mut Table, key: &str, layers: &[Node], members: Table) {
    if let Some(Node { span, .. }) = layers.last() {
        explicit
            .insert(key.to_owned(), Entry { key_span: *span, node: Node::new(*span, Value::Table(Arc::new(members))) });
    }
}

/// A whole tree merged over another.
pub(super) fn over(under: Node, root: &Node) -> Node {
    let entry = |node: Node| Entry { key_span: node.span, node };
    laid_over(Some(entry(under)), entry(root.clone())).node
}

/// `over` merged over `under`: tables merge key by key, everything else is replaced.
pub(super) fn laid_over(under: Option<Entry>, over: Entry) -> Entry {
    let Some(mut under) = under else { return over };
    match (under.node.as_table_mut(), over.node.as_table()) {
        (Some(base), Some(table)) => {
            for (key, entry) in table {
                rival(key).and_then(|rival| base.shift_remove(rival));
                let below = base.get(key).cloned();
                base.insert(key.clone(), laid_over(below, entry.clone()));
            }
            under.node.span = over.node.span;
            Entry { key_span: over.key_span, ..under }
        }
        _ => over,
    }
}

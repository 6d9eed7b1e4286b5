//! Data that the samples of a study share: the base scenario, checked, expanded and read once. A sample that only
//! changes values of independent sections is derived from it; only its changes are checked and read again.

use std::sync::Arc;

use super::car::{self, WrittenOut};
use super::check::check_parts;
use super::expand::{explicit_joints, from_library, written_out};
use super::living;
use super::presets;
use super::sections::{Scenario, schema};
use placed_text::{Diagnostics, Document, Entry, Node, SourceId, Sources, Table, Value};
use serde::Deserialize;

/// A scenario that has passed the check, and its explicit form.
#[derive(Clone, Debug)]
pub(crate) struct Ready {
    /// The text of its positions.
    pub(crate) sources: Sources,
    main: SourceId,
    /// The scenario as written.
    pub(crate) root: Node,
    /// The same with its car expanded.
    whole: Node,
    pub(crate) scenario: Scenario,
    /// What was read of its car.
    pub(crate) read: Vec<WrittenOut>,
    /// With presets, pairs, `all` and joint sets expanded.
    pub(crate) explicit_root: Node,
    pub(crate) explicit: Scenario,
}

/// Sections on which others depend, or that have a base.
const OTHERS: [&str; 5] = ["units", "body", "joint_sets", "occupants", "provenance"];

impl Ready {
    /// Reads a document that has passed the check, with its car expanded but no preset; `root` is the tree as written.
    ///
    /// # Errors
    /// A difference between check and sections.
    pub(crate) fn of(root: Node, mut document: Document, read: Vec<WrittenOut>) -> Result<Ready, Diagnostics> {
        let scenario: Scenario = document.sections("scenario")?;
        let whole = document.root.clone();
        document.root = written_out(&mut document.sources, &whole);
        let explicit = complete(document.sections("scenario")?);
        let Document { sources, main, root: explicit_root } = document;
        Ok(Ready { sources, main, root, whole, scenario, read, explicit_root, explicit })
    }

    /// The same with another tree, if it differs only in valid values of independent sections; otherwise none. For `read` see
    /// [`car::whole`].
    pub(crate) fn with(&self, sources: &Sources, root: &Node, read: &mut Vec<WrittenOut>) -> Option<Ready> {
        let mut document = Document { sources: sources.clone(), main: self.main, root: root.clone() };
        let has_car = car::is_there(root);
        if has_car && (!check_parts(&mut document, schema(), &car::CAR).is_empty() || !car::check(&document).is_empty())
        {
            return None;
        }
        document.root = car::whole(&mut document.sources, &document.root, read);
        let unchecked = document.root.clone();
        let changed = self.changed(&unchecked, has_car)?;
        if !check_parts(&mut document, schema(), &changed).is_empty() {
            return None;
        }
        let part = Table::from_iter(["title", "time"].iter().chain(&changed).filter_map(|key| {
            let table = document.root.as_table()?;
            Some(((*key).to_owned(), table.get(*key)?.clone()))
        }));
        let whole = document.root.clone();
        document.root = Node::new(whole.span, Value::Table(Arc::new(part)));
        let part: Scenario = document.sections("scenario").ok()?;
        let root = if has_car { root.clone() } else { whole.clone() };
        let Ready { main, scenario, explicit_root, explicit, .. } = self;
        let mut ready = Ready {
            sources: document.sources,
            main: *main,
            root,
            whole,
            scenario: scenario.clone(),
            read: Vec::new(),
            explicit_root: explicit_root.clone(),
            explicit: explicit.clone(),
        };
        for key in changed {
            ready.scenario.take(key, &part)?;
            let entry = match key {
                "joints" => ready.write_out_joints()?,
                key if presets::IN_LIBRARY.contains(&key) => ready.merge_library(key)?,
                key => {
                    ready.explicit.take(key, &part)?;
                    ready.whole.as_table()?.get(key)?.clone()
                }
            };
            ready.explicit_root.as_table_mut()?.insert(key.to_owned(), entry);
        }
        ready.explicit = complete(ready.explicit);
        Some(ready)
    }

    /// Names of the sections that differ in another tree with its car expanded; none if one of them does not stand alone.
    fn changed<'n>(&self, whole: &'n Node, has_car: bool) -> Option<Vec<&'n str>> {
        let (old, new) = (self.whole.as_table()?, whole.as_table()?);
        if !old.keys().eq(new.keys()) {
            return None;
        }
        let says_same = |a: &Node, b: &Node| shares(a, b) || has_car && a.says(b);
        let is_same = |key: &str| old.get(key).zip(new.get(key)).is_some_and(|(a, b)| says_same(&a.node, &b.node));
        let changed: Vec<&str> = new.keys().map(String::as_str).filter(|key| !is_same(key)).collect();
        let is_living = living::any(&self.root);
        let refer =
            |key: &str| [old, new].into_iter().filter_map(|root| root.get(key)).any(|entry| refers(&entry.node));
        let names_same = |key: &str| {
            let [old, new] = [old, new].map(|root| root.get(key).map(|entry| in_library(&entry.node)));
            old == new
        };
        // a preset of joints may change the body, and bring muscles
        let preset = |of: &Table| of.get("joints")?.node.get("preset").map(|preset| preset.value.clone());
        let stands_alone = |key: &&str| match *key {
            "joints" => !is_living && preset(old) == preset(new),
            "muscles" | "triggers" => !is_living && !refer(key),
            key if presets::IN_LIBRARY.contains(&key) => names_same(key),
            key => !OTHERS.contains(&key) && !refer(key),
        };
        changed.iter().all(stands_alone).then_some(changed)
    }

    /// Expands the joints anew, for the same body.
    fn write_out_joints(&mut self) -> Option<Entry> {
        let (body, sets) = (self.explicit_root.get("body"), self.whole.get("joint_sets"));
        let entry = explicit_joints(&mut self.sources, &self.whole, body, sets)?;
        self.explicit.joints = Some(Deserialize::deserialize(&entry.node).ok()?);
        Some(entry)
    }

    /// Merges the library's entries anew under those of a section that refer to it, to the same as before.
    fn merge_library(&mut self, key: &str) -> Option<Entry> {
        let whole = self.whole.as_table()?;
        let needed = ["title", "time", key].into_iter();
        let mut own: Table = needed.filter_map(|key| Some((key.to_owned(), whole.get(key)?.clone()))).collect();
        from_library(&mut self.sources, &mut own);
        own.shift_remove("provenance");
        let entry = own.get(key)?.clone();
        let root = Node::new(entry.node.span, Value::Table(Arc::new(own)));
        self.explicit.take(key, &Deserialize::deserialize(&root).ok()?)?;
        Some(entry)
    }

    /// The tree of the explicit form.
    pub(crate) fn document(&self) -> Document {
        Document { sources: self.sources.clone(), main: self.main, root: self.explicit_root.clone() }
    }
}

/// Whether two trees are one and the same, or a plain value twice.
pub(super) fn shares(a: &Node, b: &Node) -> bool {
    match (&a.value, &b.value) {
        (Value::Table(one), Value::Table(other)) => Arc::ptr_eq(one, other),
        _ => a == b,
    }
}

/// To what in the library the entries of a section refer.
fn in_library(section: &Node) -> Vec<(&str, Option<&Value>)> {
    let entries = section.as_table().into_iter().flatten();
    entries.map(|(name, entry)| (name.as_str(), entry.node.get("library").map(|named| &named.value))).collect()
}

/// Whether a section or a table in it refers to the library.
fn refers(section: &Node) -> bool {
    let mut table = section.as_table().into_iter().flatten();
    table.any(|(key, entry)| key == "library" || refers(&entry.node))
}

/// Explicit values of keys that the scenario leaves out.
fn complete(mut explicit: Scenario) -> Scenario {
    // result files hold the explicit form, and what it leaves out was false in version 0.1.0
    let others = explicit.occupants.values_mut().filter_map(|occupant| occupant.posture.as_mut());
    for posture in explicit.posture.iter_mut().chain(others) {
        posture.settle.get_or_insert(true);
    }
    // nor did that version say where edge forces act: at the point of contact
    if !explicit.surfaces.is_empty() {
        explicit.contact.get_or_insert_default().edge_force.get_or_insert_default();
    }
    explicit
}

/// Defines the function that copies a section from another scenario, by its key.
macro_rules! sections {
    ($($key:ident)*) => {
        impl Scenario {
            /// Copies a section; none for an unknown key.
            fn take(&mut self, key: &str, from: &Scenario) -> Option<()> {
                match key {
                    $(stringify!($key) => self.$key.clone_from(&from.$key),)*
                    _ => return None,
                }
                Some(())
            }
        }
    };
}

sections! {
    title notes gravity inside time output integrator joints car drive path vehicles ground frames loose posture initial_state mount stance
    seats muscles triggers markers belts webbings limiters retractors bags gases materials contact self_contact surfaces solids
}

//! Names that refer to other parts of a scenario, checked on the tree itself.
//!
//! The builder checks them with full knowledge; but it is not reached when words are wrong, and a user wants to hear of
//! everything at once.

use super::check::{Checker, one_of};
use super::document::{Entry, Node, Value};
use super::path_text::with_key;
use crate::body::tti12::TTI12;
use crate::problem::nearest;

impl Checker<'_> {
    /// Reports names that lead nowhere.
    pub(super) fn references(&mut self, root: &Node) {
        let keys = |table: &str| -> Vec<&str> { entries(root, table).map(|e| &*e.key).collect() };
        let materials = keys("materials");
        let surfaces = keys("surfaces");
        let mut spheres: Vec<&str> = TTI12.spheres().iter().map(|row| row.name).collect();
        let own = root.get("body").and_then(|b| b.get("spheres")).and_then(Node::as_table);
        spheres.extend(own.iter().flat_map(|t| t.iter()).map(|e| &*e.key));
        for entry in entries(root, "surfaces") {
            let path = with_key("surfaces", &entry.key);
            self.refer(&entry.node, &path, "material", "material", &materials);
            let list = match entry.node.get("spheres").map(|n| &n.value) {
                Some(Value::Array(list)) => list.as_slice(),
                _ => &[],
            };
            for (i, item) in list.iter().enumerate() {
                self.look_up(item, &format!("{path}.spheres[{i}]"), "sphere", &spheres);
            }
        }
        for entry in entries(root, "seats") {
            let path = with_key("seats", &entry.key);
            self.refer(&entry.node, &path, "cushion", "surface", &surfaces);
            self.refer(&entry.node, &path, "back", "surface", &surfaces);
        }
        for entry in entries(root, "belts") {
            let path = with_key("belts", &entry.key);
            self.refer(&entry.node, &path, "sphere", "sphere", &spheres);
        }
        let sets = keys("joint_sets");
        for entry in entries(root, "joints") {
            let path = with_key("joints", &entry.key);
            self.refer(&entry.node, &path, "set", "joint set", &sets);
        }
        if let Some(posture) = root.get("posture") {
            self.refer(posture, "posture", "seat", "seat", &keys("seats"));
        }
    }

    fn refer(&mut self, node: &Node, path: &str, key: &str, what: &str, names: &[&str]) {
        if let Some(name) = node.get(key) {
            self.look_up(name, &with_key(path, key), what, names);
        }
    }

    fn look_up(&mut self, node: &Node, path: &str, what: &str, names: &[&str]) {
        let Some(name) = node.as_str() else { return };
        if names.contains(&name) {
            return;
        }
        let hint = nearest(name, names.iter().copied()).map(|n| format!("did you mean \"{n}\"?"));
        let expected = match names {
            [] => format!("a {what}; the scenario has none"),
            _ => one_of(names, '"'),
        };
        self.report(node.span, path, format!("no {what} is named \"{name}\""), expected, hint);
    }
}

/// Entries of a table of the scenario.
fn entries<'n>(root: &'n Node, table: &str) -> impl Iterator<Item = &'n Entry> {
    root.get(table).and_then(Node::as_table).into_iter().flat_map(|t| t.iter())
}

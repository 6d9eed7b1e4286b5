//! The part of the check that looks at groups of keys: exactly one of them, at most one, all or none.

use serde_json::{Map, Value as Json};

use super::check::{Checker, one_of, quoted};
use super::document::{Entry, Node, Table};
use super::schema::groups;
use super::view::View;

impl Checker<'_> {
    /// Keys that exclude or need each other.
    pub(super) fn groups(&mut self, view: &View, node: &Node, table: &Table, path: &str) {
        let Some(object) = view.object_with_groups() else {
            return;
        };
        self.exclusive_groups(object, node, table, path);
        for group in groups(object, "x-together") {
            let (given, absent): (Vec<&str>, Vec<&str>) = group.iter().partition(|k| table.get(k).is_some());
            if let (Some(first), false) = (given.first().and_then(|k| table.get(k)), absent.is_empty()) {
                let found = format!("{} without {}", quoted(&given, '`'), quoted(&absent, '`'));
                self.report(first.key_span, path, found, "both or neither", None);
            }
        }
    }

    fn exclusive_groups(&mut self, object: &Map<String, Json>, node: &Node, table: &Table, path: &str) {
        for (word, needed) in [("x-exactly-one", true), ("x-at-most-one", false)] {
            for group in groups(object, word) {
                let mut given: Vec<&Entry> = group.iter().filter_map(|k| table.get(k)).collect();
                given.sort_by_key(|e| e.key_span.start);
                match given.as_slice() {
                    [] if needed => {
                        let found = match path {
                            "" => "the scenario does not say where the occupant is".to_owned(),
                            _ => format!("`{path}` has none of {}", quoted(&group, '`')),
                        };
                        let expected = one_of(&group, '`');
                        self.report_table(node, path, found, expected, None);
                    }
                    [] | [_] => {}
                    [.., last] => {
                        let keys: Vec<&str> = given.iter().map(|e| e.key.as_str()).collect();
                        let found = format!("{} together", all_of(&keys));
                        self.report(last.key_span, path, found, "only one of them", None);
                    }
                }
            }
        }
    }
}

/// `a` and `b`, all in quotes.
fn all_of(names: &[&str]) -> String {
    match names {
        [first @ .., last] if !first.is_empty() => format!("{} and `{last}`", quoted(first, '`')),
        _ => quoted(names, '`'),
    }
}

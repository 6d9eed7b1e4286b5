//! The check of groups of keys: exactly one of them, at most one, all or none.

use serde_json::{Map, Value as Json};

use super::schema::groups;
use super::{Checker, View};
use placed_text::{Entry, Node, Problem, Table, one_of, quoted};

impl Checker<'_> {
    /// Keys that exclude or need each other. Keys in `meant` are absent because of a misspelling that is already
    /// reported.
    pub(super) fn groups(&mut self, view: &View, node: &Node, path: &str, meant: &[&str]) {
        let (Some(object), Some(table)) = (view.object_with_groups(), node.as_table()) else { return };
        self.exclusive_groups(object, node, table, path, meant);
        for group in groups(object, "x-together") {
            let (given, absent): (Vec<&str>, Vec<&str>) =
                group.iter().partition(|k| table.contains_key(**k) || meant.contains(*k));
            if let (Some(first), false) = (given.first().and_then(|k| table.get(*k)), absent.is_empty()) {
                let found = format!("{} without {}", quoted(&given, '`'), quoted(&absent, '`'));
                self.report(first.key_span, Problem::error(path, found, "both or neither"));
            }
        }
    }

    fn exclusive_groups(&mut self, object: &Map<String, Json>, node: &Node, table: &Table, path: &str, meant: &[&str]) {
        for (word, needed) in [("x-exactly-one", true), ("x-at-most-one", false)] {
            for group in groups(object, word) {
                let mut given: Vec<(&str, &Entry)> = group.iter().filter_map(|k| Some((*k, table.get(*k)?))).collect();
                given.sort_by_key(|(_, e)| e.key_span.start);
                match given.as_slice() {
                    [] if needed && !group.iter().any(|key| meant.contains(key)) => {
                        let found = format!("`{path}` has none of {}", quoted(&group, '`'));
                        self.report_table(node, Problem::error(path, found, one_of(&group, '`')));
                    }
                    [] | [_] => {}
                    [.., (_, last)] => {
                        let keys: Vec<&str> = given.iter().map(|(key, _)| *key).collect();
                        let found = format!("{} together", all_of(&keys));
                        self.report(last.key_span, Problem::error(path, found, "only one of them"));
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

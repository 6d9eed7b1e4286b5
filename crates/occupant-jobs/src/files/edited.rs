//! Values written into the text of a scenario: comments, order and blanks stay.

use occupant_scenario::{Draft, rival_path};
use placed_text::{Step, parse_path};
use toml_edit::{DocumentMut, InlineTable, Item, Table, TableLike, Value, value};

/// The text with `changes`, paths and values as texts; none where a value cannot be written. Whether it says the same as
/// the changes themselves is for the caller to see. `draft` knows the places of a path with wildcards.
pub fn with_changes<'c>(
    text: &str,
    changes: impl Iterator<Item = (&'c str, &'c str)>,
    draft: &Draft,
) -> Option<DocumentMut> {
    let mut document: DocumentMut = text.parse().ok()?;
    for (path, text) in changes {
        let new = text.parse().unwrap_or_else(|_| Value::from(text));
        // a path with wildcards stands for many places
        let places = if path.contains('*') { draft.places(path).ok()? } else { Vec::new() };
        let mut paths: Vec<&str> = places.iter().map(|p| p.path.as_str()).collect();
        if paths.is_empty() {
            paths.push(path);
        }
        for path in paths {
            put(document.as_item_mut(), &parse_path(path).ok()?, new.clone())?;
            // of two keys for one quantity the new one stays
            if let Some(rival) = rival_path(path) {
                remove(document.as_item_mut(), &parse_path(&rival).ok()?);
            }
        }
    }
    Some(document)
}

/// Removes a value, if it is there.
fn remove(item: &mut Item, steps: &[Step]) -> Option<()> {
    let (Step::Key(key), rest) = steps.split_first()? else { return None };
    let table = item.as_table_like_mut()?;
    if rest.is_empty() {
        table.remove(key);
        return Some(());
    }
    remove(table.get_mut(key)?, rest)
}

/// Sets a value at a path, keeping blanks and comments of the old one; none if the path does not exist and cannot be
/// created.
fn put(item: &mut Item, steps: &[Step], mut new: Value) -> Option<()> {
    let Some((step, rest)) = steps.split_first() else {
        let old = item.as_value_mut()?;
        *new.decor_mut() = old.decor().clone();
        *old = new;
        return Some(());
    };
    let inline = item.is_inline_table();
    let next = match (step, item) {
        (Step::Every, _) => return None,
        (Step::Index(i), item) => item.get_mut(*i)?,
        (Step::Key(name), Item::ArrayOfTables(tables)) => {
            let named = |t: &Table| t.get("name").and_then(Item::as_str) == Some(name);
            let place = tables.iter().position(named)?;
            return put_in_table(tables.get_mut(place)?, false, rest, new);
        }
        (Step::Key(_), item) => return put_in_table(item.as_table_like_mut()?, inline, steps, new),
    };
    put(next, rest, new)
}

/// Sets a value below a table, creating missing parents.
fn put_in_table(table: &mut dyn TableLike, inline: bool, steps: &[Step], new: Value) -> Option<()> {
    let (Step::Key(key), rest) = steps.split_first()? else {
        return None;
    };
    if !table.contains_key(key) {
        let blank = match (rest.is_empty(), inline) {
            (true, _) => Item::Value(new.clone()),
            (false, true) => value(InlineTable::new()),
            (false, false) => Item::Table(Table::new()),
        };
        table.insert(key, blank);
    }
    put(table.get_mut(key)?, rest, new)
}

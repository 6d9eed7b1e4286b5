//! `path.to.key=value`: changes to a scenario from a command line or a sweep, made before it is checked.

use std::sync::Arc;

use super::expand::rival;
use placed_text::{Entry, Node, Span, Step, Value, child, follow, with_step};

/// Whether a path exists only in the explicit form of a scenario: it has wildcards, or it leads into a list that is not
/// written.
pub(super) fn needs_explicit(root: &Node, steps: &[Step]) -> bool {
    let written = || follow(root, steps).is_some();
    steps.contains(&Step::Every) || (steps.iter().any(|s| matches!(s, Step::Index(_))) && !written())
}

/// Sets `value` at a path without wildcards. If two keys give the same quantity, such as the `peak` and the `delta_v`
/// of a pulse, the new one replaces the other. Missing tables on the way are created. A list that only the explicit
/// form has (such as a preset's inertia) is first copied from there. The word null removes the value.
///
/// # Errors
/// The part of the path that does not exist.
pub(super) fn put(root: &mut Node, explicit: Option<&Node>, steps: &[Step], value: Node) -> Result<(), String> {
    let mut node = root;
    let mut shadow = explicit;
    let mut path = String::new();
    for (i, step) in steps.iter().enumerate() {
        let last = i + 1 == steps.len();
        let above = path.clone();
        shadow = shadow.and_then(|s| child(s, step));
        path = with_step(&path, step);
        if let (Step::Key(key), Value::Table(table), true) = (step, &mut node.value, last && is_null(&value)) {
            let taken = Arc::make_mut(table).shift_remove(key);
            return taken.map(|_| ()).ok_or_else(|| format!("there is no `{path}` to remove"));
        }
        if let (Step::Key(key), Value::Table(table)) = (step, &mut node.value)
            && table.get(key).is_none()
        {
            let table = Arc::make_mut(table);
            table.insert(key.clone(), blank(value.span, steps.get(i + 1), shadow));
            rival(key).filter(|_| last).and_then(|rival| table.shift_remove(rival));
        }
        let below = below_mut(node, step);
        node = below.ok_or_else(|| match step {
            Step::Index(at) => format!("`{above}` has no item {at}"),
            _ => format!("`{above}` has nothing named `{}`", path_end(step)),
        })?;
        if last {
            *node = value;
            return Ok(());
        }
    }
    Err("an empty path".to_owned())
}

fn is_null(value: &Node) -> bool {
    matches!(&value.value, Value::Null) || value.as_str() == Some("null")
}

fn path_end(step: &Step) -> &str {
    match step {
        Step::Key(key) => key,
        _ => "*",
    }
}

/// An entry to be filled: a copy of the explicit list if the path continues into a list, else an empty table.
fn blank(span: Span, next: Option<&Step>, shadow: Option<&Node>) -> Entry {
    let copied = match (next, shadow.map(|s| &s.value)) {
        (Some(_), Some(Value::Array(items))) => Some(Value::Array(items.clone())),
        _ => None,
    };
    let node = Node::new(span, copied.unwrap_or(Value::Table(Arc::default())));
    Entry { key_span: span, node }
}

fn below_mut<'a>(node: &'a mut Node, step: &Step) -> Option<&'a mut Node> {
    match (&mut node.value, step) {
        (Value::Table(table), Step::Key(key)) => Arc::make_mut(table).get_mut(key).map(|e| &mut e.node),
        (Value::Array(items), Step::Index(i)) => items.get_mut(*i),
        (Value::Array(items), Step::Key(key)) => {
            items.iter_mut().find(|item| item.get("name").and_then(Node::as_str) == Some(key))
        }
        _ => None,
    }
}

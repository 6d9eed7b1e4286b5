//! Paths into a scenario: `belts.lap.anchors[1]`, `joints.*.damping`, `surfaces."front cushion".material`.

use crate::node::{Node, Value};
use crate::problem::with_key;
use crate::source::Span;

/// One step of a path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// Key of a table, or `name` of an item of a list.
    Key(String),
    /// Index of a list, from 0.
    Index(usize),
    /// Every entry of a table or list that has the following steps.
    Every,
}

/// Largest number of steps.
const MAX_STEPS: usize = 32;

/// Parses a path.
///
/// # Errors
/// Problems of it.
pub fn parse(text: &str) -> Result<Vec<Step>, String> {
    let mut steps = Vec::new();
    let mut rest = text.trim();
    let mut after_dot = true;
    while !rest.is_empty() {
        let (step, length) = match rest.as_bytes()[0] {
            b'[' => index_step(rest)?,
            b'.' if !after_dot => {
                rest = &rest[1..];
                after_dot = true;
                continue;
            }
            _ if !after_dot => return Err(format!("a `.` is missing before `{rest}`")),
            b'"' => quoted_step(rest)?,
            b'*' => (Step::Every, 1),
            _ => {
                let length = rest.find(['.', '[']).unwrap_or(rest.len());
                (Step::Key(rest[..length].trim().to_owned()), length)
            }
        };
        if step == Step::Key(String::new()) {
            return Err(format!("an empty name in `{text}`"));
        }
        if steps.len() == MAX_STEPS {
            return Err(format!("a path of more than {MAX_STEPS} names"));
        }
        steps.push(step);
        rest = &rest[length..];
        after_dot = false;
    }
    match (after_dot, text.trim()) {
        (true, "") => Err("an empty path".to_owned()),
        (true, _) => Err(format!("`{text}` ends where a name must follow")),
        (false, _) => Ok(steps),
    }
}

fn index_step(text: &str) -> Result<(Step, usize), String> {
    let end = text.find(']').ok_or_else(|| format!("`[` without `]` in `{text}`"))?;
    let inner = text[1..end].trim();
    let step = match inner {
        "*" => Step::Every,
        _ => Step::Index(inner.parse().map_err(|_| format!("`{inner}` in brackets is not an index, counted from 0"))?),
    };
    Ok((step, end + 1))
}

fn quoted_step(text: &str) -> Result<(Step, usize), String> {
    let inner = text[1..].find('"').ok_or_else(|| format!("an unclosed quote in `{text}`"))?;
    Ok((Step::Key(text[1..=inner].to_owned()), inner + 2))
}

/// The path as text, for messages.
pub fn to_text(steps: &[Step]) -> String {
    steps.iter().fold(String::new(), |path, step| with_step(&path, step))
}

/// A path with one more step.
pub fn with_step(path: &str, step: &Step) -> String {
    match step {
        Step::Key(key) => with_key(path, key),
        Step::Index(i) => format!("{path}[{i}]"),
        Step::Every if path.is_empty() => "*".to_owned(),
        Step::Every => format!("{path}.*"),
    }
}

/// The node that the steps of a path lead to.
pub fn follow<'a>(root: &'a Node, steps: &[Step]) -> Option<&'a Node> {
    steps.iter().try_fold(root, child)
}

/// The child of a node by key or index. Items of lists are also found by their `name`.
pub fn child<'a>(node: &'a Node, step: &Step) -> Option<&'a Node> {
    match (&node.value, step) {
        (Value::Table(table), Step::Key(key)) => table.get(key).map(|e| &e.node),
        (Value::Array(items), Step::Index(i)) => items.get(*i),
        (Value::Array(items), Step::Key(key)) => {
            items.iter().find(|item| item.get("name").and_then(Node::as_str) == Some(key))
        }
        _ => None,
    }
}

/// The existing paths matched by a path with wildcards, in the explicit form of a scenario.
///
/// A path without wildcards matches itself, even if it does not exist yet.
pub fn targets(explicit: &Node, steps: &[Step]) -> Vec<Vec<Step>> {
    if !steps.contains(&Step::Every) {
        return vec![steps.to_vec()];
    }
    let mut found = Vec::new();
    collect(explicit, steps, &mut Vec::new(), &mut found);
    found
}

fn collect(node: &Node, rest: &[Step], path: &mut Vec<Step>, found: &mut Vec<Vec<Step>>) {
    let Some((step, rest)) = rest.split_first() else {
        found.push(path.clone());
        return;
    };
    let next = match step {
        Step::Every => children(node),
        _ => child(node, step).map(|below| (step.clone(), below)).into_iter().collect(),
    };
    for (step, below) in next {
        path.push(step);
        collect(below, rest, path, found);
        path.pop();
    }
}

/// All children of a node, with their steps.
pub fn children(node: &Node) -> Vec<(Step, &Node)> {
    match &node.value {
        Value::Table(table) => table.iter().map(|(key, entry)| (Step::Key(key.clone()), &entry.node)).collect(),
        Value::Array(items) => items.iter().enumerate().map(|(i, item)| (Step::Index(i), item)).collect(),
        _ => Vec::new(),
    }
}

/// The value at a path in a tree, or the nearest existing ancestor.
pub fn locate(root: &Node, path: &str) -> Option<Span> {
    let steps = parse(path).ok()?;
    let mut node = root;
    let mut found = None;
    for step in &steps {
        match child(node, step) {
            Some(next) => {
                found = Some(next.span);
                node = next;
            }
            None => break,
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_names_indices_and_wildcards() {
        let key = |k: &str| Step::Key(k.into());
        assert_eq!(
            parse("belts.lap.anchors[1][0]").unwrap(),
            [key("belts"), key("lap"), key("anchors"), Step::Index(1), Step::Index(0)]
        );
        assert_eq!(parse("joints.*.damping").unwrap(), [key("joints"), Step::Every, key("damping")]);
        let quoted = "surfaces.\"front. cushion\".material";
        assert_eq!(to_text(&parse(quoted).unwrap()), quoted);
        for wrong in ["", ".", "a.", "a..b", "a[", "a[x]", "a[0]b", "a.\"b", "a.\"\""] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }
}

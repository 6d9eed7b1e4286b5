//! The places that a path leads to in a scenario: what may stand there, and what does.
//!
//! A study asks this before it changes anything, so that a path that leads nowhere and a unit of the wrong kind are told
//! once and not by every run.

use serde_json::Value as Json;

use super::check::units_of;
use super::document::{Node, Value};
use super::draft::Draft;
use super::expand::expand;
use super::kind::Kind;
use super::overrides::{put, targets};
use super::path_text::{Step, child, child_of, parse, to_text};
use super::quantity::{Written, si_value};
use super::schema::schema;
use super::view::View;
use crate::problem::nearest;

/// What may stand at a place.
#[derive(Clone, Debug, PartialEq)]
pub enum Wanted {
    /// A quantity of this kind.
    Quantity(&'static Kind),
    /// A number without a unit.
    Number,
    /// One of these names.
    Names(Vec<&'static str>),
    /// Any text.
    Text,
    /// True or false.
    Truth,
}

/// A single value of a scenario, presets and groups written out.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Its path, without wildcards.
    pub path: String,
    /// What may stand there.
    pub wanted: Wanted,
    /// What stands there, if anything.
    pub value: Option<Value>,
    /// The same as a number in SI units, angles in radians.
    pub si: Option<f64>,
}

/// Why a path leads to no value: found, expected, help.
#[derive(Clone, Debug, PartialEq)]
pub struct Misplaced {
    /// What was found.
    pub found: String,
    /// What was expected.
    pub expected: String,
    /// What may have been meant.
    pub hint: Option<String>,
}

impl Misplaced {
    fn new(found: impl Into<String>, expected: impl Into<String>, hint: Option<String>) -> Self {
        Misplaced { found: found.into(), expected: expected.into(), hint }
    }
}

impl Draft {
    /// Every single value that a path stands for. A path to a group that the scenario knows by one word, such as
    /// `joints.all.damping` or `body.segments.thighs.mass`, stands for the values that it changes.
    ///
    /// # Errors
    /// A path that cannot be read, leads nowhere, or leads to a whole table or list.
    pub fn places(&self, path: &str) -> Result<Vec<Place>, Misplaced> {
        let steps = parse(path).map_err(|found| Misplaced::new(found, "a path such as belts.lap.slack", None))?;
        let explicit = expand(&mut self.sources.clone(), &self.root);
        let found = targets(&explicit, &steps);
        if found.is_empty() {
            return Err(nowhere(&explicit, path, &steps));
        }
        let mut places = Vec::new();
        for steps in found {
            let place = self.place(&explicit, &steps)?;
            match place.value {
                Some(_) => places.push(place),
                None => places.extend(self.changed_by(&explicit, &steps, place)?),
            }
        }
        Ok(places)
    }

    /// The place at a path without wildcards.
    fn place(&self, explicit: &Node, steps: &[Step]) -> Result<Place, Misplaced> {
        let root = schema();
        let (mut view, mut node) = (View::of(root, root), Some(explicit));
        for (i, step) in steps.iter().enumerate() {
            let above = view.ok_or_else(|| no_value(steps))?;
            let above = at_hand(above, root, node);
            let below = node.and_then(|n| child(n, step));
            view = match step {
                Step::Key(key) => match above.property(root, key) {
                    Some(view) if below.is_some() || above.keys().contains(&key.as_str()) => Some(view),
                    _ => return Err(unknown(&above, node, steps, i)),
                },
                _ if below.is_some() => above.items(root),
                _ => return Err(unknown(&above, node, steps, i)),
            };
            node = below;
        }
        let view = view.ok_or_else(|| no_value(steps))?;
        let wanted = wanted(&view).ok_or_else(|| no_value(steps))?;
        let si = node.and_then(|n| self.si(n, &wanted));
        Ok(Place { path: to_text(steps), wanted, value: node.map(|n| n.value.clone()), si })
    }

    /// A value as a number in SI units.
    fn si(&self, node: &Node, wanted: &Wanted) -> Option<f64> {
        let written = match &node.value {
            Value::Integer(i) => Written::Integer(*i),
            Value::Float(x) => Written::Float(*x),
            Value::String(text) => Written::Text(text.clone()),
            _ => return None,
        };
        match (wanted, written) {
            (Wanted::Quantity(kind), written) => si_value(&written, kind, units_of(&self.root)).ok(),
            (Wanted::Number, Written::Integer(i)) => Some(i as f64),
            (Wanted::Number, Written::Float(x)) => Some(x),
            _ => None,
        }
    }

    /// The values of the explicit scenario that change when something is written at a place where nothing stands.
    fn changed_by(&self, explicit: &Node, steps: &[Step], place: Place) -> Result<Vec<Place>, Misplaced> {
        // any value that stands nowhere yet will do: it is only looked for again
        let mark = Value::String("\u{0}".to_owned());
        let mut root = self.root.clone();
        let node = Node { span: root.span, value: mark.clone() };
        put(&mut root, Some(explicit), steps, node)
            .map_err(|found| Misplaced::new(found, "a path that exists in the scenario", None))?;
        let marked = expand(&mut self.sources.clone(), &root);
        let mut found = Vec::new();
        collect(&marked, &mark, &mut Vec::new(), &mut found);
        if found.is_empty() {
            return Err(Misplaced::new(
                format!("`{}` changes nothing in this scenario", place.path),
                "a path to something that counts",
                Some("what is said of a single joint, segment or sphere wins over what is said of a group".into()),
            ));
        }
        if found == [steps] {
            return Ok(vec![place]);
        }
        found.iter().map(|s| self.place(explicit, s)).collect()
    }
}

/// Why a path with wildcards matches nothing: the first of its names that stands under none of what is before it.
fn nowhere(explicit: &Node, path: &str, steps: &[Step]) -> Misplaced {
    let reached = |n: usize| -> Vec<&Node> {
        targets(explicit, &steps[..n]).iter().filter_map(|place| place.iter().try_fold(explicit, child_of)).collect()
    };
    let good = (1..=steps.len()).take_while(|n| !reached(*n).is_empty()).last().unwrap_or(0);
    let beside = reached(good);
    let mut names: Vec<&str> = beside
        .iter()
        .filter_map(|node| node.as_table())
        .flat_map(|table| table.iter().map(|e| e.key.as_str()))
        .collect();
    names.sort_unstable();
    names.dedup();
    let hint = match steps.get(good) {
        Some(Step::Key(key)) => nearest(key, names.iter().copied()),
        _ => None,
    };
    Misplaced::new(
        format!("`{path}` matches nothing in the base scenario"),
        "a path to at least one value",
        hint.map(|n| format!("did you mean `{n}`?")),
    )
}

/// The case of a table with a `kind` that its own `kind` names; else the view itself.
fn at_hand(view: View, root: &'static Json, node: Option<&Node>) -> View {
    let tag = node.and_then(|n| n.get("kind")).and_then(Node::as_str);
    let cases = view.cases(root).unwrap_or_default();
    let case = cases.into_iter().find(|(name, _)| Some(*name) == tag);
    case.map_or(view, |(_, view)| view)
}

fn wanted(view: &View) -> Option<Wanted> {
    if let Some(kind) = view.kind() {
        return Some(Wanted::Quantity(kind));
    }
    if let Some(names) = view.names() {
        return Some(Wanted::Names(names));
    }
    match view.type_name() {
        "string" => Some(Wanted::Text),
        "boolean" => Some(Wanted::Truth),
        "number" => Some(Wanted::Number),
        _ => None,
    }
}

fn no_value(steps: &[Step]) -> Misplaced {
    Misplaced::new(
        format!("`{}` leads to a table or list, not to a single value", to_text(steps)),
        "a path to numbers or names",
        None,
    )
}

/// The step of a path that leads nowhere, and what stands beside it.
fn unknown(view: &View, node: Option<&Node>, steps: &[Step], at: usize) -> Misplaced {
    let above = match at {
        0 => "the base scenario".to_owned(),
        _ => format!("`{}`", to_text(&steps[..at])),
    };
    let Step::Key(key) = &steps[at] else {
        let found = match node.map(|n| &n.value) {
            Some(Value::Array(items)) => format!("{above} has only {} items", items.len()),
            Some(_) => format!("{above} is no list"),
            None => format!("{above} is not in the base scenario"),
        };
        return Misplaced::new(found, "an index that exists, from 0", None);
    };
    let mut names = view.keys();
    let own = node.and_then(Node::as_table);
    names.extend(own.iter().flat_map(|t| t.iter()).map(|e| e.key.as_str()));
    let hint = nearest(key, names.iter().copied()).map(|n| format!("did you mean `{n}`?"));
    names.sort_unstable();
    names.dedup();
    let expected = match names.is_empty() {
        true => "a shorter path".to_owned(),
        false => format!("one of {}", names.join(", ")),
    };
    Misplaced::new(format!("{above} has nothing named `{key}`"), expected, hint)
}

/// The paths at which a value stands.
fn collect(node: &Node, wanted: &Value, path: &mut Vec<Step>, found: &mut Vec<Vec<Step>>) {
    if node.value == *wanted {
        found.push(path.clone());
    }
    let below: Vec<(Step, &Node)> = match &node.value {
        Value::Table(table) => table.iter().map(|e| (Step::Key(e.key.clone()), &e.node)).collect(),
        Value::Array(items) => items.iter().enumerate().map(|(i, n)| (Step::Index(i), n)).collect(),
        _ => Vec::new(),
    };
    for (step, node) in below {
        path.push(step);
        collect(node, wanted, path, found);
        path.pop();
    }
}

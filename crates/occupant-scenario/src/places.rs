//! The places that a path matches in a scenario: their allowed and present values.
//!
//! A study uses this before it changes anything, so that an unknown path or a wrong unit is reported once and not by
//! every run.

use serde_json::Value as Json;

use super::check::View;
use super::draft::Draft;
use super::expand::expand;
use super::kind::{Kind, split_number};
use super::overrides::put;
use super::sections::schema;
use occupant_core::body::both_sides;
use occupant_units::unit::parse;
use placed_text::{Node, Problem, Step, Value, child, children, did_you_mean, follow, parse_path, targets, to_text};

/// The allowed value at a place.
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

/// A single value of a scenario with presets and groups expanded.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Its path, without wildcards.
    pub path: String,
    /// The allowed value.
    pub wanted: Wanted,
    /// The present value, if any.
    pub value: Option<Value>,
    /// The same as a number in SI units, angles in radians.
    pub si: Option<f64>,
}

impl Draft {
    /// Every single value that a path matches. A path to a group with one name, such as `joints.all.damping` or
    /// `body.segments.thighs.mass`, matches the values that it changes.
    ///
    /// # Errors
    /// A path that is invalid, does not exist, or is a whole table or list.
    pub fn places(&self, path: &str) -> Result<Vec<Place>, Problem> {
        let steps = parse_path(path).map_err(|found| misplaced(found, "a path such as belts.lap.slack"))?;
        let explicit = expand(&mut self.document.sources.clone(), &self.document.root);
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
    fn place(&self, explicit: &Node, steps: &[Step]) -> Result<Place, Problem> {
        let root = schema();
        let (mut view, mut node) = (View::of(root, root), Some(explicit));
        for (i, step) in steps.iter().enumerate() {
            let above = view.ok_or_else(|| no_value(steps))?;
            let above = at_hand(above, root, node);
            let below = node.and_then(|n| child(n, step));
            view = match step {
                Step::Key(key) => match above.property(root, key) {
                    Some(view) if below.is_some() || above.keys().contains(&key.as_str()) => Some(view),
                    Some(view) if pairs(node).contains(key) => Some(view),
                    _ => return Err(unknown(&above, node, steps, i)),
                },
                _ if below.is_some() => above.items(root),
                _ => return Err(unknown(&above, node, steps, i)),
            };
            node = below;
        }
        let view = view.ok_or_else(|| no_value(steps))?;
        let wanted = wanted(&view).ok_or_else(|| no_value(steps))?;
        let si = node.and_then(|n| self.si(&n.value, &wanted));
        Ok(Place { path: to_text(steps), wanted, value: node.map(|n| n.value.clone()), si })
    }

    /// A value as a number in SI units.
    fn si(&self, value: &Value, wanted: &Wanted) -> Option<f64> {
        match wanted {
            Wanted::Quantity(kind) => kind.si(value, self.units()).ok(),
            Wanted::Number => value.number(),
            _ => None,
        }
    }

    /// The values of the explicit scenario that change when an absent key is written.
    fn changed_by(&self, explicit: &Node, steps: &[Step], place: Place) -> Result<Vec<Place>, Problem> {
        // any value that stands nowhere yet will do: it is only looked for again
        let mark = Value::String("\u{0}".to_owned());
        let mut root = self.document.root.clone();
        let node = Node::new(root.span, mark.clone());
        put(&mut root, Some(explicit), steps, node).map_err(|found| misplaced(found, "the path of an existing key"))?;
        let marked = expand(&mut self.document.sources.clone(), &root);
        let mut found = Vec::new();
        collect(&marked, &mark, &mut Vec::new(), &mut found);
        if found.is_empty() && matches!(steps.last(), Some(Step::Key(key)) if key == "preset") {
            // the explicit scenario has what it stands for; that such a name changes nothing cannot be seen from a mark
            return Ok(vec![Place { value: follow(&self.document.root, steps).map(|n| n.value.clone()), ..place }]);
        }
        if found.is_empty() {
            let found = format!("`{}` changes nothing in this scenario", place.path);
            let hint = "a value for a single joint, segment or sphere overrides that of its group";
            return Err(misplaced(found, "the path of a value that is used").with_hint(Some(hint)));
        }
        if found == [steps] {
            return Ok(vec![place]);
        }
        found.iter().map(|s| self.place(explicit, s)).collect()
    }
}

impl Wanted {
    /// The allowed value, with its article.
    pub fn noun(&self) -> &'static str {
        match self {
            Wanted::Quantity(kind) => kind.noun,
            Wanted::Number => "a number",
            Wanted::Names(_) => "a name",
            Wanted::Text => "a text",
            Wanted::Truth => "true or false",
        }
    }
}

impl Draft {
    /// A number in SI units as TOML, with a number of significant digits, in the unit of the present value or otherwise
    /// of the scenario's bare numbers. None if no number is allowed.
    pub fn written(&self, path: &str, si: f64, digits: usize) -> Option<String> {
        let place = self.places(path).ok()?.into_iter().next()?;
        if place.wanted == Wanted::Number {
            return Some(rounded(si, digits));
        }
        let (unit, factor) = self.unit_at(path)?;
        let number = rounded(si / factor, digits);
        Some(if matches!(place.value, Some(Value::String(_))) { format!("\"{number} {unit}\"") } else { number })
    }

    /// The unit in which a number is displayed, and its size in SI units: that of the present value, otherwise that of
    /// the scenario's bare numbers. None if no quantity is allowed.
    pub fn unit_at(&self, path: &str) -> Option<(String, f64)> {
        let place = self.places(path).ok()?.into_iter().next()?;
        let Wanted::Quantity(kind) = place.wanted else { return None };
        let unit = match &place.value {
            Some(Value::String(text)) => text[split_number(text)?.1..].trim_end().to_owned(),
            _ => kind.bare_unit(self.units()).to_owned(),
        };
        let factor = if unit.is_empty() { 1.0 } else { parse(&unit, 0).ok()?.factor };
        Some((unit, factor))
    }
}

/// The shortest text of a number rounded to a number of significant digits.
fn rounded(value: f64, digits: usize) -> String {
    let short = format!("{value:.*e}", digits.max(1) - 1);
    short.parse::<f64>().unwrap_or(value).to_string()
}

/// Why a path with wildcards matches nothing: its first name that does not exist under the previous ones.
fn nowhere(explicit: &Node, path: &str, steps: &[Step]) -> Problem {
    let reached = |n: usize| -> Vec<&Node> {
        targets(explicit, &steps[..n]).iter().filter_map(|place| follow(explicit, place)).collect()
    };
    let good = (1..=steps.len()).take_while(|n| !reached(*n).is_empty()).last().unwrap_or(0);
    let beside = reached(good);
    let mut names: Vec<&str> =
        beside.iter().filter_map(|node| node.as_table()).flat_map(|table| table.keys().map(String::as_str)).collect();
    names.sort_unstable();
    names.dedup();
    let hint = match steps.get(good) {
        Some(Step::Key(key)) => did_you_mean(key, &names, '`'),
        _ => None,
    };
    misplaced(format!("`{path}` matches nothing in the base scenario"), "the path of an existing value").with_hint(hint)
}

/// Words for both sides of the entries of a table.
fn pairs(node: Option<&Node>) -> Vec<String> {
    let table = node.and_then(Node::as_table);
    table.into_iter().flat_map(|table| table.keys()).filter_map(|name| both_sides(name)).collect()
}

/// The case of a table selected by its `kind`; otherwise the view itself.
fn at_hand(view: View, root: &'static Json, node: Option<&Node>) -> View {
    let tag = node.and_then(|n| n.get("kind")).and_then(Node::as_str);
    let cases = view.cases(root).unwrap_or_default();
    let case = cases.into_iter().find(|(name, _)| Some(*name) == tag);
    case.map_or(view, |(_, view)| view)
}

/// Why a path matches no value.
fn misplaced(found: impl Into<String>, expected: impl Into<String>) -> Problem {
    Problem::error("", found, expected)
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

fn no_value(steps: &[Step]) -> Problem {
    let found = format!("`{}` is a table or list, not a single value", to_text(steps));
    misplaced(found, "the path of a number or a name")
}

/// The step of a path that does not exist, and its siblings.
fn unknown(view: &View, node: Option<&Node>, steps: &[Step], at: usize) -> Problem {
    let above = match at {
        0 => "the base scenario".to_owned(),
        _ => format!("`{}`", to_text(&steps[..at])),
    };
    let Step::Key(key) = &steps[at] else {
        let found = match node.map(|n| &n.value) {
            Some(Value::Array(items)) => format!("{above} has only {} items", items.len()),
            Some(_) => format!("{above} is not a list"),
            None => format!("{above} is not in the base scenario"),
        };
        return misplaced(found, "an index that exists, from 0");
    };
    let pairs = pairs(node);
    let mut names = view.keys();
    names.extend(pairs.iter().map(String::as_str));
    let own = node.and_then(Node::as_table);
    names.extend(own.into_iter().flat_map(|table| table.keys().map(String::as_str)));
    let hint = did_you_mean(key, &names, '`');
    names.sort_unstable();
    names.dedup();
    let expected = if names.is_empty() { "a shorter path".to_owned() } else { format!("one of {}", names.join(", ")) };
    misplaced(format!("{above} has nothing named `{key}`"), expected).with_hint(hint)
}

/// The paths of all values.
fn collect(node: &Node, wanted: &Value, path: &mut Vec<Step>, found: &mut Vec<Vec<Step>>) {
    if node.value == *wanted {
        found.push(path.clone());
    }
    for (step, node) in children(node) {
        path.push(step);
        collect(node, wanted, path, found);
        path.pop();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Format;

    #[test]
    fn numbers_keep_the_unit_that_stands_there() {
        let text = r#"
            title = "a"
            units = "in-lbf-s"
            [joints.neck]
            damping = "20 in lbf s/rad"
            [materials]
            seat = { k1 = 48, mu1 = 0.5 }
            [path]
            kind = "pulse"
            speed = "20 mph"
        "#;
        let draft = Draft::read(text, Format::Toml, "a.toml").unwrap();
        let si = |path: &str| draft.places(path).unwrap()[0].si.unwrap();
        for (path, wanted) in [
            ("joints.neck.damping", "\"24.6914 in lbf s/rad\""),
            ("materials.seat.k1", "59.2593"),
            ("materials.seat.mu1", "0.617284"),
            ("path.speed", "\"24.6914 mph\""),
        ] {
            let found = draft.written(path, si(path) * 1.234_567_9, 6);
            assert_eq!(found.as_deref(), Some(wanted));
        }
        assert_eq!(draft.written("title", 1.0, 6), None);
    }
}

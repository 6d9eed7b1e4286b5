//! Checks a tree against the schema of its sections and reports every problem at once. Each quantity is converted to SI
//! units once and stored in the tree.

mod groups;
mod references;
pub(super) mod schema;
mod view;

use occupant_units::unit::UnitError;
use serde_json::Value as Json;

pub(super) use references::references;
pub(super) use view::View;

use super::kind::{Kind, UnitSystem};
use placed_text::{
    Diagnostic, Diagnostics, Document, Node, Problem, Sources, Span, Value, did_you_mean, nearest, one_of, with_key,
};

/// All problems of a text; `what` is its name in messages.
pub fn check_words(document: &mut Document, schema: &'static Json, what: &'static str) -> Diagnostics {
    let units = units_of(document);
    let mut checker = Checker { sources: &document.sources, root: schema, what, units, problems: Diagnostics::new() };
    if let Some(view) = View::of(schema, schema) {
        checker.node(&view, &mut document.root, "");
    }
    checker.problems
}

/// All problems of some sections of a document, without their context.
pub(super) fn check_parts(document: &mut Document, schema: &'static Json, keys: &[&str]) -> Diagnostics {
    let units = units_of(document);
    let what = "the scenario";
    let mut checker = Checker { sources: &document.sources, root: schema, what, units, problems: Diagnostics::new() };
    if let (Some(view), Some(table)) = (View::of(schema, schema), document.root.as_table_mut()) {
        for key in keys {
            if let (Some(part), Some(entry)) = (view.property(schema, key), table.get_mut(*key)) {
                checker.node(&part, &mut entry.node, key);
            }
        }
    }
    checker.problems
}

/// The units of a text's bare numbers.
pub(super) fn units_of(document: &Document) -> UnitSystem {
    match document.root.get("units").and_then(Node::as_str) {
        Some("in-lbf-s") => UnitSystem::InchPound,
        _ => UnitSystem::Si,
    }
}

struct Checker<'a> {
    sources: &'a Sources,
    root: &'static Json,
    what: &'static str,
    units: UnitSystem,
    problems: Diagnostics,
}

impl Checker<'_> {
    fn node(&mut self, view: &View, node: &mut Node, path: &str) {
        if let Some(kind) = view.kind() {
            return self.quantity(view, kind, node, path);
        }
        if let Some(names) = view.names() {
            return self.name(&names, node, path);
        }
        if let Some(cases) = view.cases(self.root) {
            return self.tagged(&cases, node, path);
        }
        if view.is_open() {
            return self.open(view, node, path);
        }
        match (view.type_name(), &node.value) {
            ("object", Value::Table(_)) => self.table(view, node, path),
            ("array", Value::Array(_)) => self.array(view, node, path),
            ("string", Value::String(_)) | ("boolean", Value::Bool(_)) => {}
            ("number", Value::Integer(_)) => {}
            ("number", Value::Float(x)) if x.is_finite() => {}
            ("integer", Value::Integer(i)) => self.count(view, *i, node, path),
            _ => self.wrong_type(view, node, path),
        }
    }

    /// A whole number not below its minimum.
    fn count(&mut self, view: &View, number: i64, node: &Node, path: &str) {
        let least = view.get("minimum").and_then(Json::as_i64);
        if let Some(least) = least.filter(|least| number < *least) {
            let found = format!("`{number}` is out of range");
            self.report(node.span, Problem::error(path, found, format!("a whole number of at least {least}")));
        }
    }

    /// A value whose meaning another part of the document decides: only its type is checked here.
    fn open(&mut self, view: &View, node: &Node, path: &str) {
        let fits = match &node.value {
            Value::Integer(_) => view.may_be("number") || view.may_be("integer"),
            Value::Float(x) => view.may_be("number") && x.is_finite(),
            Value::String(_) => view.may_be("string"),
            Value::Bool(_) => view.may_be("boolean"),
            Value::Array(_) => view.may_be("array"),
            Value::Null | Value::Table(_) => false,
        };
        if !fits {
            self.wrong_type(view, node, path);
        }
    }

    fn wrong_type(&mut self, view: &View, node: &Node, path: &str) {
        let unquoted = |text: &str| format!("write {text} without quotes");
        let hint = match (&node.value, view.type_name()) {
            (Value::Null, _) => Some("leave the key out instead".to_owned()),
            (Value::String(text), "boolean") if text == "true" || text == "false" => Some(unquoted(text)),
            (Value::String(text), "number") if text.parse::<f64>().is_ok() => Some(unquoted(text)),
            _ => None,
        };
        let found = match &node.value {
            Value::Float(x) if !x.is_finite() => format!("`{x}`"),
            value => format!("{} instead of {}", value.kind(), view.noun()),
        };
        self.report(node.span, Problem::error(path, found, view.wanted()).with_hint(hint));
    }

    fn quantity(&mut self, view: &View, kind: &Kind, node: &mut Node, path: &str) {
        if !matches!(node.value, Value::Integer(_) | Value::Float(_) | Value::String(_)) {
            return self.wrong_type(view, node, path);
        }
        match kind.si(&node.value, self.units) {
            Ok(si) => {
                node.si = Some(si);
                self.range(view, kind, si, node, path);
            }
            Err(error) => self.unit_error(error, node, path),
        }
    }

    /// Points into the text of a quantity if the text is unescaped in the source.
    fn unit_error(&mut self, error: UnitError, node: &Node, path: &str) {
        let literal = self.sources.slice(node.span);
        let text = node.as_str().unwrap_or("");
        let quotes = match literal.get(1..literal.len().saturating_sub(1)) {
            _ if error.end <= error.start => None,
            Some(inner) if inner == text => Some(1),
            _ => (literal == text).then_some(0),
        };
        let span = quotes.map_or(node.span, |q| node.span.part(error.start + q, error.end + q));
        self.report(span, Problem::error(path, error.found, error.expected).with_hint(error.hint));
    }

    fn range(&mut self, view: &View, kind: &Kind, value: f64, node: &Node, path: &str) {
        let bound = |word: &str| view.get(word).and_then(Json::as_f64);
        let expected = [
            ("minimum", "of at least", -1.0, false),
            ("exclusiveMinimum", "above", -1.0, true),
            ("maximum", "of at most", 1.0, false),
        ]
        .into_iter()
        .find_map(|(word, words, sign, strict)| {
            let limit = bound(word)?;
            let excess = sign * (value - limit);
            (excess > 0.0 || (strict && excess == 0.0)).then(|| format!("{} {words} {limit}", kind.noun))
        });
        if let Some(expected) = expected {
            let found = format!("`{}` is out of range", self.sources.slice(node.span));
            self.report(node.span, Problem::error(path, found, expected));
        }
    }

    fn name(&mut self, names: &[&str], node: &Node, path: &str) {
        let expected = one_of(names, '"');
        match &node.value {
            Value::String(text) if names.contains(&text.as_str()) => {}
            Value::String(text) => {
                let found = format!("\"{text}\" is not a value of `{}`", last_key(path));
                self.report(node.span, Problem::error(path, found, expected).with_hint(did_you_mean(text, names, '"')));
            }
            value => {
                let found = format!("{} instead of a name in quotes", value.kind());
                self.report(node.span, Problem::error(path, found, expected));
            }
        }
    }

    /// A table whose `kind` decides its keys.
    fn tagged(&mut self, cases: &[(&str, View)], node: &mut Node, path: &str) {
        let names: Vec<&str> = cases.iter().map(|(name, _)| *name).collect();
        let Some(table) = node.as_table() else {
            let expected = format!("a table with a key `kind`, {}", one_of(&names, '"'));
            let found = format!("{} instead of a table", node.value.kind());
            return self.report(node.span, Problem::error(path, found, expected));
        };
        let Some(tag) = table.get("kind") else {
            let expected = format!("kind = {}", one_of(&names, '"'));
            return self.report(node.span, Problem::error(path, format!("`{path}` has no key `kind`"), expected));
        };
        match cases.iter().find(|(name, _)| tag.node.as_str() == Some(name)) {
            Some((_, view)) => self.table(view, node, path),
            None => self.name(&names, &tag.node, &with_key(path, "kind")),
        }
    }

    fn table(&mut self, view: &View, node: &mut Node, path: &str) {
        for (key, entry) in node.as_table_mut().into_iter().flatten() {
            match view.property(self.root, key) {
                Some(property) => self.node(&property, &mut entry.node, &with_key(path, key)),
                None => self.unknown_key(view, key, entry.key_span, path),
            }
        }
        let meant = self.meant(view, node);
        for key in view.required() {
            if node.get(key).is_none() && key != "kind" && !meant.contains(&key) {
                let wanted = view.property(self.root, key).map(|p| p.wanted()).unwrap_or_default();
                let owner = if path.is_empty() { self.what.to_owned() } else { format!("`{path}`") };
                let found = format!("{owner} has no key `{key}`");
                self.report_table(node, Problem::error(path, found, format!("{key} = {wanted}")));
            }
        }
        self.groups(view, node, path, &meant);
    }

    /// Keys that misspelt ones probably mean: their absence follows from the misspelling.
    fn meant(&self, view: &View, node: &Node) -> Vec<&'static str> {
        let keys = view.keys();
        let all = node.as_table().into_iter().flatten().map(|(key, _)| key.as_str());
        let unknown = all.filter(|key| view.property(self.root, key).is_none());
        unknown.filter_map(|key| nearest(key, keys.iter().copied())).collect()
    }

    fn unknown_key(&mut self, view: &View, key: &str, span: Span, path: &str) {
        let keys = view.keys();
        let problem = Problem::error(path, format!("unknown key `{key}`"), one_of(&keys, '`'));
        self.report(span, problem.with_hint(did_you_mean(key, &keys, '`')));
    }

    fn array(&mut self, view: &View, node: &mut Node, path: &str) {
        let length = |word: &str| view.get(word).and_then(Json::as_u64).map(|n| n as usize);
        let (least, most) = (length("minItems").unwrap_or(0), length("maxItems"));
        let count = node.items().len();
        if count < least || most.is_some_and(|most| count > most) {
            let found = if count == 0 { "an empty list".to_owned() } else { format!("a list of {count}") };
            self.report(node.span, Problem::error(path, found, view.wanted()));
        }
        if let (Some(item_view), Value::Array(items)) = (view.items(self.root), &mut node.value) {
            for (i, item) in items.iter_mut().enumerate() {
                self.node(&item_view, item, &format!("{path}[{i}]"));
            }
        }
    }

    /// Reports a problem of a table as a whole; the root has no text to point at.
    fn report_table(&mut self, node: &Node, problem: Problem) {
        if problem.path.is_empty() {
            let name = self.sources.name(node.span.source);
            self.problems.push(Diagnostic::of(name, problem));
        } else {
            self.report(node.span, problem);
        }
    }

    fn report(&mut self, span: Span, problem: Problem) {
        self.problems.add(problem, |problem| Diagnostic::at(self.sources, span, problem));
    }
}

/// The last name of a path, without indices.
fn last_key(path: &str) -> &str {
    let end = path.find('[').unwrap_or(path.len());
    path[..end].rsplit('.').next().unwrap_or(path)
}

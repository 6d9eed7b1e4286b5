//! Checks a scenario tree against the schema and reports every problem at once.

use serde_json::Value as Json;

use super::diagnostic::{Diagnostic, Diagnostics};
use super::document::{Entry, Node, Table, Value};
use super::kind::{KINDS, Kind, UnitSystem};
use super::path_text::with_key;
use super::quantity::{Written, si_value};
use super::schema::schema;
use super::source::{Sources, Span};
use super::unit::UnitError;
use super::view::View;
use crate::problem::nearest;
use crate::problem::{Problem, Severity};

/// All that is wrong with the words of a scenario; what they mean together is checked when the model is built.
pub fn check(sources: &Sources, root: &Node) -> Diagnostics {
    let mut checker = Checker::new(sources, schema(), "the scenario", units_of(root));
    checker.document(root);
    // where the words are right, the builder looks names up with full knowledge
    if checker.problems.has_errors() {
        checker.references(root);
    }
    checker.problems
}

/// All that is wrong with the words of another kind of document; `what` is what messages call it.
pub fn check_words(sources: &Sources, root: &Node, schema: &'static Json, what: &'static str) -> Diagnostics {
    let mut checker = Checker::new(sources, schema, what, units_of(root));
    checker.document(root);
    checker.problems
}

/// The units of bare numbers in a document.
pub fn units_of(root: &Node) -> UnitSystem {
    match root.get("units").and_then(Node::as_str) {
        Some("in-lbf-s") => UnitSystem::InchPound,
        _ => UnitSystem::Si,
    }
}

pub(super) struct Checker<'a> {
    sources: &'a Sources,
    root: &'static Json,
    pub(super) what: &'static str,
    units: UnitSystem,
    problems: Diagnostics,
}

impl<'a> Checker<'a> {
    fn new(sources: &'a Sources, root: &'static Json, what: &'static str, units: UnitSystem) -> Self {
        Checker { sources, root, what, units, problems: Diagnostics::new() }
    }

    fn document(&mut self, root: &Node) {
        if let Some(view) = View::of(self.root, self.root) {
            self.node(&view, root, "");
        }
    }
}

impl Checker<'_> {
    fn node(&mut self, view: &View, node: &Node, path: &str) {
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
            ("object", Value::Table(table)) => self.table(view, node, table, path),
            ("array", Value::Array(items)) => self.array(view, node, items, path),
            ("string", Value::String(_)) | ("boolean", Value::Bool(_)) => {}
            ("number", Value::Integer(_)) => {}
            ("number", Value::Float(x)) if x.is_finite() => {}
            ("integer", Value::Integer(i)) => self.count(view, *i, node, path),
            _ => self.wrong_type(view, node, path),
        }
    }

    /// A whole number not below the least that makes sense.
    fn count(&mut self, view: &View, number: i64, node: &Node, path: &str) {
        let least = view.get("minimum").and_then(Json::as_i64);
        if let Some(least) = least.filter(|least| number < *least) {
            let found = format!("`{number}` is out of range");
            let expected = format!("a whole number of at least {least}");
            self.report(node.span, path, found, expected, None);
        }
    }

    /// A value whose meaning another part of the document decides: here only its type is looked at.
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
        let hint = match (&node.value, view.type_name()) {
            (Value::Null, _) => Some("leave the key out instead".to_owned()),
            (Value::String(text), "boolean") if text == "true" || text == "false" => {
                Some(format!("write {text} without quotes"))
            }
            (Value::String(text), "number") if text.parse::<f64>().is_ok() => {
                Some(format!("write {text} without quotes"))
            }
            _ => None,
        };
        let found = match &node.value {
            Value::Float(x) if !x.is_finite() => format!("`{x}`"),
            _ => format!("{} where {} should stand", node.kind(), view.noun()),
        };
        self.report(node.span, path, found, view.wanted(), hint);
    }

    fn quantity(&mut self, view: &View, kind: &Kind, node: &Node, path: &str) {
        let written = match &node.value {
            Value::Integer(i) => Written::Integer(*i),
            Value::Float(x) => Written::Float(*x),
            Value::String(text) => Written::Text(text.clone()),
            _ => return self.wrong_type(view, node, path),
        };
        match si_value(&written, kind, self.units) {
            Ok(value) => self.range(view, kind, value, node, path),
            Err(error) => self.unit_error(error, node, path),
        }
    }

    /// Points into the text of a quantity where the text stands letter by letter in the source.
    fn unit_error(&mut self, error: UnitError, node: &Node, path: &str) {
        let literal = self.sources.slice(node.span);
        let text = node.as_str().unwrap_or("");
        let quotes = match literal.get(1..literal.len().saturating_sub(1)) {
            _ if error.end <= error.start => None,
            Some(inner) if inner == text => Some(1),
            _ => (literal == text).then_some(0),
        };
        let span = quotes.map_or(node.span, |q| node.span.part(error.start + q, error.end + q));
        self.report(span, path, error.found, error.expected, error.hint);
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
            self.report(node.span, path, found, expected, None);
        }
    }

    fn name(&mut self, names: &[&str], node: &Node, path: &str) {
        let expected = one_of(names, '"');
        match &node.value {
            Value::String(text) if names.contains(&text.as_str()) => {}
            Value::String(text) => {
                let hint = nearest(text, names.iter().copied()).map(|n| format!("did you mean \"{n}\"?"));
                let found = format!("\"{text}\" is not a value of `{}`", last_key(path));
                self.report(node.span, path, found, expected, hint);
            }
            _ => {
                let found = format!("{} where a name in quotes should stand", node.kind());
                self.report(node.span, path, found, expected, None);
            }
        }
    }

    /// A table whose `kind` says which keys it has.
    fn tagged(&mut self, cases: &[(&str, View)], node: &Node, path: &str) {
        let names: Vec<&str> = cases.iter().map(|(name, _)| *name).collect();
        let Some(table) = node.as_table() else {
            let expected = format!("a table with a key `kind`, {}", one_of(&names, '"'));
            let found = format!("{} where a table should stand", node.kind());
            return self.report(node.span, path, found, expected, None);
        };
        let Some(tag) = table.get("kind") else {
            let expected = format!("kind = {}", one_of(&names, '"'));
            let found = format!("`{path}` has no key `kind`");
            return self.report(node.span, path, found, expected, None);
        };
        let case = cases.iter().find(|(name, _)| tag.node.as_str() == Some(name));
        match case {
            Some((_, view)) => self.table(view, node, table, path),
            None => self.name(&names, &tag.node, &with_key(path, "kind")),
        }
    }

    fn table(&mut self, view: &View, node: &Node, table: &Table, path: &str) {
        for entry in table.iter() {
            let path = with_key(path, &entry.key);
            match view.property(self.root, &entry.key) {
                Some(property) => self.node(&property, &entry.node, &path),
                None => self.unknown_key(view, entry, &path),
            }
        }
        for key in view.required() {
            if table.get(key).is_none() && key != "kind" {
                let wanted = view.property(self.root, key).map(|p| p.wanted());
                self.missing(node, path, key, wanted.unwrap_or_default());
            }
        }
        self.groups(view, node, table, path);
    }

    fn missing(&mut self, node: &Node, path: &str, key: &str, wanted: String) {
        let expected = format!("{key} = {wanted}");
        let found = match path {
            "" => format!("{} has no key `{key}`", self.what),
            _ => format!("`{path}` has no key `{key}`"),
        };
        self.report_table(node, path, found, expected, None);
    }

    /// Reports a problem of a table as a whole; the root has no words of its own to point at.
    pub(super) fn report_table(
        &mut self,
        node: &Node,
        path: &str,
        found: String,
        expected: String,
        hint: Option<String>,
    ) {
        match path {
            "" => {
                let problem = error(path, found, expected, hint);
                let name = self.sources.name(node.span.source);
                self.problems.push(Diagnostic::of(name, problem));
            }
            _ => self.report(node.span, path, found, expected, hint),
        }
    }

    fn unknown_key(&mut self, view: &View, entry: &Entry, path: &str) {
        let keys = view.keys();
        let hint = nearest(&entry.key, keys.iter().copied()).map(|n| format!("did you mean `{n}`?"));
        let found = format!("unknown key `{}`", entry.key);
        let expected = one_of(&keys, '`');
        let parent = &path[..path.len() - with_key("", &entry.key).len()];
        self.report(entry.key_span, parent.trim_end_matches('.'), found, expected, hint);
    }

    fn array(&mut self, view: &View, node: &Node, items: &[Node], path: &str) {
        let length = |word: &str| view.get(word).and_then(Json::as_u64).map(|n| n as usize);
        let (least, most) = (length("minItems").unwrap_or(0), length("maxItems"));
        if items.len() < least || most.is_some_and(|most| items.len() > most) {
            let found = match items.len() {
                0 => "an empty list".to_owned(),
                n => format!("a list of {n}"),
            };
            self.report(node.span, path, found, view.wanted(), None);
        }
        if let Some(item_view) = view.items(self.root) {
            for (i, item) in items.iter().enumerate() {
                self.node(&item_view, item, &format!("{path}[{i}]"));
            }
        }
    }

    pub(super) fn report(
        &mut self,
        span: Span,
        path: &str,
        found: impl Into<String>,
        expected: impl Into<String>,
        hint: Option<String>,
    ) {
        let problem = error(path, found.into(), expected.into(), hint);
        self.problems.push(Diagnostic::at(self.sources, span, problem));
    }
}

fn error(path: &str, found: String, expected: String, hint: Option<String>) -> Problem {
    Problem { severity: Severity::Error, path: path.to_owned(), found, expected, hint }
}

/// The kind of quantity with this name.
pub(super) fn kind_named(name: &str) -> Option<&'static Kind> {
    KINDS.iter().find(|k| k.name == name)
}

/// `"a", "b" or "c"`.
pub fn one_of(names: &[&str], quote: char) -> String {
    match names {
        [] => "no key at all".to_owned(),
        [only] => format!("{quote}{only}{quote}"),
        [first @ .., last] => format!("{} or {quote}{last}{quote}", quoted(first, quote)),
    }
}

/// The last name of a path, without indices.
fn last_key(path: &str) -> &str {
    let end = path.find('[').unwrap_or(path.len());
    path[..end].rsplit('.').next().unwrap_or(path)
}

pub(super) fn quoted(names: &[&str], quote: char) -> String {
    let each: Vec<String> = names.iter().map(|n| format!("{quote}{n}{quote}")).collect();
    each.join(", ")
}

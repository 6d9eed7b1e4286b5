//! The tree that a scenario text is read into, TOML and JSON alike: plain values, each with its [`Span`].

use super::diagnostic::{Diagnostic, Diagnostics};
use super::source::{SourceId, Sources, Span};
use super::{json, toml_text};
use crate::problem::{Problem, Severity};

/// How a scenario text is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// TOML 1.1.
    Toml,
    /// JSON, strict (RFC 8259).
    Json,
}

impl Format {
    /// JSON if the first character that is not a blank opens an object, else TOML: no TOML document starts with `{`.
    pub fn of_text(text: &str) -> Format {
        match text.trim_start_matches('\u{feff}').trim_start().starts_with('{') {
            true => Format::Json,
            false => Format::Toml,
        }
    }
}

/// A value and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Where.
    pub span: Span,
    /// What.
    pub value: Value,
}

/// What a [`Node`] holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// JSON's `null`.
    Null,
    /// Truth.
    Bool(bool),
    /// Whole number.
    Integer(i64),
    /// Number with a decimal point or an exponent.
    Float(f64),
    /// Text.
    String(String),
    /// List.
    Array(Vec<Node>),
    /// Named values.
    Table(Table),
}

/// Named values in the order in which they were written; names are unique.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table(Vec<Entry>);

/// A name and its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The name.
    pub key: String,
    /// Where the name stands.
    pub key_span: Span,
    /// The value.
    pub node: Node,
}

/// Reads a text into a tree; the root is a table.
///
/// # Errors
/// Everything the parser can say about a text that is not valid TOML or JSON.
pub fn parse(sources: &Sources, id: SourceId, format: Format) -> Result<Node, Diagnostics> {
    match format {
        Format::Toml => toml_text::parse(sources, id),
        Format::Json => json::parse(sources, id),
    }
}

impl Node {
    /// The table, if it is one.
    pub fn as_table(&self) -> Option<&Table> {
        match &self.value {
            Value::Table(table) => Some(table),
            _ => None,
        }
    }

    /// The table, if it is one.
    pub fn as_table_mut(&mut self) -> Option<&mut Table> {
        match &mut self.value {
            Value::Table(table) => Some(table),
            _ => None,
        }
    }

    /// The text, if it is one.
    pub fn as_str(&self) -> Option<&str> {
        match &self.value {
            Value::String(text) => Some(text),
            _ => None,
        }
    }

    /// The entry of a table with this key.
    pub fn get(&self, key: &str) -> Option<&Node> {
        self.as_table().and_then(|t| t.get(key)).map(|e| &e.node)
    }

    /// The kind of value in words: `a number`, `a table`.
    pub fn kind(&self) -> &'static str {
        match self.value {
            Value::Null => "null",
            Value::Bool(_) => "true or false",
            Value::Integer(_) | Value::Float(_) => "a number",
            Value::String(_) => "a text",
            Value::Array(_) => "a list",
            Value::Table(_) => "a table",
        }
    }

    /// The same tree as if it had been read from another text.
    pub(super) fn moved_to(&self, source: SourceId) -> Node {
        let value = match &self.value {
            Value::Array(items) => Value::Array(items.iter().map(|item| item.moved_to(source)).collect()),
            Value::Table(table) => Value::Table(Table(
                table
                    .iter()
                    .map(|entry| Entry {
                        key: entry.key.clone(),
                        key_span: Span { source, ..entry.key_span },
                        node: entry.node.moved_to(source),
                    })
                    .collect(),
            )),
            plain => plain.clone(),
        };
        Node { span: Span { source, ..self.span }, value }
    }

    /// The same tree without places. A number that JSON cannot hold (`inf`, `nan`) becomes null.
    pub fn to_json(&self) -> serde_json::Value {
        use serde_json::Value as Json;
        match &self.value {
            Value::Null => Json::Null,
            Value::Bool(b) => Json::Bool(*b),
            Value::Integer(i) => Json::from(*i),
            Value::Float(x) => Json::from(*x),
            Value::String(s) => Json::String(s.clone()),
            Value::Array(items) => items.iter().map(Node::to_json).collect(),
            Value::Table(table) => Json::Object(table.iter().map(|e| (e.key.clone(), e.node.to_json())).collect()),
        }
    }
}

impl Table {
    /// An empty table.
    pub fn new() -> Self {
        Table::default()
    }

    /// The entry with this key.
    pub fn get(&self, key: &str) -> Option<&Entry> {
        self.0.iter().find(|e| e.key == key)
    }

    /// The entry with this key.
    pub fn get_mut(&mut self, key: &str) -> Option<&mut Entry> {
        self.0.iter_mut().find(|e| e.key == key)
    }

    /// Adds an entry, or replaces the one with the same key in its place.
    pub fn insert(&mut self, entry: Entry) {
        match self.get_mut(&entry.key) {
            Some(old) => *old = entry,
            None => self.0.push(entry),
        }
    }

    /// Takes an entry out.
    pub fn remove(&mut self, key: &str) -> Option<Entry> {
        let at = self.0.iter().position(|e| e.key == key)?;
        Some(self.0.remove(at))
    }

    /// The entries in order.
    pub fn iter(&self) -> std::slice::Iter<'_, Entry> {
        self.0.iter()
    }

    /// The entries in order.
    pub fn iter_mut(&mut self) -> std::slice::IterMut<'_, Entry> {
        self.0.iter_mut()
    }

    /// Appends an entry whose key is known to be new; for the parsers.
    pub(super) fn push(&mut self, entry: Entry) {
        self.0.push(entry);
    }
}

/// One syntax error as a list of diagnostics.
pub(super) fn syntax_error(
    sources: &Sources,
    span: Span,
    found: impl Into<String>,
    expected: impl Into<String>,
) -> Diagnostic {
    Diagnostic::at(
        sources,
        span,
        Problem {
            severity: Severity::Error,
            path: String::new(),
            found: found.into(),
            expected: expected.into(),
            hint: None,
        },
    )
}

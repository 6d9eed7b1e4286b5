//! TOML text → [`Node`] tree.

use ::toml::de::{DeTable, DeValue, Error};

use super::diagnostic::{Diagnostic, Diagnostics};
use super::node::{Entry, Node, Table, Value};
use super::source::{SourceId, Sources, Span};
use crate::problem::Problem;

/// Reads a TOML document.
///
/// # Errors
/// All syntax errors of the text, dates, and integers beyond 64 bits.
pub fn parse(sources: &Sources, id: SourceId) -> Result<Node, Diagnostics> {
    let (table, errors) = DeTable::parse_recoverable(sources.text(id));
    let mut reader = Reader::new(sources, id);
    reader.add(errors);
    let root = Node::new(sources.start_of(id), reader.table(table.into_inner()));
    reader.finish(root)
}

/// Reads one TOML value, as the right side of `key = value`.
///
/// # Errors
/// As for [`parse`].
pub fn parse_value(sources: &Sources, id: SourceId) -> Result<Node, Diagnostics> {
    let (value, errors) = DeValue::parse_recoverable(sources.text(id));
    let mut reader = Reader::new(sources, id);
    reader.add(errors);
    let span = reader.span(value.span());
    let node = reader.node(span, value.into_inner());
    reader.finish(node)
}

struct Reader<'a> {
    sources: &'a Sources,
    id: SourceId,
    problems: Diagnostics,
}

impl<'a> Reader<'a> {
    fn new(sources: &'a Sources, id: SourceId) -> Self {
        Reader { sources, id, problems: Diagnostics::new() }
    }

    fn add(&mut self, errors: Vec<Error>) {
        for error in errors {
            let span = match error.span() {
                Some(range) => self.span(range),
                None => self.sources.start_of(self.id),
            };
            // The parser says "found, expected a, b": split so that both sides show.
            let message = error.message();
            let (found, expected) = match message.split_once(", expected ") {
                Some((found, expected)) => (found, expected),
                None => (message, "valid TOML"),
            };
            self.report(span, found, expected);
        }
    }

    fn finish(self, node: Node) -> Result<Node, Diagnostics> {
        if self.problems.is_empty() { Ok(node) } else { Err(self.problems) }
    }

    fn span(&self, range: std::ops::Range<usize>) -> Span {
        Span { source: self.id, start: range.start, end: range.end }
    }

    fn table(&mut self, source: DeTable<'_>) -> Value {
        let mut table = Table::new();
        for (key, value) in source {
            let key_span = self.span(key.span());
            let mut span = self.span(value.span());
            let value = value.into_inner();
            // A table that only dotted keys or sub-headers open has no words of its own.
            if span.start == span.end && matches!(value, DeValue::Table(_) | DeValue::Array(_)) {
                span = key_span;
            }
            table.push(Entry { key: key.into_inner().into_owned(), key_span, node: self.node(span, value) });
        }
        Value::Table(table)
    }

    fn node(&mut self, span: Span, value: DeValue<'_>) -> Node {
        let value = match value {
            DeValue::String(text) => Value::String(text.into_owned()),
            DeValue::Boolean(b) => Value::Bool(b),
            DeValue::Table(table) => self.table(table),
            DeValue::Array(items) => Value::Array(
                items
                    .into_iter()
                    .map(|item| {
                        let span = self.span(item.span());
                        self.node(span, item.into_inner())
                    })
                    .collect(),
            ),
            DeValue::Integer(number) => match i64::from_str_radix(number.as_str(), number.radix()) {
                Ok(i) => Value::Integer(i),
                Err(_) => self.reject(span, "a whole number too large to read", "at most 64 bits"),
            },
            DeValue::Float(number) => match number.as_str().parse() {
                Ok(x) => Value::Float(x),
                Err(_) => self.reject(span, "a number that cannot be read", "a decimal number"),
            },
            DeValue::Datetime(_) => self.reject(span, "a date or time of day", "a text, in quotes, or a number"),
        };
        Node::new(span, value)
    }

    fn report(&mut self, span: Span, found: &str, expected: &str) {
        self.problems.push(Diagnostic::at(self.sources, span, Problem::error("", found, expected)));
    }

    fn reject(&mut self, span: Span, found: &str, expected: &str) -> Value {
        self.report(span, found, expected);
        Value::Null
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> (Sources, Result<Node, Diagnostics>) {
        let mut sources = Sources::new();
        let id = sources.add("t.toml", text);
        let node = parse(&sources, id);
        (sources, node)
    }

    #[test]
    fn keeps_order_and_words() {
        let (sources, node) = read("z = 1\na = \"x\"\n[m.seat]\nk1 = 4.80\n[m.dash]\n");
        let node = node.unwrap();
        let keys: Vec<_> = node.as_table().unwrap().iter().map(|e| &e.key).collect();
        assert_eq!(keys, ["z", "a", "m"]);
        let k1 = node.get("m").unwrap().get("seat").unwrap().get("k1").unwrap();
        assert_eq!(sources.slice(k1.span), "4.80");
        assert_eq!(sources.slice(node.get("m").unwrap().get("seat").unwrap().span), "[m.seat]");
        assert_eq!(sources.slice(node.get("m").unwrap().span), "m");
    }

    #[test]
    fn reports_all_syntax_errors() {
        let (_, node) = read("a = \nb = 1979-05-27\nc = 99999999999999999999\nd = 1\nd = 2\n");
        let errors = node.unwrap_err();
        let lines: Vec<_> = errors.iter().map(|d| d.position.unwrap().line).collect();
        assert_eq!(lines, [1, 5, 2, 3], "{errors}");
    }
}

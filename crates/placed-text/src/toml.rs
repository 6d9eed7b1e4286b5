//! TOML text → [`Node`] tree.

use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeTable, DeValue, Error};

use crate::diagnostic::Diagnostics;
use crate::node::{Entry, Node, Table, Value};
use crate::reader::Reader;
use crate::source::{SourceId, Sources, Span};

/// Reads a TOML document.
///
/// # Errors
/// All syntax errors of the text, dates, and integers beyond 64 bits.
pub fn parse(sources: &Sources, id: SourceId) -> Result<Node, Diagnostics> {
    let (table, errors) = DeTable::parse_recoverable(sources.text(id));
    let mut reader = Reader::new(sources, id);
    report_all(&mut reader, errors);
    let root = Node::new(sources.start_of(id), read_table(&mut reader, table.into_inner()));
    reader.finish(root)
}

/// Reads one TOML value, as the right side of `key = value`.
///
/// # Errors
/// All syntax errors of the text, dates, and integers beyond 64 bits.
pub fn parse_value(sources: &Sources, id: SourceId) -> Result<Node, Diagnostics> {
    let (value, errors) = DeValue::parse_recoverable(sources.text(id));
    let mut reader = Reader::new(sources, id);
    report_all(&mut reader, errors);
    let span = reader.span(value.span());
    let node = read_node(&mut reader, span, value.into_inner());
    reader.finish(node)
}

fn report_all(reader: &mut Reader, errors: Vec<Error>) {
    for error in errors {
        let span = error.span().map_or(reader.sources.start_of(reader.id), |range| reader.span(range));
        // The parser says "found, expected a, b": split so that both sides show.
        let message = error.message();
        let (found, expected) = message.split_once(", expected ").unwrap_or((message, "valid TOML"));
        let expected = if expected == "literal string" { "quotes around text, such as \"50 km/h\"" } else { expected };
        reader.reject(span, found, expected);
    }
}

fn read_table(reader: &mut Reader, source: DeTable<'_>) -> Value {
    let mut table = Table::new();
    for (key, value) in source {
        let key_span = reader.span(key.span());
        let mut span = reader.span(value.span());
        let value = value.into_inner();
        // A table that only dotted keys or sub-headers open has no words of its own.
        if span.start == span.end && matches!(value, DeValue::Table(_) | DeValue::Array(_)) {
            span = key_span;
        }
        table.insert(key.into_inner().into_owned(), Entry { key_span, node: read_node(reader, span, value) });
    }
    Value::Table(Arc::new(table))
}

fn read_node(reader: &mut Reader, span: Span, value: DeValue<'_>) -> Node {
    let item = |item: Spanned<DeValue<'_>>| {
        let span = reader.span(item.span());
        read_node(reader, span, item.into_inner())
    };
    let value = match value {
        DeValue::String(text) => Value::String(text.into_owned()),
        DeValue::Boolean(b) => Value::Bool(b),
        DeValue::Table(table) => read_table(reader, table),
        DeValue::Array(items) => Value::Array(items.into_iter().map(item).collect()),
        DeValue::Integer(number) => match i64::from_str_radix(number.as_str(), number.radix()) {
            Ok(i) => Value::Integer(i),
            Err(_) => reader.reject(span, "a whole number too large to read", "at most 64 bits"),
        },
        DeValue::Float(number) => match number.as_str().parse() {
            Ok(x) => Value::Float(x),
            Err(_) => reader.reject(span, "a number that cannot be read", "a decimal number"),
        },
        DeValue::Datetime(_) => reader.reject(span, "a date or time of day", "text in quotes, or a number"),
    };
    Node::new(span, value)
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
        let keys: Vec<_> = node.as_table().unwrap().keys().collect();
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

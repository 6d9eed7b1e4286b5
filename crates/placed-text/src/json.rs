//! JSON text → [`Node`] tree, strictly by RFC 8259.

use std::sync::Arc;

use jsonc_parser::ast::{Object, Value as Ast};
use jsonc_parser::common::Ranged;
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};

use crate::diagnostic::Diagnostics;
use crate::node::{Entry, Node, Table, Value};
use crate::reader::Reader;
use crate::source::{SourceId, Sources, Span};

/// Strict RFC 8259.
const STRICT: ParseOptions = ParseOptions {
    allow_comments: false,
    allow_loose_object_property_names: false,
    allow_trailing_commas: false,
    allow_missing_commas: false,
    allow_single_quoted_strings: false,
    allow_hexadecimal_numbers: false,
    allow_unary_plus_numbers: false,
    allow_bare_decimal_point_numbers: false,
    allow_non_finite_numbers: false,
    allow_extended_string_escapes: false,
};

/// Reads a JSON document whose root is an object.
///
/// # Errors
/// The first syntax error; keys that stand twice in one object; a root that is no object.
pub fn parse(sources: &Sources, id: SourceId) -> Result<Node, Diagnostics> {
    let mut reader = Reader::new(sources, id);
    let root = match parse_to_ast(sources.text(id), &CollectOptions::default(), &STRICT) {
        Ok(parsed) => match parsed.value {
            Some(root @ Ast::Object(_)) => read_node(&mut reader, root),
            _ => rejected(&mut reader, sources.start_of(id), "no JSON object", "{ \"title\": …, … }"),
        },
        Err(error) => {
            let span = span(&reader, &error.range());
            rejected(&mut reader, span, &error.kind().to_string(), "valid JSON")
        }
    };
    reader.finish(root)
}

fn span(reader: &Reader, ranged: &impl Ranged) -> Span {
    reader.span(ranged.start()..ranged.end())
}

fn rejected(reader: &mut Reader, span: Span, found: &str, expected: &str) -> Node {
    Node::new(span, reader.reject(span, found, expected))
}

fn read_object(reader: &mut Reader, object: Object<'_>) -> Value {
    let mut table = Table::new();
    for property in object.properties {
        let key_span = span(reader, &property.name);
        let key = property.name.into_string();
        if table.contains_key(&key) {
            reader.reject(key_span, &format!("key `{key}` twice"), "each key once");
            continue;
        }
        table.insert(key, Entry { key_span, node: read_node(reader, property.value) });
    }
    Value::Table(Arc::new(table))
}

fn read_node(reader: &mut Reader, ast: Ast<'_>) -> Node {
    let span = span(reader, &ast);
    let value = match ast {
        Ast::Object(object) => read_object(reader, object),
        Ast::Array(array) => Value::Array(array.elements.into_iter().map(|e| read_node(reader, e)).collect()),
        Ast::StringLit(text) => Value::String(text.value.into_owned()),
        Ast::BooleanLit(b) => Value::Bool(b.value),
        Ast::NullKeyword(_) => Value::Null,
        Ast::NumberLit(number) => match (number.value.parse(), number.value.parse()) {
            (Ok(i), _) => Value::Integer(i),
            (_, Ok(x)) => Value::Float(x),
            _ => reader.reject(span, "a number that cannot be read", "a number"),
        },
    };
    Node::new(span, value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Node, Diagnostics> {
        let mut sources = Sources::new();
        let id = sources.add("t.json", text);
        parse(&sources, id)
    }

    #[test]
    fn reads_values_and_rejects_duplicates() {
        let node = read(r#"{"a": [1, 2.5, "x\u00e9"], "b": {"c": null, "d": true}}"#).unwrap();
        let values: Vec<&Value> = node.get("a").unwrap().items().iter().map(|n| &n.value).collect();
        assert_eq!(values, [&Value::Integer(1), &Value::Float(2.5), &Value::String("xé".into())]);
        let b = node.get("b").unwrap();
        assert_eq!([b.get("c"), b.get("d")].map(|n| &n.unwrap().value), [&Value::Null, &Value::Bool(true)]);
        let error = read("{\"a\": 1,\n \"a\": 2}").unwrap_err().to_string();
        assert_eq!(
            error,
            "error: key `a` twice\n --> t.json:2:2\n  |\n2 |  \"a\": 2}\n  |  ^^^\n  = expected: each key once"
        );
    }

    #[test]
    fn is_strict_and_survives_nonsense() {
        for text in ["", "[]", "{a: 1}", "{\"a\": 1,}", "{\"a\": 0x1}", "{\"a\": 1} x", "{\"a\": NaN}", "// c\n{}"] {
            assert!(read(text).is_err(), "{text}");
        }
        assert!(read(&"[".repeat(100_000)).is_err());
        assert!(read(&"{\"a\":".repeat(100_000)).is_err());
    }
}

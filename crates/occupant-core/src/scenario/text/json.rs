//! JSON text → [`Node`] tree, strictly by RFC 8259.

use std::collections::HashSet;

use jsonc_parser::ast::{Object, Value as Ast};
use jsonc_parser::common::Ranged;
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};

use super::diagnostic::{Diagnostic, Diagnostics};
use super::node::{Entry, Node, Table, Value};
use super::source::{SourceId, Sources, Span};
use crate::problem::Problem;

/// Nothing that goes beyond RFC 8259.
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
    let mut reader = Reader { sources, id, problems: Diagnostics::new() };
    let node = match parse_to_ast(sources.text(id), &CollectOptions::default(), &STRICT) {
        Ok(parsed) => match parsed.value {
            Some(Ast::Object(object)) => reader.object(object),
            _ => reader.reject(sources.start_of(id), "no JSON object", "{ \"title\": …, … }"),
        },
        Err(error) => {
            let span = reader.span(&error.range());
            reader.reject(span, &error.kind().to_string(), "valid JSON")
        }
    };
    if reader.problems.is_empty() { Ok(node) } else { Err(reader.problems) }
}

struct Reader<'a> {
    sources: &'a Sources,
    id: SourceId,
    problems: Diagnostics,
}

impl Reader<'_> {
    fn span(&self, ranged: &impl Ranged) -> Span {
        Span { source: self.id, start: ranged.start(), end: ranged.end() }
    }

    fn reject(&mut self, span: Span, found: &str, expected: &str) -> Node {
        self.problems.push(Diagnostic::at(self.sources, span, Problem::error("", found, expected)));
        Node::new(span, Value::Null)
    }

    fn object(&mut self, object: Object<'_>) -> Node {
        let span = self.span(&object);
        let mut table = Table::new();
        let mut seen = HashSet::new();
        for property in object.properties {
            let key_span = self.span(&property.name);
            let key = property.name.into_string();
            if !seen.insert(key.clone()) {
                let found = format!("key `{key}` a second time");
                self.reject(key_span, &found, "each key once");
                continue;
            }
            let node = self.node(property.value);
            table.push(Entry { key, key_span, node });
        }
        Node::new(span, Value::Table(table))
    }

    fn node(&mut self, ast: Ast<'_>) -> Node {
        let span = self.span(&ast);
        let value = match ast {
            Ast::Object(object) => return self.object(object),
            Ast::Array(array) => Value::Array(array.elements.into_iter().map(|e| self.node(e)).collect()),
            Ast::StringLit(text) => Value::String(text.value.into_owned()),
            Ast::BooleanLit(b) => Value::Bool(b.value),
            Ast::NullKeyword(_) => Value::Null,
            Ast::NumberLit(number) => match number.value.parse::<i64>() {
                Ok(i) => Value::Integer(i),
                Err(_) => match number.value.parse::<f64>() {
                    Ok(x) => Value::Float(x),
                    Err(_) => {
                        return self.reject(span, "a number that cannot be read", "a number");
                    }
                },
            },
        };
        Node::new(span, value)
    }
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
            "error: key `a` a second time\n --> t.json:2:2\n  |\n2 |  \"a\": 2}\n  |  ^^^\n  = expected: each key once"
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

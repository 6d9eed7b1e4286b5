//! The tree that a scenario text is read into, TOML and JSON alike: plain values, each with its [`Span`].

use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;

use indexmap::IndexMap;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::{Error, MapDeserializer, SeqDeserializer};
use serde::de::{Deserializer, Expected, IntoDeserializer, SeqAccess, Unexpected, Visitor};
use serde::{Deserialize, Serialize, forward_to_deserialize_any};

use crate::source::{SourceId, Span};

/// Format of a scenario text.
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
        let text = text.trim_start_matches('\u{feff}').trim_start();
        if text.starts_with('{') { Format::Json } else { Format::Toml }
    }
}

/// A value with its position.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Its position.
    pub span: Span,
    /// The value.
    pub value: Value,
    /// For a quantity: its value in SI units, angles in radians, set by the check.
    pub si: Option<f64>,
}

/// A value.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// JSON's `null`.
    #[serde(skip)]
    Null,
    /// Boolean.
    Bool(bool),
    /// Whole number.
    Integer(i64),
    /// Number with a decimal point or an exponent.
    Float(f64),
    /// Text.
    String(String),
    /// List.
    #[serde(skip)]
    Array(Vec<Node>),
    /// Named values. Copies of a tree share them until one is changed (copy on write).
    #[serde(skip)]
    Table(Arc<Table>),
}

/// Named values in the order written.
pub type Table = IndexMap<String, Entry>;

/// A named value.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Position of the name.
    pub key_span: Span,
    /// The value.
    pub node: Node,
}

impl Value {
    /// Kind of the value in words: `a number`, `a table`.
    pub fn kind(&self) -> &'static str {
        match self {
            Value::Null => "null",
            Value::Bool(_) => "true or false",
            Value::Integer(_) | Value::Float(_) => "a number",
            Value::String(_) => "a text",
            Value::Array(_) => "a list",
            Value::Table(_) => "a table",
        }
    }

    /// The number, if it is a bare one.
    pub fn number(&self) -> Option<f64> {
        match self {
            Value::Integer(i) => Some(*i as f64),
            Value::Float(x) => Some(*x),
            _ => None,
        }
    }

    fn unwanted(&self, expected: &dyn Expected) -> Error {
        serde::de::Error::invalid_type(Unexpected::Other(self.kind()), expected)
    }

    fn visit<'de, V: Visitor<'de>>(&'de self, visitor: V) -> Result<V::Value, Error> {
        match self {
            Value::Null => visitor.visit_unit(),
            Value::Bool(b) => visitor.visit_bool(*b),
            Value::Integer(i) => visitor.visit_i64(*i),
            Value::Float(x) => visitor.visit_f64(*x),
            Value::String(text) => visitor.visit_borrowed_str(text),
            Value::Array(items) => visitor.visit_seq(SeqDeserializer::new(items.iter())),
            Value::Table(table) => visitor.visit_map(entries(table)),
        }
    }
}

fn entries(table: &Table) -> MapDeserializer<'_, impl Iterator<Item = (&str, &Node)>, Error> {
    MapDeserializer::new(table.iter().map(|(key, entry)| (key.as_str(), &entry.node)))
}

/// A value for a section, with its SI value if the check has read it as a quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Written {
    /// The value as written.
    pub value: Value,
    /// In SI units, angles in radians.
    pub si: Option<f64>,
}

impl From<Value> for Written {
    fn from(value: Value) -> Self {
        Written { value, si: None }
    }
}

impl<'de> Deserialize<'de> for Value {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Written::deserialize(deserializer).map(|written| written.value)
    }
}

impl<'de> Deserialize<'de> for Written {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(PlainOrQuantity)
    }
}

/// Accepts booleans, numbers and texts, and the pair that [`Node`] makes of a quantity.
struct PlainOrQuantity;

impl<'de> Visitor<'de> for PlainOrQuantity {
    type Value = Written;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("true, false, a number or text")
    }

    fn visit_bool<E>(self, truth: bool) -> Result<Written, E> {
        Ok(Value::Bool(truth).into())
    }

    fn visit_i64<E>(self, number: i64) -> Result<Written, E> {
        Ok(Value::Integer(number).into())
    }

    fn visit_u64<E>(self, number: u64) -> Result<Written, E> {
        Ok(i64::try_from(number).map_or(Value::Float(number as f64), Value::Integer).into())
    }

    fn visit_f64<E>(self, number: f64) -> Result<Written, E> {
        Ok(Value::Float(number).into())
    }

    fn visit_str<E>(self, text: &str) -> Result<Written, E> {
        Ok(Value::String(text.to_owned()).into())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut pair: A) -> Result<Written, A::Error> {
        match (pair.next_element()?, pair.next_element()?) {
            (Some(si), Some(value)) => Ok(Written { value, si: Some(si) }),
            _ => Err(serde::de::Error::invalid_type(Unexpected::Seq, &self)),
        }
    }
}

/// A value whose type is defined elsewhere in the document.
impl JsonSchema for Value {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "value".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": ["number", "string", "boolean"],
            "x-example": "a value as the scenario has it: 0.3, \"20 in lbf s/rad\", \"seat\"",
        })
    }
}

impl Node {
    /// Whether it equals another, ignoring positions.
    pub fn says(&self, other: &Node) -> bool {
        match (&self.value, &other.value) {
            (Value::Table(a), Value::Table(b)) => {
                let both = || a.iter().zip(b.iter());
                Arc::ptr_eq(a, b) || a.len() == b.len() && both().all(|((k, x), (l, y))| k == l && x.node.says(&y.node))
            }
            (Value::Array(a), Value::Array(b)) => a.len() == b.len() && a.iter().zip(b).all(|(x, y)| x.says(y)),
            (a, b) => a == b,
        }
    }

    /// A value and where it stands.
    pub fn new(span: Span, value: Value) -> Node {
        Node { span, value, si: None }
    }

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
            Value::Table(table) => Some(Arc::make_mut(table)),
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
        self.as_table()?.get(key).map(|e| &e.node)
    }

    /// Whether it has `remove = true`.
    pub fn is_removed(&self) -> bool {
        self.get("remove").is_some_and(|n| n.value == Value::Bool(true))
    }

    /// The items, if it is a list.
    pub fn items(&self) -> &[Node] {
        match &self.value {
            Value::Array(items) => items,
            _ => &[],
        }
    }

    /// The same tree with positions in another text.
    pub fn moved_to(&self, source: SourceId) -> Node {
        let value = match &self.value {
            Value::Array(items) => Value::Array(items.iter().map(|item| item.moved_to(source)).collect()),
            Value::Table(table) => {
                let moved =
                    |e: &Entry| Entry { key_span: Span { source, ..e.key_span }, node: e.node.moved_to(source) };
                Value::Table(Arc::new(table.iter().map(|(key, entry)| (key.clone(), moved(entry))).collect()))
            }
            plain => plain.clone(),
        };
        Node { span: Span { source, ..self.span }, value, ..*self }
    }
}

/// Deserialises sections directly from the tree. A checked quantity is the pair of its SI value and its text.
impl<'de> Deserializer<'de> for &'de Node {
    type Error = Error;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match self.si {
            Some(si) => visitor.visit_seq(SeqDeserializer::new([Part::Si(si), Part::Written(&self.value)].into_iter())),
            None => self.value.visit(visitor),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        visitor.visit_some(self)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        self.as_str().unwrap_or_default().into_deserializer().deserialize_enum(name, variants, visitor)
    }

    // what sections are made of knows what it wants: any other visit is not compiled for each of their hundred types

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        _fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        self.deserialize_map(visitor)
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match &self.value {
            Value::Table(table) => visitor.visit_map(entries(table)),
            other => Err(other.unwanted(&visitor)),
        }
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match &self.value {
            Value::Array(items) => visitor.visit_seq(SeqDeserializer::new(items.iter())),
            other => Err(other.unwanted(&visitor)),
        }
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, _len: usize, visitor: V) -> Result<V::Value, Error> {
        self.deserialize_seq(visitor)
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct
        newtype_struct tuple_struct identifier ignored_any
    }
}

impl<'de> IntoDeserializer<'de> for &'de Node {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

/// The two parts of a quantity.
enum Part<'de> {
    Si(f64),
    Written(&'de Value),
}

impl<'de> Deserializer<'de> for Part<'de> {
    type Error = Error;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match self {
            Part::Si(si) => visitor.visit_f64(si),
            Part::Written(value) => value.visit(visitor),
        }
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map struct enum identifier ignored_any
    }
}

impl<'de> IntoDeserializer<'de> for Part<'de> {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

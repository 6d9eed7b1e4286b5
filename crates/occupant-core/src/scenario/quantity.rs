//! A number with a unit as a scenario writes it: bare (`14`, in the file's units) or with its unit (`"20 mph"`).

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use super::kind::{KINDS, Kind, UnitSystem};
use super::unit::{Scale, UnitError};
use super::unit_expression;

/// A quantity of kind `KINDS[KIND]`, exactly as it was written.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity<const KIND: usize> {
    written: Written,
}

/// How a quantity was written.
#[derive(Clone, Debug, PartialEq)]
pub enum Written {
    /// Bare whole number.
    Integer(i64),
    /// Bare number.
    Float(f64),
    /// Number and unit.
    Text(String),
}

impl<const KIND: usize> Quantity<KIND> {
    /// What it measures.
    pub const KIND: &'static Kind = &KINDS[KIND];

    /// A bare number in the file's units.
    pub fn bare(value: f64) -> Self {
        Quantity { written: Written::Float(value) }
    }

    /// A number with its unit.
    pub fn text(text: impl Into<String>) -> Self {
        Quantity { written: Written::Text(text.into()) }
    }

    /// As it was written.
    pub fn written(&self) -> &Written {
        &self.written
    }

    /// The value in SI units, angles in radians.
    ///
    /// # Errors
    /// A text that is no number with a unit of this kind.
    pub fn si(&self, units: UnitSystem) -> Result<f64, UnitError> {
        si_value(&self.written, Self::KIND, units)
    }
}

/// A text such as `"20 mph"` with its number multiplied and its unit kept; none if it does not start with a number.
pub fn scaled_text(text: &str, factor: f64) -> Option<String> {
    let (number, unit_start) = split_number(text)?;
    let unit = text[unit_start..].trim_end();
    Some(format!("{} {unit}", number * factor))
}

/// The value of a written quantity in SI units, angles in radians.
///
/// # Errors
/// A text that is no number with a unit of this kind; a number that is not finite.
pub fn si_value(written: &Written, kind: &Kind, units: UnitSystem) -> Result<f64, UnitError> {
    match written {
        Written::Integer(i) => bare_si(*i as f64, kind, units),
        Written::Float(x) => bare_si(*x, kind, units),
        Written::Text(text) => text_si(text, kind),
    }
}

fn bare_si(value: f64, kind: &Kind, units: UnitSystem) -> Result<f64, UnitError> {
    let unit = kind.bare_unit(units);
    if unit.is_empty() {
        return finite(value, &value.to_string());
    }
    finite(value * unit_expression::parse(unit, 0)?.factor, &value.to_string())
}

fn finite(value: f64, text: &str) -> Result<f64, UnitError> {
    match value.is_finite() {
        true => Ok(value),
        false => Err(whole(text, format!("`{text}` is not finite"), "a finite number".into())),
    }
}

/// An error about a whole text.
fn whole(text: &str, found: String, expected: String) -> UnitError {
    UnitError { start: 0, end: text.len(), found, expected, hint: None }
}

/// Reads `"48 lbf/in"` and the like.
fn text_si(text: &str, kind: &Kind) -> Result<f64, UnitError> {
    let expected = || format!("{}: {}", kind.noun, kind.example);
    let (number, unit_start) =
        split_number(text).ok_or_else(|| whole(text, format!("`{text}` does not start with a number"), expected()))?;
    let unit_text = text[unit_start..].trim_end();
    if unit_text.is_empty() {
        return Err(UnitError {
            hint: Some(format!("write {} without quotes", text.trim())),
            ..whole(text, format!("a number without unit in quotes, `{text}`"), expected())
        });
    }
    if unit_text.starts_with(',') {
        return Err(UnitError {
            hint: Some("decimals are written with a point".into()),
            ..whole(text, format!("a comma in the number `{text}`"), expected())
        });
    }
    let scale = unit_expression::parse(unit_text, unit_start)?;
    if !scale.dimension.serves_as(kind.dimension) {
        return Err(UnitError {
            start: unit_start,
            end: unit_start + unit_text.len(),
            found: format!("`{unit_text}` is not the unit of {}", kind.noun),
            expected: expected(),
            hint: pound_hint(number, unit_text, scale, kind),
        });
    }
    finite(number * scale.factor, text)
}

/// The number at the start of a text, and where its unit starts.
pub(super) fn split_number(text: &str) -> Option<(f64, usize)> {
    let start = text.len() - text.trim_start().len();
    let body = &text[start..];
    let (sign, body_start) = match body.chars().next()? {
        '-' => (-1.0, 1),
        '−' => (-1.0, '−'.len_utf8()),
        '+' => (1.0, 1),
        _ => (1.0, 0),
    };
    let digits = &body[body_start..];
    let bytes = digits.as_bytes();
    let run = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let mut length = run(0);
    if bytes.get(length) == Some(&b'.') {
        length += 1 + run(length + 1);
    }
    if matches!(bytes.get(length), Some(b'e' | b'E')) {
        let signed = usize::from(matches!(bytes.get(length + 1), Some(b'-' | b'+')));
        let exponent = run((length + 1 + signed).min(bytes.len()));
        if exponent > 0 {
            length += 1 + signed + exponent;
        }
    }
    let value: f64 = digits[..length].parse().ok()?;
    let unit = &digits[length..];
    let blanks = unit.len() - unit.trim_start().len();
    Some((sign * value, start + body_start + length + blanks))
}

/// The usual slip: pounds of mass for pounds of force, or the other way round.
fn pound_hint(number: f64, unit_text: &str, scale: Scale, kind: &Kind) -> Option<String> {
    if kind.name == "ratio" || scale.dimension == kind.dimension {
        return None;
    }
    [("lbf", "lb", "mass"), ("lb", "lbf", "force"), ("lbs", "lbf", "force")].into_iter().find_map(
        |(wrong, right, what)| {
            let swapped: Vec<String> =
                words(unit_text).map(|w| if w == wrong { right.to_owned() } else { w.to_owned() }).collect();
            let swapped = swapped.concat();
            let fits = unit_expression::parse(&swapped, 0).is_ok_and(|s| s.dimension.serves_as(kind.dimension));
            fits.then(|| format!("the pound of {what} is `{right}`: \"{number} {swapped}\""))
        },
    )
}

/// Splits into runs of letters and single other characters.
fn words(text: &str) -> impl Iterator<Item = &str> {
    let mut rest = text;
    std::iter::from_fn(move || {
        let first = rest.chars().next()?;
        let length = match first.is_alphabetic() {
            true => rest.find(|c: char| !c.is_alphabetic()).unwrap_or(rest.len()),
            false => first.len_utf8(),
        };
        let (word, tail) = rest.split_at(length);
        rest = tail;
        Some(word)
    })
}

impl<const KIND: usize> Serialize for Quantity<KIND> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.written {
            Written::Integer(i) => serializer.serialize_i64(*i),
            Written::Float(x) => serializer.serialize_f64(*x),
            Written::Text(text) => serializer.serialize_str(text),
        }
    }
}

impl<'de, const KIND: usize> Deserialize<'de> for Quantity<KIND> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Visitor).map(|written| Quantity { written })
    }
}

struct Visitor;

impl de::Visitor<'_> for Visitor {
    type Value = Written;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("a number, or a text with number and unit")
    }

    fn visit_i64<E>(self, value: i64) -> Result<Written, E> {
        Ok(Written::Integer(value))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Written, E> {
        Ok(i64::try_from(value).map_or(Written::Float(value as f64), Written::Integer))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Written, E> {
        Ok(Written::Float(value))
    }

    fn visit_str<E>(self, value: &str) -> Result<Written, E> {
        Ok(Written::Text(value.to_owned()))
    }
}

impl<const KIND: usize> JsonSchema for Quantity<KIND> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        Self::KIND.name.into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let kind = Self::KIND;
        json_schema!({
            "type": ["number", "string"],
            "x-dimension": kind.name,
            "x-bare-unit": { "si": kind.si, "in-lbf-s": kind.inch_pound },
            "x-example": kind.example,
        })
    }
}

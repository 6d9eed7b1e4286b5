//! A number with a unit as a scenario writes it: bare (`14`, in the file's units) or with its unit (`"20 mph"`).

use std::borrow::Cow;

use nalgebra::Point3;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize, Serializer};
use serde_json::json;

use super::Length;
use crate::kind::{KINDS, Kind, UnitSystem};
use placed_text::{Value, Written};

/// Any number.
pub(crate) const ANY: usize = 0;
/// Numbers of at least 0.
pub const NOT_NEGATIVE: usize = 1;
/// Numbers above 0.
pub const POSITIVE: usize = 2;
/// Numbers from 0 to 1.
pub const FRACTION: usize = 3;

/// The schema keywords for each range.
const RANGES: [&[(&str, i32)]; 4] =
    [&[], &[("minimum", 0)], &[("exclusiveMinimum", 0)], &[("minimum", 0), ("maximum", 1)]];

/// A quantity of kind `KINDS[KIND]` in a range: its text, and its value in SI units.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(from = "Written")]
pub struct Quantity<const KIND: usize, const RANGE: usize = ANY> {
    written: Value,
    si: f64,
}

impl<const KIND: usize, const RANGE: usize> From<Written> for Quantity<KIND, RANGE> {
    /// A value of an unchecked tree is NaN.
    fn from(Written { value, si }: Written) -> Self {
        Quantity { written: value, si: si.unwrap_or(f64::NAN) }
    }
}

impl<const KIND: usize, const RANGE: usize> Quantity<KIND, RANGE> {
    /// Its kind.
    pub(super) const KIND: &'static Kind = &KINDS[KIND];

    /// A number in SI units, angles in radians, without a source text.
    pub fn of_si(si: f64) -> Self {
        Quantity { written: Value::Float(si), si }
    }

    /// The value in SI units, angles in radians; NaN in an unchecked tree.
    pub fn si(&self) -> f64 {
        self.si
    }

    /// The number, if it is bare.
    pub(super) fn bare(&self) -> Option<f64> {
        self.written.number()
    }
}

/// The value in SI units, or `default` if absent.
pub(crate) fn si_or<const KIND: usize, const RANGE: usize>(
    quantity: &Option<Quantity<KIND, RANGE>>,
    default: f64,
) -> f64 {
    quantity.as_ref().map_or(default, Quantity::si)
}

/// Several values in SI units.
pub(super) fn all_si<const KIND: usize, const RANGE: usize, const N: usize>(
    quantities: &[Quantity<KIND, RANGE>; N],
) -> [f64; N] {
    quantities.each_ref().map(Quantity::si)
}

/// A point.
pub(super) fn point(point: &[Length; 3]) -> Point3<f64> {
    Point3::from(all_si(point))
}

impl<const KIND: usize, const RANGE: usize> Serialize for Quantity<KIND, RANGE> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.written.serialize(serializer)
    }
}

impl<const KIND: usize, const RANGE: usize> JsonSchema for Quantity<KIND, RANGE> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        Self::KIND.name.into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let kind = Self::KIND;
        let mut schema = json_schema!({
            "type": ["number", "string"],
            "x-dimension": kind.name,
            "x-bare-unit": {
                "si": kind.bare_unit(UnitSystem::Si),
                "in-lbf-s": kind.bare_unit(UnitSystem::InchPound),
            },
            "x-example": kind.example,
        });
        if RANGE != ANY {
            // keeps the place of the field's own description, before the bounds
            schema.insert("description".to_owned(), json!(""));
        }
        for (word, bound) in RANGES[RANGE] {
            schema.insert((*word).to_owned(), json!(bound));
        }
        schema
    }
}

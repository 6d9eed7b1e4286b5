//! A parameter that has found its places in the base scenario, and the texts that put a value there.

use super::law::{Law, Value};
use crate::section::ApplyChoice;
use occupant_scenario::{Diagnostics, Draft, Place, Wanted};
use placed_text::Value as Written;

/// A parameter bound to its targets in the base scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Name of the parameter and its column.
    pub name: String,
    /// SI unit of its numbers, angles in rad; empty for names, plain numbers and factors.
    pub unit: &'static str,
    /// How its number changes the scenario's value.
    pub apply: ApplyChoice,
    /// Law of its values.
    pub law: Law,
    /// Whether each of its values is run with every sample of the other parameters.
    pub crossed: bool,
    /// Values that it changes.
    pub targets: Vec<Target>,
    /// Where its law comes from, of a law that is built in; else empty.
    pub source: &'static str,
}

/// A value that a parameter changes.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// Its path, without wildcards.
    pub path: String,
    /// SI unit of a number there.
    pub unit: &'static str,
    /// The base scenario's value.
    pub base: Value,
}

/// A value assigned to a path.
#[derive(Clone, Debug, PartialEq)]
pub struct Assignment {
    /// A path without wildcards.
    pub path: String,
    /// The value in SI units.
    pub value: Value,
    /// SI unit of a number.
    pub unit: &'static str,
}

/// SI unit of the numbers at a path; empty if there are none.
pub(super) fn si_unit(wanted: &Wanted) -> &'static str {
    match wanted {
        Wanted::Quantity(kind) => kind.unit.expression(),
        _ => "",
    }
}

impl Target {
    pub(crate) fn of(place: &Place) -> Target {
        let base = match (&place.value, place.si) {
            (_, Some(x)) => Value::Number(x),
            (Some(Written::String(text)), _) => Value::Text(text.clone()),
            (Some(Written::Bool(b)), _) => Value::Truth(*b),
            _ => Value::Base,
        };
        Target { path: place.path.clone(), unit: si_unit(&place.wanted), base }
    }
}

impl Assignment {
    /// The value in the form that [`Draft::set_value`] and `--set` read; it returns the same bits.
    pub fn text(&self) -> String {
        match &self.value {
            Value::Number(x) if self.unit.is_empty() => format!("{x:?}"),
            Value::Number(x) => format!("{x:?} {}", self.unit),
            Value::Text(text) => toml::Value::String(text.clone()).to_string(),
            Value::Truth(b) => b.to_string(),
            Value::Base => String::new(),
        }
    }
}

/// Assigns values in a draft.
pub(super) fn put(list: &[Assignment], draft: &mut Draft) -> Result<(), Diagnostics> {
    list.iter().try_for_each(|assignment| draft.set_value(&assignment.path, &assignment.text()))
}

impl Parameter {
    /// Its value in the base scenario: a factor of 1, an offset of 0, or the scenario's value if that is a single one.
    pub fn nominal(&self) -> Value {
        match self.apply {
            ApplyChoice::Factor => Value::Number(1.0),
            ApplyChoice::Offset => Value::Number(0.0),
            ApplyChoice::Value => {
                let mut bases = self.targets.iter().map(|t| &t.base);
                match bases.next() {
                    Some(first) if bases.all(|b| b == first) => first.clone(),
                    _ => Value::Base,
                }
            }
        }
    }

    /// Assigns a value to its targets, replacing earlier assignments.
    pub(super) fn assign(&self, value: &Value, list: &mut Vec<Assignment>) {
        for target in &self.targets {
            let put = match (self.apply, value) {
                (_, Value::Base) => continue,
                (ApplyChoice::Value, _) => value.clone(),
                (ApplyChoice::Factor, Value::Number(x)) => changed(target, list, |old| old * x),
                (ApplyChoice::Offset, Value::Number(x)) => changed(target, list, |old| old + x),
                _ => continue,
            };
            place(target, put, list);
        }
    }
}

/// The present value at a target, changed by `value`.
pub(super) fn changed(target: &Target, list: &[Assignment], change: impl Fn(f64) -> f64) -> Value {
    let earlier = list.iter().find(|a| a.path == target.path).map(|a| &a.value);
    match earlier.unwrap_or(&target.base) {
        Value::Number(old) => Value::Number(change(*old)),
        _ => Value::Base,
    }
}

/// Assigns a value to a target, replacing an earlier one.
pub(super) fn place(target: &Target, value: Value, list: &mut Vec<Assignment>) {
    if value == Value::Base {
        return;
    }
    match list.iter_mut().find(|a| a.path == target.path) {
        Some(earlier) => earlier.value = value,
        None => list.push(Assignment { path: target.path.clone(), value, unit: target.unit }),
    }
}

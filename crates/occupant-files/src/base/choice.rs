//! Flags with named values: tables of names, their help texts, and their values.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

/// Parses one of the names in a table.
pub fn one_of<T: Copy + Send + Sync + 'static>(table: &'static [(&str, &str, T)]) -> impl TypedValueParser<Value = T> {
    let names = table.iter().map(|(name, help, _)| PossibleValue::new(*name).help(*help));
    let named = |name: String| table.iter().find(|row| row.0 == name).map(|row| row.2).ok_or("unknown name");
    PossibleValuesParser::new(names).try_map(named)
}

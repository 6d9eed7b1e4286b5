//! SI numbers as the digits of a card.
//!
//! A quantity of a scenario is its number times its unit's factor. The shortest decimal number that gives the same product
//! is the number that was written, so a deck's digits come back however its scenario was read.

use occupant_units::unit::parse;

use crate::cards::Unit;
use crate::deck::Number;
use crate::write::punch_real;

/// Columns of a number on most cards.
const WIDTH: usize = 10;

/// SI units per unit of a card.
pub(super) fn factor(unit: Unit) -> f64 {
    parse(unit.in_scenarios, 0).map_or(1.0, |scale| scale.factor)
}

/// Digits of `si` in a card's unit, and the number as it fits into ten columns, if different.
pub(super) fn digits(si: f64, unit: Unit) -> (String, Option<String>) {
    let exact = shortest(si, factor(unit));
    let Some(number) = Number::from_digits(&exact) else { return ("0".to_owned(), None) };
    let punched = punch_real(&number, WIDTH);
    match crate::fortran::read_real(format!("{punched:>WIDTH$}").as_bytes()) {
        Ok(read) if read.value == number.value => (exact, None),
        Ok(read) => (read.digits.clone(), Some(exact)),
        Err(_) => (exact, None),
    }
}

/// Shortest decimal number whose product with `factor` is `si`.
fn shortest(si: f64, factor: f64) -> String {
    let value = si / factor;
    if value == 0.0 || !value.is_finite() {
        return "0".to_owned();
    }
    let candidates = (0..17).map(|places| format!("{value:.places$e}"));
    let found = candidates.filter_map(|text| text.parse::<f64>().ok()).find(|candidate| candidate * factor == si);
    plain(found.unwrap_or(value))
}

/// Number without exponent, unless very small or large.
fn plain(value: f64) -> String {
    if (1e-5..1e10).contains(&value.abs()) { format!("{value}") } else { format!("{value:e}") }
}

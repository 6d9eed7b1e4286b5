//! Numbers as people read them.

use super::Told;
use super::text_table::{number, without_zeros};
use occupant_units::trig;

/// SI value of one display unit, and its symbol; empty for a plain number.
pub fn shown_unit(unit: &Told) -> (f64, &str) {
    (unit.shown.0, &unit.shown.1)
}

/// A number in its display unit.
pub fn shown(value: f64, unit: &Told) -> String {
    significant(value / unit.shown.0)
}

/// A number with its display unit.
pub fn with_unit(value: f64, unit: &Told) -> String {
    unit_after(shown(value, unit), unit)
}

/// A given number with its display unit.
pub fn given_with_unit(value: f64, unit: &Told) -> String {
    unit_after(given(value, unit), unit)
}

fn unit_after(number: String, unit: &Told) -> String {
    match shown_unit(unit).1 {
        "" => number,
        "°" => format!("{number}°"),
        symbol => format!("{number} {symbol}"),
    }
}

/// Four significant digits, with an exponent instead of many zeros.
pub fn significant(value: f64) -> String {
    let size = value.abs();
    let text = match size {
        _ if !value.is_finite() => return "–".to_owned(),
        0.0 => return "0".to_owned(),
        _ if !(1e-4..1e6).contains(&size) => format!("{value:.3e}"),
        _ => {
            let decimals = (3.0 - trig::log10(size).floor()).clamp(0.0, 8.0) as usize;
            format!("{value:.decimals$}")
        }
    };
    text.replace('-', "−")
}

/// As [`significant`], without trailing zeros: for numbers given by the user.
pub fn given(value: f64, unit: &Told) -> String {
    let text = shown(value, unit);
    if text.contains('.') && !text.contains('e') { without_zeros(&text).to_owned() } else { text }
}

/// Three decimals, for fractions and correlations.
pub fn part(value: f64) -> String {
    if value.is_finite() { number(value, 3).replace('-', "−") } else { "–".to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::Units;

    #[test]
    fn four_digits_are_shown() {
        let cases = [
            (1234.56, "1235"),
            (-0.012345, "−0.01235"),
            (0.0, "0"),
            (3.2e7, "3.200e7"),
            (1e-9, "1.000e−9"),
            (f64::NAN, "–"),
        ];
        for (value, text) in cases {
            assert_eq!(significant(value), text);
        }
        let [m, rad, none] = ["m", "rad", ""].map(|unit| Units::default().told(unit));
        assert_eq!(with_unit(0.5, &m), "500.0 mm");
        assert_eq!(given_with_unit(0.5, &m), "500 mm");
        assert_eq!((given(100.0, &none), given(3e7, &none)), ("100".to_owned(), "3.000e7".to_owned()));
        assert_eq!(with_unit(std::f64::consts::PI, &rad), "180.0°");
        assert_eq!([-0.25, -1e-4, f64::NAN].map(part), ["−0.250", "0.000", "–"]);
    }
}

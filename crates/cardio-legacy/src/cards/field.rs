//! One field of a card: where it stands, how it is punched, what it means, and what is doubted about it.

use crate::punched::Columns;
use crate::rule::Rule;

/// Columns of the card number NCARD, whatever the format gives.
pub(crate) const NCARD: Columns = Columns::new(71, 80);

/// Format of a punched field.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// F10.0 or F6.0: a real number, with or without the point.
    Real,
    /// I2 or I10: an integer, right-justified.
    Integer,
    /// A4: text.
    Text,
}

/// Unit of a field, as in the report.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unit {
    /// Symbol in text; empty for a dimensionless number.
    pub symbol: &'static str,
    /// Name in scenarios.
    pub in_scenarios: &'static str,
}

impl Unit {
    /// Dimensionless number: a switch, a count, a fraction.
    pub(crate) const ONE: Self = plain("");
}

pub(super) const ONE: Unit = Unit::ONE;
pub(super) const SECOND: Unit = plain("s");
pub(super) const INCH: Unit = plain("in");
pub(super) const INCH_PER_SECOND: Unit = plain("in/s");
pub(super) const INCH_PER_SECOND_SQUARED: Unit = unit("in/s²", "in/s^2");
pub(super) const RADIAN: Unit = plain("rad");
pub(super) const RADIAN_PER_SECOND: Unit = plain("rad/s");
pub(super) const DEGREE: Unit = plain("deg");
pub(super) const MASS: Unit = unit("lbf·s²/in", "lbf s^2/in");
pub(super) const INERTIA: Unit = unit("lbf·in·s²", "lbf in s^2");
pub(super) const STIFFNESS: Unit = plain("lbf/in");
/// A torque per angular velocity; the report prints lb.-sec.
pub(super) const ROTARY_DAMPING: Unit = unit("in·lbf·s", "in lbf s/rad");
pub(super) const ROTARY_STIFFNESS: Unit = unit("in·lbf/rad", "in lbf/rad");

const fn plain(symbol: &'static str) -> Unit {
    unit(symbol, symbol)
}

const fn unit(symbol: &'static str, in_scenarios: &'static str) -> Unit {
    Unit { symbol, in_scenarios }
}

/// One field of a card.
#[derive(Debug, Clone)]
pub struct Field {
    /// Its columns.
    pub columns: Columns,
    /// Format.
    pub format: Format,
    /// The report's name; on repeated cards, the name without its index.
    pub variable: String,
    /// Its unit.
    pub unit: Unit,
    /// Meaning.
    pub meaning: String,
    /// Key of a scenario with the same number.
    pub(crate) key: Option<String>,
    /// Checks of its number alone.
    pub(crate) bounds: Vec<Bound>,
}

/// A condition that reports a problem if a number meets it. An unreadable number meets none.
#[derive(Debug, Clone)]
pub(crate) struct Bound {
    pub rule: Rule,
    pub violated: fn(f64) -> bool,
    pub message: String,
    pub expected: String,
    pub remedy: &'static str,
}

/// A field whose columns and kind follow from the card's format.
pub(super) fn field(variable: impl Into<String>, unit: Unit, meaning: impl Into<String>) -> Field {
    Field {
        columns: Columns::new(1, 1),
        format: Format::Real,
        variable: variable.into(),
        unit,
        meaning: meaning.into(),
        key: None,
        bounds: Vec::new(),
    }
}

/// Card number at the end of a series' first card. The I8 of some formats would end in column 78.
pub(super) fn ncard(number: u32, format: &str) -> Field {
    let slip = if format.ends_with("I8") { "; the format's I8 would end in column 78" } else { "" };
    Field { columns: NCARD, format: Format::Integer, ..field("NCARD", ONE, format!("card number {number}{slip}")) }
}

impl Field {
    pub(super) fn key(self, key: impl Into<String>) -> Self {
        Self { key: Some(key.into()), ..self }
    }

    /// Adds a check; [`Field::expected`] completes it.
    pub(super) fn wrong_if(mut self, rule: Rule, violated: fn(f64) -> bool, message: impl Into<String>) -> Self {
        let message = message.into();
        self.bounds.push(Bound { rule, violated, message, expected: String::new(), remedy: "" });
        self
    }

    /// Expectation of the last check, and the remedy.
    pub(super) fn expected(mut self, expected: impl Into<String>, remedy: &'static str) -> Self {
        if let Some(bound) = self.bounds.last_mut() {
            (bound.expected, bound.remedy) = (expected.into(), remedy);
        }
        self
    }

    pub(super) fn positive(self, what: &str) -> Self {
        self.wrong_if(Rule::Impossible, |v| v <= 0.0, what).expected("a number above 0", "punch the number")
    }

    pub(super) fn not_negative(self, what: &str) -> Self {
        self.wrong_if(Rule::Impossible, |v| v < 0.0, what).expected("0 or more", "look for a wrong sign")
    }

    /// An angle in radians that must not look like degrees.
    pub(super) fn radians(self) -> Self {
        self.wrong_if(Rule::LooksLikeOtherUnit, |v| v.abs() > std::f64::consts::TAU, "more than a full turn")
            .expected("an angle in radians", "divide by 57.2958 if it is in degrees")
    }
}

/// Kinds and columns of the fields of a FORTRAN format: `I2,8X,6F10.0` is an integer in columns 1–2, eight blank
/// columns, and six reals from column 11. Text of several words is one field.
pub(super) fn places(format: &str) -> Vec<(Format, Columns)> {
    let mut places = Vec::new();
    let mut next = 1;
    for item in format.split(',') {
        let (count, rest) = item.split_at(item.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(0));
        let (kind, width) = rest.split_at(1);
        let number = |digits: &str| digits.split('.').next().and_then(|d| d.parse::<u8>().ok()).unwrap_or(1);
        let (count, width) = (number(count), number(width));
        let (format, count, width) = match kind {
            "F" => (Format::Real, count, width),
            "I" => (Format::Integer, count, width),
            "A" => (Format::Text, 1, count * width),
            _ => {
                next += count;
                continue;
            }
        };
        for _ in 0..count {
            places.push((format, Columns::new(next, next + width - 1)));
            next += width;
        }
    }
    places
}

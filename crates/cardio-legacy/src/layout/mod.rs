//! The cards as data: every field of the report's Appendix IV, one entry each.
//!
//! Columns, variable names and units are the report's; where it slips, the entry holds what is right and the
//! crate's `docs/cards.md` says what the report prints.

mod belts;
mod body;
mod compartment;
mod control;
mod joints;
mod markdown;
mod motion;
mod path;
mod restart;
mod seating;
mod surfaces;

use std::fmt;

pub use markdown::tables_as_markdown;

use crate::columns::Columns;

/// Card number that ends the numbers of a deck (series 15).
pub const TERMINATOR: u32 = 1000;

/// How a field is punched.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// F10.0 or F6.0: a real number, with the point or without.
    Real,
    /// I2 or I10: an integer, right-justified.
    Integer,
    /// A4: text.
    Text,
}

/// Unit of a field, as the report has it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// A number without unit: a switch, a count, a fraction.
    One,
    /// s
    Second,
    /// in
    Inch,
    /// in/s
    InchPerSecond,
    /// in/s²
    InchPerSecondSquared,
    /// rad
    Radian,
    /// rad/s
    RadianPerSecond,
    /// degrees
    Degree,
    /// lbf·s²/in
    Mass,
    /// lbf·in·s²
    Inertia,
    /// lbf/in
    Stiffness,
    /// in·lbf·s (a torque per angular velocity; the report prints lb.-sec.)
    RotaryDamping,
    /// in·lbf/rad
    RotaryStiffness,
}

impl Unit {
    /// The unit in words for a reader; empty for a pure number.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::One => "",
            Self::Second => "s",
            Self::Inch => "in",
            Self::InchPerSecond => "in/s",
            Self::InchPerSecondSquared => "in/s²",
            Self::Radian => "rad",
            Self::RadianPerSecond => "rad/s",
            Self::Degree => "deg",
            Self::Mass => "lbf·s²/in",
            Self::Inertia => "lbf·in·s²",
            Self::Stiffness => "lbf/in",
            Self::RotaryDamping => "in·lbf·s",
            Self::RotaryStiffness => "in·lbf/rad",
        }
    }
}

/// One field of a card.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Field {
    /// Where it stands.
    pub columns: Columns,
    /// How it is punched.
    pub format: Format,
    /// The report's name; on cards that repeat, the name without its index.
    pub variable: &'static str,
    /// Its unit.
    pub unit: Unit,
    /// What it is.
    pub description: &'static str,
}

/// How often a card of a series comes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Repeat {
    /// Once.
    Once,
    /// Once for each number from 1 to `count`, in any order; its first field holds the number.
    Each {
        /// Largest number.
        count: u32,
    },
    /// As often as the first card of the series says.
    Counted,
}

/// One card of a series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CardLayout {
    /// The report's letter, where a series has several cards.
    pub letter: Option<char>,
    /// The format as the report prints it.
    pub format: &'static str,
    /// How often it comes.
    pub repeat: Repeat,
    /// Its fields from left to right.
    pub fields: &'static [Field],
}

/// One series of cards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeriesLayout {
    /// Its number in the report, 1–16.
    pub number: u8,
    /// The card number NCARD that its first card carries, where it has one.
    pub ncard: Option<u32>,
    /// What it is about.
    pub title: &'static str,
    /// Its cards, the first one first.
    pub cards: &'static [CardLayout],
}

/// Name of a card: series, letter and, on cards that repeat, a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct CardId {
    /// The series, 1–16; 17 is the final card.
    pub series: u8,
    /// The letter of the report.
    pub letter: Option<char>,
    /// Segment, surface, station or pair on cards that repeat.
    pub number: Option<u32>,
}

/// The series number by which the final card FINI goes in a [`CardId`].
pub const FINAL_CARD: u8 = 17;

impl CardId {
    /// The only or first card of a series.
    pub fn first_of(series: &SeriesLayout) -> Self {
        Self { series: series.number, letter: series.cards.first().and_then(|c| c.letter), number: None }
    }
}

impl fmt::Display for CardId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.series == FINAL_CARD {
            return f.write_str("FINI");
        }
        write!(f, "{}", self.series)?;
        if let Some(letter) = self.letter {
            write!(f, "{letter}")?;
        }
        match self.number {
            Some(number) => write!(f, " no. {number}"),
            None => Ok(()),
        }
    }
}

/// All sixteen series, in the report's order.
pub const SERIES: [SeriesLayout; 16] = [
    control::TITLE,
    control::TITLE_CONTINUED,
    control::TIMES,
    motion::VELOCITY,
    body::SEGMENTS,
    motion::COORDINATES,
    body::SPHERES,
    compartment::POINTS,
    surfaces::SURFACES,
    seating::SEATING,
    joints::JOINTS,
    path::PATH,
    belts::BELTS,
    restart::PAIRS,
    control::END_OF_NUMBERS,
    control::PLOT,
];

/// The layout of a series by its number, 1–16.
pub fn series(number: u8) -> Option<&'static SeriesLayout> {
    SERIES.iter().find(|s| s.number == number)
}

/// The series whose first card carries this card number.
pub fn series_with_ncard(ncard: u32) -> Option<&'static SeriesLayout> {
    SERIES.iter().find(|s| s.ncard == Some(ncard))
}

impl SeriesLayout {
    /// Number of cards behind the first one, where the layout fixes it; `None` where the first card counts them.
    pub fn cards_behind_first(&self) -> Option<usize> {
        self.cards.iter().skip(1).try_fold(0, |sum, card| match card.repeat {
            Repeat::Once => Some(sum + 1),
            Repeat::Each { count } => Some(sum + count as usize),
            Repeat::Counted => None,
        })
    }
}

impl CardLayout {
    /// The name of a field of this card as the report writes it, with the index where the card repeats.
    pub fn name_of(&self, field: &Field, number: Option<u32>) -> String {
        let is_index = self.fields.first() == Some(field) && matches!(self.repeat, Repeat::Each { .. });
        match number {
            Some(number) if self.repeat != Repeat::Once && !is_index => {
                format!("{}({number})", field.variable)
            }
            _ => field.variable.to_owned(),
        }
    }
}

/// A card that comes once.
const fn card(letter: char, format: &'static str, fields: &'static [Field]) -> CardLayout {
    CardLayout { letter: Some(letter), format, repeat: Repeat::Once, fields }
}

/// The only card of a series.
const fn only_card(format: &'static str, fields: &'static [Field]) -> CardLayout {
    CardLayout { letter: None, format, repeat: Repeat::Once, fields }
}

/// A field of ten columns that starts at column `first`.
const fn real(first: u8, variable: &'static str, unit: Unit, description: &'static str) -> Field {
    Field { columns: Columns::new(first, first + 9), format: Format::Real, variable, unit, description }
}

/// An integer in some columns.
const fn integer(first: u8, last: u8, variable: &'static str, description: &'static str) -> Field {
    Field { columns: Columns::new(first, last), format: Format::Integer, variable, unit: Unit::One, description }
}

/// The card number in columns 71–80, read where it stands whatever the format says.
const fn ncard(description: &'static str) -> Field {
    integer(71, 80, "NCARD", description)
}

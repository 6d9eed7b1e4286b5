//! The cards as one table: every field of the report's Appendix IV, a file for each series.
//!
//! An entry holds the report's name of a variable, its unit, what it means, the bounds outside of which it is doubted, and the
//! scenario's key where there is a single one. Columns and kind of a field come from the card's FORTRAN format. Reader, checks,
//! conversion both ways, writer and `docs/cards.md` use this table and no other. Where the report slips, the entry holds what is
//! right and `docs/cards.md` says what the report prints. Nothing here reads a card or reports a problem.

mod card_01_titles;
mod card_03_times;
mod card_04_velocity;
mod card_05_segments;
mod card_06_exact_state;
mod card_07_spheres;
mod card_08_compartment;
mod card_09_surfaces;
mod card_10_seating;
mod card_11_joints;
mod card_12_path;
mod card_13_belts;
mod card_14_passed_pairs;
mod card_15_end;
mod card_16_plots;
mod field;
mod markdown;

use std::fmt;
use std::sync::LazyLock;

pub(crate) use card_03_times::{Need, need};
pub(crate) use card_10_seating::{POSTURE, SEATS};
pub(crate) use card_11_joints::{JOINTS, Joint};
pub(crate) use card_13_belts::{BELTS, is_of_unused, uses};
pub(crate) use card_15_end::END_OF_NUMBERS;
pub(crate) use field::NCARD;
pub use field::{Field, Format, Unit};
pub use markdown::tables_as_markdown;

/// All sixteen series, in the report's order.
pub static SERIES: LazyLock<Vec<SeriesLayout>> = LazyLock::new(|| {
    let series = [
        card_01_titles::title(),
        card_01_titles::title_continued(),
        card_03_times::series(),
        card_04_velocity::series(),
        card_05_segments::series(),
        card_06_exact_state::series(card_13_belts::initial_lengths()),
        card_07_spheres::series(),
        card_08_compartment::series(),
        card_09_surfaces::series(),
        card_10_seating::series(),
        card_11_joints::series(),
        card_12_path::series(),
        card_13_belts::series(),
        card_14_passed_pairs::series(),
        card_15_end::series(),
        card_16_plots::series(),
    ];
    series.map(SeriesLayout::lettered).into()
});

/// Number of cards of one kind in a series.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Repeat {
    /// Once.
    Once,
    /// Once for each index from 1 to `count`, in any order; its first field contains the index.
    Each {
        /// Largest number.
        count: u32,
    },
    /// As often as the first card of the series gives.
    Counted,
}

/// One card of a series.
#[derive(Debug)]
pub struct CardLayout {
    /// The report's letter, in a series of several cards.
    pub letter: Option<char>,
    /// Format as printed in the report.
    pub format: &'static str,
    /// Number of such cards.
    pub repeat: Repeat,
    /// Its fields from left to right.
    pub fields: Vec<Field>,
}

/// One series of cards.
#[derive(Debug)]
pub struct SeriesLayout {
    /// Its number in the report, 1–16.
    pub number: u8,
    /// Card number NCARD of its first card, if it has one.
    pub ncard: Option<u32>,
    /// Subject.
    pub title: &'static str,
    /// Its cards, in order.
    pub cards: Vec<CardLayout>,
}

/// Name of a card: series, letter and, for repeated cards, an index.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct CardId {
    /// The series, 1–16; 17 is the final card.
    pub series: u8,
    /// The letter of the report.
    pub letter: Option<char>,
    /// Segment, surface, station or pair of a repeated card.
    pub number: Option<u32>,
}

/// Series number of the final card FINI in a [`CardId`].
pub(crate) const FINAL_CARD: u8 = 17;

impl CardId {
    /// The only or first card of a series.
    pub(crate) fn first_of(series: &SeriesLayout) -> Self {
        Self { series: series.number, letter: series.cards.first().and_then(|c| c.letter), number: None }
    }

    /// Layout of the card.
    pub(crate) fn layout(self) -> Option<&'static CardLayout> {
        series(self.series)?.cards.iter().find(|card| card.letter == self.letter)
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

impl fmt::Display for SeriesLayout {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "series {} ({})", self.number, self.title)
    }
}

/// A series by its number, 1–16.
pub fn series(number: u8) -> Option<&'static SeriesLayout> {
    SERIES.iter().find(|s| s.number == number)
}

/// Series whose first card has this card number.
pub(crate) fn series_with_ncard(ncard: u32) -> Option<&'static SeriesLayout> {
    SERIES.iter().find(|s| s.ncard == Some(ncard))
}

/// Field with a name and its index: `TF`, `XLE(3)`, `Q0(17)`, `CALT(5)`.
pub(crate) fn field_named(name: &str) -> Option<&'static Field> {
    let base = name.split_once('(').map_or(name, |(base, _)| base);
    let mut fields = SERIES.iter().flat_map(|series| &series.cards).flat_map(|card| &card.fields);
    fields.find(|field| field.variable == name || field.variable == base)
}

impl SeriesLayout {
    fn new(number: u8, title: &'static str) -> Self {
        Self { number, ncard: None, title, cards: Vec::new() }
    }

    /// Adds the first card, which contains the card number.
    fn first(mut self, ncard: u32, format: &'static str, fields: impl IntoIterator<Item = Field>) -> Self {
        self.ncard = Some(ncard);
        let fields: Vec<Field> = fields.into_iter().chain([field::ncard(ncard, format)]).collect();
        self.with(Repeat::Once, format, fields)
    }

    /// Adds as many cards of this format as the fields need.
    fn then(self, format: &'static str, fields: impl IntoIterator<Item = Field>) -> Self {
        let fields: Vec<Field> = fields.into_iter().collect();
        let on_a_card = field::places(format).len();
        fields.chunks(on_a_card).fold(self, |series, fields| series.with(Repeat::Once, format, fields.to_vec()))
    }

    /// Adds the card that is present once for each index up to `count`.
    fn each(self, count: u32, format: &'static str, fields: impl IntoIterator<Item = Field>) -> Self {
        self.with(Repeat::Each { count }, format, fields.into_iter().collect())
    }

    /// Adds the card whose number the first card gives.
    fn counted(self, format: &'static str, fields: impl IntoIterator<Item = Field>) -> Self {
        self.with(Repeat::Counted, format, fields.into_iter().collect())
    }

    fn with(mut self, repeat: Repeat, format: &'static str, mut fields: Vec<Field>) -> Self {
        for (field, (kind, columns)) in fields.iter_mut().zip(field::places(format)) {
            if field.columns != NCARD {
                (field.format, field.columns) = (kind, columns);
            }
        }
        self.cards.push(CardLayout { letter: None, format, repeat, fields });
        self
    }

    /// Letters of the cards of a series: a, b, c, …; an only card has none.
    fn lettered(mut self) -> Self {
        if self.cards.len() > 1 {
            self.cards.iter_mut().zip('a'..).for_each(|(card, letter)| card.letter = Some(letter));
        }
        self
    }

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
        let is_index = matches!(self.repeat, Repeat::Each { .. }) && self.fields[0].variable == field.variable;
        match number {
            Some(number) if self.repeat != Repeat::Once && !is_index => format!("{}({number})", field.variable),
            _ => field.variable.clone(),
        }
    }
}

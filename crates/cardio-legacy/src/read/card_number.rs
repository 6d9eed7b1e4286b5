//! The card number NCARD, which says which series a card begins.

use crate::cards::{CardLayout, Format, NCARD, SeriesLayout, series_with_ncard};
use crate::fortran::{read_integer, read_real};
use crate::punched::{Columns, PunchedCard};

/// Where the format I8 of series 7, 8 and 10 would read it.
const NCARD_BY_I8: Columns = Columns::new(71, 78);

/// What the columns of NCARD say.
#[derive(Debug, Clone)]
pub(super) enum CardNumber {
    /// The series, by the number where the report describes it.
    Series(&'static SeriesLayout),
    /// The series, by a number that ends in column 78, where the format I8 reads it.
    ByFormat(&'static SeriesLayout),
    /// The series, by a number that is not right-justified; `read_as` is what I10 makes of it.
    Misplaced { series: &'static SeriesLayout, read_as: String },
    /// Nothing.
    Blank,
    /// Something else.
    Other(String),
}

impl CardNumber {
    /// The series that the number names.
    pub(super) fn series(&self) -> Option<&'static SeriesLayout> {
        match self {
            Self::Series(series) | Self::ByFormat(series) | Self::Misplaced { series, .. } => Some(series),
            Self::Blank | Self::Other(_) => None,
        }
    }
}

/// Reads the card number of a card on which a series should begin.
pub(super) fn card_number(card: &PunchedCard) -> CardNumber {
    let text = card.text_of(NCARD);
    let Ok(reading) = read_integer(card.field(NCARD)) else { return CardNumber::Other(text) };
    if reading.blank {
        return CardNumber::Blank;
    }
    if let Some(series) = by_format(card) {
        return CardNumber::ByFormat(series);
    }
    if let Some(series) = with_number(reading.value) {
        return CardNumber::Series(series);
    }
    match text.trim().parse::<u32>().ok().and_then(series_with_ncard) {
        Some(series) => CardNumber::Misplaced { series, read_as: reading.digits },
        None => CardNumber::Other(text),
    }
}

/// The series 7, 8 or 10 by a number that ends where its format I8 does. A 10 there is no 1000 to its own format.
fn by_format(card: &PunchedCard) -> Option<&'static SeriesLayout> {
    let number = read_integer(card.field(NCARD_BY_I8)).ok().filter(|_| card.is_blank_in(Columns::new(79, 80)))?;
    with_number(number.value).filter(|series| matches!(series.number, 7 | 8 | 10))
}

/// The series that a card's number names, wherever in its columns it stands.
pub(super) fn series_by_number(card: &PunchedCard) -> Option<&'static SeriesLayout> {
    card_number(card).series()
}

fn with_number(value: f64) -> Option<&'static SeriesLayout> {
    if (1.0..=9999.0).contains(&value) { series_with_ncard(value as u32) } else { None }
}

/// Whether a card is beyond doubt the first one of a series: a known card number, right-justified, numbers or blanks in
/// the fields before it and blanks in between. Used only to find the place again in a deck that has gone wrong.
pub(super) fn looks_like_first_card(card: &PunchedCard) -> Option<&'static SeriesLayout> {
    let CardNumber::Series(series) = card_number(card) else { return None };
    let layout = series.cards.first()?;
    fits(card, layout).then_some(series)
}

fn fits(card: &PunchedCard, layout: &CardLayout) -> bool {
    let mut next = 1;
    for field in layout.fields.iter().filter(|f| f.variable != "NCARD" && f.format == Format::Real) {
        if read_real(card.field(field.columns)).is_err() {
            return false;
        }
        next = field.columns.last + 1;
    }
    next > 70 || card.is_blank_in(Columns::new(next, 70))
}

//! The card number NCARD, which says which series a card begins.

use crate::cards::{CardLayout, Format, NCARD, SeriesLayout, series_with_ncard};
use crate::fortran::{read_integer, read_real};
use crate::punched::{Columns, PunchedCard};

/// Columns in which the format I8 of series 7, 8 and 10 would read it.
const NCARD_BY_I8: Columns = Columns::new(71, 78);

/// Content of the columns of NCARD.
#[derive(Debug, Clone)]
pub(super) enum CardNumber {
    /// Series by a number in the documented columns.
    Series(&'static SeriesLayout),
    /// Series by a number that ends in column 78, as read by the format I8.
    ByFormat(&'static SeriesLayout),
    /// Series by a number that is not right-justified; `read_as` is its value by I10.
    Misplaced { series: &'static SeriesLayout, read_as: String },
    /// Nothing.
    Blank,
    /// Something else.
    Other(String),
}

impl CardNumber {
    /// Series of the number.
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

/// Series 7, 8 or 10 by a number that ends where its format I8 ends. A 10 there is not 1000 in its own format.
fn by_format(card: &PunchedCard) -> Option<&'static SeriesLayout> {
    let number = read_integer(card.field(NCARD_BY_I8)).ok().filter(|_| card.is_blank_in(Columns::new(79, 80)))?;
    with_number(number.value).filter(|series| matches!(series.number, 7 | 8 | 10))
}

/// Series of a card's number, anywhere in its columns.
pub(super) fn series_by_number(card: &PunchedCard) -> Option<&'static SeriesLayout> {
    card_number(card).series()
}

fn with_number(value: f64) -> Option<&'static SeriesLayout> {
    if (1.0..=9999.0).contains(&value) { series_with_ncard(value as u32) } else { None }
}

/// Whether a card is certainly the first of a series: a known card number, right-justified, numbers or blanks in the
/// fields before it and blanks between. Used only to resynchronize in a damaged deck.
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

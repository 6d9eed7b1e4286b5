//! One series of cards: its first card, and as many behind it as belong to it.

use std::iter::repeat_n;

use super::card_number::{CardNumber, card_number, looks_like_first_card, series_by_number};
use super::fields::read_fields;
use super::{FINI, WORD};
use crate::cards::{CardId, CardLayout, END_OF_NUMBERS, Field, NCARD, Repeat, SeriesLayout};
use crate::deck::{DeckCard, Number};
use crate::diagnostics::{Diagnostic, Sink};
use crate::fortran::read_integer;
use crate::punched::{Columns, PunchedCard};
use crate::rule::Rule;

/// Blank columns between the index of a segment or surface and its other fields.
const AFTER_INDEX: Columns = Columns::new(3, 10);
/// Largest plausible number of cards.
const MOST_CARDS: f64 = 1e9;

/// Reads the series that begins with the first of `cards`; returns its cards and the number of cards used.
pub(super) fn read_series(cards: &[PunchedCard], series: &SeriesLayout, sink: &mut Sink) -> (Vec<DeckCard>, usize) {
    match cards.split_first() {
        Some((first, behind)) => SeriesReader { first, behind, series, sink }.read(),
        None => (Vec::new(), 1),
    }
}

/// A series being read: its first card and all following cards of the file.
struct SeriesReader<'a> {
    first: &'a PunchedCard,
    behind: &'a [PunchedCard],
    series: &'a SeriesLayout,
    sink: &'a mut Sink,
}

impl SeriesReader<'_> {
    fn read(mut self) -> (Vec<DeckCard>, usize) {
        let fixed = self.series.cards_behind_first();
        let id = CardId::first_of(self.series);
        self.report_card_number(id);
        let mut numbers = read_fields(self.first, &self.series.cards[0], id, self.sink);
        if let (Some(last), Some(ncard)) = (numbers.last_mut(), self.series.ncard) {
            *last = Number::whole(ncard);
        }
        let wanted = fixed.or_else(|| self.count(id, &numbers[0]));
        let count = match self.series.cards.get(1) {
            Some(layout @ CardLayout { repeat: Repeat::Each { count }, .. }) => self.cards_with_index(layout, *count),
            _ => self.cards_behind(wanted),
        };
        if fixed.is_none() && wanted != Some(count) {
            // In lenient reading the cards that stand there count; otherwise the difference is an error.
            numbers[0] = Number::whole(u32::try_from(count).unwrap_or(u32::MAX));
        }
        let mut read = vec![deck_card(self.first, id, numbers)];
        read.extend(self.read_behind(count));
        if fixed.is_some_and(|wanted| wanted > count) && self.series.cards.iter().all(|c| c.repeat == Repeat::Once) {
            // Which card is missing cannot be known, so none of the numbers is in a known place.
            read.truncate(1);
        }
        (read, 1 + count)
    }

    /// Reads the cards after the first, without those that lack the index of a segment or surface.
    fn read_behind(&mut self, count: usize) -> Vec<DeckCard> {
        let times = |layout: &CardLayout| if layout.repeat == Repeat::Once { 1 } else { count };
        let layouts = self.series.cards.iter().skip(1).flat_map(|layout| repeat_n(layout, times(layout)));
        let cards = self.behind.iter().take(count).zip(1..).zip(layouts);
        cards.filter_map(|((card, n), layout)| read_card(card, n, self.series.number, layout, self.sink)).collect()
    }

    /// Reports irregularities of the card number of the first card.
    fn report_card_number(&mut self, id: CardId) {
        let problem = |rule, message: String| {
            Diagnostic::new(rule, message).on(self.first).in_card(id).at(NCARD).variable("NCARD")
        };
        let problem = match card_number(self.first) {
            CardNumber::ByFormat(SeriesLayout { number, .. }) => {
                let message = "the card number ends in column 78, where the format I8 of series";
                problem(Rule::CardNumberByFormat, format!("{message} {number} reads it"))
                    .expected("the number at the end of columns 71–80, as the report's table has it")
            }
            CardNumber::Misplaced { series, read_as } => {
                let message = format!("the card number reads as {read_as}, because blanks behind a digit are zeros");
                problem(Rule::CardNumber, message)
                    .expected(format!("{} ending in column 80", series.ncard.unwrap_or_default()))
                    .remedy("move the card number to the right end of the card")
            }
            CardNumber::Blank => {
                problem(Rule::CardNumber, format!("the card number is blank; by its place this is card {id}"))
                    .expected("the number of the series, ending in column 80")
                    .remedy("punch the card number")
            }
            CardNumber::Series(_) | CardNumber::Other(_) => return,
        };
        problem.report(self.sink);
    }

    /// Count on the first card of series 12 or 14; `None` if it is not a plausible count.
    fn count(&mut self, id: CardId, count: &Number) -> Option<usize> {
        if count.value >= 1.0 && count.value <= MOST_CARDS && count.value.fract() == 0.0 {
            return Some(count.value as usize);
        }
        let field = &self.series.cards[0].fields[0];
        if !count.value.is_nan() {
            let message = format!("{} is {}, which counts no cards", field.variable, count.digits);
            Diagnostic::new(Rule::NotAWholeNumber, message)
                .on(self.first)
                .in_card(id)
                .in_field(field)
                .expected("exactly the number of cards that follow in this series, punched with the decimal point")
                .remedy("count the cards behind this one")
                .report(self.sink);
        }
        None
    }

    /// Number of cards after the first in a series whose cards have indices: as many as expected, fewer if something
    /// else begins, more while cards with such an index follow.
    fn cards_with_index(&self, layout: &CardLayout, count: u32) -> usize {
        let numbered =
            |card| PunchedCard::is_blank_in(card, AFTER_INDEX) && index_on_card(card, layout, count).is_some();
        let follows = |(place, card)| !begins_something(card) && (place < count as usize || numbered(card));
        self.behind.iter().enumerate().take_while(|place_and_card| follows(*place_and_card)).count()
    }

    /// Number of cards after the first in the series. The layout or the count gives it; if the next series begins
    /// elsewhere, the present cards count, and the difference is reported.
    fn cards_behind(&mut self, wanted: Option<usize>) -> usize {
        let standing = self.behind.iter().position(begins_something).unwrap_or(self.behind.len());
        let Some(wanted) = wanted else { return standing };
        let fixed = self.series.cards_behind_first().is_some();
        let next = self.behind.get(wanted);
        let in_place = next.is_some_and(|card| series_by_number(card).is_some() || is_word(card))
            && !self.behind.iter().take(wanted).any(ends_numbers);
        if standing == wanted || in_place || (fixed && standing > wanted) {
            return wanted.min(self.behind.len());
        }
        self.report_count(wanted, standing, fixed);
        standing
    }

    fn report_count(&mut self, wanted: usize, standing: usize, fixed: bool) {
        let rule = if fixed { Rule::SeriesTooShort } else { Rule::CountDiffers };
        let end = match self.behind.get(standing) {
            Some(card) => format!("line {} begins something else", card.line),
            None => "the file ends".to_owned(),
        };
        let message =
            format!("{} should have {wanted} cards behind this one and has {standing}: then {end}", self.series);
        let problem = Diagnostic::new(rule, message).on(self.first).in_card(CardId::first_of(self.series));
        let count = &self.series.cards[0].fields[0];
        let problem = if fixed {
            problem.expected(format!("{wanted} more cards"))
        } else {
            problem.in_field(count).expected(format!("as many cards as {} says, {wanted}", count.variable))
        };
        problem.report(self.sink);
    }
}

/// Reads a card after the first; `None` if it lacks the index of a segment or surface.
fn read_card(card: &PunchedCard, n: u32, series: u8, layout: &CardLayout, sink: &mut Sink) -> Option<DeckCard> {
    let number = match layout.repeat {
        Repeat::Once => None,
        Repeat::Counted => Some(n),
        Repeat::Each { count } => index_on_card(card, layout, count),
    };
    let id = CardId { series, letter: layout.letter, number };
    let numbers = read_fields(card, layout, id, sink);
    if let (Repeat::Each { count }, None) = (layout.repeat, number) {
        report_bad_index(card, id, &layout.fields[0], count, &numbers[0], sink);
        return None;
    }
    Some(deck_card(card, id, numbers))
}

fn deck_card(card: &PunchedCard, id: CardId, numbers: Vec<Number>) -> DeckCard {
    DeckCard { id, line: Some(card.line), raw: Some(card.text()), numbers }
}

/// Index of a segment or surface on a card, if valid.
fn index_on_card(card: &PunchedCard, layout: &CardLayout, count: u32) -> Option<u32> {
    let value = read_integer(card.field(layout.fields[0].columns)).ok()?.value;
    (1.0..=f64::from(count)).contains(&value).then_some(value as u32)
}

fn report_bad_index(card: &PunchedCard, id: CardId, field: &Field, count: u32, read: &Number, sink: &mut Sink) {
    if read.value.is_nan() {
        return;
    }
    let what = if read.blank { "is blank".to_owned() } else { format!("is {}", read.digits) };
    Diagnostic::new(Rule::BadIndex, format!("{} {what}: the card belongs to nothing", field.variable))
        .on(card)
        .in_card(id)
        .in_field(field)
        .expected(format!("1 to {count}, right-justified in {}", field.columns))
        .remedy(format!("punch the number so that it ends in column {}", field.columns.last))
        .report(sink);
}

/// Whether a series begins with a card, or a word is alone on it.
pub(super) fn begins_something(card: &PunchedCard) -> bool {
    looks_like_first_card(card).is_some() || is_word(card)
}

/// Whether a card is certainly the card 1000 or a word after it.
fn ends_numbers(card: &PunchedCard) -> bool {
    looks_like_first_card(card).is_some_and(|series| series.number == END_OF_NUMBERS) || is_word(card)
}

/// Whether STAN, NONE or FINI is alone on a card, in capitals or not.
pub(super) fn is_word(card: &PunchedCard) -> bool {
    let word = card.text_of(WORD).to_ascii_uppercase();
    matches!(word.as_str(), "STAN" | "NONE" | FINI) && card.is_blank_in(Columns::new(5, 72))
}

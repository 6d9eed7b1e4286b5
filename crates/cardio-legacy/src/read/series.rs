//! One series of cards: its first card, and as many behind it as belong to it.

use super::WORD;
use super::card_number::{CardNumber, card_number, looks_like_first_card, series_by_number};
use super::fields::read_fields;
use crate::cards::{CardId, CardLayout, NCARD, Repeat, SeriesLayout};
use crate::deck::{DeckCard, Number};
use crate::diagnostics::{Diagnostic, Sink};
use crate::fortran::read_integer;
use crate::punched::{Columns, PunchedCard};
use crate::rule::Rule;

/// No file of cards counts more than this.
const MOST_CARDS: f64 = 1e9;

/// Reads the series that begins at `at`; returns its cards and how many cards of the file it took.
pub(super) fn read_series(
    cards: &[PunchedCard],
    at: usize,
    series: &SeriesLayout,
    sink: &mut Sink,
) -> (Vec<DeckCard>, usize) {
    let (Some(first), Some(layout)) = (cards.get(at), series.cards.first()) else {
        return (Vec::new(), 1);
    };
    let id = CardId::first_of(series);
    report_card_number(first, id, sink);
    let mut numbers = read_fields(first, layout, id, sink);
    if let (Some(last), Some(ncard)) = (numbers.last_mut(), series.ncard) {
        *last = Number::whole(ncard);
    }
    let wanted = match series.cards_behind_first() {
        Some(count) => Some(count),
        None => count_on_card(first, id, layout, numbers.first(), sink),
    };
    let behind = match series.cards.get(1).map(|c| (c.repeat, c)) {
        Some((Repeat::Each { count }, layout)) => cards_with_index(cards, at, layout, count),
        _ => cards_behind(cards, at, series, wanted, sink),
    };
    if let (None, Some(count)) = (series.cards_behind_first(), numbers.first_mut()) {
        // In lenient reading the cards that stand there count; otherwise the difference is an error.
        *count = if wanted == Some(behind) {
            count.clone()
        } else {
            Number::whole(u32::try_from(behind).unwrap_or(u32::MAX))
        };
    }
    let mut read = vec![deck_card(first, id, numbers)];
    let rest = cards.get(at + 1..at + 1 + behind).unwrap_or_default();
    let mut letters = series.cards.iter().skip(1).flat_map(|c| std::iter::repeat_n(c, how_often(c, behind)));
    for (index, card) in rest.iter().enumerate() {
        let Some(layout) = letters.next() else { break };
        read.extend(read_card(card, index, series, layout, sink));
    }
    if series.cards_behind_first().is_some_and(|count| count > behind)
        && series.cards.iter().all(|c| c.repeat == Repeat::Once)
    {
        // Which card is missing cannot be known, so none of the numbers is in a known place.
        read.truncate(1);
    }
    (read, 1 + behind)
}

fn how_often(card: &CardLayout, behind: usize) -> usize {
    match card.repeat {
        Repeat::Once => 1,
        Repeat::Each { .. } | Repeat::Counted => behind,
    }
}

/// How many cards behind the first one belong to a series whose cards carry their own number: as many as there should
/// be, fewer if something else begins, more while cards with such a number follow.
fn cards_with_index(cards: &[PunchedCard], at: usize, layout: &CardLayout, count: u32) -> usize {
    let behind = cards.get(at + 1..).unwrap_or_default();
    let free = Columns::new(3, 10);
    let follows = |(place, card): (usize, &PunchedCard)| {
        let numbered = card.is_blank_in(free) && index_on_card(card, layout, count).is_some();
        !begins_something(card) && (place < count as usize || numbered)
    };
    behind.iter().enumerate().take_while(|(place, card)| follows((*place, card))).count()
}

fn begins_something(card: &PunchedCard) -> bool {
    looks_like_first_card(card).is_some() || is_word(card)
}

fn deck_card(card: &PunchedCard, id: CardId, numbers: Vec<Number>) -> DeckCard {
    DeckCard { id, line: Some(card.line), raw: Some(card.text()), numbers }
}

/// Reads a card behind the first one; `None` if it does not say for which segment or surface it is.
fn read_card(
    card: &PunchedCard,
    index: usize,
    series: &SeriesLayout,
    layout: &CardLayout,
    sink: &mut Sink,
) -> Option<DeckCard> {
    let mut id = CardId { series: series.number, letter: layout.letter, number: None };
    match layout.repeat {
        Repeat::Once => {}
        Repeat::Counted => id.number = u32::try_from(index + 1).ok(),
        Repeat::Each { count } => id.number = index_on_card(card, layout, count),
    }
    let numbers = read_fields(card, layout, id, sink);
    if let (Repeat::Each { count }, None) = (layout.repeat, id.number) {
        report_bad_index(card, id, layout, count, numbers.first(), sink);
        return None;
    }
    Some(deck_card(card, id, numbers))
}

/// The segment or surface number on a card, if it is one.
fn index_on_card(card: &PunchedCard, layout: &CardLayout, count: u32) -> Option<u32> {
    let value = read_integer(card.field(layout.fields.first()?.columns)).ok()?.value;
    (1.0..=f64::from(count)).contains(&value).then_some(value as u32)
}

fn report_bad_index(
    card: &PunchedCard,
    id: CardId,
    layout: &CardLayout,
    count: u32,
    read: Option<&Number>,
    sink: &mut Sink,
) {
    let (Some(field), Some(read)) = (layout.fields.first(), read) else {
        return;
    };
    if read.value.is_nan() {
        return;
    }
    let what = if read.blank { "is blank".to_owned() } else { format!("is {}", read.digits) };
    sink.report(
        Diagnostic::new(Rule::BadIndex, format!("{} {what}: the card belongs to nothing", &*field.variable))
            .on(card)
            .in_card(id)
            .at(field.columns)
            .variable(&*field.variable)
            .expected(format!("1 to {count}, right-justified in {}", field.columns))
            .remedy(format!("punch the number so that it ends in column {}", field.columns.last)),
    );
}

/// Says what is odd about the card number of a first card.
fn report_card_number(card: &PunchedCard, id: CardId, sink: &mut Sink) {
    let finding =
        |rule, message: String| Diagnostic::new(rule, message).on(card).in_card(id).at(NCARD).variable("NCARD");
    match card_number(card) {
        CardNumber::ByFormat(series) => sink.report(
            finding(
                Rule::CardNumberByFormat,
                format!("the card number ends in column 78, where the format I8 of series {} reads it", series.number),
            )
            .expected("the number at the end of columns 71–80, as the report's table has it"),
        ),
        CardNumber::Misplaced { series, read_as } => sink.report(
            finding(
                Rule::CardNumber,
                format!("the card number reads as {read_as}, because blanks behind a digit are zeros"),
            )
            .expected(format!("{} ending in column 80", series.ncard.unwrap_or_default()))
            .remedy("move the card number to the right end of the card"),
        ),
        CardNumber::Blank => sink.report(
            finding(Rule::CardNumber, format!("the card number is blank; by its place this is card {id}"))
                .expected("the number of the series, ending in column 80")
                .remedy("punch the card number"),
        ),
        CardNumber::Series(_) | CardNumber::Other(_) => {}
    }
}

/// The count on the first card of series 12 or 14; `None` if it counts nothing sensible.
fn count_on_card(
    card: &PunchedCard,
    id: CardId,
    layout: &CardLayout,
    count: Option<&Number>,
    sink: &mut Sink,
) -> Option<usize> {
    let (field, count) = (layout.fields.first()?, count?);
    if count.value >= 1.0 && count.value <= MOST_CARDS && count.value.fract() == 0.0 {
        return Some(count.value as usize);
    }
    if !count.value.is_nan() {
        sink.report(
            Diagnostic::new(
                Rule::NotAWholeNumber,
                format!("{} is {}, which counts no cards", field.variable, count.digits),
            )
            .on(card)
            .in_card(id)
            .at(field.columns)
            .variable(&*field.variable)
            .expected("exactly the number of cards that follow in this series, punched with the decimal point")
            .remedy("count the cards behind this one"),
        );
    }
    None
}

/// How many cards behind the first one belong to the series. The layout or the count says so; where the next series
/// begins elsewhere, the cards that stand there do, and the difference is reported.
fn cards_behind(
    cards: &[PunchedCard],
    at: usize,
    series: &SeriesLayout,
    wanted: Option<usize>,
    sink: &mut Sink,
) -> usize {
    let begins_next = |place: usize| cards.get(place).is_some_and(begins_something);
    let next = (at + 1..cards.len()).find(|place| begins_next(*place)).unwrap_or(cards.len());
    let standing = next - at - 1;
    let Some(wanted) = wanted else {
        return standing;
    };
    let fixed = series.cards_behind_first().is_some();
    let place = (at + 1).saturating_add(wanted);
    let in_place = cards.get(place).is_some_and(|c| series_by_number(c).is_some() || is_word(c));
    if standing == wanted || in_place || (fixed && standing > wanted) {
        return wanted.min(cards.len() - at - 1);
    }
    report_count(cards, at, series, wanted, standing, fixed, sink);
    standing
}

fn report_count(
    cards: &[PunchedCard],
    at: usize,
    series: &SeriesLayout,
    wanted: usize,
    standing: usize,
    fixed: bool,
    sink: &mut Sink,
) {
    let Some(first) = cards.get(at) else { return };
    let rule = if fixed { Rule::SeriesTooShort } else { Rule::CountDiffers };
    let end = match cards.get(at + 1 + standing) {
        Some(card) => format!("line {} begins something else", card.line),
        None => "the file ends".to_owned(),
    };
    let message = format!(
        "series {} ({}) should have {wanted} cards behind this one and has {standing}: then {end}",
        series.number, series.title
    );
    let remedy = if fixed { "add the missing cards" } else { "correct the count, or add or remove cards" };
    sink.report(
        Diagnostic::new(rule, message)
            .on(first)
            .in_card(CardId::first_of(series))
            .expected(format!("{wanted} more cards"))
            .remedy(remedy),
    );
}

/// STAN, NONE or FINI alone on a card.
pub(super) fn is_word(card: &PunchedCard) -> bool {
    let word = card.text_of(WORD);
    matches!(word.as_str(), "STAN" | "NONE" | "FINI") && card.is_blank_in(Columns::new(5, 72))
}

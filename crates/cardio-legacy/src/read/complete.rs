//! Whether a deck has the series that it needs, each segment and surface once.

use super::SeriesRead;
use crate::cards::{CardId, CardLayout, Need, Repeat, SERIES, SeriesLayout, need};
use crate::deck::DeckCard;
use crate::diagnostics::{Diagnostic, Sink};
use crate::rule::Rule;

/// Reports missing, surplus and duplicate series and cards; true if the deck is complete.
pub(super) fn check_completeness(read: &SeriesRead, first_line: usize, sink: &mut Sink) -> bool {
    let before = sink.errors();
    let card_3 = read.get(&3).and_then(|cards| cards.first());
    let switch = |name: &str| card_3?.named().find(|(n, ..)| n == name).map(|(_, _, number)| number.value);
    let (mread, npos) = (switch("MREAD"), switch("NPOS"));
    for series in SERIES.iter().filter(|s| (3..15).contains(&s.number)) {
        match (need(series.number, mread, npos), read.get(&series.number)) {
            (Need::Needed, None) => report_missing(series, read, first_line, sink),
            (Need::Unused, Some(cards)) => report_unused(series, cards, sink),
            _ => {}
        }
        for layout in &series.cards {
            if let (Repeat::Each { count }, Some(cards)) = (layout.repeat, read.get(&series.number)) {
                check_each_once(series, layout, count, cards, sink);
            }
        }
    }
    sink.errors() == before
}

fn report_missing(series: &SeriesLayout, read: &SeriesRead, first_line: usize, sink: &mut Sink) {
    let before = read.range(..series.number).next_back();
    let line = before.and_then(|(_, cards)| cards.last()).and_then(|c| c.line).unwrap_or(first_line);
    let why = match series.number {
        4 | 10 => ", which NPOS = 0 on card 3 asks for",
        6 => ", which NPOS = 1 on card 3 asks for",
        12 => ", which MREAD = 0 on card 3 asks for",
        _ => "",
    };
    let place = match before {
        Some((number, _)) => format!("it should follow series {number}"),
        None => "it should follow the titles".to_owned(),
    };
    let ncard = series.ncard.unwrap_or_default();
    Diagnostic::new(Rule::SeriesMissing, format!("{series} is missing{why}"))
        .at_line(line)
        .in_card(CardId::first_of(series))
        .expected(format!("{place} and begin with a card that has {ncard} at the end of columns 71–80"))
        .report(sink);
}

fn report_unused(series: &SeriesLayout, cards: &[DeckCard], sink: &mut Sink) {
    let why = match series.number {
        4 | 10 => "NPOS = 1 takes the initial state from series 6",
        6 => "NPOS = 0 seats the occupant by series 4 and 10",
        14 => "NPOS = 0 seats the occupant, and there is no run to extend",
        _ => "MREAD ≠ 0 takes the path from elsewhere",
    };
    on_first(Diagnostic::new(Rule::SeriesUnused, format!("{series} is not used: {why}")), cards).report(sink);
}

fn check_each_once(series: &SeriesLayout, layout: &CardLayout, count: u32, cards: &[DeckCard], sink: &mut Sink) {
    let index = &layout.fields[0];
    let variable = &index.variable;
    let mut missing = Vec::new();
    for number in 1..=count {
        let mut found = cards.iter().filter(|c| c.id.number == Some(number));
        let first = found.next();
        if first.is_none() {
            missing.push(number.to_string());
        }
        let line = first.and_then(|c| c.line).unwrap_or_default();
        for again in found {
            Diagnostic::new(Rule::IndexTwice, format!("{variable} = {number} has been read at line {line}"))
                .on_card_of_deck(again)
                .in_field(index)
                .expected("each number once")
                .remedy("correct the number of one of the two cards")
                .report(sink);
        }
    }
    if !missing.is_empty() {
        let message = format!("no card for {variable} = {}", missing.join(", "));
        on_first(Diagnostic::new(Rule::IndexMissing, message), cards)
            .in_card(CardId { series: series.number, letter: layout.letter, number: None })
            .expected(format!("a card for each number from 1 to {count}"))
            .report(sink);
    }
}

fn on_first(problem: Diagnostic, cards: &[DeckCard]) -> Diagnostic {
    if let Some(card) = cards.first() { problem.on_card_of_deck(card) } else { problem }
}

//! Whether a deck has the series that it needs, each segment and surface once.

use crate::columns::Columns;
use crate::deck::DeckCard;
use crate::diagnostic::{Finding, Sink};
use crate::layout::{CardId, CardLayout, Repeat, SERIES, SeriesLayout};
use crate::reader::SeriesRead;
use crate::rule::Rule;

/// Whether a series has to be there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Need {
    Needed,
    Optional,
    Unused,
}

/// Reports missing, surplus and doubled series and cards; true if the deck has all that it needs.
pub(crate) fn check_completeness(read: &SeriesRead, first_line: usize, sink: &mut Sink) -> bool {
    let before = sink.errors();
    for series in SERIES.iter().filter(|s| (3..15).contains(&s.number)) {
        match (need(series.number, read), read.get(&series.number)) {
            (Need::Needed, None) => report_missing(series, read, first_line, sink),
            (Need::Unused, Some(cards)) => report_unused(series, cards, sink),
            _ => {}
        }
        for layout in series.cards {
            if let (Repeat::Each { count }, Some(cards)) = (layout.repeat, read.get(&series.number)) {
                check_each_once(series, layout, count, cards, sink);
            }
        }
    }
    sink.errors() == before
}

/// The report's rules: 4 and 10 or 6 by NPOS, 12 by MREAD, 13 as wanted, 14 to extend a run (NPOS = 1).
fn need(number: u8, read: &SeriesRead) -> Need {
    let switch =
        |place: usize| read.get(&3).and_then(|c| c.first()).and_then(|c| c.numbers.get(place)).map(|n| n.value);
    let (mread, npos) = (switch(4), switch(5));
    match (number, mread, npos) {
        (14, _, Some(0.0)) => Need::Unused,
        (13 | 14, ..) => Need::Optional,
        (4 | 10, _, Some(0.0)) | (6, _, Some(1.0)) | (12, Some(0.0), _) => Need::Needed,
        (4 | 10, _, Some(1.0)) | (6, _, Some(0.0)) => Need::Unused,
        (12, Some(mread), _) if mread > 0.0 => Need::Unused,
        (4 | 6 | 10 | 12, ..) => Need::Optional,
        _ => Need::Needed,
    }
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
        Some((number, _)) => format!("it should stand behind series {number}"),
        None => "it should stand behind the titles".to_owned(),
    };
    let ncard = series.ncard.unwrap_or_default();
    sink.report(
        Finding::new(Rule::SeriesMissing, format!("series {} ({}) is missing{why}", series.number, series.title))
            .at_line(line)
            .in_card(CardId::first_of(series))
            .expected(format!("{place} and begin with a card that has {ncard} at the end of columns 71–80"))
            .remedy("add the cards, or punch the card number if they are there"),
    );
}

fn report_unused(series: &SeriesLayout, cards: &[DeckCard], sink: &mut Sink) {
    let why = match series.number {
        4 | 10 => "NPOS = 1 takes the initial state from series 6",
        6 => "NPOS = 0 seats the occupant by series 4 and 10",
        14 => "NPOS = 0 seats the occupant, and there is no run to extend",
        _ => "MREAD ≠ 0 takes the path from elsewhere",
    };
    let finding =
        Finding::new(Rule::SeriesUnused, format!("series {} ({}) is not used: {why}", series.number, series.title));
    sink.report(place(finding, cards.first()));
}

fn check_each_once(series: &SeriesLayout, layout: &CardLayout, count: u32, cards: &[DeckCard], sink: &mut Sink) {
    let variable = layout.fields.first().map_or("", |f| f.variable);
    let columns = layout.fields.first().map_or(Columns::new(1, 2), |f| f.columns);
    let mut missing = Vec::new();
    for number in 1..=count {
        let mut found = cards.iter().filter(|c| c.id.number == Some(number));
        let first = found.next();
        if first.is_none() {
            missing.push(number.to_string());
        }
        for again in found {
            let line = first.and_then(|c| c.line).unwrap_or_default();
            let finding = Finding::new(Rule::IndexTwice, format!("{variable} = {number} has been read at line {line}"))
                .at(columns)
                .variable(variable)
                .expected("each number once")
                .remedy("correct the number of one of the two cards");
            sink.report(place(finding, Some(again)));
        }
    }
    if !missing.is_empty() {
        let id = CardId { series: series.number, letter: layout.letter, number: None };
        let finding = Finding::new(Rule::IndexMissing, format!("no card for {variable} = {}", missing.join(", ")))
            .expected(format!("a card for each number from 1 to {count}"))
            .remedy("add the cards, or correct their numbers");
        sink.report(place(finding, cards.first()).in_card(id));
    }
}

fn place(finding: Finding, card: Option<&DeckCard>) -> Finding {
    match card {
        Some(card) => {
            let finding = finding.in_card(card.id);
            let finding = if let Some(line) = card.line { finding.at_line(line) } else { finding };
            if let Some(raw) = &card.raw { finding.raw(raw.clone()) } else { finding }
        }
        None => finding,
    }
}

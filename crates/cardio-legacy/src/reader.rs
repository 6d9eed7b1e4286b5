//! A file of decks: titles, series, plot card, deck after deck, and the final card.

use std::collections::BTreeMap;

use crate::card::{Card, read_cards};
use crate::card_number::{CardNumber, NCARD, card_number, looks_like_first_card, series_by_number};
use crate::check::check_deck;
use crate::columns::Columns;
use crate::completeness::check_completeness;
use crate::deck::{Deck, DeckCard};
use crate::diagnostic::{Finding, Sink};
use crate::layout::{CardId, FINAL_CARD, SeriesLayout, series};
use crate::rule::Rule;
use crate::series_reader::{WORD, is_word, read_series};

/// The series read so far of a deck, by number.
pub(crate) type SeriesRead = BTreeMap<u8, Vec<DeckCard>>;

const TERMINATOR_SERIES: u8 = 15;
/// How many cards are searched for the third one when the titles are not where they should be.
const TITLE_SEARCH: usize = 8;

/// Reads all decks of a file; those with an error are left out.
pub(crate) fn read_file(bytes: &[u8], sink: &mut Sink) -> Vec<Deck> {
    let mut cards = read_cards(bytes, sink);
    while cards.last().is_some_and(Card::is_blank) {
        cards.pop();
    }
    if cards.is_empty() {
        sink.report(
            Finding::new(Rule::EmptyFile, "the file holds no card")
                .expected("two title cards, series 3 to 16 and FINI")
                .remedy("give the name of a deck"),
        );
    }
    let mut reader = Reader { cards: &cards, at: 0, sink };
    let mut decks = Vec::new();
    while let Some(card) = reader.card() {
        if starts_with_fini(card) {
            if reader.at == 0 {
                report_no_deck(card, reader.sink);
            }
            reader.end_file();
            return decks;
        }
        let before = reader.sink.errors();
        let first_line = card.line;
        let deck = reader.read_deck();
        let last_line = reader.cards[..reader.at].last().map_or(first_line, |c| c.line);
        let sound = reader.sink.errors() == before && !reader.sink.has_error_in(first_line, last_line);
        decks.extend(deck.filter(|_| sound));
    }
    if let Some(last) = cards.last() {
        sink.report(
            Finding::new(Rule::NoFinalCard, "the file ends without the final card")
                .on(last)
                .expected("FINI in columns 1–4 behind the last deck")
                .remedy("add a card FINI; look whether the file is complete"),
        );
    }
    decks
}

fn report_no_deck(card: &Card, sink: &mut Sink) {
    sink.report(
        Finding::new(Rule::EmptyFile, "the first card is the final one: the file holds no deck")
            .on(card)
            .expected("two title cards, series 3 to 16 and FINI")
            .remedy("change the first word of the title if the card is meant to be one"),
    );
}

pub(crate) fn starts_with_fini(card: &Card) -> bool {
    card.field(WORD) == b"FINI"
}

/// Where the card of series 3 stands, counted from the first title.
fn place_of_third(cards: &[Card]) -> Option<usize> {
    if cards.get(2).and_then(series_by_number).is_some_and(|s| s.number == 3) {
        return Some(2);
    }
    let is_third = |card: &Card| looks_like_first_card(card).is_some_and(|s| s.number == 3);
    cards.iter().take(TITLE_SEARCH).position(is_third)
}

/// A file under reading: its cards, where it stands, what was found.
pub(crate) struct Reader<'a> {
    pub(crate) cards: &'a [Card],
    pub(crate) at: usize,
    pub(crate) sink: &'a mut Sink,
}

impl<'a> Reader<'a> {
    pub(crate) fn card(&self) -> Option<&'a Card> {
        self.cards.get(self.at)
    }

    /// Reads one deck from the present card; always moves on. `None` if it is not whole.
    fn read_deck(&mut self) -> Option<Deck> {
        let first_line = self.card()?.line;
        let titles = self.read_titles();
        let read = self.read_all_series();
        let plot = self.read_plot()?;
        let complete = check_completeness(&read, first_line, self.sink);
        let deck = Deck::assemble(titles?, read.into_values().flatten().collect(), plot);
        if complete {
            check_deck(&deck, first_line, self.sink);
        }
        Some(deck)
    }

    /// The two title cards: they stand before the card of series 3, which has its number.
    fn read_titles(&mut self) -> Option<[String; 2]> {
        let here = &self.cards[self.at..];
        match place_of_third(here) {
            Some(place) if place != 2 => {
                self.report_titles(&here[place], place);
                self.at += place;
                None
            }
            _ => {
                let titles = here.get(..2).map(|t| [t[0].text(), t[1].text()]);
                self.at = (self.at + 2).min(self.cards.len());
                titles
            }
        }
    }

    fn report_titles(&mut self, third: &Card, found: usize) {
        let (rule, remedy) = if found < 2 {
            (Rule::MissingTitle, "add the missing title cards; they may be blank, but they must be there")
        } else {
            (Rule::UnexpectedCard, "remove the cards between the titles and series 3")
        };
        let cards = if found == 1 { "card stands" } else { "cards stand" };
        self.sink.report(
            Finding::new(rule, format!("{found} {cards} before the first card with a card number"))
                .on(third)
                .expected("exactly two title cards at the beginning of a deck")
                .remedy(remedy),
        );
    }

    /// The series with a card number, up to and with the card 1000.
    fn read_all_series(&mut self) -> SeriesRead {
        let mut read = SeriesRead::new();
        let mut highest = 2;
        loop {
            let Some(card) = self.card() else {
                self.report_truncated();
                return read;
            };
            if is_word(card) {
                self.report_no_terminator(card);
                return read;
            }
            let Some(series) = self.series_here(card, highest, &read) else {
                self.skip_unexpected(highest);
                continue;
            };
            self.report_order(card, series, highest, &read);
            let (cards, taken) = read_series(self.cards, self.at, series, self.sink);
            self.at += taken;
            read.insert(series.number, cards);
            if series.number == TERMINATOR_SERIES {
                return read;
            }
            highest = highest.max(series.number);
        }
    }

    /// The series that begins with this card: by its number, or, where that is blank, by its place.
    fn series_here(&self, card: &Card, highest: u8, read: &SeriesRead) -> Option<&'static SeriesLayout> {
        match card_number(card) {
            CardNumber::Series(_) | CardNumber::ByFormat(_) | CardNumber::Misplaced { .. } => series_by_number(card),
            CardNumber::Other(_) => None,
            CardNumber::Blank => {
                let next = series(highest + 1).filter(|s| s.ncard.is_some() && !read.contains_key(&s.number))?;
                let behind = self.at + 1 + next.cards_behind_first()?;
                let follows = self.cards.get(behind).is_some_and(|c| looks_like_first_card(c).is_some());
                (follows && !card.is_blank()).then_some(next)
            }
        }
    }

    fn report_order(&mut self, card: &Card, series: &SeriesLayout, highest: u8, read: &SeriesRead) {
        let id = CardId::first_of(series);
        let finding = |rule, message: String| Finding::new(rule, message).on(card).in_card(id).at(NCARD);
        if let Some(earlier) = read.get(&series.number) {
            let line = earlier.first().and_then(|c| c.line).unwrap_or_default();
            self.sink.report(
                finding(
                    Rule::SeriesTwice,
                    format!("series {} ({}) has been read at line {line}", series.number, series.title),
                )
                .expected("each series once")
                .remedy("remove one of the two; in lenient reading the later one counts, as it did in the program"),
            );
        } else if series.number < highest {
            self.sink.report(
                finding(Rule::OutOfOrder, format!("series {} stands behind series {highest}", series.number))
                    .expected("the series in the order of their numbers")
                    .remedy("sort the deck; the card number says which series it is, and so it was read"),
            );
        }
    }

    /// Passes over cards until a series begins, a word stands alone, or the file ends.
    fn skip_unexpected(&mut self, highest: u8) {
        let here = &self.cards[self.at..];
        let Some(first) = here.first() else { return };
        let begins = |card: &Card| looks_like_first_card(card).is_some() || is_word(card);
        let count = here.iter().skip(1).position(begins).map_or(here.len(), |place| place + 1);
        let last = here.get(count - 1).map_or(first.line, |c| c.line);
        let lines =
            if count == 1 { "this card belongs".into() } else { format!("lines {} to {last} belong", first.line) };
        let number = match card_number(first) {
            CardNumber::Other(text) => format!("columns 71–80 hold `{text}`"),
            _ => "columns 71–80 are blank".to_owned(),
        };
        let after = if highest > 2 { format!(" behind series {highest}") } else { String::new() };
        self.sink.report(
            Finding::new(Rule::UnexpectedCard, format!("{lines} to no series{after}: {number}"))
                .on(first)
                .at(NCARD)
                .expected("the first card of a series, with its number ending in column 80, or the card 1000")
                .remedy("look for a surplus card, a missing first card or a wrong card number"),
        );
        self.at += count;
    }

    fn report_truncated(&mut self) {
        if let Some(last) = self.cards.last() {
            self.sink.report(
                Finding::new(Rule::Truncated, "the file ends inside a deck")
                    .on(last)
                    .expected("the rest of the deck, a card 1000, a plot card and FINI")
                    .remedy("look for the missing end of the file"),
            );
        }
    }

    fn report_no_terminator(&mut self, card: &Card) {
        self.sink.report(
            Finding::new(Rule::NoTerminator, "the numbers end without the card 1000 (series 15)")
                .on(card)
                .expected("a card with 1000 in columns 77–80 before this one")
                .remedy("add the card"),
        );
    }

    /// The final card, and what stands behind it.
    fn end_file(&mut self) {
        let Some(card) = self.card() else { return };
        self.check_rest_of_word_card(card, CardId { series: FINAL_CARD, letter: None, number: None });
        self.at += 1;
        if let Some(card) = self.cards[self.at..].iter().find(|c| !c.is_blank()) {
            self.sink.report(
                Finding::new(Rule::AfterFinalCard, "something stands behind the final card; it is not read")
                    .on(card)
                    .at(Columns::new(1, 80))
                    .expected("FINI behind the last deck, and nothing more")
                    .remedy("remove an earlier FINI if a deck follows; remove the rest otherwise"),
            );
        }
    }
}

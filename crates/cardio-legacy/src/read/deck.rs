//! One deck of a file: titles, series up to the card 1000, plot card.

use super::card_number::{CardNumber, card_number, looks_like_first_card, series_by_number};
use super::complete::check_completeness;
use super::series::{begins_something, is_word, read_series};
use super::{PLOT_SERIES, Reader, SeriesRead, WORD, starts_with_fini};
use crate::cards::{CardId, END_OF_NUMBERS, NCARD, SeriesLayout, series};
use crate::check::check_deck;
use crate::deck::{Deck, Plot};
use crate::diagnostics::Diagnostic;
use crate::punched::{Columns, PunchedCard};
use crate::rule::Rule;

/// Columns of punched sequence numbers.
const SEQUENCE: Columns = Columns::new(73, 80);

/// Number of cards searched for series 3 if the titles are not in their place.
const TITLE_SEARCH: usize = 8;

impl Reader<'_> {
    /// Reads one deck from the present card; always advances. `None` if it is incomplete.
    pub(super) fn read_deck(&mut self) -> Option<Deck> {
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

    /// The two title cards, before the card of series 3, which is recognized by its number.
    fn read_titles(&mut self) -> Option<[String; 2]> {
        let here = &self.cards[self.at..];
        match place_of_third(here) {
            Some(place) if place != 2 => {
                self.report_titles(here, place);
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

    fn report_titles(&mut self, here: &[PunchedCard], found: usize) {
        let blank_before = found > 2 && here[..found - 2].iter().all(PunchedCard::is_blank);
        let (rule, at, remedy) = if found < 2 {
            (Rule::MissingTitle, found, "add the missing title cards; they may be blank, but they must be there")
        } else if blank_before {
            (Rule::UnexpectedCard, 0, "remove the blank cards before the titles")
        } else {
            (Rule::UnexpectedCard, 2, "remove the cards between the titles and series 3")
        };
        let cards = if found == 1 { "card stands" } else { "cards stand" };
        Diagnostic::new(rule, format!("{found} {cards} before the first card with a card number"))
            .on(&here[at])
            .expected("exactly two title cards at the beginning of a deck")
            .remedy(remedy)
            .report(self.sink);
    }

    /// The series with a card number, up to and including the card 1000.
    fn read_all_series(&mut self) -> SeriesRead {
        let mut read = SeriesRead::new();
        let mut highest = 2;
        loop {
            let Some(card) = self.card().filter(|card| !is_word(card)) else {
                self.report_no_end();
                return read;
            };
            let Some(series) = self.series_here(card, highest, &read) else {
                self.skip_unexpected(highest);
                continue;
            };
            self.report_order(card, series, highest, &read);
            let (cards, taken) = read_series(&self.cards[self.at..], series, self.sink);
            self.at += taken;
            read.insert(series.number, cards);
            if series.number == END_OF_NUMBERS {
                return read;
            }
            highest = highest.max(series.number);
        }
    }

    /// Series that begins with this card: by its number or, if that is blank, by its position.
    fn series_here(&self, card: &PunchedCard, highest: u8, read: &SeriesRead) -> Option<&'static SeriesLayout> {
        let number = card_number(card);
        if !matches!(number, CardNumber::Blank) {
            return number.series();
        }
        let next = series(highest + 1).filter(|s| s.ncard.is_some() && !read.contains_key(&s.number))?;
        let behind = self.at + 1 + next.cards_behind_first()?;
        let follows = self.cards.get(behind).is_some_and(|c| looks_like_first_card(c).is_some());
        (follows && !card.is_blank()).then_some(next)
    }

    fn report_order(&mut self, card: &PunchedCard, series: &SeriesLayout, highest: u8, read: &SeriesRead) {
        let id = CardId::first_of(series);
        let finding = |rule, message: String| Diagnostic::new(rule, message).on(card).in_card(id).at(NCARD);
        if let Some(earlier) = read.get(&series.number) {
            let line = earlier.first().and_then(|c| c.line).unwrap_or_default();
            finding(Rule::SeriesTwice, format!("{series} has been read at line {line}")).report(self.sink);
        } else if series.number < highest {
            finding(Rule::OutOfOrder, format!("series {} comes after series {highest}", series.number))
                .report(self.sink);
        }
    }

    /// Skips cards until a series begins, a word is alone on a card, or the file ends.
    fn skip_unexpected(&mut self, highest: u8) {
        let here = &self.cards[self.at..];
        let Some(first) = here.first() else { return };
        let count = here.iter().skip(1).position(begins_something).map_or(here.len(), |place| place + 1);
        let last = here.get(count - 1).map_or(first.line, |c| c.line);
        let lines =
            if count == 1 { "this card belongs".into() } else { format!("lines {} to {last} belong", first.line) };
        let number = match card_number(first) {
            CardNumber::Other(text) => format!("columns 71–80 hold `{text}`"),
            _ => "columns 71–80 are blank".to_owned(),
        };
        let after = if highest > 2 { format!(" behind series {highest}") } else { String::new() };
        Diagnostic::new(Rule::UnexpectedCard, format!("{lines} to no series{after}: {number}"))
            .on(first)
            .at(NCARD)
            .expected("the first card of a series, with its number ending in column 80, or the card 1000")
            .remedy(if are_numbered(&here[..count]) {
                "columns 73–80 hold sequence numbers, where card numbers are to be: blank them, and punch the card numbers"
            } else {
                "look for a surplus card, a missing first card or a wrong card number"
            })
            .report(self.sink);
        self.at += count;
    }

    /// Reports that the numbers end without a card 1000, at a word or at the end of the file.
    fn report_no_end(&mut self) {
        let truncated = Diagnostic::new(Rule::Truncated, "the file ends inside a deck");
        let no_terminator = Diagnostic::new(Rule::NoTerminator, "the numbers end without the card 1000 (series 15)");
        match (self.card(), self.cards.last()) {
            (Some(word), _) => no_terminator.on(word).report(self.sink),
            (None, Some(last)) => truncated.on(last).report(self.sink),
            (None, None) => {}
        }
    }

    /// The plot card; `None` if the deck ends without one and is unusable.
    fn read_plot(&mut self) -> Option<Plot> {
        let id = CardId { series: PLOT_SERIES, letter: None, number: None };
        let card = self.card();
        let third_follows = self.cards.get(self.at + 2).and_then(looks_like_first_card).is_some_and(|s| s.number == 3);
        let word = card.map(|c| c.text_of(WORD)).unwrap_or_default();
        let plot = Plot::of_word(&word.to_ascii_uppercase());
        if plot.is_none() && (card.is_none_or(starts_with_fini) || third_follows) {
            let problem = Diagnostic::new(Rule::NoPlotCard, "the plot card (series 16) is missing").in_card(id);
            match card.or(self.cards.last()) {
                Some(card) => problem.on(card).report(self.sink),
                None => problem.report(self.sink),
            }
            return Some(Plot::None);
        }
        let card = card?;
        self.at += 1;
        if Plot::of_word(&word).is_none() {
            Diagnostic::new(Rule::UnknownWord, format!("`{word}` is no plot option"))
                .on(card)
                .in_card(id)
                .at(WORD)
                .report(self.sink);
        }
        self.check_rest_of_word_card(card, id);
        Some(plot.unwrap_or(Plot::None))
    }
}

/// Whether columns 73–80 of cards contain sequence numbers: digits that increase from card to card.
fn are_numbered(cards: &[PunchedCard]) -> bool {
    let number = |card: &PunchedCard| card.text_of(SEQUENCE).trim().parse::<u32>().ok();
    let numbers: Option<Vec<u32>> = cards.iter().map(number).collect();
    numbers.is_some_and(|all| all.len() > 2 && all.windows(2).all(|pair| pair[0] < pair[1]))
}

/// Position of the card of series 3, counted from the first title.
pub(super) fn place_of_third(cards: &[PunchedCard]) -> Option<usize> {
    if cards.get(2).and_then(series_by_number).is_some_and(|s| s.number == 3) {
        return Some(2);
    }
    let is_third = |card: &PunchedCard| looks_like_first_card(card).is_some_and(|s| s.number == 3);
    cards.iter().take(TITLE_SEARCH).position(is_third)
}

//! Cards of a file → decks: deck after deck, and the final card. What numbers mean is no matter here but of [`crate::check`].

mod card_number;
mod complete;
mod deck;
mod fields;
mod lines;
mod records;
mod series;

use std::collections::BTreeMap;

use crate::cards::{CardId, FINAL_CARD, series};
use crate::deck::{Deck, DeckCard};
use crate::diagnostics::{Diagnostic, Diagnostics, Sink};
use crate::punched::{Columns, PunchedCard};
use crate::rule::{Rule, Strictness};
use deck::place_of_third;
use fields::read_fields;
use lines::read_cards;
use series::is_word;

/// The series of a deck read so far, by number.
type SeriesRead = BTreeMap<u8, Vec<DeckCard>>;

/// Columns of the words STAN, NONE and FINI.
const WORD: Columns = Columns::new(1, 4);
const FINI: &str = "FINI";
const PLOT_SERIES: u8 = 16;
/// Fewest cards of a deck: two titles and a card with a number.
const FEWEST_CARDS: usize = 3;

/// Options for reading a file of decks.
#[derive(Debug, Clone, PartialEq)]
pub struct ParseOptions {
    /// Name of the file, for the diagnostics.
    pub file: String,
    /// Strictness.
    pub strictness: Strictness,
}

impl Default for ParseOptions {
    fn default() -> Self {
        Self { file: "deck".into(), strictness: Strictness::Default }
    }
}

impl Deck {
    /// Whether the third card of a file, or one near it, is the first of series 3, as in a deck.
    pub fn is_likely(bytes: impl AsRef<[u8]>) -> bool {
        let mut sink = Sink::new("", Strictness::Default);
        let bytes = records::as_lines(bytes.as_ref(), &mut sink);
        place_of_third(&read_cards(&bytes, &mut sink)).is_some()
    }

    /// Reads a file of decks. All problems of the file are in the diagnostics; a deck with an error is not returned.
    ///
    ///
    /// The bytes are Latin-1, UTF-16 with its byte order mark, or EBCDIC; records of 80 columns need no line ends. No
    /// content makes this panic.
    pub fn parse(bytes: impl AsRef<[u8]>, options: &ParseOptions) -> (Vec<Self>, Diagnostics) {
        let mut sink = Sink::new(&options.file, options.strictness);
        let decks = read_file(bytes.as_ref(), &mut sink);
        (decks, sink.into_diagnostics())
    }
}

/// Reads all decks of a file, without those that have an error.
fn read_file(bytes: &[u8], sink: &mut Sink) -> Vec<Deck> {
    let bytes = records::as_lines(bytes, sink);
    if records::are_no_cards(&bytes, sink) {
        return Vec::new();
    }
    let mut cards = read_cards(&bytes, sink);
    while cards.last().is_some_and(PunchedCard::is_blank) {
        cards.pop();
    }
    if cards.is_empty() {
        Diagnostic::new(Rule::EmptyFile, "the file holds no card").remedy("give the name of a deck").report(sink);
    }
    let mut reader = Reader { cards: &cards, at: 0, sink };
    let mut decks = Vec::new();
    while let Some(card) = reader.card() {
        if starts_with_fini(card) {
            reader.end_file(card);
            return decks;
        }
        if reader.at > 0 && reader.cards.len() - reader.at < FEWEST_CARDS {
            reader.leave_rest(card);
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
        Diagnostic::new(Rule::NoFinalCard, "the file ends without the final card").on(last).report(sink);
    }
    decks
}

/// Whether a card is the final one: its word in capitals, or alone in any case.
fn starts_with_fini(card: &PunchedCard) -> bool {
    let word = card.text_of(WORD);
    word == FINI || (is_word(card) && word.eq_ignore_ascii_case(FINI))
}

/// A file being read: its cards, the position, the problems.
struct Reader<'a> {
    cards: &'a [PunchedCard],
    at: usize,
    sink: &'a mut Sink,
}

impl<'a> Reader<'a> {
    fn card(&self) -> Option<&'a PunchedCard> {
        self.cards.get(self.at)
    }

    /// The final card, and cards after it.
    fn end_file(&mut self, card: &PunchedCard) {
        if self.at == 0 {
            Diagnostic::new(Rule::EmptyFile, "the first card is the final one: the file holds no deck")
                .on(card)
                .remedy("change the first word of the title if the card is meant to be one")
                .report(self.sink);
        }
        let id = CardId { series: FINAL_CARD, letter: None, number: None };
        let word = card.text_of(WORD);
        if word != FINI {
            Diagnostic::new(Rule::NoFinalCard, format!("`{word}` was taken for the final card"))
                .on(card)
                .in_card(id)
                .at(WORD)
                .remedy("punch the word in capitals")
                .report(self.sink);
        }
        self.check_rest_of_word_card(card, id);
        let behind = self.cards.get(self.at + 1..).unwrap_or_default();
        if let Some(card) = behind.iter().find(|c| !c.is_blank()) {
            Diagnostic::new(Rule::AfterFinalCard, "there is text after the final card; it is not read")
                .on(card)
                .at(Columns::new(1, 80))
                .report(self.sink);
        }
    }

    /// Cards after a deck that are neither the final one nor another deck.
    fn leave_rest(&mut self, card: &PunchedCard) {
        let word = card.text_of(WORD);
        Diagnostic::new(
            Rule::NoFinalCard,
            format!("`{word}` is where the final card should be; nothing from here on is read"),
        )
        .on(card)
        .in_card(CardId { series: FINAL_CARD, letter: None, number: None })
        .at(WORD)
        .report(self.sink);
    }

    /// Reports text after the word on a card that should contain nothing else.
    fn check_rest_of_word_card(&mut self, card: &PunchedCard, id: CardId) {
        if let Some(layout) = series(PLOT_SERIES).and_then(|s| s.cards.first()) {
            read_fields(card, layout, id, self.sink);
        }
    }
}

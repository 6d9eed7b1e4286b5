//! A deck put together from named numbers, card by card, by the layouts.

use std::collections::BTreeMap;

use crate::deck::{Deck, DeckCard, Number, Plot};
use crate::layout::{CardId, CardLayout, Repeat, SERIES, SeriesLayout};

/// Named numbers on their way to a deck; a field without a number stays blank.
#[derive(Debug, Default)]
pub(crate) struct DeckBuilder {
    numbers: BTreeMap<String, Number>,
    series: Vec<u8>,
}

impl DeckBuilder {
    /// A builder for the series that every deck has.
    pub(crate) fn new() -> Self {
        Self { numbers: BTreeMap::new(), series: vec![3, 5, 7, 8, 9, 11, 15] }
    }

    /// All numbers and series of a deck, to be changed.
    pub(crate) fn of(deck: &Deck) -> Self {
        let mut builder = Self::default();
        for card in deck.cards() {
            if !builder.series.contains(&card.id.series) {
                builder.series.push(card.id.series);
            }
            for (field, number) in crate::deck::fields_of(card).zip(&card.numbers) {
                builder.numbers.insert(crate::deck::name_of(card, field), number.clone());
            }
        }
        builder
    }

    /// Adds a series that not every deck has.
    pub(crate) fn with_series(&mut self, number: u8) {
        if !self.series.contains(&number) {
            self.series.push(number);
        }
    }

    /// Takes a series out.
    pub(crate) fn without_series(&mut self, number: u8) {
        self.series.retain(|n| *n != number);
    }

    /// Sets a field by the report's name; digits that are no number leave it blank.
    pub(crate) fn set(&mut self, name: &str, digits: &str) {
        let number = Number::from_digits(digits).unwrap_or_else(Number::blank);
        self.numbers.insert(name.to_owned(), number);
    }

    /// Leaves a field blank.
    pub(crate) fn clear(&mut self, name: &str) {
        self.numbers.remove(name);
    }

    /// Whether a field has a number.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.numbers.contains_key(name)
    }

    /// The digits of a field, if it has a number.
    pub(crate) fn digits(&self, name: &str) -> Option<&str> {
        self.numbers.get(name).map(|n| n.digits.as_str())
    }

    /// The deck.
    pub(crate) fn build(self, titles: [String; 2], plot: Plot) -> Deck {
        let wanted = SERIES.iter().filter(|s| self.series.contains(&s.number));
        let cards = wanted.flat_map(|series| self.cards(series)).collect();
        Deck::assemble(titles, cards, plot)
    }

    fn cards(&self, series: &SeriesLayout) -> Vec<DeckCard> {
        let count = match series.number {
            12 => self.count("NVPOS"),
            14 => self.count("NOCRD"),
            _ => 0,
        };
        let numbered = |layout: &CardLayout| match layout.repeat {
            Repeat::Once => vec![None],
            Repeat::Each { count } => (1..=count).map(Some).collect(),
            Repeat::Counted => (1..=count).map(Some).collect(),
        };
        let mut cards = Vec::new();
        for layout in series.cards {
            for number in numbered(layout) {
                let id = CardId { series: series.number, letter: layout.letter, number };
                cards.push(self.card(series, layout, id));
            }
        }
        cards
    }

    fn count(&self, name: &str) -> u32 {
        self.numbers.get(name).map_or(0, |n| n.value as u32)
    }

    fn card(&self, series: &SeriesLayout, layout: &CardLayout, id: CardId) -> DeckCard {
        let is_index = |place: usize| place == 0 && matches!(layout.repeat, Repeat::Each { .. });
        let numbers = layout.fields.iter().enumerate().map(|(place, field)| match (field.variable, id.number) {
            ("NCARD", _) => Number::whole(series.ncard.unwrap_or_default()),
            (_, Some(number)) if is_index(place) => Number::whole(number),
            _ => self.numbers.get(&layout.name_of(field, id.number)).cloned().unwrap_or_else(Number::blank),
        });
        DeckCard { id, line: None, raw: None, numbers: numbers.collect() }
    }
}

//! A deck put together from named numbers, card by card, by the layouts.

use std::collections::BTreeMap;

use crate::cards::{CardId, CardLayout, Repeat, SERIES, SeriesLayout};
use crate::deck::{Deck, DeckCard, Number, Plot};

/// Named numbers on their way to a deck; a field without a number stays blank.
#[derive(Debug, Default)]
pub(super) struct DeckBuilder {
    numbers: BTreeMap<String, Number>,
    series: Vec<u8>,
}

impl DeckBuilder {
    /// A builder for the series that every deck has.
    pub(super) fn new() -> Self {
        Self { numbers: BTreeMap::new(), series: vec![3, 5, 7, 8, 9, 11, 15] }
    }

    /// All numbers and series of a deck, to be changed.
    pub(super) fn of(deck: &Deck) -> Self {
        let mut builder = Self::default();
        for card in deck.cards() {
            builder.with_series(card.id.series);
            builder.numbers.extend(card.named().map(|(name, _, number)| (name, number.clone())));
        }
        builder
    }

    /// Adds a series that not every deck has.
    pub(super) fn with_series(&mut self, number: u8) {
        if !self.series.contains(&number) {
            self.series.push(number);
        }
    }

    /// Takes a series out.
    pub(super) fn without_series(&mut self, number: u8) {
        self.series.retain(|n| *n != number);
    }

    /// Sets a field by the report's name; digits that are no number leave it blank.
    pub(super) fn set(&mut self, name: impl Into<String>, digits: &str) {
        let number = Number::from_digits(digits).unwrap_or_else(Number::blank);
        self.numbers.insert(name.into(), number);
    }

    /// Sets the cards of series 14; without pairs there are none.
    pub(super) fn set_pairs(&mut self, pairs: &[(String, String)]) {
        if pairs.is_empty() {
            return;
        }
        self.with_series(14);
        self.set("NOCRD", &pairs.len().to_string());
        for (n, (sphere, surface)) in (1..).zip(pairs) {
            self.set(format!("J({n})"), sphere);
            self.set(format!("K({n})"), surface);
        }
    }

    /// Leaves a field blank.
    pub(super) fn clear(&mut self, name: &str) {
        self.numbers.remove(name);
    }

    /// Whether a field has a number.
    pub(super) fn has(&self, name: &str) -> bool {
        self.numbers.contains_key(name)
    }

    /// The digits of a field, if it has a number.
    pub(super) fn digits(&self, name: &str) -> Option<&str> {
        self.numbers.get(name).map(|n| n.digits.as_str())
    }

    /// The deck.
    pub(super) fn build(self, titles: [String; 2], plot: Plot) -> Deck {
        let wanted = SERIES.iter().filter(|s| self.series.contains(&s.number));
        let cards = wanted.flat_map(|series| self.cards(series)).collect();
        Deck::assemble(titles, cards, plot)
    }

    fn cards(&self, series: &'static SeriesLayout) -> Vec<DeckCard> {
        let count = match series.number {
            12 => self.count("NVPOS"),
            14 => self.count("NOCRD"),
            _ => 0,
        };
        let numbers = |layout: &CardLayout| match layout.repeat {
            Repeat::Once => vec![None],
            Repeat::Each { count } => (1..=count).map(Some).collect(),
            Repeat::Counted => (1..=count).map(Some).collect(),
        };
        let cards = series.cards.iter().flat_map(|layout| numbers(layout).into_iter().map(move |n| (layout, n)));
        cards.map(|(layout, number)| self.card(series, layout, number)).collect()
    }

    fn count(&self, name: &str) -> u32 {
        self.numbers.get(name).map_or(0, |n| n.value as u32)
    }

    fn card(&self, series: &SeriesLayout, layout: &CardLayout, number: Option<u32>) -> DeckCard {
        let is_index = |place: usize| place == 0 && matches!(layout.repeat, Repeat::Each { .. });
        let fields = layout.fields.iter().enumerate();
        let numbers = fields.map(|(place, field)| match (&*field.variable, number) {
            ("NCARD", _) => Number::whole(series.ncard.unwrap_or_default()),
            (_, Some(number)) if is_index(place) => Number::whole(number),
            _ => self.numbers.get(&layout.name_of(field, number)).cloned().unwrap_or_else(Number::blank),
        });
        let id = CardId { series: series.number, letter: layout.letter, number };
        DeckCard { id, line: None, raw: None, numbers: numbers.collect() }
    }
}

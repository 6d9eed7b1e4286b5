//! One deck: the numbers of one run, by the report's names.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use crate::cards::{CardId, CardLayout, END_OF_NUMBERS, Field, Need, Repeat, is_of_unused, need, series};

/// A number of a card.
#[derive(Debug, Clone, PartialEq)]
pub struct Number {
    /// Number in the card's unit; zero if blank.
    pub value: f64,
    /// Its digits as on the card, in usual notation.
    pub digits: String,
    /// Whether the field is blank: the zero follows from the rule blank-is-zero.
    pub blank: bool,
}

impl Number {
    /// A blank field.
    pub(crate) fn blank() -> Self {
        Self { value: 0.0, digits: "0".into(), blank: true }
    }

    /// Number from its digits; `None` if they are not a finite number.
    pub(crate) fn from_digits(digits: &str) -> Option<Self> {
        let value: f64 = digits.parse().ok()?;
        value.is_finite().then(|| Self { value, digits: digits.to_owned(), blank: false })
    }

    /// A whole number, for counts and switches.
    pub(crate) fn whole(value: u32) -> Self {
        Self { value: f64::from(value), digits: value.to_string(), blank: false }
    }

    /// Placeholder of an unreadable field; such a deck is never returned.
    pub(crate) fn unreadable() -> Self {
        Self { value: f64::NAN, digits: String::new(), blank: false }
    }
}

/// A card of a deck with numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct DeckCard {
    /// Identity.
    pub id: CardId,
    /// Line in the file, if it was read from one.
    pub line: Option<usize>,
    /// Text of the card in the file.
    pub raw: Option<String>,
    /// Its numbers, in the order of the layout's fields.
    pub numbers: Vec<Number>,
}

impl DeckCard {
    /// A card with only its own indices: the card number, the segment or the surface.
    fn blank(id: CardId, layout: &CardLayout) -> Self {
        let mut numbers = vec![Number::blank(); layout.fields.len()];
        if let (Repeat::Each { .. }, Some(index)) = (layout.repeat, id.number) {
            numbers[0] = Number::whole(index);
        }
        let ncard = series(id.series).and_then(|series| series.ncard);
        if let (Some(last), Some(ncard)) = (layout.fields.iter().position(|f| f.variable == "NCARD"), ncard) {
            numbers[last] = Number::whole(ncard);
        }
        Self { id, line: None, raw: None, numbers }
    }

    /// Layout's fields of this card.
    pub(crate) fn fields(&self) -> &'static [Field] {
        self.id.layout().map(|layout| layout.fields.as_slice()).unwrap_or_default()
    }

    /// Its fields and numbers, with their names.
    pub(crate) fn named(&self) -> impl Iterator<Item = (String, &'static Field, &Number)> {
        let layout = self.id.layout();
        let name = move |field: &Field| layout.map(|layout| layout.name_of(field, self.id.number)).unwrap_or_default();
        self.fields().iter().zip(&self.numbers).map(move |(field, number)| (name(field), field, number))
    }
}

/// The plot option of series 16.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Plot {
    /// STAN: the report's 14 plots.
    Standard,
    /// NONE: no plots.
    None,
}

impl Plot {
    /// Option for the word in columns 1–4.
    pub(crate) fn of_word(word: &str) -> Option<Self> {
        match word {
            "STAN" => Some(Self::Standard),
            "NONE" => Some(Self::None),
            _ => None,
        }
    }

    /// Word on the card.
    pub(crate) fn word(self) -> &'static str {
        if self == Self::Standard { "STAN" } else { "NONE" }
    }
}

/// Cards of one run, checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Deck {
    titles: [String; 2],
    cards: Vec<DeckCard>,
    plot: Plot,
    places: HashMap<String, (usize, usize)>,
}

/// A field in which two decks differ.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// Name of the field, or of a title or the plot option.
    pub field: String,
    /// Value in the first deck; `None` if it lacks the field.
    pub left: Option<String>,
    /// Value in the second deck.
    pub right: Option<String>,
}

impl Deck {
    /// Deck of these cards, which are sorted in the report's order.
    pub(crate) fn assemble(titles: [String; 2], cards: Vec<DeckCard>, plot: Plot) -> Self {
        let mut deck = Self { titles, cards, plot, places: HashMap::new() };
        if !deck.has_series(END_OF_NUMBERS) {
            // In lenient reading the card may have been missing.
            deck.add_series(END_OF_NUMBERS, 0);
        }
        deck.sort();
        deck
    }

    fn sort(&mut self) {
        self.cards.sort_by_key(|card| card.id);
        self.places.clear();
        for (at, card) in self.cards.iter().enumerate() {
            for (place, (name, ..)) in card.named().enumerate() {
                self.places.entry(name).or_insert((at, place));
            }
        }
    }

    /// Adds the blank cards of a series; `count` of those that its first card counts.
    pub(crate) fn add_series(&mut self, number: u8, count: u32) {
        for layout in series(number).into_iter().flat_map(|series| &series.cards) {
            let numbers = match layout.repeat {
                Repeat::Once => vec![None],
                Repeat::Each { count } => (1..=count).map(Some).collect(),
                Repeat::Counted => (1..=count).map(Some).collect(),
            };
            let id = |n| CardId { series: number, letter: layout.letter, number: n };
            self.cards.extend(numbers.into_iter().map(|n| DeckCard::blank(id(n), layout)));
        }
        self.sort();
    }

    /// Removes the cards of a series.
    pub(crate) fn remove_series(&mut self, number: u8) {
        self.cards.retain(|card| card.id.series != number);
        self.sort();
    }

    /// Sets a number by the report's name, if its card exists; invalid digits leave it blank.
    pub(crate) fn set(&mut self, name: &str, digits: &str) {
        if let Some((card, place)) = self.places.get(name) {
            self.cards[*card].numbers[*place] = Number::from_digits(digits).unwrap_or_else(Number::blank);
        }
    }

    /// Sets the pairs (sphere, surface) of series 14; without pairs, the series is absent.
    pub(crate) fn set_pairs(&mut self, pairs: &[(String, String)]) {
        self.remove_series(14);
        if pairs.is_empty() {
            return;
        }
        self.add_series(14, u32::try_from(pairs.len()).unwrap_or(u32::MAX));
        self.set("NOCRD", &pairs.len().to_string());
        for (n, (sphere, surface)) in (1..).zip(pairs) {
            self.set(&format!("J({n})"), sphere);
            self.set(&format!("K({n})"), surface);
        }
    }

    /// The two title cards, without trailing blanks.
    pub fn titles(&self) -> &[String; 2] {
        &self.titles
    }

    /// The plot option.
    pub fn plot(&self) -> Plot {
        self.plot
    }

    /// All cards with numbers, in the report's order.
    pub fn cards(&self) -> &[DeckCard] {
        &self.cards
    }

    /// Cards of one series and letter: `cards_of(12, 'b')` are the stations of the path.
    pub fn cards_of(&self, series: u8, letter: char) -> impl Iterator<Item = &DeckCard> {
        self.cards.iter().filter(move |c| c.id.series == series && c.id.letter == Some(letter))
    }

    /// Whether a series is present.
    pub fn has_series(&self, series: u8) -> bool {
        self.cards.iter().any(|c| c.id.series == series)
    }

    /// Number by the report's name, with its index: `TF`, `XLE(3)`, `Q0(17)`, `CALT(5)`. `None` if its card is absent.
    pub fn number(&self, name: &str) -> Option<&Number> {
        let (card, place) = self.places.get(name)?;
        self.cards.get(*card)?.numbers.get(*place)
    }

    /// Value of [`Deck::number`], in the card's unit.
    pub fn value(&self, name: &str) -> Option<f64> {
        self.number(name).map(|n| n.value)
    }

    /// Card of a number, and its field.
    pub fn place_of(&self, name: &str) -> Option<(&DeckCard, &'static Field)> {
        let (card, place) = self.places.get(name)?;
        let card = self.cards.get(*card)?;
        Some((card, card.fields().get(*place)?))
    }

    /// Blank fields read as zero, by name, without those that the report permits to be blank because they have no
    /// effect (the other belt, NARRY).
    pub fn blank_fields(&self) -> Vec<String> {
        let numbers = self.cards.iter().filter(|c| c.id.series != 14).flat_map(DeckCard::named);
        let blank = numbers.filter(|(name, _, number)| number.blank && !self.has_no_effect(name));
        blank.map(|(name, ..)| name).collect()
    }

    /// Whether a field belongs to something that a switch disables.
    pub(crate) fn is_unused(&self, name: &str) -> bool {
        is_of_unused(name, self.value("NOPBLT").unwrap_or(f64::NAN))
    }

    /// Whether a field belongs to something that a switch disables, or is overridden by another.
    pub(crate) fn has_no_effect(&self, name: &str) -> bool {
        self.is_unused(name) || (name.starts_with("SLACK(") && self.value("NPOS") == Some(1.0))
    }

    /// Whether the switches make a series superfluous; the pairs of series 14 are kept in any case.
    pub(crate) fn is_superfluous(&self, series: u8) -> bool {
        series != 14 && need(series, self.value("MREAD"), self.value("NPOS")) == Need::Unused
    }

    /// Fields in which two decks differ: by value, with blanks as zeros. Titles are compared without trailing blanks;
    /// line numbers and notation are ignored.
    pub fn differences(&self, other: &Self) -> Vec<Difference> {
        let (mut left, mut right) = (self.shown(), other.shown());
        let fields: BTreeSet<String> = left.keys().chain(right.keys()).cloned().collect();
        let of_both = |field: String| Difference { left: left.remove(&field), right: right.remove(&field), field };
        fields.into_iter().map(of_both).filter(|difference| difference.left != difference.right).collect()
    }

    /// Values of the deck, by field. The pairs are one entry, because their order is arbitrary.
    fn shown(&self) -> BTreeMap<String, String> {
        let is_pair = |card: &&DeckCard| card.id.series == 14 && card.id.letter == Some('b');
        let named = self.cards.iter().filter(|card| !is_pair(card)).flat_map(DeckCard::named);
        let fields = named.filter(|(name, ..)| name != "NCARD");
        let mut shown: BTreeMap<_, _> = fields.map(|(name, _, n)| (name, format!("{:?}", n.value + 0.0))).collect();
        shown.insert("title card 1".into(), self.titles[0].clone());
        shown.insert("title card 2".into(), self.titles[1].clone());
        shown.insert("plot option".into(), self.plot.word().into());
        let mut pairs = self.passed_pairs();
        pairs.sort_unstable();
        shown.insert("passed pairs".into(), format!("{pairs:?}"));
        shown
    }

    /// The pairs (sphere, surface) of series 14 that have passed the surface's edge, in the order of the cards.
    pub fn passed_pairs(&self) -> Vec<(u8, u8)> {
        let pair = |card: &DeckCard| Some((card.numbers.first()?.value as u8, card.numbers.get(1)?.value as u8));
        self.cards_of(14, 'b').filter_map(pair).collect()
    }
}

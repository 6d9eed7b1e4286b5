//! One deck: the numbers of one run, by the report's names.

use std::collections::HashMap;

use crate::diagnostic::{Diagnostics, Sink};
use crate::layout::{CardId, CardLayout, Field, Repeat, SERIES, TERMINATOR, series};
use crate::reader::read_file;
use crate::rule::Strictness;

/// How a file of decks is read.
#[derive(Debug, Clone, PartialEq)]
pub struct ParseOptions {
    /// Name of the file, for the diagnostics.
    pub file: String,
    /// How strictly it is judged.
    pub strictness: Strictness,
}

impl Default for ParseOptions {
    fn default() -> Self {
        Self { file: "deck".into(), strictness: Strictness::Default }
    }
}

/// A number of a card.
#[derive(Debug, Clone, PartialEq)]
pub struct Number {
    /// The number in the card's unit; zero where nothing is punched.
    pub value: f64,
    /// Its digits as on the card, written as a person writes them.
    pub digits: String,
    /// Nothing is punched: the zero comes from the rule blank-is-zero.
    pub blank: bool,
}

impl Number {
    /// A blank field.
    pub(crate) fn blank() -> Self {
        Self { value: 0.0, digits: "0".into(), blank: true }
    }

    /// A number by its digits; `None` if they are no finite number.
    pub(crate) fn from_digits(digits: &str) -> Option<Self> {
        let value: f64 = digits.parse().ok()?;
        value.is_finite().then(|| Self { value, digits: digits.to_owned(), blank: false })
    }

    /// A whole number, as counts and switches are.
    pub(crate) fn whole(value: u32) -> Self {
        Self { value: f64::from(value), digits: value.to_string(), blank: false }
    }

    /// Stands where a field could not be read; such a deck is never handed out.
    pub(crate) fn unreadable() -> Self {
        Self { value: f64::NAN, digits: String::new(), blank: false }
    }
}

/// One card of a deck that carries numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct DeckCard {
    /// Which card it is.
    pub id: CardId,
    /// Line in the file, if it was read from one.
    pub line: Option<usize>,
    /// The card as it stood in the file.
    pub raw: Option<String>,
    /// Its numbers, in the order of the layout's fields.
    pub numbers: Vec<Number>,
}

/// The plot option of series 16.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Plot {
    /// STAN: the report's 14 plots.
    Standard,
    /// NONE: no plots.
    None,
}

/// The cards of one run, checked.
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
    /// What the one deck says; `None` where it lacks the field.
    pub left: Option<String>,
    /// What the other says.
    pub right: Option<String>,
}

impl Deck {
    /// Reads a file of decks. Every problem of the file is in the diagnostics; a deck with an error is not handed out.
    ///
    /// The bytes are Latin-1; nothing that they hold makes this panic.
    pub fn parse(bytes: impl AsRef<[u8]>, options: &ParseOptions) -> (Vec<Self>, Diagnostics) {
        let mut sink = Sink::new(&options.file, options.strictness);
        let decks = read_file(bytes.as_ref(), &mut sink);
        (decks, sink.into_diagnostics())
    }

    /// Puts a deck together; the cards come in the report's order afterwards.
    pub(crate) fn assemble(titles: [String; 2], mut cards: Vec<DeckCard>, plot: Plot) -> Self {
        let terminator = SERIES.iter().find(|s| s.ncard == Some(TERMINATOR));
        if let Some(series) = terminator.filter(|s| cards.iter().all(|c| c.id.series != s.number)) {
            // In lenient reading the card may have been missing.
            let numbers = vec![Number::whole(TERMINATOR)];
            cards.push(DeckCard { id: CardId::first_of(series), line: None, raw: None, numbers });
        }
        cards.sort_by_key(|card| card.id);
        let mut places = HashMap::new();
        for (at, card) in cards.iter().enumerate() {
            for (place, field) in fields_of(card).enumerate() {
                places.entry(name_of(card, field)).or_insert((at, place));
            }
        }
        Self { titles, cards, plot, places }
    }

    /// The two title cards, without trailing blanks.
    pub fn titles(&self) -> &[String; 2] {
        &self.titles
    }

    /// The plot option.
    pub fn plot(&self) -> Plot {
        self.plot
    }

    /// All cards that carry numbers, in the report's order.
    pub fn cards(&self) -> &[DeckCard] {
        &self.cards
    }

    /// The cards of one series and letter: `cards_of(12, 'b')` are the stations of the path.
    pub fn cards_of(&self, series: u8, letter: char) -> impl Iterator<Item = &DeckCard> {
        self.cards.iter().filter(move |c| c.id.series == series && c.id.letter == Some(letter))
    }

    /// Whether a series is there.
    pub fn has_series(&self, series: u8) -> bool {
        self.cards.iter().any(|c| c.id.series == series)
    }

    /// A number by the report's name, index included: `TF`, `XLE(3)`, `Q0(17)`, `CALT(5)`. `None` where its card is absent.
    pub fn number(&self, name: &str) -> Option<&Number> {
        let (card, place) = self.places.get(name)?;
        self.cards.get(*card)?.numbers.get(*place)
    }

    /// The value of [`Deck::number`], in the card's unit.
    pub fn value(&self, name: &str) -> Option<f64> {
        self.number(name).map(|n| n.value)
    }

    /// The card on which a number stands, and its field.
    pub fn place_of(&self, name: &str) -> Option<(&DeckCard, &'static Field)> {
        let (card, place) = self.places.get(name)?;
        let card = self.cards.get(*card)?;
        Some((card, layout_of(card)?.fields.get(*place)?))
    }

    /// The fields that are blank and were read as zero, by name. Fields that the report allows to be blank because
    /// they have no effect (the other belt, NARRY) are left out.
    pub fn blank_fields(&self) -> Vec<String> {
        let mut names = Vec::new();
        for card in self.cards.iter().filter(|c| c.id.series != 14) {
            for (field, number) in fields_of(card).zip(&card.numbers) {
                let name = name_of(card, field);
                if number.blank && !self.has_no_effect(&name) {
                    names.push(name);
                }
            }
        }
        names
    }

    /// Whether a field belongs to a belt that is not in use, or gives way to another one.
    pub(crate) fn has_no_effect(&self, name: &str) -> bool {
        let belts = self.value("NOPBLT").unwrap_or(0.0);
        let lap = belts == 1.0 || belts == 3.0;
        let torso = belts == 2.0 || belts == 3.0;
        let exact = self.value("NPOS") == Some(1.0);
        let of_lap = ["P1(1,", "P2(1,", "SK1(1)", "SK2(1)", "DELC(1)", "SLACK(1)", "BLTLEO(1)"];
        let of_torso = ["P1(2,", "P2(2,", "SK1(2)", "SK2(2)", "DELC(2)", "SLACK(2)", "BLTLEO(2)"];
        (!lap && of_lap.iter().any(|p| name.starts_with(p)))
            || (!torso && of_torso.iter().any(|p| name.starts_with(p)))
            || (exact && name.starts_with("SLACK("))
    }

    /// The fields in which two decks differ: by value, a blank counting as the zero that it means.
    /// Titles are compared without trailing blanks; lines and digits do not count.
    pub fn differences(&self, other: &Self) -> Vec<Difference> {
        let mut differences = Vec::new();
        let mut compare = |field: String, left: Option<String>, right: Option<String>| {
            if left != right {
                differences.push(Difference { field, left, right });
            }
        };
        for (at, (left, right)) in self.titles.iter().zip(&other.titles).enumerate() {
            compare(format!("title card {}", at + 1), Some(left.clone()), Some(right.clone()));
        }
        compare("plot option".into(), Some(format!("{:?}", self.plot)), Some(format!("{:?}", other.plot)));
        for name in self.names_with(other) {
            let shown = |deck: &Self| deck.number(&name).map(|n| format!("{:?}", n.value + 0.0));
            compare(name.clone(), shown(self), shown(other));
        }
        let pairs = |deck: &Self| format!("{:?}", deck.passed_pairs());
        compare("passed pairs".into(), Some(pairs(self)), Some(pairs(other)));
        differences
    }

    /// The pairs (sphere, surface) of series 14 that have passed the surface's edge.
    pub fn passed_pairs(&self) -> Vec<(u8, u8)> {
        let pair = |card: &DeckCard| Some((card.numbers.first()?.value as u8, card.numbers.get(1)?.value as u8));
        let mut pairs: Vec<_> = self.cards_of(14, 'b').filter_map(pair).collect();
        pairs.sort_unstable();
        pairs
    }

    /// The names of all fields of both decks, those of the pairs left out: their order is free.
    fn names_with(&self, other: &Self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for card in self.cards.iter().chain(&other.cards).filter(|c| !(c.id.series == 14 && c.id.letter == Some('b'))) {
            names.extend(fields_of(card).map(|field| name_of(card, field)).filter(|n| n != "NCARD"));
        }
        names.sort_unstable();
        names.dedup();
        names
    }
}

/// The layout of a deck's card.
pub(crate) fn layout_of(card: &DeckCard) -> Option<&'static CardLayout> {
    series(card.id.series)?.cards.iter().find(|c| c.letter == card.id.letter)
}

/// The fields of a deck's card.
pub(crate) fn fields_of(card: &DeckCard) -> impl Iterator<Item = &'static Field> + use<> {
    layout_of(card).map(|layout| layout.fields).unwrap_or_default().iter()
}

/// The full name of a field on a deck's card.
pub(crate) fn name_of(card: &DeckCard, field: &Field) -> String {
    let number = card.id.number.filter(|_| layout_of(card).is_some_and(|l| l.repeat != Repeat::Once));
    layout_of(card).map_or_else(|| field.variable.to_owned(), |layout| layout.name_of(field, number))
}

//! Whether the numbers of a deck can be a body in a car: the table's bounds, then sums, contradictions, units.
//!
//! A field that could not be read is NaN here, and every check asks for the violation (`a > b`), so that an unreadable number
//! is reported once and not again. A check changes no number.

mod belts;
mod body;
mod compartment;
mod path;
mod start;
mod times;

use std::fmt::Display;

use crate::deck::Deck;
use crate::diagnostics::{Diagnostic, LISTED, Sink};
use crate::rule::Rule;

/// Checks all numbers of a deck, and counts its blanks.
pub(crate) fn check_deck(deck: &Deck, first_line: usize, sink: &mut Sink) {
    let mut check = Check { deck, sink };
    check.bounds();
    times::check(&mut check);
    body::check(&mut check);
    compartment::check(&mut check);
    start::check(&mut check);
    path::check(&mut check);
    check.count_blanks(first_line);
}

/// A deck under examination.
struct Check<'a> {
    deck: &'a Deck,
    sink: &'a mut Sink,
}

/// A problem, if any, whose expectation and remedy are still to be set.
#[must_use = "without `expected` nothing is reported"]
struct Pending<'a> {
    sink: &'a mut Sink,
    problem: Option<Diagnostic>,
}

impl Pending<'_> {
    fn expected(self, expected: &str, remedy: &str) {
        if let Some(problem) = self.problem {
            problem.expected(expected).remedy(remedy).report(self.sink);
        }
    }
}

impl Check<'_> {
    /// A value by the report's name; NaN where it is absent or unreadable.
    fn value(&self, name: impl AsRef<str>) -> f64 {
        self.deck.value(name.as_ref()).unwrap_or(f64::NAN)
    }

    /// The digits of a number, for messages.
    fn digits(&self, name: impl AsRef<str>) -> &str {
        self.deck.number(name.as_ref()).map_or("", |n| n.digits.as_str())
    }

    /// A problem of one number.
    fn problem(&mut self, rule: Rule, name: impl AsRef<str>, message: impl Into<String>) -> Pending<'_> {
        let problem = Diagnostic::new(rule, message).variable(name.as_ref());
        let problem = match self.deck.place_of(name.as_ref()) {
            Some((card, field)) => problem.on_card_of_deck(card).at(field.columns),
            None => problem,
        };
        Pending { sink: self.sink, problem: Some(problem) }
    }

    /// A problem of one number if `violated`; the message says the number first.
    fn wrong_if(&mut self, violated: bool, rule: Rule, name: impl AsRef<str>, message: impl Display) -> Pending<'_> {
        if !violated {
            return Pending { sink: self.sink, problem: None };
        }
        let message = format!("{} = {}: {message}", name.as_ref(), self.digits(&name));
        self.problem(rule, name, message)
    }

    /// The bounds of the table, for all numbers that have an effect.
    fn bounds(&mut self) {
        let cards = self.deck.cards().iter().filter(|card| !self.deck.is_superfluous(card.id.series));
        for (name, field, number) in cards.flat_map(|card| card.named()) {
            if !field.bounds.is_empty() && !self.deck.is_unused(&name) {
                for bound in field.bounds.iter().filter(|bound| (bound.violated)(number.value)) {
                    self.wrong_if(!number.value.is_nan(), bound.rule, &name, &bound.message)
                        .expected(&bound.expected, bound.remedy);
                }
            }
        }
    }

    fn count_blanks(&mut self, first_line: usize) {
        let blanks = self.deck.blank_fields();
        if blanks.is_empty() {
            return;
        }
        let more = if blanks.len() > LISTED { format!(" and {} more", blanks.len() - LISTED) } else { String::new() };
        let listed: Vec<_> = blanks.iter().take(LISTED).map(String::as_str).collect();
        let message = format!("{} blank fields were read as zero: {}{more}", blanks.len(), listed.join(", "));
        Diagnostic::new(Rule::BlankIsZero, message).at_line(first_line).report(self.sink);
    }
}

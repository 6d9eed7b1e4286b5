//! Whether the numbers of a deck can be a body in a car: ranges, sums, contradictions, units.
//!
//! A field that could not be read is NaN here, and every check asks for the violation (`value <= 0.0`), so that an
//! unreadable number is reported once and not again.

mod belts;
mod body;
mod compartment;
mod joints;
mod path;
mod seating;
mod state;
mod surfaces;
mod times;

use crate::deck::Deck;
use crate::diagnostic::{Finding, Sink};
use crate::rule::Rule;

/// How many names a message lists.
const LISTED: usize = 24;

/// Checks all numbers of a deck, and counts its blanks.
pub(crate) fn check_deck(deck: &Deck, first_line: usize, sink: &mut Sink) {
    let mut check = Check { deck, sink, first_line };
    times::check(&mut check);
    body::check(&mut check);
    compartment::check(&mut check);
    surfaces::check(&mut check);
    joints::check(&mut check);
    belts::check(&mut check);
    if check.value("NPOS") == 1.0 {
        state::check(&mut check);
    } else {
        seating::check(&mut check);
    }
    path::check(&mut check);
    state::check_pairs(&mut check);
    check.count_blanks();
}

/// A deck under examination.
struct Check<'a> {
    deck: &'a Deck,
    sink: &'a mut Sink,
    first_line: usize,
}

/// What is said about a number.
struct Complaint<'a> {
    rule: Rule,
    message: String,
    expected: &'a str,
    remedy: &'a str,
}

impl Check<'_> {
    /// A value by the report's name; NaN where it is absent or unreadable.
    fn value(&self, name: &str) -> f64 {
        self.deck.value(name).unwrap_or(f64::NAN)
    }

    /// The digits of a number, for messages.
    fn digits(&self, name: &str) -> &str {
        self.deck.number(name).map_or("", |n| n.digits.as_str())
    }

    /// Complains about one number.
    fn complain(&mut self, name: &str, complaint: Complaint<'_>) {
        let mut finding = Finding::new(complaint.rule, complaint.message)
            .variable(name)
            .expected(complaint.expected)
            .remedy(complaint.remedy);
        if let Some((card, field)) = self.deck.place_of(name) {
            finding = finding.in_card(card.id).at(field.columns);
            if let Some(line) = card.line {
                finding = finding.at_line(line);
            }
            if let Some(raw) = &card.raw {
                finding = finding.raw(raw.clone());
            }
        }
        self.sink.report(finding);
    }

    fn complain_if(&mut self, violated: bool, rule: Rule, name: &str, message: &str, expected: &str, remedy: &str) {
        if violated {
            let message = format!("{name} = {}: {message}", self.digits(name));
            self.complain(name, Complaint { rule, message, expected, remedy });
        }
    }

    /// The number must be above zero.
    fn positive(&mut self, name: &str, what: &str) {
        let violated = self.value(name) <= 0.0;
        self.complain_if(violated, Rule::Impossible, name, what, "a number above 0", "punch the number");
    }

    /// The number must not be below zero.
    fn not_negative(&mut self, name: &str, what: &str) {
        let violated = self.value(name) < 0.0;
        self.complain_if(violated, Rule::Impossible, name, what, "0 or more", "look for a wrong sign");
    }

    /// Angles due in radians that look like degrees.
    fn radians(&mut self, names: &[&str]) {
        for name in names {
            let violated = self.value(name).abs() > std::f64::consts::TAU;
            let remedy = "divide by 57.2958 if it is in degrees";
            self.complain_if(
                violated,
                Rule::LooksLikeOtherUnit,
                name,
                "more than a full turn",
                "an angle in radians",
                remedy,
            );
        }
    }

    fn count_blanks(&mut self) {
        let blanks = self.deck.blank_fields();
        if blanks.is_empty() {
            return;
        }
        let more = if blanks.len() > LISTED { format!(" and {} more", blanks.len() - LISTED) } else { String::new() };
        let listed: Vec<_> = blanks.iter().take(LISTED).map(String::as_str).collect();
        let message = format!("{} blank fields were read as zero: {}{more}", blanks.len(), listed.join(", "));
        self.sink.report(Finding::new(Rule::BlankIsZero, message).at_line(self.first_line));
    }
}

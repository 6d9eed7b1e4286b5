//! The cards that extend a run that has ended: series 6 and 14, as the original procedure has it.

use super::digits::{digits, factor};
use super::motion::RunEnd;
use super::unit_of;
use crate::check::check_deck;
use crate::deck::{Deck, DeckCard};
use crate::diagnostics::{Diagnostics, Sink};
use crate::rule::Strictness;

impl Deck {
    /// Deck that extends the run of this one from its end to `final_s`: NPOS = 1, series 6 and 14 in place of seating.
    ///
    /// # Errors
    /// Problems of the resulting deck, such as a final time beyond the last station of the path.
    pub fn extended(&self, end: &RunEnd, final_s: f64) -> Result<Deck, Diagnostics> {
        let cards = self.cards().iter().filter(|card| ![4, 10].contains(&card.id.series));
        let cards = cards.map(|card| DeckCard { line: None, raw: None, ..card.clone() });
        let mut deck = Deck::assemble(self.titles().clone(), cards.collect(), self.plot());
        if !deck.has_series(6) {
            deck.add_series(6, 0);
        }
        for (name, time_s) in [("T1", end.time_s), ("TF", final_s)] {
            deck.set(name, &digits(time_s, unit_of(name)).0);
        }
        deck.set("NPOS", "1");
        for (name, si) in end.fields() {
            deck.set(&name, &rounded(&name, si));
        }
        deck.set("SLACK(1)", "");
        deck.set("SLACK(2)", "");
        let pairs: Vec<_> = end.passed.iter().map(|(j, k)| (j.to_string(), k.to_string())).collect();
        deck.set_pairs(&pairs);
        let mut sink = Sink::new("the deck that extends the run", Strictness::Default);
        check_deck(&deck, 1, &mut sink);
        let found = sink.into_diagnostics();
        if found.has_errors() { Err(found) } else { Ok(deck) }
    }
}

/// Number of a state as on cards: six decimals, or fewer if they would leave no blank before the next field.
fn rounded(name: &str, si: f64) -> String {
    let value = si / factor(unit_of(name));
    let texts = (0..=DECIMALS).rev().map(|decimals| format!("{value:.decimals$}"));
    let fitting = texts.into_iter().find(|text| text.len() <= STATE_WIDTH).unwrap_or_else(|| format!("{value:e}"));
    if !fitting.contains('.') {
        return fitting;
    }
    fitting.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Decimals of a state on cards.
const DECIMALS: usize = 6;
/// Columns of a number of a state; the tenth stays blank.
const STATE_WIDTH: usize = 9;

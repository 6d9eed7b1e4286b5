//! The cards of a scenario that fits on them: each number with the digits of its card, for a check of the punching.

use crate::Deck;

use crate::print::{Case, Pages};

/// Writes the cards, if there are any.
pub(crate) fn write(pages: &mut Pages, case: &Case) {
    let Ok(cards) = Deck::from_scenario(&case.loaded, None) else {
        return;
    };
    pages.begin("INPUT: CARDS");
    pages.say("SERIES 1 TO 16 IN ORDER, NUMBERS AS THEY WERE READ AT THE RIGHT END OF THEIR FIELDS, BLANKS THAT MEAN ZERO AS 0.");
    cards.remarks.iter().for_each(|remark| pages.say(remark));
    pages.say("");
    pages.say(&(1..=8).map(|ten| format!("{ten:>10}")).collect::<String>());
    pages.say(&"1234567890".repeat(8));
    cards.deck.write().lines().for_each(|card| pages.say(card));
}

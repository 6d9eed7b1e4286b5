//! Surfaces of series 9 that no scenario gets: those without area and those that resist nothing.

use crate::compartment::CompartmentLayout;
use crate::deck::Deck;

/// A surface of a deck that a conversion leaves out.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LeftOut {
    /// Number in series 9.
    pub number: u32,
    /// Name in scenarios.
    pub name: String,
    /// Why, as the predicate of a sentence about it.
    pub why: &'static str,
}

/// All surfaces of a deck that a conversion leaves out, by number. A number that could not be read leaves none out.
pub(crate) fn left_out(deck: &Deck, layout: &CompartmentLayout) -> Vec<LeftOut> {
    let faces = layout.faces(deck);
    let mut left_out: Vec<_> = faces
        .into_iter()
        .filter_map(|face| {
            let why = if face.corners.is_empty() { "has no area" } else { without_resistance(deck, face.number)? };
            Some(LeftOut { number: face.number, name: face.name, why })
        })
        .collect();
    let wheel = &layout.wheel;
    let why = if deck.value("DSW").is_some_and(|diameter| diameter <= 0.0) {
        Some("has no diameter")
    } else {
        without_resistance(deck, wheel.number)
    };
    left_out.extend(why.map(|why| LeftOut { number: wheel.number, name: wheel.name.clone(), why }));
    left_out
}

fn without_resistance(deck: &Deck, number: u32) -> Option<&'static str> {
    let resists_nothing = deck.value(&format!("STIF1({number})")) == Some(0.0);
    resists_nothing.then_some("resists nothing (STIF1 = 0)")
}

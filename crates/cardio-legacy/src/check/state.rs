//! The exact initial state (series 6), and the pairs of an extension (series 14).

use std::f64::consts::PI;

use super::{Check, Complaint};
use crate::compartment::CompartmentLayout;
use crate::deck::DeckCard;
use crate::left_out::{LeftOut, left_out};
use crate::rule::Rule;

pub(super) fn check(check: &mut Check<'_>) {
    for name in ["BETA4", "BETA7"] {
        let value = check.value(name);
        let violated = !(0.0..=PI).contains(&value) && !value.is_nan();
        check.complain_if(
            violated,
            Rule::Impossible,
            name,
            "an angle between two axes",
            "0 to π, in radians",
            "divide degrees by 57.2958",
        );
    }
    for coordinate in 4..=31 {
        let name = format!("Q0({coordinate})");
        check.radians(&[&name]);
    }
    let used = check.value("NOPBLT");
    for (belt, name, in_use) in [(1, "lap", used == 1.0 || used == 3.0), (2, "torso", used == 2.0 || used == 3.0)] {
        if in_use {
            check_belt_length(check, belt, name);
        }
    }
}

fn check_belt_length(check: &mut Check<'_>, belt: u32, name: &str) {
    let (length, slack) = (format!("BLTLEO({belt})"), format!("SLACK({belt})"));
    let missing = check.value(&length) <= 0.0;
    let message = format!("the {name} belt is in use and has no initial length");
    let remedy = "punch the length, or switch the belt off by NOPBLT";
    check.complain_if(missing, Rule::Impossible, &length, &message, "a length in inches, if NPOS = 1", remedy);
    let value = check.value(&slack);
    if value != 0.0 && !value.is_nan() {
        let message = format!("{slack} has no effect: with NPOS = 1 the length of the {name} belt is {length}");
        let complaint = Complaint {
            rule: Rule::Ignored,
            message,
            expected: "blank",
            remedy: "add the slack to the length if it is not in it",
        };
        check.complain(&slack, complaint);
    }
}

/// The pairs of series 14: spheres 1–17, surfaces 1–25 that are there, each pair once, NARRY zero.
pub(super) fn check_pairs(check: &mut Check<'_>) {
    check_surfaces_of_pairs(check);
    let pairs: Vec<_> = check
        .deck
        .cards_of(14, 'b')
        .filter_map(|c| Some((c.id.number?, c.numbers.first()?.value, c.numbers.get(1)?.value)))
        .collect();
    for (at, (card, sphere, surface)) in pairs.iter().enumerate() {
        for (variable, value, count) in [("J", *sphere, 17.0), ("K", *surface, 25.0)] {
            let name = format!("{variable}({card})");
            let violated = !(1.0..=count).contains(&value) && !value.is_nan();
            let expected = format!("1 to {count}, right-justified");
            check.complain_if(
                violated,
                Rule::BadIndex,
                &name,
                "no such number",
                &expected,
                "copy it from the last sheet of the earlier run",
            );
        }
        if pairs[..at].iter().any(|(_, j, k)| j == sphere && k == surface) {
            let message = format!("the pair of sphere {sphere} and surface {surface} comes twice");
            let complaint = Complaint {
                rule: Rule::IndexTwice,
                message,
                expected: "each pair once",
                remedy: "remove one of the cards and correct NOCRD",
            };
            check.complain(&format!("J({card})"), complaint);
        }
        let name = format!("NARRY({card})");
        let value = check.value(&name);
        let violated = value != 0.0 && !value.is_nan();
        check.complain_if(
            violated,
            Rule::Impossible,
            &name,
            "only pairs with NARRY = 0 are listed",
            "0. or blank",
            "leave the pair out",
        );
    }
}

/// With NPOS = 1, a pair whose surface is left out of the scenario changes nothing: the sphere cannot touch it anyway.
fn check_surfaces_of_pairs(check: &mut Check<'_>) {
    let Ok(layout) = CompartmentLayout::reconstruction() else {
        return;
    };
    if check.value("NPOS") != 1.0 || !check.deck.has_series(14) {
        return;
    }
    let missing = left_out(check.deck, &layout);
    let surface_of = |card: &DeckCard| Some((card.id.number?, card.numbers.get(1)?.value));
    let pairs: Vec<_> = check.deck.cards_of(14, 'b').filter_map(surface_of).collect();
    for (card, surface) in pairs {
        let unused = missing.iter().find(|l| f64::from(l.number) == surface);
        if let Some(LeftOut { number, name, why }) = unused {
            let complaint = Complaint {
                rule: Rule::PassedPairUnused,
                message: format!("the pair has no effect: surface {number}, {name}, {why} and is left out"),
                expected: "a surface that a sphere can touch",
                remedy: "remove the pair and correct NOCRD, or give the surface its area and stiffness",
            };
            check.complain(&format!("K({card})"), complaint);
        }
    }
}

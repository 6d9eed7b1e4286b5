//! The start of the occupant (series 10 or 6), what holds it (13) and the pairs of an extension (14).

use std::f64::consts::PI;

use super::{Check, belts};
use crate::cards::POSTURE;
use crate::compartment::CompartmentLayout;
use crate::rule::Rule;

pub(super) fn check(c: &mut Check<'_>) {
    belts::check(c);
    if c.value("NPOS") == 1.0 {
        check_surfaces_of_pairs(c);
    } else {
        check_posture(c);
        check_heels(c);
    }
    check_pairs(c);
}

fn check_posture(c: &mut Check<'_>) {
    let largest = POSTURE.map(|name| c.value(name).abs()).into_iter().fold(0.0, f64::max);
    if largest > 0.0 && largest < PI {
        let message = format!("no angle of the posture is larger than {largest}; they look like radians");
        c.problem(Rule::LooksLikeOtherUnit, "GAMA1", message)
            .expected("angles in degrees", "multiply radians by 57.2958");
    }
}

fn check_heels(c: &mut Check<'_>) {
    for (name, points) in [("XHPV", "XV"), ("ZHPV", "ZV")] {
        let all = (1..=22).map(|n| c.value(format!("{points}({n})")));
        let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (v.min(low), v.max(high)));
        let own = c.value(name);
        c.wrong_if(own < low || own > high, Rule::Unlikely, name, "the heels lie outside the compartment")
            .expected("within the points of series 8", "vehicle axes: X forward, Z down, from the centre of gravity");
    }
}

/// Checks that each pair of series 14 is listed once.
fn check_pairs(c: &mut Check<'_>) {
    let pairs: Vec<_> = pairs(c).collect();
    for (at, (card, sphere, surface)) in pairs.iter().enumerate() {
        if pairs[..at].iter().any(|(_, j, k)| j == sphere && k == surface) {
            let message = format!("the pair of sphere {sphere} and surface {surface} comes twice");
            c.problem(Rule::IndexTwice, format!("J({card})"), message)
                .expected("each pair once", "remove one of the cards and correct NOCRD");
        }
    }
}

/// Pairs of series 14: index of the card, sphere, surface.
fn pairs(c: &Check<'_>) -> impl Iterator<Item = (u32, f64, f64)> {
    let cards = c.deck.cards_of(14, 'b');
    cards.filter_map(|c| Some((c.id.number?, c.numbers.first()?.value, c.numbers.get(1)?.value)))
}

/// Pairs whose surface is omitted from the scenario have no effect: the sphere cannot touch it anyway.
fn check_surfaces_of_pairs(c: &mut Check<'_>) {
    let Ok(layout) = CompartmentLayout::reconstruction() else { return };
    let missing = layout.left_out(c.deck);
    let pairs: Vec<_> = pairs(c).collect();
    for (card, _, surface) in pairs {
        let Some(left_out) = missing.iter().find(|l| f64::from(l.number) == surface) else { continue };
        let (number, name, why) = (left_out.number, &left_out.name, left_out.why);
        let message = format!("the pair has no effect: surface {number}, {name}, {why} and is left out");
        let remedy = "remove the pair and correct NOCRD, or give the surface its area and stiffness";
        c.problem(Rule::PassedPairUnused, format!("K({card})"), message)
            .expected("a surface that a sphere can touch", remedy);
    }
}

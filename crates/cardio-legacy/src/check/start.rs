//! The start of the occupant (series 10 or 6), the belts that hold it (13) and the pairs of an extension (14).

use std::f64::consts::PI;

use super::Check;
use crate::cards::{BELTS, POSTURE};
use crate::compartment::CompartmentLayout;
use crate::rule::Rule;

pub(super) fn check(c: &mut Check<'_>) {
    if c.deck.has_series(13) {
        for (belt, name, _) in BELTS {
            if c.deck.uses_belt(belt) {
                check_belt(c, belt, name);
            } else {
                note_ignored(c, belt, name);
            }
        }
    }
    if c.value("NPOS") == 1.0 {
        BELTS.into_iter().for_each(|(belt, name, _)| note_slack(c, belt, name));
        check_surfaces_of_pairs(c);
    } else {
        check_posture(c);
        check_heels(c);
    }
    check_pairs(c);
}

fn check_belt(c: &mut Check<'_>, belt: u32, name: &str) {
    let ends = [1, 2].map(|end| (end, [1, 2, 3].map(|axis| c.value(format!("P{end}({belt},{axis})")))));
    if ends[0].1 == ends[1].1 {
        let message = format!("both anchors of the {name} belt lie at the same point");
        c.problem(Rule::Impossible, format!("P1({belt},1)"), message)
            .expected("two points", "punch both anchors in vehicle axes");
    }
    let width = c.value("VCW");
    for (end, point) in ends {
        let outside = point[1].abs() > 1.2 * width;
        c.wrong_if(outside, Rule::Unlikely, format!("P{end}({belt},2)"), "the anchor lies outside the car")
            .expected("within ±VCW", "Y counts from the vehicle's centre line, to the right");
    }
}

/// Numbers of a belt that is not in use.
fn note_ignored(c: &mut Check<'_>, belt: u32, name: &str) {
    let mut names: Vec<String> = ["SLACK", "SK1", "SK2", "DELC"].map(|n| format!("{n}({belt})")).to_vec();
    names.extend((1..=3).flat_map(|axis| [format!("P1({belt},{axis})"), format!("P2({belt},{axis})")]));
    let punched = names.into_iter().find(|n| c.value(n) != 0.0 && !c.value(n).is_nan());
    if let Some(first) = punched {
        let used = c.digits("NOPBLT");
        let message = format!("the {name} belt is not in use (NOPBLT = {used}); its numbers have no effect");
        c.problem(Rule::Ignored, first, message).expected("blanks", "leave them blank, or change NOPBLT");
    }
}

fn note_slack(c: &mut Check<'_>, belt: u32, name: &str) {
    let slack = format!("SLACK({belt})");
    let value = c.value(&slack);
    if c.deck.uses_belt(belt) && value != 0.0 && !value.is_nan() {
        let message = format!("{slack} has no effect: with NPOS = 1 the length of the {name} belt is BLTLEO({belt})");
        c.problem(Rule::Ignored, slack, message).expected("blank", "add the slack to the length if it is not in it");
    }
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

/// Each pair of series 14 once.
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

/// The pairs of series 14: number of the card, sphere, surface.
fn pairs(c: &Check<'_>) -> impl Iterator<Item = (u32, f64, f64)> {
    let cards = c.deck.cards_of(14, 'b');
    cards.filter_map(|c| Some((c.id.number?, c.numbers.first()?.value, c.numbers.get(1)?.value)))
}

/// A pair whose surface is left out of the scenario changes nothing: the sphere cannot touch it anyway.
fn check_surfaces_of_pairs(c: &mut Check<'_>) {
    let Ok(layout) = CompartmentLayout::reconstruction() else {
        return;
    };
    let missing = layout.left_out(c.deck);
    let pairs: Vec<_> = pairs(c).collect();
    for (card, _, surface) in pairs {
        let Some(left_out) = missing.iter().find(|l| f64::from(l.number) == surface) else {
            continue;
        };
        let (number, name, why) = (left_out.number, &left_out.name, left_out.why);
        let message = format!("the pair has no effect: surface {number}, {name}, {why} and is left out");
        let remedy = "remove the pair and correct NOCRD, or give the surface its area and stiffness";
        c.problem(Rule::PassedPairUnused, format!("K({card})"), message)
            .expected("a surface that a sphere can touch", remedy);
    }
}

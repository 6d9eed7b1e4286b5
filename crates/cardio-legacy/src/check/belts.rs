//! Lap and torso belt (series 13): anchors, and numbers that have no effect.

use super::Check;
use crate::cards::{BELTS, uses};
use crate::rule::Rule;

pub(super) fn check(c: &mut Check<'_>) {
    if !c.deck.has_series(13) {
        return;
    }
    let nopblt = c.value("NOPBLT");
    for (belt, name, _) in BELTS {
        if uses(nopblt, belt) { check_anchors(c, belt, name) } else { check_unused(c, belt, name) }
    }
    for (belt, name, _) in BELTS.into_iter().filter(|(belt, ..)| uses(nopblt, *belt)) {
        let slack = format!("SLACK({belt})");
        if c.value("NPOS") == 1.0 && is_punched(c, &slack) {
            let length = format!("with NPOS = 1 the length of the {name} belt is BLTLEO({belt})");
            c.problem(Rule::Ignored, &slack, format!("{slack} has no effect: {length}"))
                .expected("blank", "add the slack to the length if it is not in it");
        }
    }
}

fn check_anchors(c: &mut Check<'_>, belt: u32, name: &str) {
    let slack_for_ever = [1, 2].iter().all(|slope| c.value(format!("SK{slope}({belt})")) == 0.0);
    c.wrong_if(slack_for_ever, Rule::Impossible, format!("SK1({belt})"), format!("the {name} belt never pulls"))
        .expected("SK1 or SK2 above 0", "punch the stiffness, or leave the belt out by NOPBLT");
    let [one, two] = [1, 2].map(|end| [1, 2, 3].map(|axis| c.value(format!("P{end}({belt},{axis})"))));
    if one == two {
        let message = format!("both anchors of the {name} belt lie at the same point");
        c.problem(Rule::Impossible, format!("P1({belt},1)"), message)
            .expected("two points", "punch both anchors in vehicle axes");
    }
    let width = c.value("VCW");
    for (end, [_, y, _]) in [(1, one), (2, two)] {
        let outside = y.abs() > 1.2 * width;
        c.wrong_if(outside, Rule::Unlikely, format!("P{end}({belt},2)"), "the anchor lies outside the car")
            .expected("within ±VCW", "Y counts from the vehicle's centre line, to the right");
    }
}

/// Numbers of a belt that is not in use.
fn check_unused(c: &mut Check<'_>, belt: u32, name: &str) {
    let mut names: Vec<String> = ["SLACK", "SK1", "SK2", "DELC"].map(|n| format!("{n}({belt})")).to_vec();
    names.extend((1..=3).flat_map(|axis| [format!("P1({belt},{axis})"), format!("P2({belt},{axis})")]));
    if let Some(punched) = names.iter().find(|name| is_punched(c, name)) {
        let used = c.digits("NOPBLT");
        let message = format!("the {name} belt is not in use (NOPBLT = {used}); its numbers have no effect");
        c.problem(Rule::Ignored, punched, message).expected("blanks", "leave them blank, or change NOPBLT");
    }
}

/// Whether a field holds a number other than zero.
fn is_punched(c: &Check<'_>, name: &str) -> bool {
    let value = c.value(name);
    value != 0.0 && !value.is_nan()
}

//! Belts (series 13).

use super::{Check, Complaint};
use crate::rule::Rule;

pub(super) fn check(check: &mut Check<'_>) {
    if !check.deck.has_series(13) {
        return;
    }
    let used = check.value("NOPBLT");
    let known = used == 1.0 || used == 2.0 || used == 3.0 || used.is_nan();
    let remedy = "punch it with its decimal point, or leave the series out for an unrestrained occupant";
    check.complain_if(
        !known,
        Rule::Impossible,
        "NOPBLT",
        "this names no belt",
        "1. lap belt, 2. torso belt, 3. both",
        remedy,
    );
    for (belt, name, in_use) in [(1, "lap", used == 1.0 || used == 3.0), (2, "torso", used == 2.0 || used == 3.0)] {
        if in_use {
            check_belt(check, belt, name);
        } else {
            note_ignored(check, belt, name);
        }
    }
}

fn check_belt(check: &mut Check<'_>, belt: u32, name: &str) {
    let [first, second, elbow] = ["SK1", "SK2", "DELC"].map(|n| format!("{n}({belt})"));
    check.positive(&first, "first slope of the webbing");
    check.not_negative(&second, "second slope of the webbing");
    check.not_negative(&elbow, "elongation of the webbing");
    let anchor = |end: u32, check: &Check<'_>| [1, 2, 3].map(|axis| check.value(&format!("P{end}({belt},{axis})")));
    let (one, two) = (anchor(1, check), anchor(2, check));
    if one == two {
        let message = format!("both anchors of the {name} belt lie at the same point");
        let complaint = Complaint {
            rule: Rule::Impossible,
            message,
            expected: "two points",
            remedy: "punch both anchors in vehicle axes",
        };
        check.complain(&format!("P1({belt},1)"), complaint);
    }
    let width = check.value("VCW");
    for (end, point) in [(1, one), (2, two)] {
        let outside = point[1].abs() > 1.2 * width;
        let remedy = "Y counts from the vehicle's centre line, to the right";
        check.complain_if(
            outside,
            Rule::Unlikely,
            &format!("P{end}({belt},2)"),
            "the anchor lies outside the car",
            "within ±VCW",
            remedy,
        );
    }
    let slack = format!("SLACK({belt})");
    let loose = check.value(&slack).abs() > 12.0;
    check.complain_if(loose, Rule::Unlikely, &slack, "a foot of slack", "a few inches", "look for the decimal point");
}

/// Numbers of a belt that is not in use.
fn note_ignored(check: &mut Check<'_>, belt: u32, name: &str) {
    let mut names: Vec<String> = ["SLACK", "SK1", "SK2", "DELC"].map(|n| format!("{n}({belt})")).to_vec();
    names.extend((1..=3).flat_map(|axis| [format!("P1({belt},{axis})"), format!("P2({belt},{axis})")]));
    let punched = names.into_iter().find(|n| check.value(n) != 0.0 && !check.value(n).is_nan());
    if let Some(first) = punched {
        let message =
            format!("the {name} belt is not in use (NOPBLT = {}); its numbers have no effect", check.digits("NOPBLT"));
        let complaint = Complaint {
            rule: Rule::Ignored,
            message,
            expected: "blanks",
            remedy: "leave them blank, or change NOPBLT",
        };
        check.complain(&first, complaint);
    }
}

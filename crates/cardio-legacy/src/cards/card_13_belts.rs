//! Series 13: lap and torso belt.

use super::SeriesLayout;
use super::field::{Field, INCH, ONE, STIFFNESS, field};
use crate::rule::Rule;

/// Belts by their number on the cards: name, and the sphere that they loop round.
pub(crate) const BELTS: [(u32, &str, &str); 2] = [(1, "lap", "pelvis"), (2, "torso", "chest")];

/// Variables of a belt; the index that follows begins with its number.
const VARIABLES: [&str; 7] = ["P1", "P2", "SK1", "SK2", "DELC", "SLACK", "BLTLEO"];

/// Whether a value of NOPBLT enables a belt.
pub(crate) fn uses(nopblt: f64, belt: u32) -> bool {
    nopblt == f64::from(belt) || nopblt == 3.0
}

/// Whether a field belongs to a disabled belt.
pub(crate) fn is_of_unused(name: &str, nopblt: f64) -> bool {
    let Some((variable, index)) = name.split_once('(') else { return false };
    let belt = if index.starts_with('1') { 1 } else { 2 };
    VARIABLES.contains(&variable) && !uses(nopblt, belt)
}

/// Lengths of a run that continues from an exact state, on card 6a.
pub(super) fn initial_lengths() -> [Field; 2] {
    BELTS.map(|(number, name, _)| {
        let unknown = format!("the {name} belt is in use and has no initial length");
        field(format!("BLTLEO({number})"), INCH, format!("initial length of the {name} belt if in use"))
            .key(format!("belts.{name}.length"))
            .wrong_if(Rule::Impossible, |v| v <= 0.0, unknown)
            .expected("a length in inches, if NPOS = 1", "punch the length, or switch the belt off by NOPBLT")
    })
}

pub(super) fn series() -> SeriesLayout {
    let used = field("NOPBLT", ONE, "1 lap belt, 2 torso belt, 3 both")
        .wrong_if(Rule::Impossible, |v| ![1.0, 2.0, 3.0].contains(&v), "this names no belt")
        .expected(
            "1. lap belt, 2. torso belt, 3. both",
            "punch it with its decimal point, or leave the series out for an unrestrained occupant",
        );
    let [lap_anchors, torso_anchors] = BELTS.map(anchors);
    SeriesLayout::new(13, "lap and torso belt (left out for an unrestrained occupant)")
        .first(13, "7F10.0,I10", [used].into_iter().chain(lap_anchors))
        .then("8F10.0", torso_anchors.into_iter().chain(BELTS.map(slack)))
        .then("8F10.0", BELTS.into_iter().flat_map(webbing))
}

fn anchors((number, name, _): (u32, &str, &str)) -> Vec<Field> {
    let coordinate = |end: u32, (index, axis): (u32, &str)| {
        let meaning = format!("vehicle {axis} of the {name} belt's anchor {end}");
        field(format!("P{end}({number},{index})"), INCH, meaning)
    };
    [1, 2].into_iter().flat_map(|end| [(1, "X"), (2, "Y"), (3, "Z")].map(|axis| coordinate(end, axis))).collect()
}

fn slack((number, name, _): (u32, &str, &str)) -> Field {
    field(format!("SLACK({number})"), INCH, format!("initial slack of the {name} belt"))
        .key(format!("belts.{name}.slack"))
        .wrong_if(Rule::Unlikely, |v| v.abs() > 12.0, "a foot of slack")
        .expected("a few inches", "look for the decimal point")
}

fn webbing((number, name, _): (u32, &str, &str)) -> [Field; 3] {
    let first = match number {
        1 => "first slope of force over elongation",
        _ => "first slope (the report prints SK1(1))",
    };
    let elbow = format!("elongation where the slope changes from SK1({number}) to SK2({number})");
    let field = |variable: &str, key: &str, unit, meaning: &str| {
        field(format!("{variable}({number})"), unit, format!("{name} belt: {meaning}"))
            .key(format!("belts.{name}.{key}"))
    };
    [
        field("SK1", "k1", STIFFNESS, first)
            .not_negative("first slope of the webbing")
            .wrong_if(Rule::Unlikely, |k| k == 0.0, "the webbing does not pull up to DELC")
            .expected("a stiffness in lbf/in", "punch the stiffness, unless a gap is meant; SLACK is one too"),
        field("SK2", "k2", STIFFNESS, "second slope").not_negative("second slope of the webbing"),
        field("DELC", "delta_b", INCH, &elbow).not_negative("elongation of the webbing"),
    ]
}

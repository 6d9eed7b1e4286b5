//! Segments and spheres (series 5 and 7).

use super::{Check, Complaint};
use crate::rule::Rule;

const GRAVITY: f64 = 386.04;
/// More mass than any body has, lbf·s²/in (460 lb).
const HEAVIEST: f64 = 1.2;
/// Left and right segments of the report.
const PAIRS: [(u32, u32); 4] = [(5, 6), (7, 8), (9, 10), (11, 12)];
/// Left and right may differ by this much before it is called unlikely.
const ASYMMETRY: f64 = 0.2;
/// Inertias are rounded on cards; the triangle inequality is allowed this much.
const ROUNDING: f64 = 1e-3;

pub(super) fn check(check: &mut Check<'_>) {
    check.positive("XLS", "half of the shoulder width");
    check.positive("XLH", "half of the hip width");
    for segment in 1..=12 {
        check_segment(check, segment);
    }
    check_sums(check);
    for (left, right) in PAIRS {
        check_symmetry(check, left, right);
    }
    check_spheres(check);
}

fn check_segment(check: &mut Check<'_>, n: u32) {
    let named = |name: &str| format!("{name}({n})");
    for (name, what) in [("XLE", "length of a segment"), ("XM", "mass of a segment")] {
        check.positive(&named(name), what);
    }
    check.not_negative(&named("RHO"), "distance of the centre of gravity from the lower end");
    let (length, rho) = (check.value(&named("XLE")), check.value(&named("RHO")));
    let message =
        format!("the centre of gravity lies beyond the segment's end, XLE({n}) = {}", check.digits(&named("XLE")));
    check.complain_if(
        length > 0.0 && rho > length,
        Rule::Impossible,
        &named("RHO"),
        &message,
        "0 to XLE",
        "RHO counts from the lower end of the segment",
    );
    let axes = ["XIN", "YIN", "ZIN"].map(named);
    for axis in &axes {
        check.positive(axis, "moment of inertia of a segment");
    }
    let inertia = axes.each_ref().map(|axis| check.value(axis));
    let sum: f64 = inertia.iter().sum();
    for (axis, own) in axes.iter().zip(inertia) {
        let others = sum - own;
        let message = format!("more than the two others together, {others:.6}, which no body can have");
        let violated = own > others * (1.0 + ROUNDING) && inertia.iter().all(|i| *i > 0.0);
        check.complain_if(
            violated,
            Rule::Impossible,
            axis,
            &message,
            "each moment at most the sum of the two others",
            "look for a digit or a point",
        );
    }
}

/// Whole body: weight, and lengths that look like feet.
fn check_sums(check: &mut Check<'_>) {
    let sum = |name: &str, check: &Check<'_>| (1..=12).map(|n| check.value(&format!("{name}({n})"))).sum::<f64>();
    let mass = sum("XM", check);
    let weight = mass * GRAVITY;
    let complaint = |rule, message, expected, remedy| Complaint { rule, message, expected, remedy };
    if mass > HEAVIEST {
        let heaviest = heaviest_segment(check);
        let message = format!(
            "the masses add up to {mass:.3} lbf·s²/in, a weight of {weight:.0} lb; they look like weights in lb"
        );
        check.complain(
            &heaviest,
            complaint(Rule::LooksLikeOtherUnit, message, "masses in lbf·s²/in", "divide weights in lb by 386.04"),
        );
    } else if !(15.0..=450.0).contains(&weight) && mass > 0.0 {
        let message = format!("the body weighs {weight:.1} lb");
        check.complain(
            "XM(1)",
            complaint(
                Rule::Unlikely,
                message,
                "a weight of 15 to 450 lb",
                "look at each mass: weight in lb divided by 386.04",
            ),
        );
    }
    let length = sum("XLE", check);
    if length > 0.0 && length < 24.0 {
        let message = format!("the twelve lengths add up to {length:.2}; they look like feet");
        check.complain(
            "XLE(1)",
            complaint(Rule::LooksLikeOtherUnit, message, "lengths in inches", "multiply feet by 12"),
        );
    } else if length > 250.0 {
        let message = format!("the twelve lengths add up to {length:.1}; they look like centimetres or millimetres");
        check.complain(
            "XLE(1)",
            complaint(Rule::LooksLikeOtherUnit, message, "lengths in inches", "divide centimetres by 2.54"),
        );
    }
}

fn heaviest_segment(check: &Check<'_>) -> String {
    let names = (1..=12).map(|n| format!("XM({n})"));
    names.max_by(|a, b| check.value(a).total_cmp(&check.value(b))).unwrap_or_default()
}

fn check_symmetry(check: &mut Check<'_>, left: u32, right: u32) {
    for name in ["XLE", "RHO", "XM", "XIN", "YIN", "ZIN"] {
        let (a, b) = (check.value(&format!("{name}({left})")), check.value(&format!("{name}({right})")));
        let message = format!("the other side has {name}({left}) = {a}");
        let violated = (a - b).abs() > ASYMMETRY * a.abs().max(b.abs());
        check.complain_if(
            violated,
            Rule::Unlikely,
            &format!("{name}({right})"),
            &message,
            "left and right about alike",
            "look for a wrong digit or a card in the wrong place",
        );
    }
}

fn check_spheres(check: &mut Check<'_>) {
    let radii: Vec<f64> = (1..=17).map(|n| check.value(&format!("RS({n})"))).collect();
    for (index, radius) in radii.iter().enumerate() {
        let name = format!("RS({})", index + 1);
        check.positive(&name, "radius of a contact sphere");
        check.complain_if(
            *radius > 12.0,
            Rule::Unlikely,
            &name,
            "a sphere wider than any part of a body",
            "a radius in inches",
            "look for the decimal point",
        );
    }
    let largest = radii.iter().copied().fold(0.0, f64::max);
    if largest > 0.0 && largest < 1.0 {
        let message = format!("the largest radius is {largest}; the radii look like feet");
        check.complain(
            "RS(1)",
            Complaint {
                rule: Rule::LooksLikeOtherUnit,
                message,
                expected: "radii in inches",
                remedy: "multiply feet by 12",
            },
        );
    }
}

//! Segments, spheres and joints (series 5, 7 and 11).

use super::Check;
use crate::cards::JOINTS;
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

pub(super) fn check(c: &mut Check<'_>) {
    for segment in 1..=12 {
        check_segment(c, segment);
    }
    check_weight(c);
    check_lengths(c);
    for (left, right) in PAIRS {
        check_symmetry(c, left, right);
    }
    let largest = (1..=17).map(|n| c.value(format!("RS({n})"))).fold(0.0, f64::max);
    if largest > 0.0 && largest < 1.0 {
        let message = format!("the largest radius is {largest}; the radii look like feet");
        c.problem(Rule::LooksLikeOtherUnit, "RS(1)", message).expected("radii in inches", "multiply feet by 12");
    }
    check_joints(c);
}

fn check_segment(c: &mut Check<'_>, n: u32) {
    let (length, rho) = (c.value(format!("XLE({n})")), c.value(format!("RHO({n})")));
    let digits = c.digits(format!("XLE({n})"));
    let message = format!("the centre of gravity lies beyond the segment's end, XLE({n}) = {digits}");
    c.wrong_if(length > 0.0 && rho > length, Rule::Impossible, format!("RHO({n})"), message)
        .expected("0 to XLE", "RHO counts from the lower end of the segment");
    let axes = ["XIN", "YIN", "ZIN"].map(|axis| format!("{axis}({n})"));
    let inertia = axes.each_ref().map(|axis| c.value(axis));
    let sum: f64 = inertia.iter().sum();
    for (axis, own) in axes.iter().zip(inertia) {
        let others = sum - own;
        let violated = own > others * (1.0 + ROUNDING) && inertia.iter().all(|i| *i > 0.0);
        let message = format!("more than the two others together, {others:.6}, which no body can have");
        c.wrong_if(violated, Rule::Impossible, axis, message)
            .expected("each moment at most the sum of the two others", "look for a digit or a point");
    }
}

fn sum(c: &Check<'_>, name: &str) -> f64 {
    (1..=12).map(|n| c.value(format!("{name}({n})"))).sum()
}

fn check_weight(c: &mut Check<'_>) {
    let mass = sum(c, "XM");
    let weight = mass * GRAVITY;
    if mass > HEAVIEST {
        let names = (1..=12).map(|n| format!("XM({n})"));
        let heaviest = names.max_by(|a, b| c.value(a).total_cmp(&c.value(b))).unwrap_or_default();
        let message = format!(
            "the masses add up to {mass:.3} lbf·s²/in, a weight of {weight:.0} lb; they look like weights in lb"
        );
        c.problem(Rule::LooksLikeOtherUnit, heaviest, message)
            .expected("masses in lbf·s²/in", "divide weights in lb by 386.04");
    } else if !(15.0..=450.0).contains(&weight) && mass > 0.0 {
        c.problem(Rule::Unlikely, "XM(1)", format!("the body weighs {weight:.1} lb"))
            .expected("a weight of 15 to 450 lb", "look at each mass: weight in lb divided by 386.04");
    }
}

fn check_lengths(c: &mut Check<'_>) {
    let length = sum(c, "XLE");
    let (message, remedy) = if length > 0.0 && length < 24.0 {
        (format!("the twelve lengths add up to {length:.2}; they look like feet"), "multiply feet by 12")
    } else if length > 250.0 {
        let message = format!("the twelve lengths add up to {length:.1}; they look like centimetres or millimetres");
        (message, "divide centimetres by 2.54")
    } else {
        return;
    };
    c.problem(Rule::LooksLikeOtherUnit, "XLE(1)", message).expected("lengths in inches", remedy);
}

fn check_symmetry(c: &mut Check<'_>, left: u32, right: u32) {
    for name in ["XLE", "RHO", "XM", "XIN", "YIN", "ZIN"] {
        let (a, b) = (c.value(format!("{name}({left})")), c.value(format!("{name}({right})")));
        let violated = (a - b).abs() > ASYMMETRY * a.abs().max(b.abs());
        let message = format!("the other side has {name}({left}) = {a}");
        c.wrong_if(violated, Rule::Unlikely, format!("{name}({right})"), message)
            .expected("left and right about alike", "look for a wrong digit or a card in the wrong place");
    }
}

fn check_joints(c: &mut Check<'_>) {
    for joint in &JOINTS {
        let (normal, full) = (joint.damping(), joint.full_damping());
        let less = c.value(&full) < c.value(&normal) && c.value(&full) != 0.0;
        let message = format!("less than the damping before the stop, {normal} = {}", c.digits(&normal));
        c.wrong_if(less, Rule::Unlikely, full, message)
            .expected("more than the damping before the stop", "check whether the two are exchanged");
        for (at, [begin, full]) in joint.stops().iter().enumerate() {
            // The lower stop of a hinge is met by a falling angle.
            let falling = joint.is_hinge() && at == 0;
            let (begins_at, full_at) = (c.value(begin), c.value(full));
            let wrong = if falling { begins_at < full_at } else { begins_at > full_at };
            let side = if falling { "above the angle of the full stop" } else { "below the angle of the full stop" };
            let message = format!("the stop begins beyond its end, {full} = {}", c.digits(full));
            c.wrong_if(wrong, Rule::Impossible, begin, message)
                .expected(side, "check whether the two angles are exchanged");
        }
    }
}

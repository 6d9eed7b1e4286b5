//! Seating and initial velocity (series 4 and 10), used if NPOS = 0.

use super::{Check, Complaint};
use crate::rule::Rule;

const ANGLES: [&str; 6] = ["GAMA1", "GAMA2", "GAMA3", "GAMA4", "GAMA5", "ALPHA1"];

pub(super) fn check(check: &mut Check<'_>) {
    let seat = check.value("NOPTSP");
    let known = seat.is_nan() || [1.0, 2.0, 3.0, 4.0].contains(&seat);
    check.complain_if(
        !known,
        Rule::Impossible,
        "NOPTSP",
        "this names no seat",
        "1. driver, 2. right front, 3. left rear, 4. right rear",
        "punch it with its decimal point",
    );
    let largest = ANGLES.map(|name| check.value(name).abs()).into_iter().fold(0.0, f64::max);
    if largest > 0.0 && largest < std::f64::consts::PI {
        let message = format!("no angle of the posture is larger than {largest}; they look like radians");
        let complaint = Complaint {
            rule: Rule::LooksLikeOtherUnit,
            message,
            expected: "angles in degrees",
            remedy: "multiply radians by 57.2958",
        };
        check.complain("GAMA1", complaint);
    }
    for name in ANGLES {
        let violated = check.value(name).abs() > 180.0;
        check.complain_if(
            violated,
            Rule::Unlikely,
            name,
            "more than half a turn",
            "an angle in degrees within ±180",
            "look for the decimal point",
        );
    }
    let backward = check.value("ALPHA1") > 0.0;
    check.complain_if(
        backward,
        Rule::Unlikely,
        "ALPHA1",
        "the elbow bends backward",
        "a negative angle: it brings the hand forward",
        "look for a missing minus sign",
    );
    check_heels(check);
}

fn check_heels(check: &mut Check<'_>) {
    let (x, z) = (check.value("XHPV"), check.value("ZHPV"));
    let along =
        |name: &str, check: &Check<'_>| (1..=22).map(|n| check.value(&format!("{name}({n})"))).collect::<Vec<_>>();
    for (name, own, all) in [("XHPV", x, along("XV", check)), ("ZHPV", z, along("ZV", check))] {
        let low = all.iter().copied().fold(f64::INFINITY, f64::min);
        let high = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let violated = own < low || own > high;
        check.complain_if(
            violated,
            Rule::Unlikely,
            name,
            "the heels lie outside the compartment",
            "within the points of series 8",
            "vehicle axes: X forward, Z down, from the centre of gravity",
        );
    }
}

//! The compartment (series 8): its seven equalities, its widths, its units.

use super::{Check, Complaint};
use crate::compartment::CompartmentLayout;
use crate::rule::Rule;

/// Coordinates that the report says are equal.
const EQUALITIES: [&[&str]; 7] = [
    &["ZV(5)", "ZV(18)"],
    &["ZV(20)", "ZV(21)"],
    &["ZV(6)", "ZV(11)", "ZV(19)"],
    &["ZV(2)", "ZV(3)"],
    &["ZV(8)", "ZV(13)", "ZV(14)", "ZV(17)"],
    &["XV(11)", "XV(12)", "XV(15)"],
    &["XV(6)", "XV(7)", "XV(22)"],
];
const TOLERANCE_IN: f64 = 1e-6;

pub(super) fn check(check: &mut Check<'_>) {
    for name in ["VCW", "VRW"] {
        check.positive(name, "half of a width");
    }
    let (width, roof) = (check.value("VCW"), check.value("VRW"));
    check.complain_if(
        roof > width,
        Rule::Unlikely,
        "VRW",
        "the roof is wider than the compartment",
        "at most VCW",
        "look whether VCW and VRW have changed places",
    );
    check.complain_if(
        check.value("SWP").abs() > width,
        Rule::Unlikely,
        "SWP",
        "the wheel's centre lies outside the compartment",
        "at most VCW",
        "SWP counts from the centre line",
    );
    let no_wheel = check.value("DSW") <= 0.0;
    check.complain_if(
        no_wheel,
        Rule::Unlikely,
        "DSW",
        "without a diameter there is no steering wheel",
        "a diameter in inches",
        "punch the diameter; surface 25 is left out otherwise",
    );
    for equal in EQUALITIES {
        check_equality(check, equal);
    }
    let points = (1..=22).flat_map(|n| [format!("XV({n})"), format!("ZV({n})")]);
    let largest = points.map(|name| check.value(&name).abs()).fold(0.0, f64::max);
    if largest > 0.0 && largest < 12.0 {
        let message = format!("no coordinate is larger than {largest}; the points look like feet");
        check.complain(
            "XV(1)",
            Complaint {
                rule: Rule::LooksLikeOtherUnit,
                message,
                expected: "coordinates in inches",
                remedy: "multiply feet by 12",
            },
        );
    }
    check_extents(check);
    check.complain_if(
        width > 0.0 && width < 8.0,
        Rule::LooksLikeOtherUnit,
        "VCW",
        "a compartment narrower than a person",
        "half of the width in inches",
        "multiply feet by 12",
    );
}

/// Surfaces without area, by the layout that conversion uses.
fn check_extents(check: &mut Check<'_>) {
    let Ok(layout) = CompartmentLayout::reconstruction() else {
        return;
    };
    for face in layout.faces(check.deck).iter().filter(|face| face.corners.is_empty()) {
        let name = format!("STIF1({})", face.number);
        let message = format!("surface {}, {}, has no area: its points in series 8 coincide", face.number, face.name);
        let complaint = Complaint {
            rule: Rule::Unlikely,
            message,
            expected: "points apart from one another",
            remedy: "correct the points in series 8; the surface is left out otherwise",
        };
        check.complain(&name, complaint);
    }
}

fn check_equality(check: &mut Check<'_>, names: &[&str]) {
    let Some((first, others)) = names.split_first() else {
        return;
    };
    for name in others {
        let violated = (check.value(name) - check.value(first)).abs() > TOLERANCE_IN;
        let message =
            format!("{first} is {}, and Figs 13 and 14 have {} equal", check.digits(first), names.join(" = "));
        let remedy = "correct one of them; surfaces between the points will lie differently than the report means";
        check.complain_if(violated, Rule::CompartmentEquality, name, &message, &names.join(" = "), remedy);
    }
}

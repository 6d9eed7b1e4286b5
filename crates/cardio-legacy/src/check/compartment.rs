//! The compartment and its surfaces (series 8 and 9): widths, units, the seven equalities, areas.

use super::Check;
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
    let (width, roof, wheel) = (check.value("VCW"), check.value("VRW"), check.value("SWP"));
    check
        .wrong_if(roof > width, Rule::Unlikely, "VRW", "the roof is wider than the compartment")
        .expected("at most VCW", "look whether VCW and VRW have changed places");
    check
        .wrong_if(wheel.abs() > width, Rule::Unlikely, "SWP", "the wheel's centre lies outside the compartment")
        .expected("at most VCW", "SWP counts from the centre line");
    for equal in EQUALITIES {
        check_equality(check, equal);
    }
    let points = (1..=22).flat_map(|n| [format!("XV({n})"), format!("ZV({n})")]);
    let largest = points.map(|name| check.value(name).abs()).fold(0.0, f64::max);
    if largest > 0.0 && largest < 12.0 {
        let message = format!("no coordinate is larger than {largest}; the points look like feet");
        check
            .problem(Rule::LooksLikeOtherUnit, "XV(1)", message)
            .expected("coordinates in inches", "multiply feet by 12");
    }
    check_extents(check);
    let narrow = width > 0.0 && width < 8.0;
    check
        .wrong_if(narrow, Rule::LooksLikeOtherUnit, "VCW", "a compartment narrower than a person")
        .expected("half of the width in inches", "multiply feet by 12");
    for surface in 1..=25 {
        check_stiffness(check, surface);
    }
}

fn check_equality(check: &mut Check<'_>, names: &[&str]) {
    let equal = names.join(" = ");
    for name in &names[1..] {
        let violated = (check.value(name) - check.value(names[0])).abs() > TOLERANCE_IN;
        let message = format!("{} is {}, and Figs 13 and 14 have {equal} equal", names[0], check.digits(names[0]));
        let remedy = "correct one of them; surfaces between the points will lie differently than the report means";
        check.wrong_if(violated, Rule::CompartmentEquality, name, message).expected(&equal, remedy);
    }
}

/// Surfaces without area, by the layout that conversion uses.
fn check_extents(check: &mut Check<'_>) {
    let Ok(layout) = CompartmentLayout::reconstruction() else {
        return;
    };
    for face in layout.faces(check.deck).iter().filter(|face| face.corners.is_empty()) {
        let message = format!("surface {}, {}, has no area: its points in series 8 coincide", face.number, face.name);
        let remedy = "correct the points in series 8; the surface is left out otherwise";
        check
            .problem(Rule::Unlikely, format!("STIF1({})", face.number), message)
            .expected("points apart from one another", remedy);
    }
}

fn check_stiffness(check: &mut Check<'_>, n: u32) {
    let (soft, stiff) = (check.value(format!("STIF1({n})")), check.value(format!("STIF2({n})")));
    let message = format!("softer than STIF1({n}) = {}", check.digits(format!("STIF1({n})")));
    check
        .wrong_if(soft > stiff && stiff > 0.0, Rule::Unlikely, format!("STIF2({n})"), message)
        .expected("the larger of the two", "look whether the two have changed places");
}

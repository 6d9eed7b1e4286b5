//! The compartment, its surfaces and belts (series 8, 9 and 13): widths, units, the seven equalities, areas, slopes of springs.

use super::Check;
use crate::cards::BELTS;
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
/// Largest distance of a point of a car's compartment from its centre of gravity.
const FARTHEST_IN: f64 = 200.0;
/// No car is wider to each side.
const WIDEST_IN: f64 = 60.0;

pub(super) fn check(c: &mut Check<'_>) {
    let (width, roof, wheel) = (c.value("VCW"), c.value("VRW"), c.value("SWP"));
    c.wrong_if(roof > width, Rule::Unlikely, "VRW", "the roof is wider than the compartment")
        .expected("at most VCW", "check whether VCW and VRW are exchanged");
    c.wrong_if(wheel.abs() > width, Rule::Unlikely, "SWP", "the wheel's centre lies outside the compartment")
        .expected("at most VCW", "SWP counts from the centre line");
    for equal in EQUALITIES {
        check_equality(c, equal);
    }
    let points = (1..=22).flat_map(|n| [format!("XV({n})"), format!("ZV({n})")]);
    let largest = points.map(|name| c.value(name).abs()).fold(0.0, f64::max);
    if largest > 0.0 && largest < 12.0 {
        let message = format!("no coordinate is larger than {largest}; the points look like feet");
        c.problem(Rule::LooksLikeOtherUnit, "XV(1)", message).expected("coordinates in inches", "multiply feet by 12");
    }
    for name in (1..=22).flat_map(|n| [format!("XV({n})"), format!("ZV({n})")]) {
        let far = c.value(&name).abs() > FARTHEST_IN;
        c.wrong_if(far, Rule::Unlikely, &name, "further from the centre of gravity than any point of a car")
            .expected("a coordinate in inches", "look for the decimal point");
    }
    check_extents(c);
    let narrow = width > 0.0 && width < 8.0;
    c.wrong_if(narrow, Rule::LooksLikeOtherUnit, "VCW", "a compartment narrower than a person")
        .expected("half of the width in inches", "multiply feet by 12");
    c.wrong_if(width > WIDEST_IN, Rule::Unlikely, "VCW", "half of the width of no car")
        .expected("14 to 40 inches", "look for the decimal point, and give half of the width");
    let size = c.value("DSW");
    c.wrong_if(size > 0.0 && !(8.0..=30.0).contains(&size), Rule::Unlikely, "DSW", "the diameter of no steering wheel")
        .expected("14 to 18 inches", "look for the decimal point, and give the diameter");
    (1..=25).for_each(|surface| check_stiffness(c, "STIF", surface));
    BELTS.iter().for_each(|belt| check_stiffness(c, "SK", belt.0));
}

fn check_equality(c: &mut Check<'_>, names: &[&str]) {
    let equal = names.join(" = ");
    for name in &names[1..] {
        let violated = (c.value(name) - c.value(names[0])).abs() > TOLERANCE_IN;
        let message = format!("{} is {}, and Figs 13 and 14 have {equal} equal", names[0], c.digits(names[0]));
        let remedy = "correct one of them; surfaces between the points will lie differently than the report means";
        c.wrong_if(violated, Rule::CompartmentEquality, name, message).expected(&equal, remedy);
    }
}

/// Surfaces without area, by the layout that conversion uses.
fn check_extents(c: &mut Check<'_>) {
    let Ok(layout) = CompartmentLayout::reconstruction() else { return };
    for face in layout.faces(c.deck).iter().filter(|face| face.corners.is_empty()) {
        let message = format!("surface {}, {}, has no area: its points in series 8 coincide", face.number, face.name);
        let remedy = "correct the points in series 8; the surface is left out otherwise";
        c.problem(Rule::Unlikely, format!("STIF1({})", face.number), message)
            .expected("points apart from one another", remedy);
    }
}

/// Springs of which the second slope is the softer; webbing that yields under load is seldom meant.
fn check_stiffness(c: &mut Check<'_>, stem: &str, n: u32) {
    let [first, second] = [1, 2].map(|slope| format!("{stem}{slope}({n})"));
    let (soft, stiff) = (c.value(&first), c.value(&second));
    let message = format!("softer than {first} = {}", c.digits(&first));
    c.wrong_if(soft > stiff && stiff > 0.0, Rule::Unlikely, second, message)
        .expected("the larger of the two", "check whether the two are exchanged");
}

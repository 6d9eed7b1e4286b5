//! Initial position of the occupant (series 4 and 10, or 6), and the belts (series 13).

use super::DeckSeating;
use super::compartment::passed_pair;
use super::writer::{Writer, negated};
use crate::cards::{BELTS, POSTURE, SEATS, uses};
use crate::compartment::CompartmentLayout;

pub(super) fn write(w: &mut Writer<'_>, layout: &CompartmentLayout, how: DeckSeating) {
    if w.value("NPOS") == 1.0 {
        exact_state(w);
        passed(w, layout);
    } else {
        seating(w, layout, how);
    }
    if w.deck.has_series(13) {
        belts(w);
    }
}

fn exact_state(w: &mut Writer<'_>) {
    w.table("initial_state", "Series 6, cards b–i: generalized coordinates in in and rad, and their rates");
    for (key, name) in [("q", "Q0"), ("rates", "QDO")] {
        let numbers: Vec<String> = (1..=31).map(|n| w.bare(&format!("{name}({n})"))).collect();
        let order = if key == "q" { ORDER } else { "" };
        w.raw(&format!("{key} = [{order}{}\n]\n", rows_of_coordinates(&numbers)));
    }
}

/// Pairs of series 14, one line per sphere.
fn passed(w: &mut Writer<'_>, layout: &CompartmentLayout) {
    if !w.deck.has_series(14) {
        return;
    }
    let (mut text, mut before) = (String::new(), "");
    for pair in w.deck.passed_pairs() {
        let Some((sphere, surface)) = passed_pair(w, layout, pair) else { continue };
        text.push_str(if sphere == before { " " } else { "\n    " });
        text.push_str(&format!("[\"{sphere}\", \"{surface}\"],"));
        before = sphere;
    }
    w.raw(&format!("passed = [                     # series 14: spheres that have passed a surface's edge{text}\n]\n"));
}

const ORDER: &str =
    "                          # T1; φ θ ψ of segments 1, 2, 3, 4, 5, 6; α₇ α₈; φ θ ψ of 9, 10; α₁₁ α₁₂";

/// T1, six triples, two angles, two triples, two angles: one line each.
fn rows_of_coordinates(mut numbers: &[String]) -> String {
    let mut rows = String::new();
    for length in [3, 3, 3, 3, 3, 3, 3, 2, 3, 3, 2] {
        let (row, behind) = numbers.split_at(length);
        rows.push_str(&format!("\n    {},", row.join(", ")));
        numbers = behind;
    }
    rows
}

fn seating(w: &mut Writer<'_>, layout: &CompartmentLayout, how: DeckSeating) {
    let number = w.value("NOPTSP") as usize;
    let Some(seat) = SEATS.get(number.wrapping_sub(1)) else { return };
    let surface = |number| layout.name_of(number).unwrap_or_default();
    let distance = w.bare("SWP");
    let (y, from, side) = if seat.is_left {
        (negated(&distance), "card 8a, −SWP", "left")
    } else {
        (distance.clone(), "card 8a, SWP", "right")
    };
    w.table(&format!("seats.{}", seat.name), &format!("Card 10a, NOPTSP = {number}"));
    w.set("cushion", &format!("\"{}\"", surface(seat.cushion)));
    w.set("back", &format!("\"{}\"", surface(seat.back)));
    w.set_with("y", &y, from);
    w.report.assumptions.push(format!(
        "the occupant sits {distance} in {side} of the centre line, as far as the wheel (SWP): no card places a seat sideways"
    ));
    w.table("posture", "Series 10, angles lean the top of a segment back; series 4");
    w.set("seat", &format!("\"{}\"", seat.name));
    POSTURE.into_iter().for_each(|angle| w.field(angle));
    let heels = ["XHPV", "ZHPV"].map(|n| w.quantity(n)).join(", ");
    w.set_with("heels", &format!("[{heels}]"), "card 10b, XHPV, ZHPV");
    w.set("settle", if how == DeckSeating::Balanced { "true" } else { "false" });
    let velocity = ["VXVC", "VYVC", "VZVC"].map(|n| w.quantity(n)).join(", ");
    w.set_with("velocity", &format!("[{velocity}]"), "card 4, VXVC, VYVC, VZVC: of every point, vehicle axes");
    w.report.assumptions.push(placed(how).into());
}

/// Value of the key for the placing of a seated body.
fn placed(how: DeckSeating) -> &'static str {
    match how {
        DeckSeating::Balanced => {
            "the body is seated in the cards' posture and then moved as one piece until all that it touches carries its \
             weight; `occupant check` says how far. --seating pelvis leaves it where the pelvis alone carries it"
        }
        DeckSeating::Pelvis => {
            "the pelvis touches the seat back and sinks into the cushion until it carries body and half of the thighs; what \
             other parts press besides is left over, and `occupant check` says how much"
        }
    }
}

fn belts(w: &mut Writer<'_>) {
    let used = w.value("NOPBLT");
    for (number, name, sphere) in BELTS {
        if uses(used, number) {
            belt(w, number, name, sphere);
            continue;
        }
        let places = (1..=3).flat_map(|axis| ["P1", "P2"].map(|point| format!("{point}({number},{axis})")));
        let numbers = ["SK1", "SK2", "DELC", "SLACK"].map(|name| format!("{name}({number})"));
        if places.chain(numbers).any(|field| w.value(&field) != 0.0) {
            let text = format!("series 13: numbers of the {name} belt, which NOPBLT = {used} does not use");
            w.report.ignored.push(text);
        }
    }
}

fn belt(w: &mut Writer<'_>, number: u32, name: &str, sphere: &str) {
    let used = w.value("NOPBLT");
    w.table(&format!("belts.{name}"), &format!("Series 13, NOPBLT = {used}: {name} belt"));
    w.set("sphere", &format!("\"{sphere}\""));
    let [one, two] = [1, 2].map(|end| [1, 2, 3].map(|axis| w.bare(&format!("P{end}({number},{axis})"))).join(", "));
    w.set_with("anchors", &format!("[[{one}], [{two}]]"), &format!("P1({number},·), P2({number},·)"));
    for field in ["SK1", "DELC", "SK2"] {
        w.field(&format!("{field}({number})"));
    }
    if w.value("NPOS") == 1.0 {
        let field = format!("BLTLEO({number})");
        w.field_with(&field, &format!("card 6a, {field}"));
    } else {
        w.field(&format!("SLACK({number})"));
    }
}

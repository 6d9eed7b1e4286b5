//! Where the occupant is at the start (series 4 and 10, or 6), and the belts (series 13).

use super::compartment::passed_pair;
use super::writer::{Writer, negated};
use crate::compartment::CompartmentLayout;

/// Seats by NOPTSP − 1: name, cushion and back by surface number, left side.
pub(crate) const SEATS: [(&str, u32, u32, bool); 4] = [
    ("driver", 13, 14, true),
    ("right_front", 13, 14, false),
    ("left_rear", 18, 19, true),
    ("right_rear", 18, 19, false),
];
/// Fields of series 10 and the keys they become.
pub(crate) const POSTURE: [(&str, &str); 6] = [
    ("middle_torso", "GAMA1"),
    ("upper_torso", "GAMA2"),
    ("head", "GAMA3"),
    ("lower_torso", "GAMA4"),
    ("upper_arms", "GAMA5"),
    ("elbows", "ALPHA1"),
];
/// Belts by their number on the cards: name, sphere.
pub(crate) const BELTS: [(u32, &str, &str); 2] = [(1, "lap", "pelvis"), (2, "torso", "chest")];

pub(super) fn write(w: &mut Writer<'_>, layout: &CompartmentLayout) {
    if w.value("NPOS") == 1.0 {
        exact_state(w);
        passed(w, layout);
    } else {
        seating(w, layout);
    }
    if w.deck.has_series(13) {
        belts(w);
    }
}

fn exact_state(w: &mut Writer<'_>) {
    w.table("initial_state", "Series 6, cards b–i: generalized coordinates in in and rad, and their rates");
    for (key, name) in [("q", "Q0"), ("rates", "QDO")] {
        let numbers: Vec<String> = (1..=31).map(|n| w.bare(&format!("{name}({n})"))).collect();
        let rows: Vec<String> = rows_of_coordinates(&numbers);
        w.raw(&format!("{key} = [{}{}\n]\n", if key == "q" { ORDER } else { "" }, rows.concat()));
    }
}

/// The pairs of series 14, a line for each sphere.
fn passed(w: &mut Writer<'_>, layout: &CompartmentLayout) {
    if !w.deck.has_series(14) {
        return;
    }
    let (mut text, mut before) = (String::new(), "");
    for pair in w.deck.passed_pairs() {
        let Some((sphere, surface)) = passed_pair(w, layout, pair) else {
            continue;
        };
        text.push_str(if sphere == before { " " } else { "\n    " });
        text.push_str(&format!("[\"{sphere}\", \"{surface}\"],"));
        before = sphere;
    }
    w.raw(&format!("passed = [                     # series 14: spheres that have passed a surface's edge{text}\n]\n"));
}

const ORDER: &str =
    "                          # T1; φ θ ψ of segments 1, 2, 3, 4, 5, 6; α₇ α₈; φ θ ψ of 9, 10; α₁₁ α₁₂";

/// T1, six triples, two angles, two triples, two angles: a line each.
fn rows_of_coordinates(numbers: &[String]) -> Vec<String> {
    let lengths = [3, 3, 3, 3, 3, 3, 3, 2, 3, 3, 2];
    let mut rest = numbers;
    let mut rows = Vec::new();
    for length in lengths {
        let (row, behind) = rest.split_at(length.min(rest.len()));
        rows.push(format!("\n    {},", row.join(", ")));
        rest = behind;
    }
    rows
}

fn seating(w: &mut Writer<'_>, layout: &CompartmentLayout) {
    let seat = w.value("NOPTSP") as usize;
    let Some((name, cushion, back, left)) = SEATS.get(seat.wrapping_sub(1)).copied() else {
        return;
    };
    let surface = |number| layout.name_of(number).unwrap_or_default();
    let y = w.bare("SWP");
    let y = if left { negated(&y) } else { y };
    w.table(&format!("seats.{name}"), &format!("Card 10a, NOPTSP = {seat}"));
    w.set("cushion", &format!("\"{}\"", surface(cushion)));
    w.set("back", &format!("\"{}\"", surface(back)));
    w.set_with("y", &y, if left { "card 8a, −SWP" } else { "card 8a, SWP" });
    let distance = w.bare("SWP");
    w.report.assumptions.push(format!(
        "the occupant sits {distance} in {} of the centre line, as far as the wheel (SWP): no card places a seat sideways",
        if left { "left" } else { "right" }
    ));
    w.table("posture", "Series 10, angles lean the top of a segment back; series 4");
    w.set("seat", &format!("\"{name}\""));
    for (key, field) in POSTURE {
        let value = w.quantity(field);
        w.set_with(key, &value, field);
    }
    let heels = ["XHPV", "ZHPV"].map(|n| w.quantity(n)).join(", ");
    w.set_with("heels", &format!("[{heels}]"), "card 10b, XHPV, ZHPV");
    let velocity = ["VXVC", "VYVC", "VZVC"].map(|n| w.quantity(n)).join(", ");
    w.set_with("velocity", &format!("[{velocity}]"), "card 4, VXVC, VYVC, VZVC: of every point, vehicle axes");
    w.report.assumptions.push(
        "the pelvis touches the seat back and sinks into the cushion until it carries body and half of the thighs"
            .into(),
    );
}

fn belts(w: &mut Writer<'_>) {
    let used = w.value("NOPBLT");
    let exact = w.value("NPOS") == 1.0;
    for (number, name, sphere) in BELTS {
        if used != f64::from(number) && used != 3.0 {
            let says_something = [format!("SK1({number})"), format!("P1({number},1)"), format!("P2({number},1)")];
            if says_something.iter().any(|field| w.value(field) != 0.0) {
                w.report
                    .ignored
                    .push(format!("series 13: numbers of the {name} belt, which NOPBLT = {used} does not use"));
            }
            continue;
        }
        w.table(&format!("belts.{name}"), &format!("Series 13, NOPBLT = {used}: {name} belt"));
        w.set("sphere", &format!("\"{sphere}\""));
        let anchors = [1, 2].map(|end| [1, 2, 3].map(|axis| w.bare(&format!("P{end}({number},{axis})"))).join(", "));
        w.set_with(
            "anchors",
            &format!("[[{}], [{}]]", anchors[0], anchors[1]),
            &format!("P1({number},·), P2({number},·)"),
        );
        for (key, field) in [("k1", "SK1"), ("delta_b", "DELC"), ("k2", "SK2")] {
            let field = format!("{field}({number})");
            let value = w.quantity(&field);
            w.set_with(key, &value, &field);
        }
        let (key, field) = if exact { ("length", "BLTLEO") } else { ("slack", "SLACK") };
        let field = format!("{field}({number})");
        let value = w.quantity(&field);
        w.set_with(key, &value, &if exact { format!("card 6a, {field}") } else { field });
    }
}

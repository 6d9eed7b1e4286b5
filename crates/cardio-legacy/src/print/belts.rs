//! Belts: as read, as laid, and item 7, their forces.

use occupant_core::forces::belt::RestLength;
use occupant_core::results::sample::Sample;
use occupant_units::unit::Unit::{Metre, Newton, NewtonPerMetre, One};

use super::unit::degree;
use super::{Case, Element, Pages, Table, Units};

/// The sections on belts.
pub(crate) const BELTS: Element = Element {
    heading: "BELTS",
    input,
    start: |pages, case, units| {
        for (name, length_m) in lengths(case) {
            pages.fact("BELT", format!("{name}: UNSTRETCHED LENGTH {}", units.of(Metre).say(length_m)));
        }
    },
    output,
    end: |pages, case, units| {
        let unit = units.of(Metre);
        for (name, length_m) in lengths(case) {
            // six decimals, as cards have them
            let length = length_m / unit.size();
            pages.say(&format!("UNSTRETCHED LENGTH OF THE BELT {name}: {length:.6} {}", unit.name()));
        }
    },
};

fn input(pages: &mut Pages, case: &Case, units: Units) {
    let (k, l, ratio) = (units.of(NewtonPerMetre), units.of(Metre), units.of(One));
    let mut table = Table::new(
        units.heading("BELTS ({}, {}); ANCHORS IN VEHICLE COORDINATES", &[NewtonPerMetre, Metre]),
        "<BELT|<ROUND|ANCHOR 1 X|Y|Z|ANCHOR 2 X|Y|Z|K1|K2|BREAK AT|RET 1|RET 2|<LENGTH",
    );
    for belt in &case.model.setup().belts {
        let w = &belt.webbing;
        let rest = match belt.rest {
            RestLength::Slack { slack_m } => format!("SLACK {}", l.show(slack_m)),
            RestLength::Given { length_m } => format!("GIVEN {}", l.show(length_m)),
        };
        table.row_of(&[
            &[belt.name.clone(), case.sphere(belt.sphere)],
            &belt.anchors_m.map(|a| l.vector(a.coords)).concat(),
            &[w.k1_n_per_m, w.k2_n_per_m].map(|x| k.show(x)),
            &[l.show(w.break_m), ratio.show(w.returned_1), ratio.show(w.returned_2), rest],
        ]);
    }
    table.write_or(pages, &["NO BELTS"]);
}

fn output(pages: &mut Pages, units: Units, s: &Sample<'_>) {
    let (f, l) = (units.of(Newton), units.of(Metre));
    let mut table = Table::new(
        units.heading(
            "7. RESTRAINING FORCES OF BELTS, VEHICLE COORDINATES ({}, {}); WRAP (DEG) 0 OR LESS: OFF THE BODY",
            &[Newton, Metre],
        ),
        "<BELT|<ROUND|LOOP FORCE|FORCE X|FORCE Y|FORCE Z|RESULTANT|ELONGATION|LENGTH|WRAP",
    );
    for (belt, action) in s.model.setup().belts.iter().zip(&s.actions.belts) {
        let round = s.model.body().spheres.get(belt.sphere);
        let force = action.force.to_vector();
        table.row_of(&[
            &[belt.name.clone(), round.map_or_else(String::new, |s| s.name.clone()), f.show(action.loop_force)],
            &f.vector(force),
            &[f.show(force.norm()), l.show(action.elongation), l.show(action.length), degree().show(action.wrap)],
        ]);
    }
    table.write_or(pages, &["7. NO BELTS"]);
}

/// Names and unstretched lengths, m.
fn lengths(case: &Case) -> impl Iterator<Item = (&str, f64)> {
    let laid = case.model.setup().belts.iter().zip(&case.model.system().forces.belts);
    laid.map(|(belt, law)| (belt.name.as_str(), law.rest_length))
}

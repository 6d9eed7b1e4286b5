//! Belts.

use occupant_core::forces::belt::RestLength;

use crate::jobs::print::case::Case;
use crate::jobs::print::page::Pages;
use crate::jobs::print::table::Table;
use crate::jobs::print::unit::{RATIO, Units};

/// Writes the belts as read; what was computed of them stands with the start.
pub(crate) fn write(pages: &mut Pages, case: &Case, units: &Units) {
    let (k, l) = (units.stiffness, units.length);
    let mut table = Table::new(
        format!("BELTS ({}, {}); ANCHORS IN VEHICLE COORDINATES", k.name, l.name),
        "<BELT | <ROUND | ANCHOR 1 X | Y | Z | ANCHOR 2 X | Y | Z | K1 | K2 | BREAK AT | RET 1 | RET 2 | <LENGTH",
    );
    for belt in &case.model.setup().belts {
        let w = &belt.webbing;
        let round = case.model.body().spheres.get(belt.sphere);
        let anchors = belt.anchors_m.map(|a| l.vector(a.coords));
        let rest = match belt.rest {
            RestLength::Slack { slack_m } => format!("SLACK {}", l.show(slack_m)),
            RestLength::Given { length_m } => format!("GIVEN {}", l.show(length_m)),
        };
        let first = [belt.name.clone(), round.map_or_else(String::new, |s| s.name.clone())];
        let last = [
            k.show(w.k1_n_per_m),
            k.show(w.k2_n_per_m),
            l.show(w.break_m),
            RATIO.show(w.returned_1),
            RATIO.show(w.returned_2),
            rest,
        ];
        let anchors = anchors.into_iter().flatten();
        table.row(first.into_iter().chain(anchors).chain(last));
    }
    match table.is_empty() {
        true => pages.block(&["NO BELTS".to_owned()], 0),
        false => table.write(pages),
    }
}

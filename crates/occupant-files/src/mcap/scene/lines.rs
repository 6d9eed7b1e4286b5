//! Lines of force elements, such as webbing, and sections of bags.

use occupant_core::results::sample::Sample;

use super::primitive::{Closing, line, polygon};
use super::{Color, entity, replace};
use crate::mcap::topics::VEHICLE_FRAME;
use crate::mcap::wire::Wire;

const WIDTH_M: f64 = 0.025;
const TAUT: Color = Color(0.85, 0.25, 0.15, 1.0);
const SECTION: Color = Color(0.55, 0.50, 0.70, 0.25);
const EDGE_M: f64 = 0.004;
const SLACK: Color = Color(0.45, 0.45, 0.45, 1.0);

/// A message with one entity per line and per section, vehicle axes.
pub fn write(wire: &mut Wire, ns: u64, sample: &Sample<'_>) {
    replace(wire, ns, |w| {
        for drawn in sample.seen_by_vehicle().lines() {
            let color = if drawn.force_n > 0.0 { TAUT } else { SLACK };
            entity(w, ns, VEHICLE_FRAME, &drawn.name, |w| {
                line(w, Closing::Open, &drawn.points_m, WIDTH_M, color);
            });
        }
        for (i, section) in sample.sections().iter().enumerate() {
            entity(w, ns, VEHICLE_FRAME, &format!("{} {i}", section.name), |w| {
                polygon(w, &section.corners_m, SECTION);
                line(w, Closing::Closed, &section.corners_m, EDGE_M, SECTION.with_opacity(0.9));
            });
        }
    });
}

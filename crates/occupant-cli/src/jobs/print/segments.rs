//! Items 1 to 4: end points, accelerations, angular accelerations and velocities of the twelve segments.

use occupant_core::body::{Body, Segment};
use occupant_core::results::sample::Sample;

use super::page::Pages;
use super::table::Table;
use super::unit::{G, RAD_S, RAD_S2, Units};

/// Writes the segments' tables.
pub(crate) fn write(pages: &mut Pages, units: &Units, sample: &Sample<'_>) {
    end_points(sample, units).write(pages);
    accelerations(sample, units).write(pages);
    turning(sample).write(pages);
}

/// The first cells of a segment's row.
pub(crate) fn label(body: &Body, segment: Segment) -> [String; 2] {
    [segment.number().to_string(), body.tree[segment].name.to_owned()]
}

fn end_points(s: &Sample<'_>, units: &Units) -> Table {
    let mut table = Table::new(
        format!("1. END POINTS AND C.G. OF SEGMENTS, VEHICLE COORDINATES ({})", units.length.name),
        "NO | <SEGMENT | UPPER X | UPPER Y | UPPER Z | LOWER X | LOWER Y | LOWER Z | C.G. X | C.G. Y | C.G. Z",
    );
    for segment in s.model.body().tree.segments() {
        let [upper, lower] = s.end_points_m(segment);
        let places = [upper, lower, s.cg_m(segment)].map(|place| units.length.vector(place.coords));
        table.row(label(s.model.body(), segment).into_iter().chain(places.into_iter().flatten()));
    }
    table
}

fn accelerations(s: &Sample<'_>, units: &Units) -> Table {
    let mut table = Table::new(
        format!(
            "2. ACCELERATION OF C.G., SEGMENT COORDINATES: TOTAL ({}), AND LESS GRAVITY AS AN ACCELEROMETER READS IT (G)",
            units.acceleration.name
        ),
        "NO | <SEGMENT | TOTAL X | TOTAL Y | TOTAL Z | RESULTANT | READS X | READS Y | READS Z | RESULTANT",
    );
    for segment in s.model.body().tree.segments() {
        let total = s.cg_acceleration_m_s2(segment);
        let reads = s.specific_force_m_s2(segment);
        let cells = label(s.model.body(), segment)
            .into_iter()
            .chain(units.acceleration.vector(total))
            .chain([units.acceleration.show(total.norm())])
            .chain(G.vector(reads))
            .chain([G.show(reads.norm())]);
        table.row(cells);
    }
    table
}

fn turning(s: &Sample<'_>) -> Table {
    let mut table = Table::new(
        "3, 4. ANGULAR ACCELERATION (RAD/S2) AND ANGULAR VELOCITY (RAD/S), SEGMENT COORDINATES",
        "NO | <SEGMENT | ACC X | ACC Y | ACC Z | VEL X | VEL Y | VEL Z",
    );
    for segment in s.model.body().tree.segments() {
        let acceleration = RAD_S2.vector(s.angular_acceleration_rad_s2(segment));
        let velocity = RAD_S.vector(s.angular_velocity_rad_s(segment));
        let cells = label(s.model.body(), segment).into_iter();
        table.row(cells.chain(acceleration).chain(velocity));
    }
    table
}

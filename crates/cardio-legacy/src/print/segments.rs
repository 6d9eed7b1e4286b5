//! Items 1 to 4: end points, accelerations, angular accelerations and velocities of the twelve segments.

use occupant_core::body::{Body, Segment};
use occupant_core::results::sample::Sample;
use occupant_units::unit::Unit::{Metre, MetrePerSecondSquared, RadianPerSecond, RadianPerSecondSquared};

use super::unit::g;
use super::{Pages, Table, Units};

/// Writes the segments' tables.
pub(crate) fn write(pages: &mut Pages, units: Units, s: &Sample<'_>) {
    let (l, a) = (units.of(Metre), units.of(MetrePerSecondSquared));
    table(
        s,
        units.heading("1. END POINTS AND C.G. OF SEGMENTS, VEHICLE COORDINATES ({})", &[Metre]),
        "UPPER X|UPPER Y|UPPER Z|LOWER X|LOWER Y|LOWER Z|C.G. X|C.G. Y|C.G. Z",
        |segment| {
            let [upper, lower] = s.end_points_m(segment);
            [upper, lower, s.cg_m(segment)].map(|place| l.vector(place.coords)).concat()
        },
    )
    .write(pages);
    table(
        s,
        units.heading(
            "2. ACCELERATION OF C.G., SEGMENT COORDINATES: TOTAL ({}), AND LESS GRAVITY AS AN ACCELEROMETER READS IT (G)",
            &[MetrePerSecondSquared],
        ),
        "TOTAL X|TOTAL Y|TOTAL Z|RESULTANT|READS X|READS Y|READS Z|RESULTANT",
        |segment| {
            let (total, reads) = (s.cg_acceleration_m_s2(segment), s.specific_force_m_s2(segment));
            let resultants = [a.show(total.norm()), g().show(reads.norm())];
            [&a.vector(total)[..], &resultants[..1], &g().vector(reads), &resultants[1..]].concat()
        },
    )
    .write(pages);
    table(
        s,
        "3, 4. ANGULAR ACCELERATION (RAD/S2) AND ANGULAR VELOCITY (RAD/S), SEGMENT COORDINATES".to_owned(),
        "ACC X|ACC Y|ACC Z|VEL X|VEL Y|VEL Z",
        |segment| {
            let acceleration = units.of(RadianPerSecondSquared).vector(s.angular_acceleration_rad_s2(segment));
            [acceleration, units.of(RadianPerSecond).vector(s.angular_velocity_rad_s(segment))].concat()
        },
    )
    .write(pages);
}

/// A table with a row for each segment.
fn table(s: &Sample<'_>, title: String, heads: &str, cells: impl Fn(Segment) -> Vec<String>) -> Table {
    let mut table = Table::new(title, &format!("NO|<SEGMENT|{heads}"));
    let body = s.model.body();
    for segment in body.tree.segments() {
        table.row_of(&[&label(body, segment), &cells(segment)]);
    }
    table
}

/// First cells of a segment's row.
pub(crate) fn label(body: &Body, segment: Segment) -> [String; 2] {
    [segment.number().to_string(), body.tree[segment].name.to_owned()]
}

//! Items 1 to 4: end points, accelerations, angular accelerations and velocities of the twelve segments.

use occupant_core::body::Segment;

use super::case::Case;
use super::message::Message;
use super::page::Pages;
use super::table::Table;
use super::unit::{G, RAD_S, RAD_S2, Units};
use crate::files::mcap::groups::SEGMENT;
use crate::files::mcap::topics;

/// Writes the segments' tables.
pub(crate) fn write(pages: &mut Pages, case: &Case, units: &Units, output: usize) -> Result<(), String> {
    let mut messages = Vec::new();
    for segment in Segment::ALL {
        let message = case.message(&topics::segment(segment), &SEGMENT, output)?;
        messages.push((segment, message));
    }
    end_points(&messages, units).write(pages);
    accelerations(&messages, units).write(pages);
    turning(&messages).write(pages);
    Ok(())
}

/// The first cells of a segment's row.
pub(crate) fn label(segment: Segment) -> [String; 2] {
    [segment.number().to_string(), segment.name().to_owned()]
}

fn end_points(messages: &[(Segment, Message<'_>)], units: &Units) -> Table {
    let mut table = Table::new(
        format!("1. END POINTS AND C.G. OF SEGMENTS, VEHICLE COORDINATES ({})", units.length.name),
        &[
            "NO", "<SEGMENT", "UPPER X", "UPPER Y", "UPPER Z", "LOWER X", "LOWER Y", "LOWER Z", "C.G. X", "C.G. Y",
            "C.G. Z",
        ],
    );
    for (segment, m) in messages {
        let places = ["upper_end_vehicle_m", "lower_end_vehicle_m", "cg_vehicle_m"];
        let places = places.map(|name| units.length.vector(m.components(name)));
        table.row(label(*segment).into_iter().chain(places.into_iter().flatten()));
    }
    table
}

fn accelerations(messages: &[(Segment, Message<'_>)], units: &Units) -> Table {
    let mut table = Table::new(
        format!(
            "2. ACCELERATION OF C.G., SEGMENT COORDINATES: TOTAL ({}), AND LESS GRAVITY AS AN ACCELEROMETER READS IT (G)",
            units.acceleration.name
        ),
        &["NO", "<SEGMENT", "TOTAL X", "TOTAL Y", "TOTAL Z", "RESULTANT", "READS X", "READS Y", "READS Z", "RESULTANT"],
    );
    for (segment, m) in messages {
        let total = m.components("cg_acceleration_segment_m_s2");
        let reads = m.components("accelerometer_segment_m_s2");
        let cells = label(*segment)
            .into_iter()
            .chain(units.acceleration.vector(total))
            .chain([units.acceleration.show(magnitude(total))])
            .chain(G.vector(reads))
            .chain([G.show(m.number("accelerometer_resultant_m_s2"))]);
        table.row(cells);
    }
    table
}

fn turning(messages: &[(Segment, Message<'_>)]) -> Table {
    let mut table = Table::new(
        "3, 4. ANGULAR ACCELERATION (RAD/S2) AND ANGULAR VELOCITY (RAD/S), SEGMENT COORDINATES",
        &["NO", "<SEGMENT", "ACC X", "ACC Y", "ACC Z", "VEL X", "VEL Y", "VEL Z"],
    );
    for (segment, m) in messages {
        let acceleration = RAD_S2.vector(m.components("angular_acceleration_segment_rad_s2"));
        let velocity = RAD_S.vector(m.components("angular_velocity_segment_rad_s"));
        let cells = label(*segment).into_iter();
        table.row(cells.chain(acceleration).chain(velocity));
    }
    table
}

/// √(x² + y² + z²).
pub(crate) fn magnitude([x, y, z]: [f64; 3]) -> f64 {
    (x * x + y * y + z * z).sqrt()
}

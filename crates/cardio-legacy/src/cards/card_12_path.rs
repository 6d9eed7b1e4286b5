//! Series 12: the vehicle's path, in the space axes of the vehicle program (CAL): X forward, Y right, Z down.

use super::SeriesLayout;
use super::field::{DEGREE, INCH, ONE, SECOND, field};

pub(super) fn series() -> SeriesLayout {
    let place = |axis: &str, key: &str| {
        field(format!("CAL{axis}"), INCH, format!("{axis} of the vehicle's centre of gravity")).key(key)
    };
    SeriesLayout::new(12, "path of the vehicle (needed if MREAD = 0)")
        .first(12, "7F10.0,I10", [field("NVPOS", ONE, "number of stations, one card each")])
        .counted(
            "8F10.0",
            [
                field("CALT", SECOND, "time of the station").key("path.columns.t"),
                place("X", "path.columns.x"),
                place("Y", "path.columns.y"),
                place("Z", "path.columns.z"),
                field("CALPH", DEGREE, "roll").key("path.columns.roll"),
                field("CALTH", DEGREE, "pitch").key("path.columns.pitch"),
                field("CALPS", DEGREE, "yaw").key("path.columns.yaw"),
            ],
        )
}

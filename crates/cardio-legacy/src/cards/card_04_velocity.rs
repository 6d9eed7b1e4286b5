//! Series 4: velocity of the seated occupant.

use super::SeriesLayout;
use super::field::{INCH_PER_SECOND, field};

pub(super) fn series() -> SeriesLayout {
    let velocity = |axis: &str| field(format!("V{axis}VC"), INCH_PER_SECOND, format!("velocity along vehicle {axis}"));
    SeriesLayout::new(4, "initial velocity of the occupant (not needed if NPOS = 1)").first(
        4,
        "7F10.0,I10",
        ["X", "Y", "Z"].map(velocity),
    )
}

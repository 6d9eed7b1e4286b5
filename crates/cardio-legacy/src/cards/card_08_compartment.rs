//! Series 8: dimensions of the compartment and its 22 points in the vehicle's X–Z plane.

use super::SeriesLayout;
use super::field::{INCH, field};
use crate::rule::Rule;

pub(super) fn series() -> SeriesLayout {
    let coordinate = |axis, n| field(format!("{axis}V({n})"), INCH, format!("vehicle {axis} of point {n}"));
    SeriesLayout::new(8, "dimensions and points of the compartment")
        .first(
            8,
            "7F10.0,I8",
            [
                field("VCW", INCH, "half of the compartment's width").positive("half of a width"),
                field("VRW", INCH, "half of the roof's width").positive("half of a width"),
                field("SWP", INCH, "distance of the steering wheel's centre from the centre line"),
                field("DSW", INCH, "diameter of the steering wheel")
                    .wrong_if(Rule::Unlikely, |v| v <= 0.0, "without a diameter there is no steering wheel")
                    .expected("a diameter in inches", "punch the diameter; surface 25 is left out otherwise"),
            ],
        )
        .then("8F10.0", (1..=22).flat_map(|n| ["X", "Z"].map(|axis| coordinate(axis, n))))
}

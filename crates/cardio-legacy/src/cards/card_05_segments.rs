//! Series 5: body segments.

use super::SeriesLayout;
use super::field::{Field, INCH, INERTIA, MASS, ONE, field};
use crate::rule::Rule;

pub(super) fn series() -> SeriesLayout {
    let inertia = |axis: &str| {
        field(format!("{axis}IN"), INERTIA, format!("moment of inertia about the segment's {axis} axis"))
            .positive("moment of inertia of a segment")
    };
    let rho = "distance of the centre of gravity from the lower end";
    let shoulder = field("XLS", INCH, "half of the shoulder width").key("body.shoulder_half_width");
    let hip = field("XLH", INCH, "half of the hip width").key("body.hip_half_width");
    SeriesLayout::new(5, "body segments").first(5, "7F10.0,I10", [shoulder, hip].map(half_width)).each(
        12,
        "I2,8X,6F10.0",
        [
            field("NSEG", ONE, "number of the segment, 1–12, right-justified"),
            field("XLE", INCH, "length of the segment")
                .positive("length of a segment")
                .wrong_if(Rule::Unlikely, |v| v > 30.0, "longer than any segment of a body")
                .expected("a length in inches", "look for the decimal point"),
            field("RHO", INCH, rho).not_negative(rho),
            field("XM", MASS, "mass").positive("mass of a segment"),
            inertia("X"),
            inertia("Y"),
            inertia("Z"),
        ],
    )
}

fn half_width(width: Field) -> Field {
    let what = width.meaning.clone();
    width
        .positive(&what)
        .wrong_if(Rule::Unlikely, |v| v > 12.0 || v > 0.0 && v < 1.0, "no half width of a body")
        .expected("1 to 12 inches", "look for the decimal point")
}

//! Series 5: body segments.

use super::SeriesLayout;
use super::field::{INCH, INERTIA, MASS, ONE, field};

pub(super) fn series() -> SeriesLayout {
    let inertia = |axis: &str| {
        field(format!("{axis}IN"), INERTIA, format!("moment of inertia about the segment's {axis} axis"))
            .positive("moment of inertia of a segment")
    };
    let rho = "distance of the centre of gravity from the lower end";
    let shoulder = field("XLS", INCH, "half of the shoulder width").key("body.shoulder_half_width");
    let hip = field("XLH", INCH, "half of the hip width").key("body.hip_half_width");
    SeriesLayout::new(5, "body segments")
        .first(5, "7F10.0,I10", [shoulder, hip].map(|width| width.clone().positive(&width.meaning)))
        .each(
            12,
            "I2,8X,6F10.0",
            [
                field("NSEG", ONE, "number of the segment, 1–12, right-justified"),
                field("XLE", INCH, "length of the segment").positive("length of a segment"),
                field("RHO", INCH, rho).not_negative(rho),
                field("XM", MASS, "mass").positive("mass of a segment"),
                inertia("X"),
                inertia("Y"),
                inertia("Z"),
            ],
        )
}

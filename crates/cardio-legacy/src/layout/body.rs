//! The body: segments (series 5) and contact spheres (series 7).

use super::{CardLayout, Repeat, SeriesLayout, Unit, card, integer, ncard, real};

pub(super) const SEGMENTS: SeriesLayout = SeriesLayout {
    number: 5,
    ncard: Some(5),
    title: "body segments",
    cards: &[
        card(
            'a',
            "7F10.0,I10",
            &[
                real(1, "XLS", Unit::Inch, "half of the shoulder width"),
                real(11, "XLH", Unit::Inch, "half of the hip width"),
                ncard("card number 5"),
            ],
        ),
        CardLayout {
            letter: Some('b'),
            format: "I2,8X,6F10.0",
            repeat: Repeat::Each { count: 12 },
            fields: &[
                integer(1, 2, "NSEG", "number of the segment, 1–12, right-justified"),
                real(11, "XLE", Unit::Inch, "length of the segment"),
                real(21, "RHO", Unit::Inch, "distance of the centre of gravity from the lower end"),
                real(31, "XM", Unit::Mass, "mass"),
                real(41, "XIN", Unit::Inertia, "moment of inertia about the segment's X axis"),
                real(51, "YIN", Unit::Inertia, "moment of inertia about the segment's Y axis"),
                real(61, "ZIN", Unit::Inertia, "moment of inertia about the segment's Z axis"),
            ],
        },
    ],
};

pub(super) const SPHERES: SeriesLayout = SeriesLayout {
    number: 7,
    ncard: Some(7),
    title: "radii of the contact spheres",
    cards: &[
        card('a', "7F10.0,I8", &[ncard("card number 7; the format's I8 would end in column 78")]),
        card(
            'b',
            "8F10.0",
            &[
                real(1, "RS(1)", Unit::Inch, "radius of sphere 1, head"),
                real(11, "RS(2)", Unit::Inch, "radius of sphere 2, chest"),
                real(21, "RS(3)", Unit::Inch, "radius of sphere 3, pelvis"),
                real(31, "RS(4)", Unit::Inch, "radius of sphere 4, right shoulder"),
                real(41, "RS(5)", Unit::Inch, "radius of sphere 5, left shoulder"),
                real(51, "RS(6)", Unit::Inch, "radius of sphere 6, right elbow"),
                real(61, "RS(7)", Unit::Inch, "radius of sphere 7, left elbow"),
                real(71, "RS(8)", Unit::Inch, "radius of sphere 8, right hand"),
            ],
        ),
        card(
            'c',
            "8F10.0",
            &[
                real(1, "RS(9)", Unit::Inch, "radius of sphere 9, left hand"),
                real(11, "RS(10)", Unit::Inch, "radius of sphere 10, right thigh"),
                real(21, "RS(11)", Unit::Inch, "radius of sphere 11, left thigh"),
                real(31, "RS(12)", Unit::Inch, "radius of sphere 12, right knee"),
                real(41, "RS(13)", Unit::Inch, "radius of sphere 13, left knee"),
                real(51, "RS(14)", Unit::Inch, "radius of sphere 14, right shin"),
                real(61, "RS(15)", Unit::Inch, "radius of sphere 15, left shin"),
                real(71, "RS(16)", Unit::Inch, "radius of sphere 16, right foot"),
            ],
        ),
        card('d', "8F10.0", &[real(1, "RS(17)", Unit::Inch, "radius of sphere 17, left foot")]),
    ],
};

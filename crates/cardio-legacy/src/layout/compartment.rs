//! The compartment (series 8).

use super::{SeriesLayout, Unit, card, ncard, real};

pub(super) const POINTS: SeriesLayout = SeriesLayout {
    number: 8,
    ncard: Some(8),
    title: "dimensions and points of the compartment",
    cards: &[
        card(
            'a',
            "7F10.0,I8",
            &[
                real(1, "VCW", Unit::Inch, "half of the compartment's width"),
                real(11, "VRW", Unit::Inch, "half of the roof's width"),
                real(21, "SWP", Unit::Inch, "distance of the steering wheel's centre from the centre line"),
                real(31, "DSW", Unit::Inch, "diameter of the steering wheel"),
                ncard("card number 8; the format's I8 would end in column 78"),
            ],
        ),
        card(
            'b',
            "8F10.0",
            &[
                real(1, "XV(1)", Unit::Inch, "vehicle X of point 1"),
                real(11, "ZV(1)", Unit::Inch, "vehicle Z of point 1"),
                real(21, "XV(2)", Unit::Inch, "vehicle X of point 2"),
                real(31, "ZV(2)", Unit::Inch, "vehicle Z of point 2"),
                real(41, "XV(3)", Unit::Inch, "vehicle X of point 3"),
                real(51, "ZV(3)", Unit::Inch, "vehicle Z of point 3"),
                real(61, "XV(4)", Unit::Inch, "vehicle X of point 4"),
                real(71, "ZV(4)", Unit::Inch, "vehicle Z of point 4"),
            ],
        ),
        card(
            'c',
            "8F10.0",
            &[
                real(1, "XV(5)", Unit::Inch, "vehicle X of point 5"),
                real(11, "ZV(5)", Unit::Inch, "vehicle Z of point 5"),
                real(21, "XV(6)", Unit::Inch, "vehicle X of point 6"),
                real(31, "ZV(6)", Unit::Inch, "vehicle Z of point 6"),
                real(41, "XV(7)", Unit::Inch, "vehicle X of point 7"),
                real(51, "ZV(7)", Unit::Inch, "vehicle Z of point 7"),
                real(61, "XV(8)", Unit::Inch, "vehicle X of point 8"),
                real(71, "ZV(8)", Unit::Inch, "vehicle Z of point 8"),
            ],
        ),
        card(
            'd',
            "8F10.0",
            &[
                real(1, "XV(9)", Unit::Inch, "vehicle X of point 9"),
                real(11, "ZV(9)", Unit::Inch, "vehicle Z of point 9"),
                real(21, "XV(10)", Unit::Inch, "vehicle X of point 10"),
                real(31, "ZV(10)", Unit::Inch, "vehicle Z of point 10"),
                real(41, "XV(11)", Unit::Inch, "vehicle X of point 11"),
                real(51, "ZV(11)", Unit::Inch, "vehicle Z of point 11"),
                real(61, "XV(12)", Unit::Inch, "vehicle X of point 12"),
                real(71, "ZV(12)", Unit::Inch, "vehicle Z of point 12"),
            ],
        ),
        card(
            'e',
            "8F10.0",
            &[
                real(1, "XV(13)", Unit::Inch, "vehicle X of point 13"),
                real(11, "ZV(13)", Unit::Inch, "vehicle Z of point 13"),
                real(21, "XV(14)", Unit::Inch, "vehicle X of point 14"),
                real(31, "ZV(14)", Unit::Inch, "vehicle Z of point 14"),
                real(41, "XV(15)", Unit::Inch, "vehicle X of point 15"),
                real(51, "ZV(15)", Unit::Inch, "vehicle Z of point 15"),
                real(61, "XV(16)", Unit::Inch, "vehicle X of point 16"),
                real(71, "ZV(16)", Unit::Inch, "vehicle Z of point 16"),
            ],
        ),
        card(
            'f',
            "8F10.0",
            &[
                real(1, "XV(17)", Unit::Inch, "vehicle X of point 17"),
                real(11, "ZV(17)", Unit::Inch, "vehicle Z of point 17"),
                real(21, "XV(18)", Unit::Inch, "vehicle X of point 18"),
                real(31, "ZV(18)", Unit::Inch, "vehicle Z of point 18"),
                real(41, "XV(19)", Unit::Inch, "vehicle X of point 19"),
                real(51, "ZV(19)", Unit::Inch, "vehicle Z of point 19"),
                real(61, "XV(20)", Unit::Inch, "vehicle X of point 20"),
                real(71, "ZV(20)", Unit::Inch, "vehicle Z of point 20"),
            ],
        ),
        card(
            'g',
            "8F10.0",
            &[
                real(1, "XV(21)", Unit::Inch, "vehicle X of point 21"),
                real(11, "ZV(21)", Unit::Inch, "vehicle Z of point 21"),
                real(21, "XV(22)", Unit::Inch, "vehicle X of point 22"),
                real(31, "ZV(22)", Unit::Inch, "vehicle Z of point 22"),
            ],
        ),
    ],
};

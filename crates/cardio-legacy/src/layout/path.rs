//! The vehicle's path (series 12), in the space axes of the vehicle program (CAL): X forward, Y right, Z down.

use super::{CardLayout, Repeat, SeriesLayout, Unit, card, ncard, real};

pub(super) const PATH: SeriesLayout = SeriesLayout {
    number: 12,
    ncard: Some(12),
    title: "path of the vehicle (needed if MREAD = 0)",
    cards: &[
        card(
            'a',
            "7F10.0,I10",
            &[real(1, "NVPOS", Unit::One, "number of stations, one card each"), ncard("card number 12")],
        ),
        CardLayout {
            letter: Some('b'),
            format: "8F10.0",
            repeat: Repeat::Counted,
            fields: &[
                real(1, "CALT", Unit::Second, "time of the station"),
                real(11, "CALX", Unit::Inch, "X of the vehicle's centre of gravity"),
                real(21, "CALY", Unit::Inch, "Y of the vehicle's centre of gravity"),
                real(31, "CALZ", Unit::Inch, "Z of the vehicle's centre of gravity"),
                real(41, "CALPH", Unit::Degree, "roll"),
                real(51, "CALTH", Unit::Degree, "pitch"),
                real(61, "CALPS", Unit::Degree, "yaw"),
            ],
        },
    ],
};

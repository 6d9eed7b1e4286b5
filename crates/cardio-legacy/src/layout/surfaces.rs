//! The materials of the 25 surfaces (series 9).

use super::{CardLayout, Repeat, SeriesLayout, Unit, card, integer, ncard, real};

pub(super) const SURFACES: SeriesLayout = SeriesLayout {
    number: 9,
    ncard: Some(9),
    title: "deformation and friction of the 25 surfaces",
    cards: &[
        card('a', "7F10.0,I10", &[ncard("card number 9")]),
        CardLayout {
            letter: Some('b'),
            format: "I2,8X,6F10.0",
            repeat: Repeat::Each { count: 25 },
            fields: &[
                integer(1, 2, "J", "number of the surface, 1–25, right-justified"),
                real(11, "STIF1", Unit::Stiffness, "first and smaller stiffness"),
                real(21, "STIF2", Unit::Stiffness, "second and larger stiffness"),
                real(31, "DELB", Unit::Inch, "deformation at which the second stiffness begins"),
                real(41, "AMU1", Unit::One, "fraction of the energy given back up to DELB"),
                real(51, "AMU2", Unit::One, "fraction of the energy given back beyond DELB"),
                real(61, "COFR", Unit::One, "coefficient of friction"),
            ],
        },
    ],
};

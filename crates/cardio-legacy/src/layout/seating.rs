//! Seating (series 10).

use super::{SeriesLayout, Unit, card, ncard, real};

pub(super) const SEATING: SeriesLayout = SeriesLayout {
    number: 10,
    ncard: Some(10),
    title: "seating of the occupant (not needed if NPOS = 1)",
    cards: &[
        card(
            'a',
            "7F10.0,I8",
            &[
                real(1, "NOPTSP", Unit::One, "seat: 1 driver, 2 right front, 3 left rear, 4 right rear"),
                real(11, "GAMA1", Unit::Degree, "γ₁, middle torso"),
                real(21, "GAMA2", Unit::Degree, "γ₂, upper torso"),
                real(31, "GAMA3", Unit::Degree, "γ₃, head"),
                real(41, "GAMA4", Unit::Degree, "γ₄, lower torso"),
                real(51, "GAMA5", Unit::Degree, "γ₅, upper arms"),
                real(61, "ALPHA1", Unit::Degree, "α₇ = α₈, forearms (the report prints α₁)"),
                ncard("card number 10; the format's I8 would end in column 78"),
            ],
        ),
        card(
            'b',
            "8F10.0",
            &[
                real(1, "XHPV", Unit::Inch, "vehicle X of the heels"),
                real(11, "ZHPV", Unit::Inch, "vehicle Z of the heels"),
            ],
        ),
    ],
};

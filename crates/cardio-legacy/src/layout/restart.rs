//! What an extension of an earlier run needs (series 14).

use super::{CardLayout, Field, Format, Repeat, SeriesLayout, Unit, card, integer, ncard, real};
use crate::columns::Columns;

pub(super) const PAIRS: SeriesLayout = SeriesLayout {
    number: 14,
    ncard: Some(14),
    title: "pairs that no longer touch, to extend an earlier run",
    cards: &[
        card(
            'a',
            "7F10.0,I10",
            &[real(1, "NOCRD", Unit::One, "number of pairs, one card each"), ncard("card number 14")],
        ),
        CardLayout {
            letter: Some('b'),
            format: "2I2,F6.0",
            repeat: Repeat::Counted,
            fields: &[
                integer(1, 2, "J", "sphere, 1–17, right-justified"),
                integer(3, 4, "K", "surface, 1–25, right-justified"),
                Field {
                    columns: Columns::new(5, 10),
                    format: Format::Real,
                    variable: "NARRY",
                    unit: Unit::One,
                    description: "0 or blank: the sphere has passed the surface's edge",
                },
            ],
        },
    ],
};

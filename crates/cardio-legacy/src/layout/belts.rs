//! Belts (series 13).

use super::{SeriesLayout, Unit, card, ncard, real};

pub(super) const BELTS: SeriesLayout = SeriesLayout {
    number: 13,
    ncard: Some(13),
    title: "lap and torso belt (left out for an unrestrained occupant)",
    cards: &[
        card(
            'a',
            "7F10.0,I10",
            &[
                real(1, "NOPBLT", Unit::One, "1 lap belt, 2 torso belt, 3 both"),
                real(11, "P1(1,1)", Unit::Inch, "vehicle X of the lap belt's anchor 1"),
                real(21, "P1(1,2)", Unit::Inch, "vehicle Y of the lap belt's anchor 1"),
                real(31, "P1(1,3)", Unit::Inch, "vehicle Z of the lap belt's anchor 1"),
                real(41, "P2(1,1)", Unit::Inch, "vehicle X of the lap belt's anchor 2"),
                real(51, "P2(1,2)", Unit::Inch, "vehicle Y of the lap belt's anchor 2"),
                real(61, "P2(1,3)", Unit::Inch, "vehicle Z of the lap belt's anchor 2"),
                ncard("card number 13"),
            ],
        ),
        card(
            'b',
            "8F10.0",
            &[
                real(1, "P1(2,1)", Unit::Inch, "vehicle X of the torso belt's anchor 1"),
                real(11, "P1(2,2)", Unit::Inch, "vehicle Y of the torso belt's anchor 1"),
                real(21, "P1(2,3)", Unit::Inch, "vehicle Z of the torso belt's anchor 1"),
                real(31, "P2(2,1)", Unit::Inch, "vehicle X of the torso belt's anchor 2"),
                real(41, "P2(2,2)", Unit::Inch, "vehicle Y of the torso belt's anchor 2"),
                real(51, "P2(2,3)", Unit::Inch, "vehicle Z of the torso belt's anchor 2"),
                real(61, "SLACK(1)", Unit::Inch, "initial slack of the lap belt"),
                real(71, "SLACK(2)", Unit::Inch, "initial slack of the torso belt"),
            ],
        ),
        card(
            'c',
            "8F10.0",
            &[
                real(1, "SK1(1)", Unit::Stiffness, "lap belt: first slope of force over elongation"),
                real(11, "SK2(1)", Unit::Stiffness, "lap belt: second slope"),
                real(21, "DELC(1)", Unit::Inch, "lap belt: elongation where the slope changes from SK1(1) to SK2(1)"),
                real(31, "SK1(2)", Unit::Stiffness, "torso belt: first slope (the report prints SK1(1))"),
                real(41, "SK2(2)", Unit::Stiffness, "torso belt: second slope"),
                real(51, "DELC(2)", Unit::Inch, "torso belt: elongation where the slope changes from SK1(2) to SK2(2)"),
            ],
        ),
    ],
};

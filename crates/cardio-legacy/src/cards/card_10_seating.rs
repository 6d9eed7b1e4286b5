//! Series 10: seating of the occupant.

use super::SeriesLayout;
use super::field::{DEGREE, Field, INCH, ONE, field};
use crate::rule::Rule;

/// A seat by NOPTSP − 1: its name in scenarios, its cushion and back by surface number, and whether it is on the left.
pub(crate) struct Seat {
    pub name: &'static str,
    pub cushion: u32,
    pub back: u32,
    pub is_left: bool,
}

/// The four seats of the cards.
pub(crate) const SEATS: [Seat; 4] = [
    Seat { name: "driver", cushion: 13, back: 14, is_left: true },
    Seat { name: "right_front", cushion: 13, back: 14, is_left: false },
    Seat { name: "left_rear", cushion: 18, back: 19, is_left: true },
    Seat { name: "right_rear", cushion: 18, back: 19, is_left: false },
];

/// The fields of the posture's angles.
pub(crate) const POSTURE: [&str; 6] = ["GAMA1", "GAMA2", "GAMA3", "GAMA4", "GAMA5", "ALPHA1"];

pub(super) fn series() -> SeriesLayout {
    SeriesLayout::new(10, "seating of the occupant (not needed if NPOS = 1)")
        .first(
            10,
            "7F10.0,I8",
            [
                field("NOPTSP", ONE, "seat: 1 driver, 2 right front, 3 left rear, 4 right rear")
                    .wrong_if(Rule::Impossible, |v| ![1.0, 2.0, 3.0, 4.0].contains(&v), "this names no seat")
                    .expected(
                        "1. driver, 2. right front, 3. left rear, 4. right rear",
                        "punch it with its decimal point",
                    ),
                angle("GAMA1", "middle_torso", "γ₁, middle torso"),
                angle("GAMA2", "upper_torso", "γ₂, upper torso"),
                angle("GAMA3", "head", "γ₃, head"),
                angle("GAMA4", "lower_torso", "γ₄, lower torso"),
                angle("GAMA5", "upper_arms", "γ₅, upper arms"),
                angle("ALPHA1", "elbows", "α₇ = α₈, forearms (the report prints α₁)")
                    .wrong_if(Rule::Unlikely, |v| v > 0.0, "the elbow bends backward")
                    .expected("a negative angle: it brings the hand forward", "look for a missing minus sign"),
            ],
        )
        .then("8F10.0", [field("XHPV", INCH, "vehicle X of the heels"), field("ZHPV", INCH, "vehicle Z of the heels")])
}

fn angle(variable: &str, part: &str, meaning: &str) -> Field {
    field(variable, DEGREE, meaning)
        .key(format!("posture.{part}"))
        .wrong_if(Rule::Unlikely, |v| v.abs() > 180.0, "more than half a turn")
        .expected("an angle in degrees within ±180", "look for the decimal point")
}

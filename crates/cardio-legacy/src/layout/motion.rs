//! The occupant's motion at the initial time: series 4 (velocity when seated) and 6 (exact state).

use super::{SeriesLayout, Unit, card, ncard, only_card, real};

pub(super) const VELOCITY: SeriesLayout = SeriesLayout {
    number: 4,
    ncard: Some(4),
    title: "initial velocity of the occupant (not needed if NPOS = 1)",
    cards: &[only_card(
        "7F10.0,I10",
        &[
            real(1, "VXVC", Unit::InchPerSecond, "velocity along vehicle X"),
            real(11, "VYVC", Unit::InchPerSecond, "velocity along vehicle Y"),
            real(21, "VZVC", Unit::InchPerSecond, "velocity along vehicle Z"),
            ncard("card number 4"),
        ],
    )],
};

pub(super) const COORDINATES: SeriesLayout = SeriesLayout {
    number: 6,
    ncard: Some(6),
    title: "initial generalized coordinates and velocities (needed only if NPOS = 1)",
    cards: &[
        card(
            'a',
            "7F10.0,I10",
            &[
                real(1, "BETA4", Unit::Radian, "initial angle between middle and upper torso"),
                real(11, "BETA7", Unit::Radian, "initial angle between middle and lower torso"),
                real(21, "BLTLEO(1)", Unit::Inch, "initial length of the lap belt if in use"),
                real(31, "BLTLEO(2)", Unit::Inch, "initial length of the torso belt if in use"),
                ncard("card number 6"),
            ],
        ),
        card(
            'b',
            "8F10.0",
            &[
                real(1, "Q0(1)", Unit::Inch, "X′ of the reference point T1 in space"),
                real(11, "Q0(2)", Unit::Inch, "Y′ of T1"),
                real(21, "Q0(3)", Unit::Inch, "Z′ of T1"),
                real(31, "Q0(4)", Unit::Radian, "Euler angle φ of segment 1"),
                real(41, "Q0(5)", Unit::Radian, "Euler angle θ of segment 1"),
                real(51, "Q0(6)", Unit::Radian, "Euler angle ψ of segment 1"),
                real(61, "Q0(7)", Unit::Radian, "Euler angle φ of segment 2"),
                real(71, "Q0(8)", Unit::Radian, "Euler angle θ of segment 2"),
            ],
        ),
        card(
            'c',
            "8F10.0",
            &[
                real(1, "Q0(9)", Unit::Radian, "Euler angle ψ of segment 2"),
                real(11, "Q0(10)", Unit::Radian, "Euler angle φ of segment 3"),
                real(21, "Q0(11)", Unit::Radian, "Euler angle θ of segment 3"),
                real(31, "Q0(12)", Unit::Radian, "Euler angle ψ of segment 3"),
                real(41, "Q0(13)", Unit::Radian, "Euler angle φ of segment 4"),
                real(51, "Q0(14)", Unit::Radian, "Euler angle θ of segment 4"),
                real(61, "Q0(15)", Unit::Radian, "Euler angle ψ of segment 4"),
                real(71, "Q0(16)", Unit::Radian, "Euler angle φ of segment 5"),
            ],
        ),
        card(
            'd',
            "8F10.0",
            &[
                real(1, "Q0(17)", Unit::Radian, "Euler angle θ of segment 5"),
                real(11, "Q0(18)", Unit::Radian, "Euler angle ψ of segment 5"),
                real(21, "Q0(19)", Unit::Radian, "Euler angle φ of segment 6"),
                real(31, "Q0(20)", Unit::Radian, "Euler angle θ of segment 6"),
                real(41, "Q0(21)", Unit::Radian, "Euler angle ψ of segment 6"),
                real(51, "Q0(22)", Unit::Radian, "α₇, forearm 7 relative to upper arm 5"),
                real(61, "Q0(23)", Unit::Radian, "α₈, forearm 8 relative to upper arm 6"),
                real(71, "Q0(24)", Unit::Radian, "Euler angle φ of segment 9"),
            ],
        ),
        card(
            'e',
            "8F10.0",
            &[
                real(1, "Q0(25)", Unit::Radian, "Euler angle θ of segment 9"),
                real(11, "Q0(26)", Unit::Radian, "Euler angle ψ of segment 9"),
                real(21, "Q0(27)", Unit::Radian, "Euler angle φ of segment 10"),
                real(31, "Q0(28)", Unit::Radian, "Euler angle θ of segment 10"),
                real(41, "Q0(29)", Unit::Radian, "Euler angle ψ of segment 10"),
                real(51, "Q0(30)", Unit::Radian, "α₁₁, lower leg 11 relative to thigh 9"),
                real(61, "Q0(31)", Unit::Radian, "α₁₂, lower leg 12 relative to thigh 10"),
            ],
        ),
        card(
            'f',
            "8F10.0",
            &[
                real(1, "QDO(1)", Unit::InchPerSecond, "rate of X′ of the reference point T1 in space"),
                real(11, "QDO(2)", Unit::InchPerSecond, "rate of Y′ of T1"),
                real(21, "QDO(3)", Unit::InchPerSecond, "rate of Z′ of T1"),
                real(31, "QDO(4)", Unit::RadianPerSecond, "rate of Euler angle φ of segment 1"),
                real(41, "QDO(5)", Unit::RadianPerSecond, "rate of Euler angle θ of segment 1"),
                real(51, "QDO(6)", Unit::RadianPerSecond, "rate of Euler angle ψ of segment 1"),
                real(61, "QDO(7)", Unit::RadianPerSecond, "rate of Euler angle φ of segment 2"),
                real(71, "QDO(8)", Unit::RadianPerSecond, "rate of Euler angle θ of segment 2"),
            ],
        ),
        card(
            'g',
            "8F10.0",
            &[
                real(1, "QDO(9)", Unit::RadianPerSecond, "rate of Euler angle ψ of segment 2"),
                real(11, "QDO(10)", Unit::RadianPerSecond, "rate of Euler angle φ of segment 3"),
                real(21, "QDO(11)", Unit::RadianPerSecond, "rate of Euler angle θ of segment 3"),
                real(31, "QDO(12)", Unit::RadianPerSecond, "rate of Euler angle ψ of segment 3"),
                real(41, "QDO(13)", Unit::RadianPerSecond, "rate of Euler angle φ of segment 4"),
                real(51, "QDO(14)", Unit::RadianPerSecond, "rate of Euler angle θ of segment 4"),
                real(61, "QDO(15)", Unit::RadianPerSecond, "rate of Euler angle ψ of segment 4"),
                real(71, "QDO(16)", Unit::RadianPerSecond, "rate of Euler angle φ of segment 5"),
            ],
        ),
        card(
            'h',
            "8F10.0",
            &[
                real(1, "QDO(17)", Unit::RadianPerSecond, "rate of Euler angle θ of segment 5"),
                real(11, "QDO(18)", Unit::RadianPerSecond, "rate of Euler angle ψ of segment 5"),
                real(21, "QDO(19)", Unit::RadianPerSecond, "rate of Euler angle φ of segment 6"),
                real(31, "QDO(20)", Unit::RadianPerSecond, "rate of Euler angle θ of segment 6"),
                real(41, "QDO(21)", Unit::RadianPerSecond, "rate of Euler angle ψ of segment 6"),
                real(51, "QDO(22)", Unit::RadianPerSecond, "rate of α₇, forearm 7 relative to upper arm 5"),
                real(61, "QDO(23)", Unit::RadianPerSecond, "rate of α₈, forearm 8 relative to upper arm 6"),
                real(71, "QDO(24)", Unit::RadianPerSecond, "rate of Euler angle φ of segment 9"),
            ],
        ),
        card(
            'i',
            "8F10.0",
            &[
                real(1, "QDO(25)", Unit::RadianPerSecond, "rate of Euler angle θ of segment 9"),
                real(11, "QDO(26)", Unit::RadianPerSecond, "rate of Euler angle ψ of segment 9"),
                real(21, "QDO(27)", Unit::RadianPerSecond, "rate of Euler angle φ of segment 10"),
                real(31, "QDO(28)", Unit::RadianPerSecond, "rate of Euler angle θ of segment 10"),
                real(41, "QDO(29)", Unit::RadianPerSecond, "rate of Euler angle ψ of segment 10"),
                real(51, "QDO(30)", Unit::RadianPerSecond, "rate of α₁₁, lower leg 11 relative to thigh 9"),
                real(61, "QDO(31)", Unit::RadianPerSecond, "rate of α₁₂, lower leg 12 relative to thigh 10"),
            ],
        ),
    ],
};

//! Joints and gravity (series 11). Dampings carry in·lbf·s; the report prints lb.-sec. beside in.-lb.-sec.

use super::{SeriesLayout, Unit, card, ncard, real};

pub(super) const JOINTS: SeriesLayout = SeriesLayout {
    number: 11,
    ncard: Some(11),
    title: "joints and gravity",
    cards: &[
        card(
            'a',
            "7F10.0,I10",
            &[
                real(1, "XJNN", Unit::RotaryDamping, "damping of the neck"),
                real(11, "AGSN", Unit::Radian, "neck: angle of the full stop"),
                real(21, "XJSN", Unit::RotaryDamping, "neck: damping at AGSN"),
                real(31, "AGNN", Unit::Radian, "neck: angle where damping begins to grow"),
                real(41, "XJNS", Unit::RotaryDamping, "damping of a shoulder"),
                real(51, "AGSS", Unit::Radian, "shoulder: angle of the full stop"),
                real(61, "XJSS", Unit::RotaryDamping, "shoulder: damping at AGSS"),
                ncard("card number 11"),
            ],
        ),
        card(
            'b',
            "8F10.0",
            &[
                real(1, "AGNS", Unit::Radian, "shoulder: angle where damping begins to grow"),
                real(11, "XJNUB", Unit::RotaryDamping, "damping of the upper back"),
                real(21, "AGSUB", Unit::Radian, "upper back: angle of the full stop"),
                real(31, "XJSUB", Unit::RotaryDamping, "upper back: damping at AGSUB"),
                real(41, "AGNUB", Unit::Radian, "upper back: angle where damping begins to grow"),
                real(51, "XJNLB", Unit::RotaryDamping, "damping of the lower back"),
                real(61, "AGSLB", Unit::Radian, "lower back: angle of the full stop"),
                real(71, "XJSLB", Unit::RotaryDamping, "lower back: damping at AGSLB"),
            ],
        ),
        card(
            'c',
            "8F10.0",
            &[
                real(1, "AGNLB", Unit::Radian, "lower back: angle where damping begins to grow"),
                real(11, "XJNH", Unit::RotaryDamping, "damping of a hip"),
                real(21, "AGSH", Unit::Radian, "hip: angle of the full stop"),
                real(31, "XJSH", Unit::RotaryDamping, "hip: damping at AGSH"),
                real(41, "AGNH", Unit::Radian, "hip: angle where damping begins to grow"),
                real(51, "XJNE", Unit::RotaryDamping, "damping of an elbow"),
                real(61, "AGSE(1)", Unit::Radian, "elbow: full stop when closing, about −130°"),
                real(71, "AGSE(2)", Unit::Radian, "elbow: full stop when straightening, about −10°"),
            ],
        ),
        card(
            'd',
            "8F10.0",
            &[
                real(1, "XJSE", Unit::RotaryDamping, "elbow: damping at AGSE(1) and AGSE(2)"),
                real(11, "AGNE(1)", Unit::Radian, "elbow: angle where damping begins to grow when closing"),
                real(21, "AGNE(2)", Unit::Radian, "elbow: angle where damping begins to grow when straightening"),
                real(31, "XJNK", Unit::RotaryDamping, "damping of a knee"),
                real(41, "AGSK(1)", Unit::Radian, "knee: full stop when straightening, about 0°"),
                real(51, "AGSK(2)", Unit::Radian, "knee: full stop when closing, about 140°"),
                real(61, "XJSK", Unit::RotaryDamping, "knee: damping at AGSK(1) and AGSK(2)"),
                real(71, "AGNK(1)", Unit::Radian, "knee: angle where damping begins to grow when straightening"),
            ],
        ),
        card(
            'e',
            "8F10.0",
            &[
                real(1, "AGNK(2)", Unit::Radian, "knee: angle where damping begins to grow when closing"),
                real(11, "SPJNT4", Unit::RotaryStiffness, "stiffness of the spine's spring in the upper back"),
                real(21, "SPJNT7", Unit::RotaryStiffness, "stiffness of the spine's spring in the lower back"),
                real(31, "GR", Unit::InchPerSecondSquared, "acceleration due to gravity, 386.04, or 0 for none"),
            ],
        ),
    ],
};

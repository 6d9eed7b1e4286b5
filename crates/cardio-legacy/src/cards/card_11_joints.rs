//! Series 11: joints and gravity. Dampings carry in·lbf·s; the report prints lb.-sec. beside in.-lb.-sec.

use super::SeriesLayout;
use super::field::{Field, INCH_PER_SECOND_SQUARED, RADIAN, ROTARY_DAMPING, ROTARY_STIFFNESS, field};
use crate::rule::Rule;

/// A kind of joint: the letters with which its fields end (XJN damping, XJS damping at the full stop, AGN and AGS angles where
/// the stop begins and is full), and its name in scenarios.
pub(crate) struct Joint {
    pub letters: &'static str,
    pub key: &'static str,
    /// Stiffness and rest angle of the spring, of the two joints that have one.
    pub spring: Option<[&'static str; 2]>,
    /// Elbows and knees are hinges with two stops, indexed (1) and (2).
    pub is_hinge: bool,
}

/// The joints in the order of the cards.
pub(crate) const JOINTS: [Joint; 7] = [
    Joint { letters: "N", key: "neck", spring: None, is_hinge: false },
    Joint { letters: "S", key: "shoulders", spring: None, is_hinge: false },
    Joint { letters: "UB", key: "upper_back", spring: Some(["SPJNT4", "BETA4"]), is_hinge: false },
    Joint { letters: "LB", key: "lower_back", spring: Some(["SPJNT7", "BETA7"]), is_hinge: false },
    Joint { letters: "H", key: "hips", spring: None, is_hinge: false },
    Joint { letters: "E", key: "elbows", spring: None, is_hinge: true },
    Joint { letters: "K", key: "knees", spring: None, is_hinge: true },
];

impl Joint {
    /// The field of its damping before the stops.
    pub(crate) fn damping(&self) -> String {
        format!("XJN{}", self.letters)
    }

    /// The field of its damping at the full stop.
    pub(crate) fn full_damping(&self) -> String {
        format!("XJS{}", self.letters)
    }

    /// The fields of its stops, the lower one of a hinge first: angle where it begins, angle where it is full.
    pub(crate) fn stops(&self) -> Vec<[String; 2]> {
        let sides: &[&str] = if self.is_hinge { &["(1)", "(2)"] } else { &[""] };
        sides.iter().map(|side| ["AGN", "AGS"].map(|angle| format!("{angle}{}{side}", self.letters))).collect()
    }
}

pub(super) fn series() -> SeriesLayout {
    let springs_and_gravity = [
        spring("SPJNT4", "stiffness of the spine's spring in the upper back").key("joints.upper_back.stiffness"),
        spring("SPJNT7", "stiffness of the spine's spring in the lower back").key("joints.lower_back.stiffness"),
        gravity(),
    ];
    let mut fields = balls().into_iter().chain(hinges()).chain(springs_and_gravity);
    SeriesLayout::new(11, "joints and gravity").first(11, "7F10.0,I10", fields.by_ref().take(7)).then("8F10.0", fields)
}

fn balls() -> [Field; 20] {
    [
        damping("XJNN", "damping of the neck").key("joints.neck.damping"),
        angle("AGSN", "neck: angle of the full stop"),
        damping("XJSN", "neck: damping at AGSN"),
        angle("AGNN", "neck: angle where damping begins to grow"),
        damping("XJNS", "damping of a shoulder").key("joints.shoulders.damping"),
        angle("AGSS", "shoulder: angle of the full stop"),
        damping("XJSS", "shoulder: damping at AGSS"),
        angle("AGNS", "shoulder: angle where damping begins to grow"),
        damping("XJNUB", "damping of the upper back").key("joints.upper_back.damping"),
        angle("AGSUB", "upper back: angle of the full stop"),
        damping("XJSUB", "upper back: damping at AGSUB"),
        angle("AGNUB", "upper back: angle where damping begins to grow"),
        damping("XJNLB", "damping of the lower back").key("joints.lower_back.damping"),
        angle("AGSLB", "lower back: angle of the full stop"),
        damping("XJSLB", "lower back: damping at AGSLB"),
        angle("AGNLB", "lower back: angle where damping begins to grow"),
        damping("XJNH", "damping of a hip").key("joints.hips.damping"),
        angle("AGSH", "hip: angle of the full stop"),
        damping("XJSH", "hip: damping at AGSH"),
        angle("AGNH", "hip: angle where damping begins to grow"),
    ]
}

fn hinges() -> [Field; 12] {
    [
        damping("XJNE", "damping of an elbow").key("joints.elbows.damping"),
        negative(angle("AGSE(1)", "elbow: full stop when closing, about −130°")),
        angle("AGSE(2)", "elbow: full stop when straightening, about −10°"),
        damping("XJSE", "elbow: damping at AGSE(1) and AGSE(2)"),
        negative(angle("AGNE(1)", "elbow: angle where damping begins to grow when closing")),
        angle("AGNE(2)", "elbow: angle where damping begins to grow when straightening"),
        damping("XJNK", "damping of a knee").key("joints.knees.damping"),
        angle("AGSK(1)", "knee: full stop when straightening, about 0°"),
        angle("AGSK(2)", "knee: full stop when closing, about 140°"),
        damping("XJSK", "knee: damping at AGSK(1) and AGSK(2)"),
        angle("AGNK(1)", "knee: angle where damping begins to grow when straightening"),
        angle("AGNK(2)", "knee: angle where damping begins to grow when closing"),
    ]
}

fn damping(variable: &str, meaning: &str) -> Field {
    field(variable, ROTARY_DAMPING, meaning).not_negative("a damping takes energy away")
}

fn angle(variable: &str, meaning: &str) -> Field {
    field(variable, RADIAN, meaning).radians()
}

fn negative(angle: Field) -> Field {
    angle
        .wrong_if(Rule::Unlikely, |v| v > 0.0, "elbows bend towards negative angles")
        .expected("about −130° in radians, −2.27", "look for a missing minus sign")
}

fn spring(variable: &str, meaning: &str) -> Field {
    field(variable, ROTARY_STIFFNESS, meaning).not_negative("stiffness of a spring")
}

fn gravity() -> Field {
    let expected = "386.04 in/s², or 0 for none";
    field("GR", INCH_PER_SECOND_SQUARED, "acceleration due to gravity, 386.04, or 0 for none")
        .key("gravity")
        .not_negative("gravity is given by its magnitude")
        .wrong_if(Rule::LooksLikeOtherUnit, |g| (31.0..33.5).contains(&g), "this looks like ft/s²")
        .expected(expected, "multiply by 12")
        .wrong_if(Rule::LooksLikeOtherUnit, |g| (9.7..9.9).contains(&g), "this looks like m/s²")
        .expected(expected, "punch 386.04")
        .wrong_if(Rule::LooksLikeOtherUnit, |g| g == 1.0, "this looks like a number of g")
        .expected(expected, "punch 386.04")
        .wrong_if(Rule::Unlikely, |g| g > 0.0 && !is_a_gravity(g), "not the earth's gravity")
        .expected(expected, "punch 386.04")
}

/// Whether a number is the earth's gravity in some unit.
fn is_a_gravity(g: f64) -> bool {
    g == 1.0 || [9.7..9.9, 31.0..33.5, 380.0..392.0].iter().any(|range| range.contains(&g))
}

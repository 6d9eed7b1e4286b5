//! Series 11: joints and gravity. Dampings carry in·lbf·s; the report prints lb.-sec. beside in.-lb.-sec.

use super::SeriesLayout;
use super::field::{Field, INCH_PER_SECOND_SQUARED, RADIAN, ROTARY_DAMPING, ROTARY_STIFFNESS, field};
use crate::rule::Rule;

/// A kind of joint: the letters with which its fields end (XJN damping, XJS damping at the full stop, AGN and AGS angles where
/// the stop begins and is full), and its name in scenarios. Elbows and knees are hinges with two stops, indexed (1) and (2).
pub(crate) struct Joint {
    pub letters: &'static str,
    pub key: &'static str,
    /// Stiffness and rest angle of the spring, of the two joints that have one.
    pub spring: Option<[&'static str; 2]>,
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
    let [neck, shoulder, upper_back, lower_back, hip, elbow, knee] = &JOINTS;
    let elbow_stops = [("closing", ", about −130°"), ("straightening", ", about −10°")];
    let knee_stops = [("straightening", ", about 0°"), ("closing", ", about 140°")];
    let mut fields = Vec::new();
    fields.extend(ball(neck, "the neck", "neck"));
    fields.extend(ball(shoulder, "a shoulder", "shoulder"));
    fields.extend(ball(upper_back, "the upper back", "upper back"));
    fields.extend(ball(lower_back, "the lower back", "lower back"));
    fields.extend(ball(hip, "a hip", "hip"));
    fields.extend(hinge(elbow, "an elbow", "elbow", elbow_stops));
    fields.extend(hinge(knee, "a knee", "knee", knee_stops));
    for joint in [upper_back, lower_back] {
        fields.extend(spring(joint));
    }
    fields.push(gravity());
    let further = fields.split_off(7);
    SeriesLayout::new(11, "joints and gravity").first(11, "7F10.0,I10", fields).then("8F10.0", further)
}

fn damping(variable: String, meaning: String) -> Field {
    field(variable, ROTARY_DAMPING, meaning).not_negative("a damping takes energy away")
}

fn ball(joint: &Joint, of: &str, name: &str) -> Vec<Field> {
    let mut fields =
        vec![damping(joint.damping(), format!("damping of {of}")).key(format!("joints.{}.damping", joint.key))];
    for [begin, full] in joint.stops() {
        fields.push(field(&*full, RADIAN, format!("{name}: angle of the full stop")).radians());
        fields.push(damping(joint.full_damping(), format!("{name}: damping at {full}")));
        fields.push(field(begin, RADIAN, format!("{name}: angle where damping begins to grow")).radians());
    }
    fields
}

/// Two angles of the full stops, the damping there, and two angles where it begins to grow; `ways` says when each is met.
fn hinge(joint: &Joint, of: &str, name: &str, ways: [(&str, &str); 2]) -> Vec<Field> {
    let stops = joint.stops();
    let angle = |variable: &str, meaning: String| {
        let angle = field(variable, RADIAN, meaning).radians();
        // The first stop of an elbow is met at −130°.
        if !variable.ends_with("E(1)") {
            return angle;
        }
        angle
            .wrong_if(Rule::Unlikely, |v| v > 0.0, "elbows bend towards negative angles")
            .expected("about −130° in radians, −2.27", "look for a missing minus sign")
    };
    let mut fields =
        vec![damping(joint.damping(), format!("damping of {of}")).key(format!("joints.{}.damping", joint.key))];
    for ([_, full], (way, about)) in stops.iter().zip(ways) {
        fields.push(angle(full, format!("{name}: full stop when {way}{about}")));
    }
    fields.push(damping(joint.full_damping(), format!("{name}: damping at {} and {}", stops[0][1], stops[1][1])));
    for ([begin, _], (way, _)) in stops.iter().zip(ways) {
        fields.push(angle(begin, format!("{name}: angle where damping begins to grow when {way}")));
    }
    fields
}

fn spring(joint: &Joint) -> Option<Field> {
    let [stiffness, _] = joint.spring?;
    let place = joint.key.replace('_', " ");
    let spring = field(stiffness, ROTARY_STIFFNESS, format!("stiffness of the spine's spring in the {place}"));
    Some(spring.key(format!("joints.{}.stiffness", joint.key)).not_negative("stiffness of a spring"))
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

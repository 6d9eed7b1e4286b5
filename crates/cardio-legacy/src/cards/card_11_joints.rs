//! Series 11: joints and gravity. Dampings carry in·lbf·s; the report prints lb.-sec. beside in.-lb.-sec.

use super::SeriesLayout;
use super::field::{Field, INCH_PER_SECOND_SQUARED, RADIAN, ROTARY_DAMPING, ROTARY_STIFFNESS, field};
use crate::rule::Rule;

/// A kind of joint.
pub(crate) struct Joint {
    /// Suffix of its fields: XJN damping, XJS damping at the full stop, AGN and AGS angles at which the stop begins and
    /// is full.
    pub letters: &'static str,
    /// Its name in scenarios.
    pub key: &'static str,
    /// Name in text, with its article.
    called: [&'static str; 2],
    /// Stiffness and rest angle of the spring, of the two joints that have one.
    pub spring: Option<[&'static str; 2]>,
    /// Elbows and knees are hinges with two stops, indexed (1) and (2): direction, and approximate angle of the full
    /// stop.
    hinge: Option<[[&'static str; 2]; 2]>,
}

const fn ball(letters: &'static str, key: &'static str, called: [&'static str; 2]) -> Joint {
    Joint { letters, key, called, spring: None, hinge: None }
}

/// The joints in the order of the cards.
pub(crate) const JOINTS: [Joint; 7] = [
    ball("N", "neck", ["the", "neck"]),
    ball("S", "shoulders", ["a", "shoulder"]),
    Joint { spring: Some(["SPJNT4", "BETA4"]), ..ball("UB", "upper_back", ["the", "upper back"]) },
    Joint { spring: Some(["SPJNT7", "BETA7"]), ..ball("LB", "lower_back", ["the", "lower back"]) },
    ball("H", "hips", ["a", "hip"]),
    Joint {
        hinge: Some([["closing", "−130°"], ["straightening", "−10°"]]), ..ball("E", "elbows", ["an", "elbow"])
    },
    Joint { hinge: Some([["straightening", "0°"], ["closing", "140°"]]), ..ball("K", "knees", ["a", "knee"]) },
];

impl Joint {
    /// Field of its damping before the stops.
    pub(crate) fn damping(&self) -> String {
        format!("XJN{}", self.letters)
    }

    /// Field of its damping at the full stop.
    pub(crate) fn full_damping(&self) -> String {
        format!("XJS{}", self.letters)
    }

    /// Whether it is a hinge, with a lower and an upper stop.
    pub(crate) fn is_hinge(&self) -> bool {
        self.hinge.is_some()
    }

    /// Fields of its stops, the lower one of a hinge first: angle of the beginning, angle of the full stop.
    pub(crate) fn stops(&self) -> Vec<[String; 2]> {
        let sides: &[&str] = if self.is_hinge() { &["(1)", "(2)"] } else { &[""] };
        sides.iter().map(|side| ["AGN", "AGS"].map(|angle| format!("{angle}{}{side}", self.letters))).collect()
    }

    /// Its fields in the order of the cards, without springs.
    fn fields(&self) -> Vec<Field> {
        let [article, name] = self.called;
        let stops = self.stops();
        let full: Vec<&str> = stops.iter().map(|[_, full]| full.as_str()).collect();
        let normal = damping(self.damping(), format!("damping of {article} {name}"));
        let at_stop = damping(self.full_damping(), format!("{name}: damping at {}", full.join(" and ")));
        let angles = |which: usize| (0..stops.len()).map(move |side| (which, side));
        let angle = |(which, side): (usize, usize)| {
            let meaning = match (which, self.hinge) {
                (0, None) => "angle where damping begins to grow".to_owned(),
                (0, Some(ways)) => format!("angle where damping begins to grow when {}", ways[side][0]),
                (_, None) => "angle of the full stop".to_owned(),
                (_, Some(ways)) => format!("full stop when {}, about {}", ways[side][0], ways[side][1]),
            };
            let angle = field(&stops[side][which], RADIAN, format!("{name}: {meaning}")).radians();
            if self.key == "elbows" && side == 0 { negative(angle) } else { angle }
        };
        let key = format!("joints.{}.damping", self.key);
        [normal.key(key)].into_iter().chain(angles(1).map(angle)).chain([at_stop]).chain(angles(0).map(angle)).collect()
    }

    /// The stiffness of its spring, if it has one.
    fn stiffness(&self) -> Option<Field> {
        let [variable, _] = self.spring?;
        let meaning = format!("stiffness of the spine's spring in {}", self.called.join(" "));
        let stiffness = field(variable, ROTARY_STIFFNESS, meaning).not_negative("stiffness of a spring");
        Some(stiffness.key(format!("joints.{}.stiffness", self.key)))
    }
}

pub(super) fn series() -> SeriesLayout {
    let springs = JOINTS.iter().filter_map(Joint::stiffness);
    let mut fields = JOINTS.iter().flat_map(Joint::fields).chain(springs).chain([gravity()]);
    SeriesLayout::new(11, "joints and gravity").first(11, "7F10.0,I10", fields.by_ref().take(7)).then("8F10.0", fields)
}

fn damping(variable: String, meaning: String) -> Field {
    field(variable, ROTARY_DAMPING, meaning).not_negative("a damping takes energy away")
}

fn negative(angle: Field) -> Field {
    angle
        .wrong_if(Rule::Unlikely, |v| v > 0.0, "elbows bend towards negative angles")
        .expected("about −130° in radians, −2.27", "look for a missing minus sign")
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

/// Whether a number is standard gravity in some unit.
fn is_a_gravity(g: f64) -> bool {
    g == 1.0 || [9.7..9.9, 31.0..33.5, 380.0..392.0].iter().any(|range| range.contains(&g))
}

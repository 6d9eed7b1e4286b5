//! Series 6: the exact initial state, q₁–q₃₁ and their rates.

use std::f64::consts::PI;

use super::field::{Field, INCH, INCH_PER_SECOND, RADIAN, RADIAN_PER_SECOND, field};
use super::{JOINTS, Joint, SeriesLayout};
use crate::rule::Rule;

/// `lengths` are on the first card after the rest angles.
pub(super) fn series(lengths: impl IntoIterator<Item = Field>) -> SeriesLayout {
    let is_place = |n: usize| n <= 3;
    let coordinate = |(n, meaning): (usize, String)| {
        let field = |unit| field(format!("Q0({n})"), unit, meaning);
        if is_place(n) { field(INCH) } else { field(RADIAN).radians() }
    };
    let rate = |(n, meaning): (usize, String)| {
        let unit = if is_place(n) { INCH_PER_SECOND } else { RADIAN_PER_SECOND };
        field(format!("QDO({n})"), unit, format!("rate of {meaning}"))
    };
    let rest = JOINTS.iter().filter_map(rest_angle);
    SeriesLayout::new(6, "initial generalized coordinates and velocities (needed only if NPOS = 1)")
        .first(6, "7F10.0,I10", rest.chain(lengths))
        .then("8F10.0", (1..).zip(meanings()).map(coordinate))
        .then("8F10.0", (1..).zip(meanings()).map(rate))
}

/// β₀ of the spring of a back joint.
fn rest_angle(joint: &Joint) -> Option<Field> {
    let [_, variable] = joint.spring?;
    let torso = joint.key.trim_end_matches("_back");
    let angle = field(variable, RADIAN, format!("initial angle between middle and {torso} torso"))
        .key(format!("joints.{}.rest_angle", joint.key))
        .wrong_if(Rule::Impossible, |v| !(0.0..=PI).contains(&v), "an angle between two axes")
        .expected("0 to π, in radians", "divide degrees by 57.2958");
    Some(angle)
}

/// Meanings of the 31 coordinates.
fn meanings() -> Vec<String> {
    let euler = |segments: [u8; 2]| {
        let triple = |n| ["φ", "θ", "ψ"].map(|angle| format!("Euler angle {angle} of segment {n}"));
        (segments[0]..=segments[1]).flat_map(triple)
    };
    let mut meanings: Vec<String> =
        ["X′ of the reference point T1 in space", "Y′ of T1", "Z′ of T1"].map(Into::into).into();
    meanings.extend(euler([1, 6]));
    meanings.extend(["α₇, forearm 7 relative to upper arm 5", "α₈, forearm 8 relative to upper arm 6"].map(Into::into));
    meanings.extend(euler([9, 10]));
    meanings
        .extend(["α₁₁, lower leg 11 relative to thigh 9", "α₁₂, lower leg 12 relative to thigh 10"].map(Into::into));
    meanings
}

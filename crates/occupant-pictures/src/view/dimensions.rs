//! Distances in a picture: lines with an arrow at both ends, and labels that keep clear of each other.

use nalgebra::Point3;
use occupant_units::trig;

use super::panel::{Pen, arrow};
use super::projection::View;
use crate::font::{self, Weight};
use crate::svg::{Anchor, Svg, Text};

/// Colour of lines and labels.
const COLOR: &str = "#0f5c8a";
/// Fraction of its length below which a distance is drawn in another view instead.
const SEEN: f64 = 0.9;
/// Height of a label, user units.
const SIZE: f64 = 9.5;
/// Distance of labels from a line, and step by which they move to avoid overlap, user units.
const ASIDE: f64 = 3.0;
const STEP: f64 = 4.0;
/// Number of positions tried for a label.
const TRIES: i32 = 60;

/// Draws the distances in the plane of a view.
pub fn draw(svg: &mut Svg, pen: &Pen<'_>, view: View, corner: [f64; 2], corner_m: [f64; 2]) {
    let mut taken: Vec<[f64; 4]> = Vec::new();
    for own in &pen.strip.dimensions {
        let ends_m = own.ends_m.map(Point3::from);
        let long_m = (ends_m[1] - ends_m[0]).norm();
        let ends = ends_m.map(|end| {
            let flat = view.place(&end);
            [0, 1].map(|i| corner[i] + pen.scale * (flat[i] - corner_m[i]))
        });
        let seen = trig::hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]);
        let is_side_on = view == own_view(&own.ends_m);
        if !is_side_on || seen < SEEN * pen.scale * long_m || seen < 2.0 {
            continue;
        }
        if own.is_angle {
            svg.segment(
                ends[0],
                ends[1],
                &format!("stroke=\"{COLOR}\" stroke-width=\"0.8\" stroke-dasharray=\"6 2 1 2\""),
            );
        } else {
            let middle = [0, 1].map(|i| 0.5 * (ends[0][i] + ends[1][i]));
            svg.segment(ends[0], ends[1], &format!("stroke=\"{COLOR}\" stroke-width=\"0.8\""));
            ends.iter().for_each(|end| arrow(svg, middle, *end, COLOR));
        }
        label(svg, &own.label, ends, &mut taken);
    }
}

/// The view in which a distance is drawn: lateral ones from the front, all others from the side.
fn own_view([a, b]: &[[f64; 3]; 2]) -> View {
    let across = (b[1] - a[1]).abs();
    if across > (b[0] - a[0]).abs().max((b[2] - a[2]).abs()) { View::Front } else { View::Side }
}

/// Writes a label beside the middle of a line, clear of earlier labels.
fn label(svg: &mut Svg, text: &str, ends: [[f64; 2]; 2], taken: &mut Vec<[f64; 4]>) {
    let width = font::width(text, SIZE, Weight::Regular);
    let middle = [0, 1].map(|i| 0.5 * (ends[0][i] + ends[1][i]));
    let along = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
    let is_upright = along[1].abs() > along[0].abs();
    // beside an upright line, over a level one; farther along or away where others stand
    let place = |n: i32| {
        let by = STEP * f64::from((n + 1) / 2) * if n % 2 == 0 { 1.0 } else { -1.0 };
        if is_upright {
            [middle[0] + ASIDE, middle[1] + by]
        } else {
            [middle[0] - 0.5 * width, middle[1] - ASIDE - by.abs()]
        }
    };
    let of = |at: [f64; 2]| [at[0], at[1] - SIZE, at[0] + width, at[1] + 1.0];
    let clear = |own: [f64; 4]| taken.iter().all(|o| own[2] < o[0] || o[2] < own[0] || own[3] < o[1] || o[3] < own[1]);
    let at = (0..TRIES).map(place).find(|at| clear(of(*at))).unwrap_or_else(|| place(0));
    taken.push(of(at));
    let style = Text {
        size: SIZE,
        fill: COLOR,
        anchor: Anchor::Start,
        weight: Weight::Regular,
        turn_deg: 0.0,
        halo: Some("#ffffff"),
    };
    svg.text(at, text, &style);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_keep_clear_of_each_other() {
        let mut svg = Svg::new(500.0, 500.0, "test");
        let mut taken = Vec::new();
        for _ in 0..8 {
            label(&mut svg, "panel ahead 623", [[100.0, 200.0], [300.0, 200.0]], &mut taken);
        }
        for (i, a) in taken.iter().enumerate() {
            for b in &taken[i + 1..] {
                assert!(a[2] < b[0] || b[2] < a[0] || a[3] < b[1] || b[3] < a[1], "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn what_lies_across_is_read_from_ahead() {
        assert_eq!(own_view(&[[0.0, 0.0, 0.0], [0.0, -0.36, 0.0]]), View::Front);
        assert_eq!(own_view(&[[0.0, -0.36, 0.0], [0.33, -0.36, 0.0]]), View::Side);
    }
}

//! Scales and legend below the panels, and the axes beside each row.

use super::layout::{Layout, MARGIN};
use super::panel::{BAG, CONTACT, Pen, SLACK, SURFACE, TAUT, arrow};
use super::projection::View;
use crate::font::{self, Weight};
use crate::svg::{Anchor, Svg, Text};
use occupant_units::trig;

const SMALL: Text<'_> =
    Text { size: 11.0, fill: "#333333", anchor: Anchor::Start, weight: Weight::Regular, turn_deg: 0.0, halo: None };

/// Name and axes of a view, left of its first panel.
pub fn name_row(svg: &mut Svg, view: View, y: f64) {
    let name = Text { size: 12.0, weight: Weight::Bold, ..SMALL };
    svg.text([8.0, y + 14.0], view.name(), &name);
    svg.text([8.0, y + 28.0], view.from(), &Text { size: 9.5, ..SMALL });
    let centre = [38.0, y + 58.0];
    for (row, (axis, sense)) in view.axes().into_iter().enumerate() {
        let mut tip = centre;
        tip[row] += 22.0 * sense;
        arrow(svg, centre, tip, "#333333");
        let mut at = centre;
        at[row] += 30.0 * sense;
        let style = Text { size: 10.0, anchor: Anchor::Middle, ..SMALL };
        svg.text([at[0], at[1] + 3.5], axis, &style);
    }
}

/// Scales, symbols, and the caption.
pub fn draw(svg: &mut Svg, layout: &Layout, pen: &Pen<'_>) {
    let y = layout.foot() + 22.0;
    let mut row = Row { svg, x: MARGIN, y, end: layout.width - MARGIN };
    let bar_m = round_length(90.0 / layout.scale);
    row.scale_bar(bar_m * layout.scale, &format!("{bar_m} m"));
    if let Some(per_n) = pen.per_n {
        let force_n = round_length(60.0 / per_n);
        let label = format!("contact force on the body, {} kN", force_n / 1e3);
        row.force(force_n * per_n, &label);
    }
    let lines = pen.strip.moments.iter().flat_map(|m| &m.lines);
    let (taut, slack): (Vec<_>, Vec<_>) = lines.partition(|line| line.force_n > 0.0);
    for (found, color, label) in [(!taut.is_empty(), TAUT, "belt under load"), (!slack.is_empty(), SLACK, "slack belt")]
    {
        if found {
            row.stroke(&format!("stroke=\"{color}\" stroke-width=\"1.8\""), label);
        }
    }
    if pen.strip.moments.iter().any(|m| !m.sections.is_empty()) {
        row.stroke(&format!("stroke=\"{BAG}\" stroke-width=\"1.4\""), "air bag");
    }
    if pen.strip.model.setup().surface_names().next().is_some() {
        let line = format!("stroke=\"{SURFACE}\"");
        row.stroke(&format!("{line} stroke-width=\"1.6\""), "surface, edge-on");
        let dashed = format!("{line} stroke-width=\"0.8\" stroke-dasharray=\"3 2\"");
        row.stroke(&dashed, "surface in front of the body");
    }
    let print = Text { size: 9.5, fill: "#666666", ..SMALL };
    let at = [MARGIN, layout.height - 12.0];
    svg.text(at, &pen.strip.origin, &print);
}

/// Symbols with labels, in lines filled from the left.
struct Row<'s> {
    svg: &'s mut Svg,
    x: f64,
    y: f64,
    end: f64,
}

impl Row<'_> {
    fn scale_bar(&mut self, length: f64, label: &str) {
        let [x, y] = self.sign(length, label);
        let black = "stroke=\"#333333\" stroke-width=\"1.4\"";
        self.svg.segment([x, y], [x + length, y], black);
        for end in [x, x + length] {
            self.svg.segment([end, y - 4.0], [end, y + 4.0], black);
        }
    }

    fn force(&mut self, length: f64, label: &str) {
        let from = self.sign(length, label);
        self.svg.circle(from, 1.7, &format!("fill=\"{CONTACT}\""));
        arrow(self.svg, from, [from[0] + length, from[1]], CONTACT);
    }

    fn stroke(&mut self, look: &str, label: &str) {
        let from = self.sign(24.0, label);
        self.svg.segment(from, [from[0] + 24.0, from[1]], look);
    }

    /// Writes the label of a symbol of this length; the start of the symbol.
    fn sign(&mut self, length: f64, label: &str) -> [f64; 2] {
        let wide = length + 6.0 + font::width(label, SMALL.size, SMALL.weight);
        if self.x + wide > self.end {
            (self.x, self.y) = (MARGIN, self.y + 18.0);
        }
        let from = [self.x, self.y];
        self.svg.text([from[0] + length + 6.0, from[1] + 4.0], label, &SMALL);
        self.x += wide + 20.0;
        from
    }
}

/// The largest of 1, 2, 5 times a power of ten that is at most `most`.
fn round_length(most: f64) -> f64 {
    let power = trig::pow(10.0_f64, trig::log10(most).floor());
    let steps = [5.0, 2.0, 1.0].map(|s| s * power);
    steps.into_iter().find(|s| *s <= most).unwrap_or(power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_have_round_lengths() {
        for (most, round) in [(0.7, 0.5), (0.3, 0.2), (1.0, 1.0), (9_900.0, 5_000.0)] {
            assert!((round_length(most) - round).abs() < 1e-9 * round);
        }
    }
}

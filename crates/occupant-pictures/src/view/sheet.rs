//! The sheet: title, panels with their times, scales.

use std::ops::Range;

use super::layout::{DIMENSIONS_PANEL, FILM_PANEL, HEADING, Layout, MARGIN, PANEL};
use super::panel::Pen;
use super::{Strip, dimensions, legend, panel};
use crate::body::{Snapshot, parts};
use crate::font::Weight;
use crate::svg::{Anchor, Svg, Text};
use placed_text::trimmed;

/// Length of the arrow of the largest contact force, user units.
const LONGEST_FORCE: f64 = 70.0;

/// The strip as SVG.
pub fn draw(strip: &Strip<'_>) -> String {
    let all = strip.moments.len();
    // one panel alone, or one with distances to read, has room to be large
    let panel = if strip.dimensions.is_empty() { PANEL } else { DIMENSIONS_PANEL };
    sheet(strip, &Layout::of(strip, all, panel), 0..all)
}

/// The frames of a film as SVG, one per moment, with the same window and scales.
pub fn frames<'s>(strip: &'s Strip<'_>) -> impl Fn(usize) -> String + Sync + 's {
    let layout = Layout::of(strip, 1, FILM_PANEL);
    move |moment| sheet(strip, &layout, moment..moment + 1)
}

fn sheet(strip: &Strip<'_>, layout: &Layout, shown: Range<usize>) -> String {
    let title = &strip.model.setup().title;
    let mut svg = Svg::new(layout.width, layout.height, title);
    svg.rect(0.0, 0.0, layout.width, layout.height, "fill=\"#ffffff\"");
    let heading = Text { size: HEADING.0, weight: HEADING.1, ..Text::default() };
    svg.text([MARGIN, 24.0], title, &heading);
    let axes = "Vehicle axes: X forward, Y right, Z down. One scale in all panels.";
    let small = Text { size: 10.5, fill: "#555555", ..Text::default() };
    svg.text([MARGIN, 41.0], axes, &small);
    let parts = parts(strip.model.body());
    let pen = Pen { strip, parts: &parts, scale: layout.scale, per_n: force_scale(strip) };
    for (place, moment) in strip.moments[shown].iter().enumerate() {
        draw_moment(&mut svg, layout, &pen, place, moment);
    }
    legend::draw(&mut svg, layout, &pen);
    svg.finish()
}

/// User units per newton, for the largest force of all moments; none without contacts.
fn force_scale(strip: &Strip<'_>) -> Option<f64> {
    let contacts = strip.moments.iter().flat_map(|m| &m.contacts);
    let greatest = contacts.map(|c| c.force_n.norm()).fold(0.0, f64::max);
    (greatest > 0.0).then(|| LONGEST_FORCE / greatest)
}

/// The column of one moment.
fn draw_moment(svg: &mut Svg, layout: &Layout, pen: &Pen<'_>, place: usize, moment: &Snapshot) {
    let [x, y] = layout.head(place);
    let label = Text { size: 13.0, weight: Weight::Bold, anchor: Anchor::Middle, ..Text::default() };
    let middle = x + 0.5 * layout.column;
    svg.text([middle, y + 16.0], &time_label(moment.time_s), &label);
    for (row, &view) in pen.strip.views.iter().enumerate() {
        let (corner, [width, height]) = layout.panel(place, row);
        if layout.begins_block(place) {
            legend::name_row(svg, view, corner[1]);
        }
        let [x, y] = corner;
        let name = format!("panel-{place}-{}", view.name());
        svg.begin_clip(&name, x, y, width, height);
        let corner_m = layout.window.corner_m(view);
        panel::draw(svg, pen, moment, view, corner, corner_m);
        let is_first = pen.strip.moments.first().is_some_and(|first| std::ptr::eq(first, moment));
        if is_first {
            dimensions::draw(svg, pen, view, corner, corner_m);
        }
        svg.end();
        svg.rect(x, y, width, height, "fill=\"none\" stroke=\"#cccccc\"");
    }
}

/// `40 ms`, with as many decimals (up to three) as the time has.
fn time_label(time_s: f64) -> String {
    let text = trimmed(time_s * 1e3, 3);
    let text = if text == "-0" { "0" } else { &text };
    format!("{text} ms")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_labelled_in_milliseconds() {
        assert_eq!(time_label(0.04), "40 ms");
        assert_eq!(time_label(0.0125), "12.5 ms");
        assert_eq!(time_label(-1e-9), "0 ms");
        assert_eq!(time_label(0.1 + 0.2), "300 ms");
    }
}

//! One figure in a rectangle.

use super::curve::strokes;
use super::figure::{Axis, Curve, Figure, LIMIT, Mark};
use super::legend::{Legend, shortened};
use super::scale::Scale;
use crate::font::Weight;
use crate::{Anchor, Svg, Text, font};

const TITLE: f64 = 14.0;
const LABEL: f64 = 12.0;
const TICK: f64 = 11.0;
const EDGE: f64 = 10.0;
const TICK_MARK: f64 = 4.0;
const GRID: &str = "stroke=\"#e4e4e4\" stroke-width=\"1\"";
const ZERO: &str = "stroke=\"#888888\" stroke-width=\"1\"";
const FRAME: &str = "fill=\"none\" stroke=\"#444444\" stroke-width=\"1\"";

/// Largest fraction of the figure's width for words at the vertical axis.
const WORDS: f64 = 0.42;

/// Height of the area below the axes of a figure of this width.
pub fn legend_height(figure: &Figure, width: f64) -> f64 {
    Legend::new(figure, width - 2.0 * EDGE).height()
}

/// A figure's axes on the page.
struct Page {
    /// Upper left corner of the plotting area.
    corner: [f64; 2],
    size: [f64; 2],
    x: Scale,
    y: Scale,
}

/// Draws a figure into a rectangle; `below` is the height of the legend, common to a row of figures.
pub fn draw(svg: &mut Svg, figure: &Figure, [left, top]: [f64; 2], [width, height]: [f64; 2], below: f64) {
    let title = shortened(&figure.title, TITLE, Weight::Bold, width - 2.0 * EDGE);
    let style = Text { size: TITLE, weight: Weight::Bold, anchor: Anchor::Middle, ..Text::default() };
    svg.begin("");
    svg.tip(&figure.title);
    svg.text([left + 0.5 * width, top + EDGE + TITLE], &title, &style);
    let upper = top + EDGE + TITLE + 10.0;
    let bottom = top + height - below - EDGE;
    match figure.extent() {
        None => nothing(svg, figure, [left + EDGE, upper], [width - 2.0 * EDGE, bottom - upper]),
        Some(extent) => {
            let page = Page::new(figure, extent, [left, upper], [width, bottom - upper]);
            page.axes(svg, figure, left);
            page.curves(svg, figure);
        }
    }
    let legend = Legend::new(figure, width - 2.0 * EDGE);
    legend.draw(svg, [left + EDGE, bottom + 2.0]);
    svg.end();
}

fn nothing(svg: &mut Svg, figure: &Figure, [left, top]: [f64; 2], [width, height]: [f64; 2]) {
    svg.rect(left, top, width, height, FRAME);
    let style = Text { anchor: Anchor::Middle, fill: "#666666", ..Text::default() };
    let text = shortened(&figure.empty, style.size, Weight::Regular, width - 10.0);
    svg.text([left + 0.5 * width, top + 0.5 * height], &text, &style);
}

impl Page {
    fn new(figure: &Figure, [x, y]: [[f64; 2]; 2], [left, top]: [f64; 2], [width, height]: [f64; 2]) -> Self {
        let inner_height = height - TICK - LABEL - 16.0;
        let y = if figure.y.is_of_powers {
            Scale::of_powers(y)
        } else if figure.y.words.is_empty() {
            Scale::new(y, ((inner_height / 36.0) as usize).clamp(2, 8))
        } else {
            Scale::of_words(short_words(&figure.y.words, WORDS * width), true)
        };
        let margin = EDGE + LABEL + 8.0 + widest(&y) + TICK_MARK + 3.0;
        let room = width - margin - EDGE;
        let x = across(figure, x, room);
        // half of the last figure may stand beyond the axis' end
        let beyond = (0.5 * widest(&x) + 2.0 - EDGE).max(0.0);
        Page { corner: [left + margin, top], size: [room - beyond, inner_height], x, y }
    }

    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.corner[0] + self.size[0] * self.x.place(x), self.corner[1] + self.size[1] * (1.0 - self.y.place(y))]
    }

    fn axes(&self, svg: &mut Svg, figure: &Figure, outer_left: f64) {
        let ([left, top], [width, height]) = (self.corner, self.size);
        let (right, bottom) = (left + width, top + height);
        let figures = |anchor| Text { size: TICK, anchor, ..Text::default() };
        for tick in &self.y.ticks {
            let [_, y] = self.place([self.x.range[0], *tick]);
            svg.segment([left, y], [right, y], grid(&self.y, *tick));
            svg.segment([left - TICK_MARK, y], [left, y], "stroke=\"#444444\"");
            let at = [left - TICK_MARK - 3.0, y + 0.36 * TICK];
            svg.text(at, &self.y.figures(*tick), &figures(Anchor::End));
        }
        for tick in &self.x.ticks {
            let [x, _] = self.place([*tick, self.y.range[0]]);
            svg.segment([x, top], [x, bottom], grid(&self.x, *tick));
            svg.segment([x, bottom], [x, bottom + TICK_MARK], "stroke=\"#444444\"");
            let at = [x, bottom + TICK_MARK + TICK + 1.0];
            svg.text(at, &self.x.figures(*tick), &figures(Anchor::Middle));
        }
        svg.rect(left, top, width, height, FRAME);
        let label = |axis: &Axis, scale: &Scale, room: f64| {
            shortened(&labelled(&axis.name, &axis.unit, scale.exponent), LABEL, Weight::Regular, room)
        };
        let x = label(&figure.x, &self.x, width);
        let style = Text { size: LABEL, anchor: Anchor::Middle, ..Text::default() };
        svg.text([left + 0.5 * width, bottom + TICK_MARK + TICK + LABEL + 5.0], &x, &style);
        let y = label(&figure.y, &self.y, height);
        let style = Text { turn_deg: -90.0, ..style };
        svg.text([outer_left + EDGE + LABEL - 2.0, top + 0.5 * height], &y, &style);
    }

    fn curves(&self, svg: &mut Svg, figure: &Figure) {
        let (left, right) = (self.corner[0], self.corner[0] + self.size[0]);
        for limit in figure.drawn_limits() {
            let [_, y] = self.place([self.x.range[0], limit.level]);
            svg.segment([left, y], [right, y], &LIMIT.attributes());
        }
        for curve in &figure.curves {
            let look = curve.style.attributes();
            let placed = || curve.drawn().map(|p| self.place(*p)).collect::<Vec<_>>();
            match curve.style.mark {
                Mark::Dots => svg.dots(&placed(), &look),
                Mark::Area => svg.polygon(&placed(), &look),
                Mark::Line => self.line(svg, curve, &look),
            }
        }
    }

    fn line(&self, svg: &mut Svg, curve: &Curve, look: &str) {
        let columns = (2.0 * self.size[0]) as usize;
        for stroke in strokes(&curve.points, columns, |p| self.place(p)) {
            match stroke.as_slice() {
                [alone] => svg.circle(*alone, 2.2, &format!("fill=\"{}\"", curve.style.colour)),
                line => svg.polyline(line, look),
            }
        }
    }
}

/// Grid line of a tick.
fn grid(scale: &Scale, tick: f64) -> &'static str {
    if tick == 0.0 && !scale.has_words() { ZERO } else { GRID }
}

/// Words of an axis, shortened to a width.
fn short_words(words: &[String], width: f64) -> Vec<String> {
    let short = |word: &String| shortened(word, TICK, Weight::Regular, width);
    words.iter().map(short).collect()
}

/// The horizontal axis, with as many ticks as fit.
fn across(figure: &Figure, range: [f64; 2], room: f64) -> Scale {
    let words = &figure.x.words;
    if !words.is_empty() {
        let each = room / words.len() as f64 - 6.0;
        return Scale::of_words(short_words(words, each), false);
    }
    if figure.x.is_of_powers {
        return Scale::of_powers(range);
    }
    let time = figure.x.unit == "ms";
    let scale = |count| if time { Scale::inside(range, count) } else { Scale::new(range, count) };
    let fits = |s: &Scale| s.ticks.len() as f64 * (widest(s) + 12.0) <= room;
    (2..=8).rev().map(scale).find(fits).unwrap_or_else(|| scale(1))
}

/// Width of the widest tick label.
fn widest(scale: &Scale) -> f64 {
    let width = |t: &f64| font::width(&scale.figures(*t), TICK, Weight::Regular);
    scale.ticks.iter().map(width).fold(0.0, f64::max)
}

/// `force, 10³ N`.
fn labelled(name: &str, unit: &str, exponent: i32) -> String {
    let power = match exponent {
        0 => String::new(),
        exponent => format!("10{} ", raised(exponent)),
    };
    let unit = format!("{power}{unit}");
    let parts = [name, unit.trim_end()];
    parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(", ")
}

fn raised(exponent: i32) -> String {
    let digit = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        c => c.to_digit(10).and_then(|d| char::from_u32(0x2070 + d)).unwrap_or(c),
    };
    exponent.to_string().chars().map(digit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_stand_before_the_unit() {
        assert_eq!(labelled("force", "N", 3), "force, 10³ N");
        assert_eq!(labelled("force", "N", 0), "force, N");
        assert_eq!(labelled("ratio", "", -6), "ratio, 10⁻⁶");
        assert_eq!(labelled("ratio", "", 0), "ratio");
        assert_eq!(labelled("", "N", 0), "N");
        assert_eq!(raised(-105), "⁻¹⁰⁵");
    }
}

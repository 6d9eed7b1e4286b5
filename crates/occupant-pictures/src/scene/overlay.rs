//! Words over the picture: title, clock, speed, names, scale, origin.

use crate::font::{self, Weight};
use crate::svg::{Anchor, Svg, Text};
use placed_text::trimmed;

/// Least and greatest height of a picture, user units: words on small pictures are larger.
const HIGH: [f64; 2] = [720.0, 1080.0];
const INK: &str = "#1b2430";
const HALO: &str = "#ffffff";
const PANEL: &str = "fill=\"#ffffff\" fill-opacity=\"0.78\"";

/// What is written over a picture.
pub(super) struct Words<'a> {
    pub(super) size: [usize; 2],
    pub(super) title: &'a str,
    pub(super) about: &'a str,
    pub(super) time_s: f64,
    pub(super) speeds: &'a [String],
    /// Names with their places, pixels.
    pub(super) names: &'a [(String, [f64; 2])],
    /// Pixels per metre at the target, if it is before the eye.
    pub(super) per_m: Option<f64>,
    pub(super) caption: &'a [String],
}

/// The words as SVG, as large as the picture.
pub(super) fn draw(words: &Words<'_>) -> String {
    let high = (words.size[1] as f64).clamp(HIGH[0], HIGH[1]);
    let scale = high / words.size[1] as f64;
    let width = words.size[0] as f64 * scale;
    let mut svg = Svg::new(width, high, words.title);
    names(&mut svg, words, scale, [width, high]);
    head(&mut svg, words, width);
    foot(&mut svg, words, scale, [width, high]);
    svg.finish()
}

fn text(size: f64, weight: Weight, anchor: Anchor) -> Text<'static> {
    Text { size, weight, anchor, fill: INK, ..Text::default() }
}

fn head(svg: &mut Svg, words: &Words<'_>, width: f64) {
    let clock = clock(words.time_s);
    let speeds = words.speeds.iter().map(|speed| font::width(speed, 24.0, Weight::Regular));
    let right = speeds.fold(font::width(&clock, 40.0, Weight::Bold), f64::max) + 48.0;
    svg.rect(0.0, 0.0, width, 92.0f64.max(64.0 + 30.0 * words.speeds.len() as f64), PANEL);
    let room = width - right - 40.0;
    svg.text([24.0, 42.0], &cut(words.title, room, 28.0, Weight::Bold), &text(28.0, Weight::Bold, Anchor::Start));
    svg.text([24.0, 74.0], &cut(words.about, room, 20.0, Weight::Regular), &text(20.0, Weight::Regular, Anchor::Start));
    svg.text([width - 24.0, 46.0], &clock, &text(40.0, Weight::Bold, Anchor::End));
    for (i, speed) in words.speeds.iter().enumerate() {
        svg.text([width - 24.0, 80.0 + 30.0 * i as f64], speed, &text(24.0, Weight::Regular, Anchor::End));
    }
}

fn foot(svg: &mut Svg, words: &Words<'_>, scale: f64, [width, high]: [f64; 2]) {
    let bar = words.per_m.map(|per_m| per_m * scale).filter(|per_m| per_m.is_finite() && *per_m > 1.0);
    let bar = bar.map(|per_m| {
        let length =
            [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0].into_iter().rfind(|m| m * per_m <= 320.0).unwrap_or(0.1);
        (length * per_m, format!("{length} m, at the middle of the picture"))
    });
    let aside =
        bar.as_ref().map_or(0.0, |(length, label)| length.max(font::width(label, 18.0, Weight::Regular)) + 60.0);
    let lines: Vec<String> = words.caption.iter().flat_map(|line| wrapped(line, width - aside - 48.0, 18.0)).collect();
    let strip = (22.0 + 24.0 * lines.len() as f64).max(66.0);
    svg.rect(0.0, high - strip, width, strip, PANEL);
    for (i, line) in lines.iter().enumerate() {
        let y = high - strip + 30.0 + 24.0 * i as f64;
        svg.text([24.0, y], line, &text(18.0, Weight::Regular, Anchor::Start));
    }
    if let Some((length, label)) = bar {
        let (x, y) = (width - 24.0, high - 36.0);
        let black = format!("stroke=\"{INK}\" stroke-width=\"3\"");
        svg.segment([x - length, y], [x, y], &black);
        for end in [x - length, x] {
            svg.segment([end, y - 8.0], [end, y + 8.0], &black);
        }
        svg.text([x, y + 26.0], &label, &text(18.0, Weight::Regular, Anchor::End));
    }
}

/// Names above the heads, lifted off one another.
fn names(svg: &mut Svg, words: &Words<'_>, scale: f64, [width, high]: [f64; 2]) {
    let mut taken: Vec<[f64; 4]> = Vec::new();
    for (name, at) in words.names {
        let half = 0.5 * font::width(name, 22.0, Weight::Bold) + 6.0;
        let x = (at[0] * scale).clamp(half, (width - half).max(half));
        let mut y = at[1] * scale;
        while let Some(other) = taken.iter().find(|o| (o[0] - x).abs() < o[2] + half && (o[1] - y).abs() < 28.0) {
            y = other[1] - 28.0;
        }
        if y < 110.0 || y > high - 80.0 {
            continue;
        }
        taken.push([x, y, half, 0.0]);
        let style = Text { halo: Some(HALO), ..text(22.0, Weight::Bold, Anchor::Middle) };
        svg.text([x, y], name, &style);
    }
}

/// `80 ms`, with as many decimals as a tenth of a millisecond needs.
fn clock(time_s: f64) -> String {
    let text = trimmed(time_s * 1e3, 1);
    format!("{} ms", if text == "-0" { "0" } else { &text })
}

/// A text cut to a width.
fn cut(text: &str, room: f64, size: f64, weight: Weight) -> String {
    if font::width(text, size, weight) <= room {
        return text.to_owned();
    }
    let mut kept: String = text.to_owned();
    while !kept.is_empty() && font::width(&kept, size, weight) + size > room {
        kept.pop();
    }
    kept + "…"
}

/// Lines of words no wider than the room.
fn wrapped(text: &str, room: f64, size: f64) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.last().cloned().unwrap_or_default();
        let longer = if last.is_empty() { word.to_owned() } else { format!("{last} {word}") };
        match lines.last_mut() {
            Some(line) if last.is_empty() || font::width(&longer, size, Weight::Regular) <= room => *line = longer,
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

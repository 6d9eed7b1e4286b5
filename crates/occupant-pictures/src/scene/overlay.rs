//! Words over the picture: title, clock, speed, names, scale, origin.

use super::canvas::Colour;
use crate::font::{self, Weight};
use crate::svg::{Anchor, Svg, Text};
use placed_text::trimmed;

/// Least and greatest height of a picture, user units: words on small pictures are larger.
const HIGH: [f64; 2] = [720.0, 1080.0];
/// Width below which a picture is narrow, user units.
const NARROW: f64 = 1000.0;
/// Most lines of each text in the head of a narrow picture.
const MOST_LINES: usize = 4;
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
    /// Lines, with the colour of what they are of.
    pub(super) caption: &'a [(Option<Colour>, String)],
}

/// The words as SVG, as large as the picture, and the rows between head and foot, pixels.
pub(super) struct Drawn {
    pub(super) svg: String,
    pub(super) free: [f64; 2],
}

pub(super) fn draw(words: &Words<'_>) -> Drawn {
    let high = (words.size[1] as f64).clamp(HIGH[0], HIGH[1]);
    let scale = high / words.size[1] as f64;
    let width = words.size[0] as f64 * scale;
    let mut svg = Svg::new(width, high, words.title);
    names(&mut svg, words, scale, [width, high]);
    let top = head(&mut svg, words, width);
    let bottom = high - foot(&mut svg, words, scale, [width, high]);
    Drawn { svg: svg.finish(), free: [top / scale, bottom.max(top) / scale] }
}

fn text(size: f64, weight: Weight, anchor: Anchor) -> Text<'static> {
    Text { size, weight, anchor, fill: INK, ..Text::default() }
}

/// Title, how it is shown, clock and speeds; how high that is.
fn head(svg: &mut Svg, words: &Words<'_>, width: f64) -> f64 {
    let clock = clock(words.time_s);
    let speeds = words.speeds.iter().map(|speed| font::width(speed, 24.0, Weight::Regular));
    let right = speeds.fold(font::width(&clock, 40.0, Weight::Bold), f64::max) + 48.0;
    let lines = head_lines(words, width, width - right - 40.0);
    let last = lines.last().map_or(0.0, |line| line.0);
    let high = 92f64.max(64.0 + 30.0 * words.speeds.len() as f64).max(last + 18.0);
    svg.rect(0.0, 0.0, width, high, PANEL);
    for (y, line, size, weight) in &lines {
        svg.text([24.0, *y], line, &text(*size, *weight, Anchor::Start));
    }
    svg.text([width - 24.0, 46.0], &clock, &text(40.0, Weight::Bold, Anchor::End));
    for (i, speed) in words.speeds.iter().enumerate() {
        svg.text([width - 24.0, 80.0 + 30.0 * i as f64], speed, &text(24.0, Weight::Regular, Anchor::End));
    }
    high
}

/// Height, words, size and weight of the lines at the left: one for each text, on a narrow picture as many as it needs.
fn head_lines(words: &Words<'_>, width: f64, room: f64) -> Vec<(f64, String, f64, Weight)> {
    if width >= NARROW {
        let line = |y, text, size, weight| (y, cut(text, room, size, weight), size, weight);
        return vec![line(42.0, words.title, 28.0, Weight::Bold), line(74.0, words.about, 20.0, Weight::Regular)];
    }
    let kept = |text, size, weight| {
        let mut lines = wrapped(text, room, size, weight);
        if lines.len() > MOST_LINES {
            lines.truncate(MOST_LINES);
            lines.iter_mut().skip(MOST_LINES - 1).for_each(|last| last.push('…'));
        }
        lines.into_iter().map(move |line| (cut(&line, room, size, weight), size, weight))
    };
    let all = kept(words.title, 21.0, Weight::Bold).chain(kept(words.about, 18.0, Weight::Regular));
    all.enumerate().map(|(i, (line, size, weight))| (32.0 + 25.0 * i as f64, line, size, weight)).collect()
}

/// Where it comes from, and a scale; how high that is.
fn foot(svg: &mut Svg, words: &Words<'_>, scale: f64, [width, high]: [f64; 2]) -> f64 {
    let bar = words.per_m.map(|per_m| per_m * scale).filter(|per_m| per_m.is_finite() && *per_m > 1.0);
    let bar = bar.map(|per_m| {
        let most = f64::min(320.0, 0.4 * width);
        let length = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0].into_iter().rfind(|m| m * per_m <= most).unwrap_or(0.1);
        (length * per_m, format!("{length} m, at the middle of the picture"))
    });
    let aside =
        bar.as_ref().map_or(0.0, |(length, label)| length.max(font::width(label, 18.0, Weight::Regular)) + 60.0);
    // on a narrow picture the words are above the scale, not beside it
    let (aside, below) = if width < NARROW && bar.is_some() { (0.0, 56.0) } else { (aside, 0.0) };
    // a place for colours before the words
    let left = if words.caption.iter().any(|(colour, _)| colour.is_some()) { 24.0 + 42.0 } else { 24.0 };
    let room = width - aside - 24.0 - left;
    let lines: Vec<(Option<Colour>, String)> = words.caption.iter().flat_map(|own| colour_first(own, room)).collect();
    let strip = (22.0 + 24.0 * lines.len() as f64 + below).max(66.0);
    svg.rect(0.0, high - strip, width, strip, PANEL);
    for (i, (colour, line)) in lines.iter().enumerate() {
        let y = high - strip + 30.0 + 24.0 * i as f64;
        if let Some(colour) = colour {
            let [r, g, b] = colour.map(|share| (share * 255.0).round());
            svg.rect(24.0, y - 15.0, 30.0, 18.0, &format!("fill=\"rgb({r},{g},{b})\""));
        }
        svg.text([left, y], line, &text(18.0, Weight::Regular, Anchor::Start));
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
    strip
}

/// The lines of a text, the first with its colour.
fn colour_first((colour, text): &(Option<Colour>, String), room: f64) -> Vec<(Option<Colour>, String)> {
    let lines = wrapped(text, room, 18.0, Weight::Regular).into_iter().enumerate();
    lines.map(|(i, line)| (colour.filter(|_| i == 0), line)).collect()
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
pub(super) fn clock(time_s: f64) -> String {
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
fn wrapped(text: &str, room: f64, size: f64, weight: Weight) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.last().cloned().unwrap_or_default();
        let longer = if last.is_empty() { word.to_owned() } else { format!("{last} {word}") };
        match lines.last_mut() {
            Some(line) if last.is_empty() || font::width(&longer, size, weight) <= room => *line = longer,
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

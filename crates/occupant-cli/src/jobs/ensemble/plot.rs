//! Bands as a picture (SVG): a panel for each channel.
//!
//! The middle 90 % is light, the middle half darker, the median a line, the unchanged run a dashed one; a red line stands
//! where the members part.

use std::fmt::Write as _;

use super::bands::{Bands, ChannelBand};
use crate::pictures::font::FAMILY;
use crate::pictures::svg::escape;

const PANEL: [f64; 2] = [440.0, 250.0];
/// Room beside the axes: left, top, right, bottom.
const ROOM: [f64; 4] = [66.0, 34.0, 14.0, 36.0];
const HEAD: f64 = 62.0;
const COLUMNS: usize = 2;
const BLUE: &str = "#0072b2";
const RED: &str = "#c00000";

/// The drawing; `title` and `words` stand above the panels.
pub(crate) fn svg(bands: &Bands, title: &str, words: &str) -> String {
    let columns = COLUMNS.min(bands.channels.len()).max(1);
    let rows = bands.channels.len().div_ceil(columns);
    let (width, height) = (columns as f64 * PANEL[0] + 20.0, HEAD + rows as f64 * PANEL[1] + 10.0);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"{FAMILY}\" font-size=\"11\" fill=\"#222\">\n<title>{0}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n<text x=\"14\" y=\"24\" font-size=\"16\" font-weight=\"bold\">{0}</text>\n<text x=\"14\" y=\"42\">{1}</text>\n",
        escape(title),
        escape(words)
    );
    legend(&mut out, [14.0, 56.0]);
    for (i, band) in bands.channels.iter().enumerate() {
        let left = 10.0 + (i % columns) as f64 * PANEL[0];
        let top = HEAD + (i / columns) as f64 * PANEL[1];
        panel(&mut out, band, &bands.time_s, [left, top]);
    }
    out.push_str("</svg>\n");
    out
}

fn legend(out: &mut String, [x, y]: [f64; 2]) {
    let mut x = x;
    for (mark, words) in [
        (
            format!("<rect width=\"22\" height=\"8\" y=\"-8\" fill=\"{BLUE}\" fill-opacity=\"0.2\"/>"),
            "90 % of the members",
        ),
        (format!("<rect width=\"22\" height=\"8\" y=\"-8\" fill=\"{BLUE}\" fill-opacity=\"0.45\"/>"), "half of them"),
        (format!("<path d=\"M0 -4H22\" stroke=\"{BLUE}\" stroke-width=\"1.6\"/>"), "median"),
        ("<path d=\"M0 -4H22\" stroke=\"#222\" stroke-dasharray=\"4 2.5\"/>".to_owned(), "unchanged run"),
        (format!("<path d=\"M11 1V-10\" stroke=\"{RED}\"/>"), "members part"),
    ] {
        let _ = writeln!(out, "<g transform=\"translate({x:.1} {y:.1})\">{mark}<text x=\"28\">{words}</text></g>");
        x += 48.0 + 6.6 * words.len() as f64;
    }
}

/// From values to the page.
struct Axes {
    corner: [f64; 2],
    size: [f64; 2],
    time_ms: [f64; 2],
    value: [f64; 2],
    step: f64,
}

impl Axes {
    fn place(&self, time_ms: f64, value: f64) -> [f64; 2] {
        let part = |x: f64, [low, high]: [f64; 2]| (x - low) / (high - low);
        [
            self.corner[0] + self.size[0] * part(time_ms, self.time_ms),
            self.corner[1] + self.size[1] * (1.0 - part(value, self.value)),
        ]
    }

    fn points(&self, time_s: &[f64], values: &[f64]) -> Vec<[f64; 2]> {
        let pairs = time_s.iter().zip(values);
        let finite = pairs.filter(|(_, y)| y.is_finite());
        finite.map(|(t, y)| self.place(t * 1e3, *y)).collect()
    }
}

fn panel(out: &mut String, band: &ChannelBand, time_s: &[f64], [left, top]: [f64; 2]) {
    let (per, unit) = shown_unit(band.unit);
    let scaled = |values: &[f64]| values.iter().map(|x| x / per).collect::<Vec<f64>>();
    let b = &band.band;
    let [q05, q25, median, q75, q95, nominal] =
        [&b.q05, &b.q25, &b.median, &b.q75, &b.q95, &band.nominal].map(|v| scaled(v));
    let (value, step) = ticks(q05.iter().chain(&q95).chain(&nominal).copied());
    let (first, last) = (time_s.first().copied(), time_s.last().copied());
    let (from, to) = (1e3 * first.unwrap_or(0.0), 1e3 * last.unwrap_or(1.0));
    let axes = Axes {
        corner: [left + ROOM[0], top + ROOM[1]],
        size: [PANEL[0] - ROOM[0] - ROOM[2], PANEL[1] - ROOM[1] - ROOM[3]],
        time_ms: [from, if to > from { to } else { from + 1.0 }],
        value,
        step,
    };
    frame(out, &axes, &format!("{}, {unit}", band.name));
    fill(out, &axes, time_s, [&q05, &q95], 0.2);
    fill(out, &axes, time_s, [&q25, &q75], 0.45);
    line(out, &axes.points(time_s, &median), &format!("stroke=\"{BLUE}\" stroke-width=\"1.6\""));
    line(out, &axes.points(time_s, &nominal), "stroke=\"#222\" stroke-dasharray=\"4 2.5\"");
    if let Some(lost_s) = band.lost_at_s {
        let [x, y] = axes.place(lost_s * 1e3, axes.value[1]);
        let bottom = y + axes.size[1];
        let (anchor, at) = if x > axes.corner[0] + 0.7 * axes.size[0] { ("end", x - 4.0) } else { ("start", x + 4.0) };
        let _ = writeln!(
            out,
            "<path d=\"M{x:.2} {y:.2}V{bottom:.2}\" stroke=\"{RED}\"/><text x=\"{at:.2}\" y=\"{:.2}\" text-anchor=\"{anchor}\" fill=\"{RED}\" stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\">{:.1} ms</text>",
            y + 12.0,
            lost_s * 1e3
        );
    }
}

fn frame(out: &mut String, axes: &Axes, title: &str) {
    let ([left, top], [width, height]) = (axes.corner, axes.size);
    let bottom = top + height;
    let _ = writeln!(
        out,
        "<text x=\"{left:.2}\" y=\"{:.2}\" font-size=\"12\" font-weight=\"bold\">{}</text>",
        top - 8.0,
        escape(title)
    );
    let [low, high] = axes.value;
    let count = ((high - low) / axes.step).round() as i32;
    for i in 0..=count {
        let value = low + f64::from(i) * axes.step;
        let [_, y] = axes.place(axes.time_ms[0], value);
        let _ = writeln!(
            out,
            "<path d=\"M{left:.2} {y:.2}h{width:.2}\" stroke=\"#e4e4e4\"/><text x=\"{:.2}\" y=\"{:.2}\" text-anchor=\"end\">{}</text>",
            left - 5.0,
            y + 4.0,
            figures(value, axes.step)
        );
    }
    let [from, to] = axes.time_ms;
    let step = round_step((to - from) / 6.0);
    let mut i = (from / step - 1e-6).ceil();
    while i * step <= to + 1e-6 * step {
        let [x, _] = axes.place(i * step, low);
        let _ = writeln!(
            out,
            "<path d=\"M{x:.2} {top:.2}v{height:.2}\" stroke=\"#e4e4e4\"/><text x=\"{x:.2}\" y=\"{:.2}\" text-anchor=\"middle\">{}</text>",
            bottom + 14.0,
            figures(i * step, step)
        );
        i += 1.0;
    }
    let _ = writeln!(
        out,
        "<rect x=\"{left:.2}\" y=\"{top:.2}\" width=\"{width:.2}\" height=\"{height:.2}\" fill=\"none\" stroke=\"#444\"/><text x=\"{:.2}\" y=\"{:.2}\" text-anchor=\"end\">ms</text>",
        left + width,
        bottom + 28.0
    );
}

fn fill(out: &mut String, axes: &Axes, time_s: &[f64], [low, high]: [&[f64]; 2], opacity: f64) {
    let mut around = axes.points(time_s, high);
    around.extend(axes.points(time_s, low).into_iter().rev());
    let _ = writeln!(out, "<polygon points=\"{}\" fill=\"{BLUE}\" fill-opacity=\"{opacity}\"/>", list(&around));
}

fn line(out: &mut String, points: &[[f64; 2]], style: &str) {
    let _ = writeln!(out, "<polyline points=\"{}\" fill=\"none\" {style}/>", list(points));
}

fn list(points: &[[f64; 2]]) -> String {
    let words: Vec<String> = points.iter().map(|[x, y]| format!("{x:.2},{y:.2}")).collect();
    words.join(" ")
}

/// A range of round numbers that covers all values, and the step between them.
fn ticks(values: impl Iterator<Item = f64>) -> ([f64; 2], f64) {
    let finite = values.filter(|x| x.is_finite());
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    let (low, high) = match high - low > 1e-9 * high.abs().max(low.abs()).max(1e-9) {
        true if low > 0.0 && low < 0.5 * high => (0.0, high),
        true => (low, high),
        false if low.is_finite() => (low - 1.0, low + 1.0),
        false => (0.0, 1.0),
    };
    let step = round_step((high - low) / 4.0);
    ([(low / step).floor() * step, (high / step).ceil() * step], step)
}

/// The least of 1, 2, 5 times a power of ten that is not below `step`.
fn round_step(step: f64) -> f64 {
    let power = 10_f64.powi(step.log10().floor() as i32);
    let round = [1.0, 2.0, 5.0].into_iter().find(|r| step <= r * power * (1.0 + 1e-9));
    round.unwrap_or(10.0) * power
}

fn figures(value: f64, step: f64) -> String {
    let decimals = (-step.log10().floor()).clamp(0.0, 9.0) as usize;
    let text = format!("{:.decimals$}", value + 0.0);
    if text.trim_start_matches(['-', '0', '.']).is_empty() {
        text.trim_start_matches('-').to_owned()
    } else {
        text.replace('-', "−")
    }
}

fn shown_unit(unit: &str) -> (f64, &str) {
    match unit {
        "m/s²" => (occupant_core::model::setup::STANDARD_GRAVITY_M_S2, "g"),
        "m" => (1e-3, "mm"),
        unit => (1.0, unit),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_cover_the_values() {
        assert_eq!(ticks([-3.0, 41.0].into_iter()), ([-20.0, 60.0], 20.0));
        assert_eq!(ticks([7.0, 7.0].into_iter()).0, [6.0, 8.0]);
        assert_eq!(ticks([f64::NAN].into_iter()).0, [0.0, 1.0]);
        assert_eq!((figures(-0.25, 0.05), figures(-0.0, 10.0)), ("−0.25".to_owned(), "0".to_owned()));
    }
}

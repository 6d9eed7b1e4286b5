//! The legend below a plot: entries in rows, none wider than the plot.

use super::figure::{Figure, LIMIT, Mark, Style};
use crate::font::Weight;
use crate::{Svg, Text, font};

/// Font size.
const SIZE: f64 = 11.0;
/// Height of a row.
const ROW: f64 = 16.0;
/// Length of a sample line.
const SAMPLE: f64 = 24.0;
const GAP: f64 = 6.0;
const BETWEEN: f64 = 16.0;

/// An entry with its position in the legend.
struct Entry {
    label: String,
    style: Style,
    x: f64,
    row: usize,
}

/// A legend laid out for a width.
pub struct Legend {
    entries: Vec<Entry>,
    rows: usize,
}

impl Legend {
    /// Legend of a figure's curves and limits; empty for a single curve whose label repeats the title.
    pub fn new(figure: &Figure, width: f64) -> Self {
        let curves = figure.curves.iter().map(|c| (c.label.as_str(), c.style));
        let limits = figure.limits.iter().map(|l| (l.label.as_str(), LIMIT));
        let mut legend = Legend { entries: Vec::new(), rows: 0 };
        let mut x = 0.0;
        for (label, style) in curves.chain(limits).filter(|(label, _)| !label.is_empty()) {
            let label = shortened(label, SIZE, Weight::Regular, width - SAMPLE - GAP);
            let long = SAMPLE + GAP + font::width(&label, SIZE, Weight::Regular);
            if legend.rows == 0 || x + long > width {
                legend.rows += 1;
                x = 0.0;
            }
            let row = legend.rows - 1;
            legend.entries.push(Entry { label, style, x, row });
            x += long + BETWEEN;
        }
        legend
    }

    /// Height of its rows.
    pub fn height(&self) -> f64 {
        self.rows as f64 * ROW
    }

    /// Draws it with its upper left corner at a place.
    pub fn draw(&self, svg: &mut Svg, [left, top]: [f64; 2]) {
        for entry in &self.entries {
            let y = top + (entry.row as f64 + 0.5) * ROW;
            let x = left + entry.x;
            let look = entry.style.attributes();
            match entry.style.mark {
                Mark::Line => svg.segment([x, y], [x + SAMPLE, y], &look),
                Mark::Dots => svg.dots(&[[x + 0.5 * SAMPLE, y]], &look),
                Mark::Area => svg.rect(x, y - 4.0, SAMPLE, 8.0, &look),
            }
            let style = Text { size: SIZE, ..Text::default() };
            svg.text([x + SAMPLE + GAP, y + 0.36 * SIZE], &entry.label, &style);
        }
    }
}

/// A text shortened in its middle to fit a width.
pub fn shortened(text: &str, size: f64, weight: Weight, width: f64) -> String {
    if font::width(text, size, weight) <= width {
        return text.to_owned();
    }
    let letters: Vec<char> = text.chars().collect();
    let short = |kept: usize| -> String {
        let (head, tail) = (kept.div_ceil(2), kept / 2);
        letters[..head].iter().chain(&['…']).chain(&letters[letters.len() - tail..]).collect()
    };
    // the more letters are kept, the wider it is: the most that fit are found by halving
    let fits = |kept: usize| font::width(&short(kept), size, weight) <= width;
    let (mut fitting, mut wide) = (None, letters.len());
    while fitting.map_or(0, |fits: usize| fits + 1) < wide {
        let middle = (fitting.map_or(0, |fits| fits + 1) + wide) / 2;
        let middle = middle.min(wide - 1);
        if fits(middle) {
            fitting = Some(middle);
        } else {
            wide = middle;
        }
    }
    fitting.map(short).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::figure::{Axis, Curve};

    fn figure(labels: &[&str]) -> Figure {
        let curve = |l: &&str| Curve::new(*l, Style::of(0, 0), Vec::new());
        Figure::new("", [Axis::of("", ""), Axis::of("", "")], labels.iter().map(curve).collect())
    }

    #[test]
    fn a_long_name_loses_its_middle_and_fits() {
        let name = "a very long name of a run that somebody has given to a file.mcap";
        let short = shortened(name, 11.0, Weight::Regular, 120.0);
        assert!(short.starts_with("a very") && short.ends_with(".mcap") && short.contains('…'));
        assert!(font::width(&short, 11.0, Weight::Regular) <= 120.0);
        assert_eq!(shortened("short", 11.0, Weight::Regular, 120.0), "short");
        assert_eq!(shortened("short", 11.0, Weight::Regular, 1.0), "");
    }

    #[test]
    fn entries_never_overlap_nor_leave_the_width() {
        let long = "x".repeat(200);
        let labels = ["head", "upper torso", &long, "lap", "torso", "pelvis", "energy of contacts"];
        let legend = Legend::new(&figure(&labels), 300.0);
        let end = |e: &Entry| e.x + SAMPLE + GAP + font::width(&e.label, SIZE, Weight::Regular);
        for (i, entry) in legend.entries.iter().enumerate() {
            assert!(end(entry) <= 300.0 + 1e-9);
            if let Some(next) = legend.entries.get(i + 1).filter(|n| n.row == entry.row) {
                assert!(next.x > end(entry));
            }
        }
        assert!(legend.rows > 2);
        assert_eq!(Legend::new(&figure(&[""]), 300.0).height(), 0.0);
    }
}

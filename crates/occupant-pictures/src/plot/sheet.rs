//! Figures on one sheet, in rows, below a heading.

use super::draw::{draw, legend_height};
use super::figure::Figure;
use super::legend::shortened;
use crate::font::Weight;
use crate::{Svg, Text};

/// Texts of a sheet.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Heading.
    pub title: String,
    /// Small lines below it.
    pub lines: Vec<String>,
    /// Figures per row.
    pub columns: usize,
}

/// Width of a figure, and its height without legend.
const SIZE: [f64; 2] = [430.0, 300.0];
/// Size of a figure in its own file.
const ALONE: [f64; 2] = [760.0, 460.0];
const EDGE: f64 = 16.0;
const TITLE: f64 = 18.0;
const SMALL: f64 = 11.0;

/// The sheet as SVG.
pub fn sheet(sheet: &Sheet, figures: &[Figure]) -> String {
    let columns = sheet.columns.clamp(1, figures.len().max(1));
    let size = if figures.len() == 1 { ALONE } else { SIZE };
    let below: Vec<f64> =
        figures.chunks(columns).map(|row| row.iter().map(|f| legend_height(f, size[0])).fold(0.0, f64::max)).collect();
    let width = 2.0 * EDGE + columns as f64 * size[0];
    let head = head_height(sheet);
    let height = head + below.iter().map(|b| size[1] + b).sum::<f64>() + EDGE;
    let mut svg = Svg::new(width, height, &sheet.title);
    svg.rect(0.0, 0.0, width, height, "fill=\"#ffffff\"");
    heading(&mut svg, sheet, width);
    let mut top = head;
    for (row, below) in figures.chunks(columns).zip(below) {
        for (i, figure) in row.iter().enumerate() {
            let at = [EDGE + i as f64 * size[0], top];
            draw(&mut svg, figure, at, [size[0], size[1] + below], below);
        }
        top += size[1] + below;
    }
    svg.finish()
}

/// One figure as an element of an HTML page, `size` without its legend.
pub fn inline(figure: &Figure, size: [f64; 2]) -> String {
    let below = legend_height(figure, size[0]);
    let whole = [size[0], size[1] + below];
    let mut svg = Svg::new(whole[0], whole[1], &figure.title);
    draw(&mut svg, figure, [0.0, 0.0], whole, below);
    svg.inline()
}

fn head_height(sheet: &Sheet) -> f64 {
    EDGE + TITLE + 6.0 + sheet.lines.len() as f64 * (SMALL + 4.0) + 4.0
}

fn heading(svg: &mut Svg, sheet: &Sheet, width: f64) {
    let room = width - 2.0 * EDGE;
    let title = Text { size: TITLE, weight: Weight::Bold, ..Text::default() };
    let words = shortened(&sheet.title, TITLE, Weight::Bold, room);
    svg.text([EDGE, EDGE + TITLE], &words, &title);
    for (i, line) in sheet.lines.iter().enumerate() {
        let style = Text { size: SMALL, fill: "#444444", ..Text::default() };
        let y = EDGE + TITLE + 6.0 + (i + 1) as f64 * (SMALL + 4.0) - 2.0;
        let words = shortened(line, SMALL, Weight::Regular, room);
        svg.text([EDGE, y], &words, &style);
    }
}

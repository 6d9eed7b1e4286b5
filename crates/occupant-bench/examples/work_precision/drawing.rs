//! The diagram: a row of panels for each case, a column for each error, both axes logarithmic.

use std::fmt::Write as _;

use crate::measure::Point;

const WIDTH: f64 = 200.0;
const HEIGHT: f64 = 150.0;
const LEFT: f64 = 62.0;
const TOP: f64 = 64.0;
const GAP: (f64, f64) = (46.0, 46.0);

/// Names of the columns, their errors, and the accuracy that the page asks for.
type Column = (&'static str, fn(&Point) -> f64, Option<f64>);
const COLUMNS: [Column; 4] = [
    ("head path, mm", |p| p.errors.path_mm, Some(1.0)),
    ("head peak g, %", |p| p.errors.peak, Some(0.1)),
    ("HIC15, %", |p| p.errors.hic, None),
    ("belt peak, %", |p| p.errors.belt, None),
];

/// Colours of rk4 and adaptive that differ in lightness too.
const COLOURS: [&str; 2] = ["#b45309", "#1d4ed8"];

/// Decades of an axis, and where its panel begins and ends.
#[derive(Clone, Copy)]
struct Axis {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Axis {
    fn over(values: impl Iterator<Item = f64> + Clone, from: f64, to: f64) -> Self {
        let low = values.clone().fold(f64::INFINITY, f64::min).log10();
        let high = values.fold(0.0, f64::max).log10();
        Axis { low: (low - 0.05).max(-6.0), high: high + 0.05, from, to }
    }

    fn at(&self, value: f64) -> f64 {
        let share = (value.log10() - self.low) / (self.high - self.low);
        self.from + share.clamp(0.0, 1.0) * (self.to - self.from)
    }

    /// Powers of ten inside, and numbers between where there are few.
    fn ticks(&self) -> Vec<f64> {
        let decades = (self.low.floor() as i32)..=(self.high.ceil() as i32);
        let steps: &[f64] = match self.high - self.low {
            span if span > 2.5 => &[1.0],
            span if span > 1.2 => &[1.0, 3.0],
            _ => &[1.0, 2.0, 5.0],
        };
        // read from text, so that 3e-1 is 0.3
        let all = decades.flat_map(|d| steps.iter().filter_map(move |s| format!("{s}e{d}").parse().ok()));
        let inside = |v: &f64| (self.low..=self.high).contains(&v.log10());
        all.filter(inside).collect()
    }
}

/// The drawing of all cases, with cost `of` a point, named `cost`, along the abscissa.
pub fn draw(all: &[(&str, Vec<Point>, Vec<Point>)], cost: &str, of: fn(&Point) -> f64) -> String {
    let width = LEFT + 4.0 * (WIDTH + GAP.0);
    let height = TOP + all.len() as f64 * (HEIGHT + GAP.1);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n<text x=\"{LEFT}\" y=\"20\" font-size=\"15\">Error against {cost} of a run: root mean square over 8 variants</text>\n"
    );
    for (i, name) in ["rk4", "adaptive"].iter().enumerate() {
        let x = LEFT + 110.0 * i as f64;
        let _ = writeln!(
            svg,
            "<line x1=\"{x}\" y1=\"38\" x2=\"{}\" y2=\"38\" stroke=\"{c}\" stroke-width=\"2\"/><text x=\"{}\" y=\"42\">{name}</text>",
            x + 24.0,
            x + 30.0,
            c = COLOURS[i]
        );
    }
    let _ = writeln!(
        svg,
        "<text x=\"{}\" y=\"42\" fill=\"#555\">dashed: 1 mm of head path, 0.1 % of head peak</text>",
        LEFT + 220.0
    );
    for (row, (name, rk4, adaptive)) in all.iter().enumerate() {
        let y = TOP + row as f64 * (HEIGHT + GAP.1);
        for (column, c) in COLUMNS.iter().enumerate() {
            let x = LEFT + column as f64 * (WIDTH + GAP.0);
            panel(&mut svg, (x, y), name, c, [rk4, adaptive], of);
        }
    }
    svg.push_str("</svg>\n");
    svg
}

fn panel(
    svg: &mut String,
    (x, y): (f64, f64),
    case: &str,
    &(what, error, wanted): &Column,
    lines: [&Vec<Point>; 2],
    of: fn(&Point) -> f64,
) {
    let points = lines.into_iter().flatten();
    let errors = points.clone().map(error).filter(|e| *e > 0.0);
    let (right, bottom) = (x + WIDTH, y + HEIGHT);
    let _ = writeln!(
        svg,
        "<text x=\"{x}\" y=\"{}\" font-weight=\"bold\">{case}: {what}</text><rect x=\"{x}\" y=\"{y}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"none\" stroke=\"#999\"/>",
        y - 6.0
    );
    if errors.clone().next().is_none() {
        let (x, y) = (x + 0.5 * WIDTH, y + 0.5 * HEIGHT);
        let _ = writeln!(svg, "<text x=\"{x}\" y=\"{y}\" fill=\"#555\" text-anchor=\"middle\">no belt</text>");
        return;
    }
    let across = Axis::over(points.map(of), x, right);
    let up = Axis::over(errors, bottom, y);
    for tick in across.ticks() {
        let x = across.at(tick);
        let _ = writeln!(
            svg,
            "<line x1=\"{x:.1}\" y1=\"{y}\" x2=\"{x:.1}\" y2=\"{bottom}\" stroke=\"#e5e5e5\"/><text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{tick}</text>",
            bottom + 14.0
        );
    }
    for tick in up.ticks() {
        let y = up.at(tick);
        let label = if tick < 1e-3 { format!("{tick:e}") } else { format!("{tick}") };
        let _ = writeln!(
            svg,
            "<line x1=\"{x}\" y1=\"{y:.1}\" x2=\"{right}\" y2=\"{y:.1}\" stroke=\"#e5e5e5\"/><text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{label}</text>",
            x - 4.0,
            y + 4.0
        );
    }
    if let Some(wanted) = wanted {
        let y = up.at(wanted);
        let _ = writeln!(
            svg,
            "<line x1=\"{x}\" y1=\"{y:.1}\" x2=\"{right}\" y2=\"{y:.1}\" stroke=\"#444\" stroke-dasharray=\"4 3\"/>"
        );
    }
    for (points, colour) in lines.iter().zip(COLOURS) {
        let places = points.iter().filter(|p| error(p) > 0.0);
        let places: Vec<_> = places.map(|p| (across.at(of(p)), up.at(error(p)))).collect();
        let path: Vec<String> = places.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
        let _ = writeln!(
            svg,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.6\"/>",
            path.join(" ")
        );
        for (x, y) in places {
            let _ = writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.6\" fill=\"{colour}\"/>");
        }
    }
}

//! Maps of a full factorial design: each figure over two parameters, a panel for each combination of the others.

use crash_measures::measure::Dummy;
use crash_measures::measure::risk::{Severity, chest_three_ms_risk, femur_risk, hic_risk, nij_risk};
use occupant_study::Design;

use super::samples::{Input, Response};
use super::{Report, Samples};
use crate::base::shown::{given_with_unit, shown_unit, significant};
use occupant_pictures::html::Html;
use occupant_pictures::svg::escape;

/// Fewest values of an axis.
const LEAST_LEVELS: usize = 3;
/// Largest number of values along an axis, and of panels.
const MOST_LEVELS: usize = 20;
const MOST_PANELS: usize = 36;
/// Size of a cell, and space for text beside and around a panel, px.
const CELL: [f64; 2] = [46.0, 24.0];
const LEFT: f64 = 62.0;
const TOP: f64 = 26.0;
const BELOW: f64 = 40.0;
/// Colours from the least to the largest value: pale to dark, also readable without colour vision.
const SHADES: [[f64; 3]; 5] =
    [[255.0, 247.0, 220.0], [254.0, 217.0, 142.0], [251.0, 154.0, 60.0], [204.0, 76.0, 20.0], [102.0, 22.0, 10.0]];

/// A mapped quantity of a response.
struct Quantity {
    title: String,
    values: Vec<f64>,
    /// Range of the colours.
    ends: [f64; 2],
    told: fn(f64) -> String,
}

/// Panels of a study: axes, and the inputs and values that distinguish the panels.
struct Grid<'a> {
    across: (&'a Input, Vec<f64>),
    up: (&'a Input, Vec<f64>),
    others: Vec<(&'a Input, Vec<f64>)>,
}

/// The maps, if the design has any.
pub fn section(html: &mut Html, report: &Report) {
    let samples = &report.gathered.samples;
    let is_whole = matches!(report.opened.plan.study.design, Design::FullFactorial);
    let Some(grid) = Grid::of(samples).filter(|_| is_whole && samples.one_in <= 1) else { return };
    html.text("h2", "Maps");
    let words = format!(
        "{} to the right, {} upwards; one panel for each combination of the other parameters. Panels of a row share a colour scale.",
        grid.across.0.name, grid.up.0.name
    );
    html.text("p class=\"remark\"", &words);
    let drawn = samples.responses.iter().flat_map(quantities);
    let mut has_risk = false;
    for quantity in drawn {
        has_risk |= quantity.title.contains("AIS");
        html.text("h3", &quantity.title);
        html.raw("<div class=\"grid\">\n");
        for panel in grid.panels() {
            html.raw(&format!("<figure>{}</figure>\n", grid.draw(samples, &panel, &quantity)));
        }
        html.raw("</div>\n");
    }
    if has_risk {
        html.text("p class=\"remark\"", RISKS);
    }
}

const RISKS: &str = "Risk curves apply to dummy readings: head from HIC15, neck from Nij, chest from its 3 ms level, femur from its force. Those of neck and chest are not zero without load (3.8 and 4.1 %).";

/// A response, and its injury risk if there is a curve.
fn quantities(response: &Response) -> Vec<Quantity> {
    let (per, unit) = shown_unit(&response.unit);
    let values: Vec<f64> = response.values.iter().map(|value| value / per).collect();
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let ends = [finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max)];
    let title = if unit.is_empty() { response.name.clone() } else { format!("{}, {unit}", response.name) };
    let mut all = Vec::new();
    if let Some((injury, risk)) = curve(&response.name) {
        let values = response.values.iter().map(|value| 100.0 * risk(*value)).collect();
        let title = format!("risk of {injury}, %, by {}", response.name);
        all.push(Quantity { title, values, ends: [0.0, 100.0], told: |value| format!("{value:.0}") });
    }
    if ends[0] <= ends[1] {
        all.push(Quantity { title, values, ends, told: short });
    }
    all
}

/// A number with three digits.
fn short(value: f64) -> String {
    match value.abs() {
        size if size >= 100.0 => format!("{value:.0}"),
        size if size >= 10.0 => format!("{value:.1}"),
        size if size >= 0.01 || size == 0.0 => format!("{value:.2}"),
        _ => significant(value),
    }
    .replace('-', "−")
}

/// An injury, and its risk as a function of a figure's value, SI.
type Curve = (&'static str, fn(f64) -> f64);

/// The curve of a figure.
fn curve(name: &str) -> Option<Curve> {
    let own = name.rsplit('.').next().unwrap_or(name);
    Some(match own {
        "hic15" => ("head AIS3+", |hic| hic_risk(hic, Severity::Ais3).unwrap_or(f64::NAN)),
        "nij" => ("neck AIS3+", |nij| nij_risk(nij, Severity::Ais3, Dummy::HybridIii50M).unwrap_or(f64::NAN)),
        "left_femur" | "right_femur" => {
            ("femur AIS2+", |force_n| femur_risk(force_n.abs(), Dummy::HybridIii50M).unwrap_or(f64::NAN))
        }
        "three_ms_cumulative" if name.ends_with("chest.three_ms_cumulative") => ("chest AIS3+", chest_three_ms_risk),
        _ => return None,
    })
}

impl<'a> Grid<'a> {
    fn of(samples: &'a Samples) -> Option<Self> {
        let mut inputs: Vec<(&Input, Vec<f64>)> = samples.inputs.iter().map(|input| (input, levels(input))).collect();
        let is_axis = |(input, levels): &(&Input, Vec<f64>)| {
            input.is_number() && (LEAST_LEVELS..=MOST_LEVELS).contains(&levels.len())
        };
        let across = inputs.remove(inputs.iter().position(is_axis)?);
        let up = inputs.remove(inputs.iter().position(is_axis)?);
        let panels: usize = inputs.iter().map(|(_, levels)| levels.len()).product();
        (panels <= MOST_PANELS).then_some(Grid { across, up, others: inputs })
    }

    /// Indices of the values of the other inputs, by panel.
    fn panels(&self) -> Vec<Vec<f64>> {
        self.others.iter().fold(vec![Vec::new()], |panels, (_, levels)| {
            let longer = |panel: &Vec<f64>| {
                levels.iter().map(|level| panel.iter().copied().chain([*level]).collect()).collect::<Vec<Vec<f64>>>()
            };
            panels.iter().flat_map(longer).collect()
        })
    }

    /// Value of a cell; NaN without a run.
    fn value(&self, samples: &Samples, panel: &[f64], at: [f64; 2], quantity: &Quantity) -> f64 {
        let is_it = |row: usize| {
            let others = self.others.iter().zip(panel).all(|((input, _), level)| input.values[row] == *level);
            others && self.across.0.values[row] == at[0] && self.up.0.values[row] == at[1]
        };
        (0..samples.len()).find(|row| is_it(*row)).map_or(f64::NAN, |row| quantity.values[row])
    }

    fn draw(&self, samples: &Samples, panel: &[f64], quantity: &Quantity) -> String {
        let ((across, columns), (up, rows)) = (&self.across, &self.up);
        let size = [LEFT + CELL[0] * columns.len() as f64 + 4.0, TOP + CELL[1] * rows.len() as f64 + BELOW];
        let names = self.others.iter().zip(panel).map(|((input, _), level)| told(input, *level));
        let name = names.collect::<Vec<_>>().join(", ");
        let mut svg = format!(
            "<svg class=\"map\" viewBox=\"0 0 {} {}\" width=\"{}\" role=\"img\" font-family=\"sans-serif\" font-size=\"11\">\
             <text x=\"{LEFT}\" y=\"16\" font-weight=\"bold\" fill=\"#222\">{}</text>",
            size[0],
            size[1],
            size[0],
            escape(&name)
        );
        for (i, x) in columns.iter().enumerate() {
            for (j, y) in rows.iter().enumerate() {
                let corner = [LEFT + CELL[0] * i as f64, TOP + CELL[1] * (rows.len() - 1 - j) as f64];
                svg.push_str(&cell(corner, self.value(samples, panel, [*x, *y], quantity), quantity));
            }
        }
        let foot = TOP + CELL[1] * rows.len() as f64;
        let word = |x: f64, y: f64, anchor: &str, text: &str| {
            format!("<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\" fill=\"#222\">{}</text>", escape(text))
        };
        for (i, x) in columns.iter().enumerate() {
            svg.push_str(&word(LEFT + CELL[0] * (i as f64 + 0.5), foot + 14.0, "middle", &number(across, *x)));
        }
        for (j, y) in rows.iter().enumerate() {
            let middle = TOP + CELL[1] * ((rows.len() - 1 - j) as f64 + 0.5) + 4.0;
            svg.push_str(&word(LEFT - 6.0, middle, "end", &number(up, *y)));
        }
        svg.push_str(&word(size[0] - 4.0, foot + 30.0, "end", &axis(across)));
        svg.push_str(&word(4.0, TOP - 8.0, "start", &axis(up)));
        svg + "</svg>"
    }
}

/// Distinct values of an input in order.
fn levels(input: &Input) -> Vec<f64> {
    let mut levels: Vec<f64> = input.values.iter().copied().filter(|value| value.is_finite()).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    levels
}

fn axis(input: &Input) -> String {
    match shown_unit(&input.unit).1 {
        "" => input.name.clone(),
        unit => format!("{}, {unit}", input.name),
    }
}

/// A value of an input without its unit.
fn number(input: &Input, value: f64) -> String {
    short(value / shown_unit(&input.unit).0).trim_end_matches(".00").trim_end_matches(".0").to_owned()
}

/// Name and value of an input.
fn told(input: &Input, value: f64) -> String {
    match &input.words {
        Some(words) => format!("{} {}", input.name, words.get(value as usize).map_or("–", String::as_str)),
        None => format!("{} {}", input.name, given_with_unit(value, &input.unit)),
    }
}

/// A cell: its colour, and its value as text.
fn cell([x, y]: [f64; 2], value: f64, quantity: &Quantity) -> String {
    let [least, greatest] = quantity.ends;
    let share = if greatest > least { ((value - least) / (greatest - least)).clamp(0.0, 1.0) } else { 0.0 };
    let (fill, ink, text) = match value.is_finite() {
        true => (shade(share), if share > 0.6 { "#fff" } else { "#222" }, (quantity.told)(value)),
        false => ("#d8d8d8".to_owned(), "#555", "–".to_owned()),
    };
    let [width, height] = CELL;
    format!(
        "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"{fill}\" stroke=\"#fff\"/>\
         <text x=\"{}\" y=\"{}\" text-anchor=\"middle\" fill=\"{ink}\">{text}</text>",
        x + 0.5 * width,
        y + 0.5 * height + 4.0
    )
}

/// Colour of a fraction.
fn shade(share: f64) -> String {
    let place = share * (SHADES.len() - 1) as f64;
    let from = (place as usize).min(SHADES.len() - 2);
    let rest = place - from as f64;
    let mixed = [0, 1, 2].map(|i| SHADES[from][i] + rest * (SHADES[from + 1][i] - SHADES[from][i]));
    let [red, green, blue] = mixed.map(|x| x.round() as u8);
    format!("#{red:02x}{green:02x}{blue:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::Units;

    fn input(name: &str, values: Vec<f64>) -> Input {
        Input { name: name.to_owned(), unit: Units::default().told("m/s"), values, ..Input::default() }
    }

    /// Two by three by three: two panels of nine cells, each with its own value.
    #[test]
    fn each_run_has_its_cell() {
        let all: Vec<[f64; 3]> = (0..18).map(|i| [i / 9, i / 3 % 3, i % 3].map(f64::from)).collect();
        let column = |at: usize| all.iter().map(|row| row[at]).collect::<Vec<f64>>();
        let values: Vec<f64> = (0..18).map(|i| 100.0 + f64::from(i)).collect();
        let unit = Units::default().told("");
        let response = Response { name: "hic15".to_owned(), unit, values, ..Response::default() };
        let samples = Samples {
            numbers: (0..18).collect(),
            inputs: vec![input("belt", column(0)), input("speed", column(1)), input("angle", column(2))],
            responses: vec![response],
            ..Samples::default()
        };
        let grid = Grid::of(&samples).unwrap();
        assert_eq!((grid.across.0.name.as_str(), grid.up.0.name.as_str()), ("speed", "angle"));
        let panels = grid.panels();
        assert_eq!(panels, [[0.0], [1.0]]);
        let drawn = quantities(&samples.responses[0]);
        assert_eq!(drawn.len(), 2);
        assert_eq!(grid.value(&samples, &panels[1], [2.0, 1.0], &drawn[1]), 100.0 + 9.0 + 6.0 + 1.0);
        let svg = grid.draw(&samples, &panels[1], &drawn[1]);
        assert_eq!(svg.matches("<rect").count(), 9);
        assert!(svg.contains(">117<") && !svg.contains(">108<"), "{svg}");
        // HIC15 of 700: 11 % of AIS3+ by the curve, Φ((ln 700 − 7.45231)/0.73998)
        let risk = curve("driver.hic15").unwrap().1(700.0);
        assert!((risk - 0.111).abs() < 1e-3, "{risk}");
        assert!(curve("vehicle.asi_2010").is_none() && curve("belts.lap.peak").is_none());
        // a run that is missing is an empty cell, and words are no axis
        assert!(grid.value(&samples, &panels[0], [5.0, 1.0], &drawn[1]).is_nan());
        let words = Samples { inputs: vec![input("speed", column(1)), input("belt", column(0))], ..samples };
        assert!(Grid::of(&words).is_none());
    }

    #[test]
    fn shades_go_from_pale_to_dark() {
        assert_eq!((shade(0.0), shade(1.0)), ("#fff7dc".to_owned(), "#66160a".to_owned()));
        assert_eq!(shade(0.5), "#fb9a3c");
    }
}

//! The page of an optimisation: one HTML file that needs no network and no script.

use super::result::Candidate;
use super::{Optimising, Optimum, text};
use crate::base::Units;
use crate::base::text_table::NONE;
use crate::fit::report::short;
use crate::risk::{begun, ended};
use crate::search::Record;
use occupant_pictures::html::{Cell, Html};
use occupant_pictures::plot::{Axis, Curve, Figure, Style, inline};
use occupant_study::search::Rank;

/// Size of the plot of the history.
const SIZE: [f64; 2] = [820.0, 300.0];
/// Largest number of dots of a kind.
const MOST_DOTS: usize = 2000;
/// Largest number of rows of the table of a front.
const MOST_ROWS: usize = 40;

/// The complete file.
pub fn page(of: &Optimising, result: &Optimum, records: &[Record]) -> String {
    let title = if result.title.is_empty() { "Optimisation".to_owned() } else { result.title.clone() };
    let mut html = begun(&title);
    let goals: Vec<&str> = result.goals.iter().map(|g| g.measure.as_str()).collect();
    html.text("p", &format!("Optimum of {} with {}", result.scenario, goals.join(" and ")));
    html.raw("</header>\n");
    for warning in &result.warnings {
        html.text("p class=\"note\"", warning);
    }
    html.facts(&text::head(result));
    html.text("h2", "Measures and limits");
    rows(&mut html, &["measure", "base", "optimum", "unit", "wanted"], 1..3, text::measures(result));
    html.text("h2", "Parameters, and what the optimum hangs on");
    let heads = ["parameter", "unit", "base", "optimum", "bounds", "2 % of the range below", "above"];
    rows(&mut html, &heads, 2..5, text::parameters(result));
    html.text(
        "p class=\"remark\"",
        "Each parameter was moved alone: the change of the goal, and limits or caveats that keep the neighbour from winning.",
    );
    html.text("h2", "Best runs");
    candidates(&mut html, of, result, &result.best);
    if !result.front.is_empty() {
        html.text("h2", "Front");
        html.text("p class=\"remark\"", "No allowed candidate is better in one goal and as good in all others.");
        if let Some(figure) = front(of, result, records) {
            html.raw(&format!("<figure>{}</figure>\n", inline(&figure, SIZE)));
        }
        candidates(&mut html, of, result, &thinned(&result.front));
    }
    html.text("h2", "History");
    html.raw(&format!("<figure>{}</figure>\n", inline(&history(of, records), SIZE)));
    let mut origin = vec![("optimised by", result.program.clone())];
    origin.extend(of.manifest.texts.iter().map(|t| ("text", format!("{}, SHA-256 {}", t.name, t.sha256))));
    ended(html, &origin)
}

/// A table whose columns `numbers` are numbers.
fn rows<const N: usize>(html: &mut Html, heads: &[&str; N], numbers: std::ops::Range<usize>, rows: Vec<[String; N]>) {
    let cell = |(i, text): (usize, String)| if numbers.contains(&i) { Cell::Number(text) } else { Cell::Words(text) };
    let rows: Vec<Vec<Cell>> = rows.into_iter().map(|row| row.into_iter().enumerate().map(cell).collect()).collect();
    html.table(heads, &rows);
}

/// At most as many candidates as are readable, the ends included.
fn thinned(all: &[Candidate]) -> Vec<Candidate> {
    let count = all.len().min(MOST_ROWS);
    (0..count).map(|i| all[i * (all.len() - 1) / (count - 1).max(1)].clone()).collect()
}

/// Allowed candidates and the front in the plane of the first two goals; none with one goal.
fn front(of: &Optimising, result: &Optimum, records: &[Record]) -> Option<Figure> {
    let [(x, _), (y, _)] = of.measures.goals.get(..2)?.try_into().ok()?;
    let told = [x, y].map(|value| Units::default().told(of.measures.unit(value)).shown);
    let place = |values: &[f64]| [values[x] / told[0].0, values[y] / told[1].0];
    let allowed = records.iter().filter(|record| matches!(of.trial(record).rank(), Rank::Allowed(_)));
    let all = allowed.map(|record| place(&of.measures.values(&record.parts))).collect();
    let front: Vec<[f64; 2]> = result.front.iter().map(|candidate| place(&candidate.measures)).collect();
    let axis = |value: usize, told: &(f64, String)| Axis::of(of.measures.name(value), told.1.clone());
    Some(Figure {
        title: "Front between the goals".to_owned(),
        x: axis(x, &told[0]),
        y: axis(y, &told[1]),
        curves: vec![
            Curve::new("allowed", Style::dots("#c9c9c9", 3.0), thin(all)),
            Curve::new("front", Style::dots("#d55e00", 4.0), front),
        ],
        limits: Vec::new(),
        empty: "no candidate is allowed".to_owned(),
    })
}

fn candidates(html: &mut Html, of: &Optimising, result: &Optimum, list: &[Candidate]) {
    let mut heads = vec!["candidate".to_owned(), "goal".to_owned()];
    let with_unit = |name: &str, unit: &str| if unit.is_empty() { name.to_owned() } else { format!("{name}, {unit}") };
    heads.extend(result.parameters.iter().map(|p| with_unit(&p.name, &p.shown.0)));
    let told = |value: usize| Units::default().told(of.measures.unit(value)).shown;
    let values = 0..of.measures.uses.len();
    heads.extend(values.clone().map(|value| with_unit(&of.measures.name(value), &told(value).1)));
    heads.push("remark".to_owned());
    let row = |c: &Candidate| {
        let mut cells = vec![Cell::Number(c.index.to_string()), Cell::Number(short(c.goal))];
        let parameters = c.values.iter().zip(&result.parameters).map(|(x, p)| Cell::Number(short(x / p.shown.1)));
        cells.extend(parameters);
        cells.extend(values.clone().map(|value| Cell::Number(short(c.measures[value] / told(value).0))));
        let remark = [(!c.is_within).then_some("beyond a limit"), Some(c.caveats.as_str()).filter(|c| !c.is_empty())];
        let remark: Vec<&str> = remark.into_iter().flatten().collect();
        cells.push(Cell::Words(if remark.is_empty() { NONE.to_owned() } else { remark.join(", ") }));
        cells
    };
    let heads: Vec<&str> = heads.iter().map(String::as_str).collect();
    html.table(&heads, &list.iter().map(row).collect::<Vec<_>>());
}

fn thin(dots: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let every = dots.len().div_ceil(MOST_DOTS).max(1);
    dots.into_iter().step_by(every).collect()
}

/// Goal of each candidate, and the best so far.
fn history(of: &Optimising, records: &[Record]) -> Figure {
    let [mut within, mut other, mut best] = [const { Vec::new() }; 3];
    let mut least = f64::INFINITY;
    for (i, record) in records.iter().enumerate().filter(|(_, r)| r.at.is_some()) {
        let trial = of.trial(record);
        match trial.rank() {
            Rank::Allowed(goal) => {
                within.push([i as f64, goal]);
                if goal < least {
                    best.push([i as f64, least]);
                    least = goal;
                    best.push([i as f64, least]);
                }
            }
            Rank::Failed => {}
            Rank::Beyond(_) | Rank::Refused(_) => other.push([i as f64, trial.goal]),
        }
    }
    best.retain(|[_, goal]: &[f64; 2]| goal.is_finite());
    if least.is_finite() {
        best.push([records.len() as f64, least]);
    }
    // outliers of the first generations would hide the rest
    let mut goals: Vec<f64> = within.iter().map(|[_, goal]| *goal).collect();
    goals.sort_by(f64::total_cmp);
    if let (Some(low), Some(high)) = (goals.first(), goals.get(goals.len() * 95 / 100)) {
        let room = 0.5 * (high - low).max(1e-3 * low.abs());
        let shows = |[_, goal]: &[f64; 2]| (low - room..=high + room).contains(goal);
        [&mut within, &mut other, &mut best].into_iter().for_each(|dots| dots.retain(shows));
    }
    let curves = vec![
        Curve::new("beyond a limit or with caveats", Style::dots("#c9c9c9", 3.0), thin(other)),
        Curve::new("allowed", Style::dots("#0072b2", 3.5), thin(within)),
        Curve::new("best so far", Style::line("#d55e00", 1.6), best),
    ];
    Figure {
        title: "Goal of each candidate".to_owned(),
        x: Axis::of("candidate", ""),
        y: Axis::of("goal", ""),
        curves: curves.into_iter().filter(|curve| !curve.points.is_empty()).collect(),
        limits: Vec::new(),
        empty: "no candidate could be run".to_owned(),
    }
}

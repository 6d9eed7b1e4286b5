//! The tables of what matters: indices, effects, reaches, correlations, coefficients.

use occupant_study::analysis::{Effect, Estimate, SobolIndices};

use super::analysis::{Analysis, ByDesign, Linear, Reach};
use super::samples::{Response, Samples};
use super::shown::{part, shown};
use super::{Report, caution, plots};
use crate::pictures::html::{Cell, Html};

/// A table with its picture.
struct Matter {
    title: String,
    head: &'static [&'static str],
    rows: Vec<Vec<Cell>>,
    picture: String,
}

/// A response and what was found of it.
struct Found<'a> {
    samples: &'a Samples,
    response: &'a Response,
    analysis: &'a Analysis,
    /// Why all its numbers are marked.
    lacking: Option<String>,
}

impl<'a> Found<'a> {
    fn of(report: &'a Report, analysis: &'a Analysis) -> Self {
        let samples = &report.gathered.samples;
        Found {
            samples,
            response: &samples.responses[analysis.response],
            analysis,
            lacking: caution::lacking(analysis.spread.as_ref()),
        }
    }

    /// A row for each parameter that has one, those that matter most first.
    fn rows(&self, cells: impl Fn(usize) -> Option<Vec<Cell>>) -> Vec<Vec<Cell>> {
        let row = |i: &usize| {
            let mut row = vec![Cell::Words(self.samples.inputs[*i].name.clone())];
            row.extend(cells(*i)?);
            Some(row)
        };
        self.analysis.order.iter().filter_map(row).collect()
    }

    /// A number, marked by its own rule or with all others.
    fn number(&self, text: String, mark: Option<String>) -> Cell {
        Cell::of(text, mark.or_else(|| self.lacking.clone()))
    }

    /// A number and its interval.
    fn estimate(&self, estimate: &Estimate, text: &dyn Fn(f64) -> String, mark: Option<String>) -> [Cell; 2] {
        let interval = format!("{} … {}", text(estimate.low), text(estimate.high));
        [self.number(text(estimate.value), mark), Cell::Number(interval)]
    }
}

/// What the design is made for.
pub(crate) fn by_design(html: &mut Html, report: &Report, analysis: &Analysis) {
    let of = Found::of(report, analysis);
    let (what, found) = match &analysis.by_design {
        ByDesign::Plain => return,
        ByDesign::Sobol(found) => ("Sobol indices", found.as_ref().map(|f| sobol(&of, f))),
        ByDesign::Morris(found) => ("Elementary effects", found.as_ref().map(|f| morris(&of, f))),
        ByDesign::OneAtATime(found) => ("One parameter at a time", found.as_ref().map(|f| alone(&of, f))),
    };
    let matter = match found {
        Ok(matter) => matter,
        Err(why) => {
            let words = format!("{what}: none, because there are too few numbers to say anything ({why}).");
            return html.text("p class=\"note\"", &words);
        }
    };
    html.text("h3", &matter.title);
    html.raw("<div class=\"pair\">\n");
    html.raw(&format!("<figure>{}</figure>\n", matter.picture));
    html.table(matter.head, &matter.rows);
    html.raw("</div>\n");
}

fn sobol(of: &Found<'_>, found: &SobolIndices) -> Matter {
    let rows = of.rows(|i| {
        let both = [found.first.get(i)?, found.total.get(i)?];
        let cells = both.map(|e| of.estimate(e, &part, caution::index(e, found)));
        Some(cells.into_iter().flatten().collect())
    });
    let dropped = match found.dropped {
        0 => String::new(),
        n => format!("; {n} more have runs without a figure"),
    };
    Matter {
        title: format!("Sobol indices: parts of the variance, of {} points{dropped}", found.points),
        head: &["parameter", "first order", "95 %", "total", "95 %"],
        rows,
        picture: plots::sobol(of.samples, of.analysis, found),
    }
}

fn morris(of: &Found<'_>, found: &[Effect]) -> Matter {
    let text = |x: f64| shown(x, &of.response.unit);
    let rows = of.rows(|i| {
        let effect = found.get(i)?;
        let mark = caution::effect(effect);
        let mut row = of.estimate(&effect.mean_magnitude, &text, mark.clone()).to_vec();
        row.push(of.number(text(effect.mean.value), mark.clone()));
        row.push(of.number(text(effect.deviation), mark));
        row.push(Cell::Number(effect.effects.to_string()));
        Some(row)
    });
    Matter {
        title: "Morris’s elementary effects: the change over a parameter’s whole range".to_owned(),
        head: &["parameter", "μ*", "95 %", "μ", "σ", "effects"],
        rows,
        picture: plots::morris(of.samples, of.analysis, found),
    }
}

fn alone(of: &Found<'_>, found: &[Reach]) -> Matter {
    let rows = of.rows(|i| {
        let reach = found.get(i)?;
        let [low, high] = reach.range();
        let [first, last] = reach.ends().unwrap_or([f64::NAN; 2]);
        let values = [first, last, low, high, high - low];
        let number = |x: f64| of.number(shown(x, &of.response.unit), None);
        Some(values.map(number).to_vec())
    });
    Matter {
        title: "One parameter at a time".to_owned(),
        head: &["parameter", "at its least", "at its greatest", "least", "greatest", "reach"],
        rows,
        picture: plots::tornado(of.samples, of.analysis, found),
    }
}

/// Rank correlation and regression.
pub(crate) fn linear(html: &mut Html, report: &Report, analysis: &Analysis) {
    let of = Found::of(report, analysis);
    if of.samples.inputs.is_empty() {
        return;
    }
    html.text("h3", "Rank correlation and standardised regression");
    if let Some(why) = &analysis.linear.without {
        return html.text("p", &format!("None: {why}."));
    }
    let rows = of.rows(|i| Some(linear_row(&of, &analysis.linear, i)));
    let picture = plots::linear(of.samples, analysis);
    html.raw(&format!("<div class=\"pair\">\n<figure>{picture}</figure>\n<div>"));
    let head = ["parameter", "rank correlation", "95 %", "coefficient", "95 %", "reading"];
    html.table(&head, &rows);
    html.text("p class=\"remark\"", &regression_words(&analysis.linear));
    html.raw("</div></div>\n");
}

fn linear_row(of: &Found<'_>, linear: &Linear, i: usize) -> Vec<Cell> {
    let none = || [(); 2].map(|()| Cell::Number("–".to_owned()));
    let rank = linear.ranks.get(i);
    let (mut row, reading) = match rank {
        Some(Ok(found)) => {
            let reading = match (found.rho.is_clear(), found.rho.value > 0.0) {
                (false, _) => "sign not known",
                (true, true) => "rises with it",
                (true, false) => "falls",
            };
            let cells = of.estimate(&found.rho, &part, caution::rank(found));
            (cells.to_vec(), reading.to_owned())
        }
        Some(Err(why)) => (none().to_vec(), why.clone()),
        None => (none().to_vec(), String::new()),
    };
    let coefficient = linear.regression.as_ref().ok().and_then(|(which, found)| {
        let at = which.iter().position(|w| *w == i)?;
        let mark = caution::regression(found);
        Some(of.estimate(found.coefficients.get(at)?, &part, mark))
    });
    row.extend(coefficient.unwrap_or_else(none));
    row.push(Cell::Words(reading));
    row
}

fn regression_words(linear: &Linear) -> String {
    match &linear.regression {
        Ok((_, found)) => {
            let mark = caution::regression(found);
            let why = mark.map(|why| format!(" †: {why}")).unwrap_or_default();
            format!(
                "The linear model of {} rows explains R² = {} of the variance{why}.",
                found.rows,
                part(found.explained)
            )
        }
        Err(why) => format!("No regression: {why}."),
    }
}

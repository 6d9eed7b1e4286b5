//! Parameters against measures at a glance: how much each parameter matters for each measure.

use super::{ByDesign, Finding, Report};
use crate::base::shown::{part, shown, shown_unit};
use crate::base::text_table::Align::{Left, Right};
use crate::base::text_table::{NONE, Table};
use occupant_pictures::html::{Cell, Html};
use occupant_pictures::svg::escape;

/// Largest number of measures in the matrix.
const MOST: usize = 12;

/// Quantity that a design gives for each parameter, and its description.
fn telling(of: &Finding<'_>) -> (&'static str, &'static str) {
    match of.analysis.by_design {
        ByDesign::Sobol(_) => ("sobol_total", "total Sobol indices: fractions of the variance, dimensionless"),
        ByDesign::Morris(_) => ("morris_mu_star", "μ*: mean change over a parameter’s whole range"),
        ByDesign::OneAtATime(_) => ("alone_greatest", "reach: largest minus smallest value with this parameter alone"),
        ByDesign::Plain => ("rank_correlation", "rank correlations (−1 to 1)"),
    }
}

/// Influence of a parameter, with the reason if it is unreliable.
fn cell(of: &Finding<'_>, parameter: usize) -> Option<(String, Option<String>)> {
    let number = of.number(telling(of).0, parameter)?;
    let least = match number.quantity {
        "alone_greatest" => of.value("alone_least", parameter),
        _ => 0.0,
    };
    let value = number.estimate.value - least;
    let text = if number.in_unit { shown(value, &of.response.unit) } else { part(value) };
    value.is_finite().then(|| (text, number.mark.clone()))
}

/// Measures that vary, with their headings.
fn told(report: &Report) -> Vec<(Finding<'_>, String)> {
    let told = report.findings().filter(|of| of.analysis.spread.is_some() && !of.analysis.constant);
    let head = |of: &Finding<'_>| {
        let unit = of.number(telling(of).0, 0).filter(|n| n.in_unit).map(|_| shown_unit(&of.response.unit).1);
        unit.filter(|unit| !unit.is_empty())
            .map_or(of.response.name.clone(), |unit| format!("{}, {unit}", of.response.name))
    };
    told.take(MOST).map(|of| (head(&of), of)).map(|(head, of)| (of, head)).collect()
}

/// The matrix as a section of the page; nothing if no measure varies.
pub(super) fn section(html: &mut Html, report: &Report) {
    let told = told(report);
    let (Some((first, _)), inputs) = (told.first(), &report.gathered.samples.inputs) else { return };
    if inputs.is_empty() {
        return;
    }
    html.text("h2", "What matters for which result");
    let words = "Click a measure for its details. † marks unreliable numbers; hover over one for the reason.";
    html.text("p class=\"remark\"", &format!("Rows of parameters show {}. {words}", telling(first).1));
    let link = |(of, _): &(Finding<'_>, String)| {
        // the rows of the spread have the unit, whatever those of the parameters are
        let unit = shown_unit(&of.response.unit).1;
        let head = if unit.is_empty() { of.response.name.clone() } else { format!("{}, {unit}", of.response.name) };
        format!("<a href=\"#r{}\">{}</a>", of.analysis.response, breakable(&escape(&head)))
    };
    let heads: Vec<String> = std::iter::once("parameter".to_owned()).chain(told.iter().map(link)).collect();
    let spread = ["median", "q05", "q95"].map(|quantity| {
        let name = quantity.replace("q05", "5 %").replace("q95", "95 %");
        let cells = told.iter().filter_map(|(of, _)| of.numbers.iter().find(|n| n.quantity == quantity).zip(Some(of)));
        let cells = cells.map(|(n, of)| Cell::of(shown(n.estimate.value, &of.response.unit), n.mark.clone()));
        std::iter::once(Cell::Words(name)).chain(cells).collect()
    });
    let row = |i: usize| {
        let cells = told.iter().map(|(of, _)| match cell(of, i) {
            Some((text, mark)) => Cell::of(text, mark),
            None => Cell::Number(NONE.to_owned()),
        });
        std::iter::once(Cell::Words(inputs[i].name.clone())).chain(cells).collect()
    };
    html.table_under(&heads, &(0..inputs.len()).map(row).collect::<Vec<_>>());
    html.text("p class=\"remark\"", "Values over all runs, in the unit of each result:");
    html.table_under(&heads, &spread);
}

/// A name that may be broken after its dots and underscores.
fn breakable(name: &str) -> String {
    name.replace('.', ".<wbr>").replace('_', "_<wbr>")
}

/// The matrix as a text; empty if no measure varies.
pub fn text(report: &Report) -> String {
    let told = told(report);
    let (Some((first, _)), inputs) = (told.first(), &report.gathered.samples.inputs) else { return String::new() };
    // heads that can be broken
    let heads: Vec<String> = told.iter().map(|(_, head)| head.replace('.', ". ").replace('_', " ")).collect();
    let heads: Vec<&str> = heads.iter().map(String::as_str).collect();
    let mut table = Table::new(&[(Left, &["parameter"]), (Right, &heads)]);
    for (i, input) in inputs.iter().enumerate() {
        let cells = told.iter().map(|(of, _)| match cell(of, i) {
            Some((text, Some(_))) => text + "†",
            Some((text, None)) => text + " ",
            None => NONE.to_owned(),
        });
        table.row(std::iter::once(input.name.clone()).chain(cells));
    }
    format!("{}; † unreliable, see the page for the reason\n\n{}", telling(first).1, table.text())
}

//! Parameters against measures at a glance: how much each parameter matters for each measure.

use super::{ByDesign, Finding, Report};
use crate::base::shown::{part, shown, shown_unit};
use crate::base::text_table::Align::{Left, Right};
use crate::base::text_table::{NONE, Table};
use occupant_pictures::html::{Cell, Html};
use occupant_pictures::svg::escape;

/// Largest number of measures in the matrix.
const MOST: usize = 12;
/// Number of shades.
const SHADES: f64 = 5.0;

/// Quantity that a design gives for each parameter, and its description.
fn telling(of: &Finding<'_>) -> (&'static str, &'static str) {
    match of.analysis.by_design {
        ByDesign::Sobol(_) => ("sobol_total", "total Sobol indices: fractions of the variance, dimensionless"),
        ByDesign::Morris(_) => ("morris_mu_star", "μ*: mean change over a parameter’s whole range"),
        ByDesign::OneAtATime(_) => ("alone_greatest", "reach: largest minus smallest value with this parameter alone"),
        ByDesign::Plain => ("rank_correlation", "rank correlations (−1 to 1)"),
    }
}

/// Influence of a parameter on a measure.
struct Influence {
    value: f64,
    /// Its size as far as the interval tells: the distance of that from zero; without an interval that of a reliable value.
    known: f64,
    text: String,
    /// Reason why it is unreliable.
    mark: Option<String>,
}

impl Influence {
    fn of(of: &Finding<'_>, parameter: usize) -> Option<Influence> {
        let number = of.number(telling(of).0, parameter)?;
        let least = match number.quantity {
            "alone_greatest" => of.value("alone_least", parameter),
            _ => 0.0,
        };
        let value = number.estimate.value - least;
        let text = if number.in_unit { shown(value, &of.response.unit) } else { part(value) };
        let mark = number.mark.clone();
        let [low, high] = [number.estimate.low, number.estimate.high].map(|end| end - least);
        let known = match low <= high {
            true => low.max(-high).clamp(0.0, value.abs()),
            false if mark.is_none() => value.abs(),
            false => 0.0,
        };
        value.is_finite().then_some(Influence { value, known, text, mark })
    }

    /// Its cell on a shade: by what is known of its size, of which the largest of the measure is `most`.
    fn cell(self, most: f64) -> Cell {
        let shade = (SHADES * self.known / most).round().min(SHADES);
        if shade >= 1.0 { Cell::Shaded(self.text, self.mark, shade as usize) } else { Cell::of(self.text, self.mark) }
    }
}

/// Size of which an influence is a part: 1 for a number without a unit; else the largest of the measure.
fn most(of: &Finding<'_>) -> f64 {
    let all = || of.order().filter_map(|i| Influence::of(of, i));
    let is_of_unit = of.number(telling(of).0, 0).is_some_and(|number| number.in_unit);
    if is_of_unit { all().map(|one| one.value.abs()).fold(0.0, f64::max) } else { 1.0 }
}

/// Parameters by what is known of their largest influence on any measure, the most important first; by their largest number where
/// nothing is known.
fn sorted(told: &[(Finding<'_>, String)], parameters: usize) -> Vec<usize> {
    let most: Vec<f64> = told.iter().map(|(of, _)| most(of)).collect();
    let largest = |i: usize, size: fn(&Influence) -> f64| {
        let shares = told.iter().zip(&most).filter_map(|((of, _), most)| Some(size(&Influence::of(of, i)?) / most));
        shares.filter(|share| share.is_finite()).fold(-1.0, f64::max)
    };
    let weight = |i: usize| [largest(i, |one| one.known), largest(i, |one| one.value.abs())];
    let weights: Vec<[f64; 2]> = (0..parameters).map(weight).collect();
    let mut order: Vec<usize> = (0..parameters).collect();
    let by = |a: usize, b: usize, at: usize| weights[b][at].total_cmp(&weights[a][at]);
    order.sort_by(|a, b| by(*a, *b, 0).then(by(*a, *b, 1)));
    order
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
    let order = "The parameter with the largest influence on any result comes first, and shades grow with the influence, both as far as the interval tells: by its end nearest zero.";
    html.text("p class=\"remark\"", &format!("Rows of parameters show {}. {order} {words}", telling(first).1));
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
    let most: Vec<f64> = told.iter().map(|(of, _)| most(of)).collect();
    let row = |i: usize| {
        let cells = told.iter().zip(&most).map(|((of, _), most)| {
            Influence::of(of, i).map_or_else(|| Cell::Number(NONE.to_owned()), |found| found.cell(*most))
        });
        std::iter::once(Cell::Words(inputs[i].name.clone())).chain(cells).collect()
    };
    html.table_under(&heads, &sorted(&told, inputs.len()).into_iter().map(row).collect::<Vec<_>>());
    html.text("p class=\"remark\"", "Values over all runs, in the unit of each result:");
    let heads: Vec<String> = std::iter::once("quantile".to_owned()).chain(heads.into_iter().skip(1)).collect();
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
    for i in sorted(&told, inputs.len()) {
        let cells = told.iter().map(|(of, _)| match Influence::of(of, i) {
            Some(Influence { text, mark: Some(_), .. }) => text + "†",
            Some(Influence { text, .. }) => text + " ",
            None => NONE.to_owned(),
        });
        table.row(std::iter::once(inputs[i].name.clone()).chain(cells));
    }
    format!("{}; † unreliable, see the page for the reason\n\n{}", telling(first).1, table.text())
}

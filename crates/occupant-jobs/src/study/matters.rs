//! The tables of importance: indices, effects, reaches, correlations, coefficients.

use occupant_study::analysis::{Estimate, SobolIndices};

use super::{ByDesign, Finding, Linear, Number, caution, plots};
use crate::base::shown::{part, shown};
use occupant_pictures::html::{Cell, Html};

/// Largest number of pairs on the page.
const PAIRS: usize = 12;

/// A table column with a row per parameter: heading, quantity, and what to show of it.
type Column = (&'static str, &'static str, What);

enum What {
    Value,
    Interval,
    /// Number of rows or effects used.
    Rows,
    /// Range of the response.
    Reach,
    /// Whether the response rises or falls.
    Reading,
}

const SOBOL: [Column; 4] = [
    ("first order", "sobol_first", What::Value),
    ("95 %", "sobol_first", What::Interval),
    ("total", "sobol_total", What::Value),
    ("95 %", "sobol_total", What::Interval),
];
const MORRIS: [Column; 5] = [
    ("μ*", "morris_mu_star", What::Value),
    ("95 %", "morris_mu_star", What::Interval),
    ("μ", "morris_mu", What::Value),
    ("σ", "morris_sigma", What::Value),
    ("effects", "morris_mu", What::Rows),
];
const ALONE: [Column; 5] = [
    ("at its least", "alone_at_least_value", What::Value),
    ("at its greatest", "alone_at_greatest_value", What::Value),
    ("least", "alone_least", What::Value),
    ("greatest", "alone_greatest", What::Value),
    ("reach", "alone_greatest", What::Reach),
];
const LINEAR: [Column; 5] = [
    ("rank correlation", "rank_correlation", What::Value),
    ("95 %", "rank_correlation", What::Interval),
    ("coefficient", "regression_coefficient", What::Value),
    ("95 %", "regression_coefficient", What::Interval),
    ("reading", "rank_correlation", What::Reading),
];

impl Finding<'_> {
    fn cell(&self, (_, quantity, what): &Column, parameter: usize) -> Cell {
        if let What::Reading = what {
            return Cell::Words(reading(&self.analysis.linear, parameter));
        }
        let Some(number) = self.number(quantity, parameter) else {
            return Cell::Number("–".to_owned());
        };
        // a value of the response, or a part of a whole
        let text = |x: f64| if number.in_unit { shown(x, &self.response.unit) } else { part(x) };
        let e = &number.estimate;
        match what {
            What::Interval => Cell::Number(format!("{} … {}", text(e.low), text(e.high))),
            What::Rows => Cell::Number(number.rows.to_string()),
            What::Reach => Cell::of(text(e.value - self.value("alone_least", parameter)), number.mark.clone()),
            What::Value | What::Reading => Cell::of(text(e.value), number.mark.clone()),
        }
    }

    /// A row per parameter, the most important first.
    fn table(&self, html: &mut Html, columns: &[Column]) {
        let head: Vec<&str> = std::iter::once("parameter").chain(columns.iter().map(|(head, ..)| *head)).collect();
        let row = |i: usize| {
            let name = Cell::Words(self.samples.inputs[i].name.clone());
            std::iter::once(name).chain(columns.iter().map(|column| self.cell(column, i))).collect()
        };
        html.table(&head, &self.order().map(row).collect::<Vec<_>>());
    }
}

/// Analysis specific to the design.
pub fn by_design(html: &mut Html, of: &Finding<'_>) {
    let title = |title: &str| title.to_owned();
    let effects = "Morris’s elementary effects: the change over a parameter’s whole range";
    let alone = "One parameter at a time";
    let (what, heading, columns, picture): (_, _, &[Column], fn(&Finding<'_>) -> String) = match &of.analysis.by_design
    {
        ByDesign::Plain => return,
        ByDesign::Sobol(indices) => ("Sobol indices", indices.as_ref().map(sobol_title), &SOBOL, plots::sobol),
        ByDesign::Morris(found) => {
            ("Elementary effects", found.as_ref().map(|_| title(effects)), &MORRIS, plots::morris)
        }
        ByDesign::OneAtATime(found) => (alone, found.as_ref().map(|_| title(alone)), &ALONE, plots::tornado),
    };
    match heading {
        Err(why) => {
            let words = format!("{what}: none, because there are too few values ({why}).");
            html.text("p class=\"note\"", &words);
        }
        Ok(heading) => {
            html.text("h3", &heading);
            html.raw(&format!("<div class=\"pair\">\n<figure>{}</figure>\n", picture(of)));
            of.table(html, columns);
            html.raw("</div>\n");
            pairs(html, of);
        }
    }
}

/// The pairs of parameters with the largest second-order indices, if the design has them.
fn pairs(html: &mut Html, of: &Finding<'_>) {
    let mut found: Vec<&Number> = of.numbers.iter().filter(|number| number.quantity == "sobol_second").collect();
    if found.is_empty() {
        return;
    }
    found.sort_by(|a, b| b.estimate.value.total_cmp(&a.estimate.value));
    html.text("h3", "Second-order Sobol indices: what two parameters explain together, beyond each alone");
    if found.len() > PAIRS {
        html.text(
            "p class=\"remark\"",
            &format!("The {PAIRS} largest of {}; the table beside the page has all.", found.len()),
        );
    }
    let row = |number: &&Number| {
        let e = &number.estimate;
        let interval = format!("{} … {}", part(e.low), part(e.high));
        vec![Cell::Words(of.parameters(number)), Cell::of(part(e.value), number.mark.clone()), Cell::Number(interval)]
    };
    html.table(&["pair", "second order", "95 %"], &found.iter().take(PAIRS).map(row).collect::<Vec<_>>());
}

fn sobol_title(found: &SobolIndices) -> String {
    let dropped = match found.dropped {
        0 => String::new(),
        n => format!("; {n} more have runs without a result"),
    };
    format!("Sobol indices: fractions of the variance, from {} points{dropped}", found.points)
}

/// Rank correlation and regression.
pub fn linear(html: &mut Html, of: &Finding<'_>) {
    let linear = &of.analysis.linear;
    if of.samples.inputs.is_empty() {
        return;
    }
    html.text("h3", "Rank correlation and standardised regression");
    if let Some(why) = &linear.without {
        return html.text("p", &format!("None: {why}."));
    }
    let picture = plots::linear(of);
    html.raw(&format!("<div class=\"pair\">\n<figure>{picture}</figure>\n<div>"));
    of.table(html, &LINEAR);
    html.text("p class=\"remark\"", &regression_words(linear));
    html.raw("</div></div>\n");
}

/// Rule for the direction of influence: all unmarked numbers whose interval excludes zero, of the rank correlation and
/// of the regression coefficient, which accounts for the other parameters.
pub const SIGN_RULE: &str = "The reading of a sign rests on the rank correlation and the coefficient alike: it is that of the      numbers without a † of their own whose interval leaves zero out. The coefficient sees a small effect beside great ones, the rank correlation      any rising or falling curve; where the two contradict each other, or neither is clear, the sign is not known.";

fn reading(linear: &Linear, parameter: usize) -> String {
    let rank = match linear.ranks.get(parameter) {
        Some(Ok(found)) => Some(found.rho).filter(|_| caution::rank(found).is_none()),
        Some(Err(why)) => return why.clone(),
        None => return String::new(),
    };
    let fitted = linear.regression.as_ref().ok().filter(|(_, found)| caution::regression(found).is_none());
    let slope = fitted.and_then(|(which, found)| {
        let at = which.iter().position(|i| *i == parameter)?;
        found.coefficients.get(at).copied()
    });
    let clear = [rank, slope].into_iter().flatten().filter(Estimate::is_clear);
    let mut signs = clear.map(|e| e.value > 0.0);
    match (signs.next(), signs.next()) {
        (None, _) => "sign not known",
        (Some(one), Some(other)) if one != other => "sign unknown: the two contradict each other",
        (Some(true), _) => "rises with it",
        (Some(false), _) => "falls",
    }
    .to_owned()
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

#[cfg(test)]
mod tests {
    use occupant_study::analysis::{RankCorrelation, Regression};

    use super::*;

    #[test]
    fn a_sign_rests_on_all_numbers_that_can_be_relied_on() {
        let estimate = |value: f64, half: f64| Estimate { value, low: value - half, high: value + half };
        let read = |rho: f64, rows: usize, slope: f64, explained: f64| {
            let fit = Regression { coefficients: vec![estimate(slope, 0.014)], explained, rows: 40 };
            let ranks = vec![Ok(RankCorrelation { rho: estimate(rho, 0.2), rows })];
            reading(&Linear { without: None, ranks, regression: Ok((vec![0], fit)) }, 0)
        };
        // a small effect beside great ones, which a rank correlation alone does not see
        assert_eq!(read(-0.12, 40, -0.179, 0.991), "falls");
        assert_eq!(read(0.4, 40, 0.01, 0.991), "rises with it");
        assert_eq!(read(0.4, 40, -0.179, 0.5), "rises with it", "a marked regression does not count");
        assert_eq!(read(0.4, 19, 0.0, 0.991), "sign not known", "nor does a marked rank correlation");
        assert_eq!(read(0.1, 40, 0.01, 0.991), "sign not known");
        assert!(read(0.4, 40, -0.179, 0.991).contains("contradict"));
    }
}

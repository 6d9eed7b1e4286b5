//! Every number of the report: the page and the table both show these.

use occupant_study::analysis::Estimate;

use super::analysis::{Analysis, ByDesign};
use super::caution;
use super::command::command;
use super::gather::Gathered;
use crate::jobs::sweep::stored::Stored;

/// One number of a response, SI units.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Number {
    /// What it is: `median`, `rank_correlation`, `sobol_total`, …
    pub(crate) quantity: &'static str,
    /// Its parameter, where it is of one.
    pub(crate) parameter: Option<usize>,
    /// Its run, where it is of one.
    pub(crate) run: Option<Run>,
    /// Whether it is in the unit of the response; else it is a plain number.
    pub(crate) in_unit: bool,
    /// Its value and its 95 % interval; NaN without one.
    pub(crate) estimate: Estimate,
    /// Rows, points or effects that it is made of.
    pub(crate) rows: usize,
    /// Why it should not be relied on.
    pub(crate) mark: Option<String>,
}

/// A run at an end of a response.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Run {
    pub(crate) number: u64,
    /// 0 for the greatest or least value, 1 for the next.
    pub(crate) place: u64,
    /// The command that runs it again; none where no shell can say it.
    pub(crate) command: Option<String>,
}

/// All numbers of a response.
pub(crate) fn numbers(opened: &Stored, gathered: &Gathered, analysis: &Analysis) -> Vec<Number> {
    let mut list = List {
        rows: analysis.spread.map_or(0, |s| s.members),
        mark: caution::lacking(analysis.spread.as_ref()).or(caution::spoiled(&gathered.spoiled[analysis.response])),
        numbers: Vec::new(),
    };
    list.spread(analysis);
    list.linear(analysis);
    list.by_design(&analysis.by_design);
    let extremes = &gathered.extremes[analysis.response];
    for (quantity, runs) in [("worst", &extremes.worst), ("best", &extremes.best)] {
        for (place, (value, (run, caveats))) in (0..).zip(runs) {
            let command = command(&opened.plan, &opened.manifest, *run);
            let run = Run { number: *run, place, command };
            let estimate = exactly(*value);
            let mark = Some(caveats.clone()).filter(|names| !names.is_empty());
            let number = Number { quantity, parameter: None, run: Some(run), in_unit: true, estimate, rows: 1, mark };
            list.numbers.push(number);
        }
    }
    list.numbers
}

/// A value without an interval.
fn exactly(value: f64) -> Estimate {
    Estimate { value, low: f64::NAN, high: f64::NAN }
}

struct List {
    /// Samples that have the response.
    rows: usize,
    /// Why all numbers are marked.
    mark: Option<String>,
    numbers: Vec<Number>,
}

impl List {
    fn put(&mut self, quantity: &'static str, in_unit: bool, estimate: Estimate) -> &mut Number {
        let (rows, mark) = (self.rows, self.mark.clone());
        self.numbers.push(Number { quantity, parameter: None, run: None, in_unit, estimate, rows, mark });
        let last = self.numbers.len() - 1;
        &mut self.numbers[last]
    }

    /// A number of so many rows, marked by its own rule or with all others; of a parameter or of all together.
    fn found(
        &mut self,
        (quantity, in_unit): (&'static str, bool),
        parameter: Option<usize>,
        estimate: Estimate,
        rows: usize,
        mark: Option<String>,
    ) {
        let number = self.put(quantity, in_unit, estimate);
        (number.parameter, number.rows) = (parameter, rows);
        number.mark = mark.or(number.mark.take());
    }

    fn spread(&mut self, analysis: &Analysis) {
        let Some(s) = analysis.spread else {
            return;
        };
        for (quantity, count) in [("samples", s.members), ("missing", s.missing)] {
            self.put(quantity, false, exactly(count as f64));
        }
        for (quantity, value) in [
            ("least", s.least),
            ("q05", s.q05),
            ("q25", s.q25),
            ("median", s.median),
            ("q75", s.q75),
            ("q95", s.q95),
            ("greatest", s.greatest),
        ] {
            self.put(quantity, true, exactly(value));
        }
    }

    fn linear(&mut self, analysis: &Analysis) {
        let linear = &analysis.linear;
        for (i, rank) in linear.ranks.iter().enumerate() {
            if let Ok(found) = rank {
                self.found(("rank_correlation", false), Some(i), found.rho, found.rows, caution::rank(found));
            }
        }
        if let Ok((which, found)) = &linear.regression {
            let mark = caution::regression(found);
            for (i, estimate) in which.iter().zip(&found.coefficients) {
                self.found(("regression_coefficient", false), Some(*i), *estimate, found.rows, mark.clone());
            }
            self.found(("r_squared", false), None, exactly(found.explained), found.rows, mark);
        }
    }

    fn by_design(&mut self, by_design: &ByDesign) {
        match by_design {
            ByDesign::Sobol(Ok(found)) => {
                for (quantity, estimates) in [("sobol_first", &found.first), ("sobol_total", &found.total)] {
                    for (i, estimate) in estimates.iter().enumerate() {
                        let mark = caution::index(estimate, i, found);
                        self.found((quantity, false), Some(i), *estimate, found.points, mark);
                    }
                }
            }
            ByDesign::Morris(Ok(found)) => {
                for (i, effect) in found.iter().enumerate() {
                    for (quantity, estimate) in [
                        ("morris_mu", effect.mean),
                        ("morris_mu_star", effect.mean_magnitude),
                        ("morris_sigma", exactly(effect.deviation)),
                    ] {
                        self.found((quantity, true), Some(i), estimate, effect.effects, caution::effect(effect));
                    }
                }
            }
            ByDesign::OneAtATime(Ok(found)) => {
                for (i, reach) in found.iter().enumerate() {
                    let [least, greatest] = reach.range();
                    let [low, high] = reach.ends().unwrap_or([f64::NAN; 2]);
                    for (quantity, value) in [
                        ("alone_nominal", reach.nominal),
                        ("alone_least", least),
                        ("alone_greatest", greatest),
                        ("alone_at_least_value", low),
                        ("alone_at_greatest_value", high),
                    ] {
                        self.found((quantity, true), Some(i), exactly(value), reach.levels.len(), None);
                    }
                }
            }
            _ => {}
        }
    }
}

//! Every number of the report: the page and the table both show these.

use occupant_study::analysis::Estimate;

use super::command::command;
use super::{Analysis, ByDesign, Gathered, caution};
use crate::sweep::Stored;

/// One number of a response, SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    /// Quantity: `median`, `rank_correlation`, `sobol_total`, …
    pub quantity: &'static str,
    /// Its parameter, if any.
    pub parameter: Option<usize>,
    /// The other parameter of a pair.
    pub other: Option<usize>,
    /// Its run, if any.
    pub run: Option<Run>,
    /// Whether it is in the unit of the response instead of a plain number.
    pub in_unit: bool,
    /// Its value and its 95 % interval; NaN without one.
    pub estimate: Estimate,
    /// Number of rows, points or effects used.
    pub rows: usize,
    /// Reason why it is unreliable.
    pub mark: Option<String>,
}

/// An extreme run of a response.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Its number.
    pub number: u64,
    /// Rank: 0 for the largest or least value, 1 for the next.
    pub place: u64,
    /// The command that repeats it; none if it cannot be written for a shell.
    pub command: Option<String>,
}

/// All numbers of a response.
pub fn numbers(opened: &Stored, gathered: &Gathered, analysis: &Analysis) -> Vec<Number> {
    let spoiled = || caution::spoiled(&gathered.spoiled[analysis.response]);
    let mut list = List { mark: caution::lacking(analysis.spread.as_ref()).or_else(spoiled), numbers: Vec::new() };
    list.spread(analysis);
    list.linear(analysis);
    list.by_design(&analysis.by_design);
    let extremes = &gathered.extremes[analysis.response];
    for (quantity, runs) in [("worst", &extremes.worst), ("best", &extremes.best)] {
        list.numbers.extend((0..).zip(runs).map(|(place, (value, (run, caveats)))| Number {
            quantity,
            parameter: None,
            other: None,
            run: Some(Run { number: *run, place, command: command(&opened.plan, &opened.manifest, *run) }),
            in_unit: true,
            estimate: exactly(*value),
            rows: 1,
            mark: Some(caveats.clone()).filter(|names| !names.is_empty()),
        }));
    }
    list.numbers
}

/// A value without an interval.
fn exactly(value: f64) -> Estimate {
    Estimate { value, low: f64::NAN, high: f64::NAN }
}

struct List {
    /// Reason to mark all numbers.
    mark: Option<String>,
    numbers: Vec<Number>,
}

impl List {
    /// Adds a number from `rows` rows, marked by its own rule or together with all others; for one parameter or for
    /// all.
    fn put(
        &mut self,
        (quantity, in_unit): (&'static str, bool),
        parameter: Option<usize>,
        estimate: Estimate,
        rows: usize,
        mark: Option<String>,
    ) {
        let mark = mark.or_else(|| self.mark.clone());
        self.numbers.push(Number { quantity, parameter, other: None, run: None, in_unit, estimate, rows, mark });
    }

    fn spread(&mut self, analysis: &Analysis) {
        let Some(s) = analysis.spread else {
            return;
        };
        for (quantity, in_unit, value) in [
            ("samples", false, s.members as f64),
            ("missing", false, s.missing as f64),
            ("least", true, s.least),
            ("q05", true, s.q05),
            ("q25", true, s.q25),
            ("median", true, s.median),
            ("q75", true, s.q75),
            ("q95", true, s.q95),
            ("greatest", true, s.greatest),
        ] {
            self.put((quantity, in_unit), None, exactly(value), s.members, None);
        }
    }

    fn linear(&mut self, analysis: &Analysis) {
        let linear = &analysis.linear;
        for (i, rank) in linear.ranks.iter().enumerate() {
            if let Ok(found) = rank {
                self.put(("rank_correlation", false), Some(i), found.rho, found.rows, caution::rank(found));
            }
        }
        if let Ok((which, found)) = &linear.regression {
            let mark = caution::regression(found);
            for (i, estimate) in which.iter().zip(&found.coefficients) {
                self.put(("regression_coefficient", false), Some(*i), *estimate, found.rows, mark.clone());
            }
            self.put(("r_squared", false), None, exactly(found.explained), found.rows, mark);
        }
    }

    fn by_design(&mut self, by_design: &ByDesign) {
        match by_design {
            ByDesign::Sobol(Ok(found)) => {
                for (quantity, estimates) in [("sobol_first", &found.first), ("sobol_total", &found.total)] {
                    for (i, estimate) in estimates.iter().enumerate() {
                        let mark = caution::index(estimate, i, found);
                        self.put((quantity, false), Some(i), *estimate, found.points, mark);
                    }
                }
                for ([i, j], estimate) in &found.second {
                    let mark = caution::index(estimate, *i, found).or_else(|| caution::index(estimate, *j, found));
                    self.put(("sobol_second", false), Some(*i), *estimate, found.points, mark);
                    self.numbers.iter_mut().next_back().into_iter().for_each(|number| number.other = Some(*j));
                }
            }
            ByDesign::Morris(Ok(found)) => {
                for (i, effect) in found.iter().enumerate() {
                    for (quantity, estimate) in [
                        ("morris_mu", effect.mean),
                        ("morris_mu_star", effect.mean_magnitude),
                        ("morris_sigma", exactly(effect.deviation)),
                    ] {
                        self.put((quantity, true), Some(i), estimate, effect.effects, caution::effect(effect));
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
                        self.put((quantity, true), Some(i), exactly(value), reach.levels, None);
                    }
                }
            }
            _ => {}
        }
    }
}

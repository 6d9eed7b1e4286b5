//! Every number of the report, one after the other.

use occupant_study::analysis::Estimate;

use super::analysis::{Analysis, ByDesign};
use super::command::command;
use super::{Report, caution};

/// One number of the report, SI units.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Number {
    /// Name of the response.
    pub(crate) response: String,
    /// What it is: `median`, `rank_correlation`, `sobol_total`, …
    pub(crate) quantity: &'static str,
    /// Name of the parameter, empty where it is of none.
    pub(crate) parameter: String,
    /// Number of the run, where it is of one.
    pub(crate) run: Option<u64>,
    pub(crate) value: f64,
    /// Ends of its 95 % interval; NaN without one.
    pub(crate) interval: [f64; 2],
    /// Its unit, `1` for a plain number.
    pub(crate) unit: String,
    /// Rows, points or effects that it is made of.
    pub(crate) rows: usize,
    /// Why it should not be relied on; empty if no rule speaks against it.
    pub(crate) mark: String,
    /// The command that runs the run again.
    pub(crate) command: String,
}

pub(crate) fn numbers(report: &Report) -> Vec<Number> {
    let of = |analysis: &Analysis| {
        let mut list = List::of(report, analysis);
        list.spread();
        list.linear();
        list.by_design();
        list.ends();
        list.numbers
    };
    report.analyses.iter().flat_map(of).collect()
}

struct List<'a> {
    report: &'a Report,
    analysis: &'a Analysis,
    rows: usize,
    /// Why all numbers are marked.
    mark: Option<String>,
    numbers: Vec<Number>,
}

impl<'a> List<'a> {
    fn of(report: &'a Report, analysis: &'a Analysis) -> Self {
        List {
            report,
            analysis,
            rows: analysis.spread.map_or(0, |s| s.members),
            mark: caution::lacking(analysis.spread.as_ref()),
            numbers: Vec::new(),
        }
    }

    fn put(&mut self, quantity: &'static str, unit: &str, value: f64) -> &mut Number {
        let response = &self.report.gathered.samples.responses[self.analysis.response];
        self.numbers.push(Number {
            response: response.name.clone(),
            quantity,
            parameter: String::new(),
            run: None,
            value,
            interval: [f64::NAN; 2],
            unit: match unit {
                "" => response.unit.clone(),
                unit => unit.to_owned(),
            },
            rows: self.rows,
            mark: self.mark.clone().unwrap_or_default(),
            command: String::new(),
        });
        let last = self.numbers.len() - 1;
        &mut self.numbers[last]
    }

    /// A number of a parameter with its interval and why it is marked.
    fn estimate(
        &mut self,
        quantity: &'static str,
        unit: &str,
        parameter: usize,
        estimate: &Estimate,
        mark: Option<String>,
    ) -> &mut Number {
        let name = self.report.gathered.samples.inputs[parameter].name.clone();
        let number = self.put(quantity, unit, estimate.value);
        number.parameter = name;
        number.interval = [estimate.low, estimate.high];
        if let Some(mark) = mark {
            number.mark = mark;
        }
        number
    }

    fn spread(&mut self) {
        let Some(s) = self.analysis.spread else {
            return;
        };
        self.put("samples", "1", s.members as f64);
        self.put("missing", "1", s.missing as f64);
        for (quantity, value) in [
            ("least", s.least),
            ("q05", s.q05),
            ("q25", s.q25),
            ("median", s.median),
            ("q75", s.q75),
            ("q95", s.q95),
            ("greatest", s.greatest),
        ] {
            self.put(quantity, "", value);
        }
    }

    fn linear(&mut self) {
        let linear = &self.analysis.linear;
        for (i, rank) in linear.ranks.iter().enumerate() {
            if let Ok(found) = rank {
                let mark = caution::rank(found);
                self.estimate("rank_correlation", "1", i, &found.rho, mark).rows = found.rows;
            }
        }
        if let Ok((which, found)) = &linear.regression {
            let mark = caution::regression(found);
            for (i, estimate) in which.iter().zip(&found.coefficients) {
                self.estimate("regression_coefficient", "1", *i, estimate, mark.clone()).rows = found.rows;
            }
            let explained = self.put("r_squared", "1", found.explained);
            explained.rows = found.rows;
            explained.mark = mark.unwrap_or_else(|| explained.mark.clone());
        }
    }

    fn by_design(&mut self) {
        match &self.analysis.by_design {
            ByDesign::Sobol(Ok(found)) => {
                let all = [("sobol_first", &found.first), ("sobol_total", &found.total)];
                for (quantity, estimates) in all {
                    for (i, estimate) in estimates.iter().enumerate() {
                        let mark = caution::index(estimate, found);
                        self.estimate(quantity, "1", i, estimate, mark).rows = found.points;
                    }
                }
            }
            ByDesign::Morris(Ok(found)) => {
                for (i, effect) in found.iter().enumerate() {
                    let sigma = Estimate { value: effect.deviation, low: f64::NAN, high: f64::NAN };
                    for (quantity, estimate) in [
                        ("morris_mu", &effect.mean),
                        ("morris_mu_star", &effect.mean_magnitude),
                        ("morris_sigma", &sigma),
                    ] {
                        let mark = caution::effect(effect);
                        self.estimate(quantity, "", i, estimate, mark).rows = effect.effects;
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
                        let name = self.report.gathered.samples.inputs[i].name.clone();
                        let number = self.put(quantity, "", value);
                        number.parameter = name;
                        number.rows = reach.levels.len();
                    }
                }
            }
            _ => {}
        }
    }

    fn ends(&mut self) {
        let opened = &self.report.opened;
        let extremes = &self.report.gathered.extremes[self.analysis.response];
        for (quantity, runs) in [("worst", &extremes.worst), ("best", &extremes.best)] {
            for (value, run) in runs {
                let again = command(&opened.plan, &opened.manifest, *run).unwrap_or_default();
                let number = self.put(quantity, "", *value);
                number.run = Some(*run);
                number.rows = 1;
                number.mark.clear();
                number.command = again;
            }
        }
    }
}

//! The `[fit]` of a study: times in SI units, weights and windows that make sense, parameters with ends.

use indexmap::IndexMap;

use super::{Binder, Purpose};
use crate::fit::Fit;
use crate::fit_section::{FitChannel, FitSection, FitTest};
use crate::{Parameter, Study, StudyText};
use occupant_scenario::Time;
use occupant_scenario::{Diagnostics, Draft, Resolver};
use occupant_units::trig::ln;
use placed_text::{Problem, Value};

/// Default number of evaluations per parameter.
pub(super) const BUDGET: u64 = 400;
const POPULATION: usize = 16;
pub(super) const TOLERANCE: f64 = 1e-4;
const MOST_EVALUATIONS: u64 = 10_000_000;
const MOST_CANDIDATES: u64 = 10_000;

impl StudyText {
    /// The fit section of the study; without one, that of an empty `[fit]`.
    ///
    /// # Errors
    /// All problems of it, as far as that can be seen without tests and scenarios.
    pub fn fit(&self) -> Result<Fit, Diagnostics> {
        let empty = FitSection::default();
        let section = self.section.fit.as_ref().unwrap_or(&empty);
        let mut binder = Binder::new(self, Purpose::Sweep);
        if self.section.parameters.is_empty() {
            let hint = "[[parameters]] with `path` and `range`".to_owned();
            let found = "nothing to fit";
            binder.error("", found, "`parameters` with ranges", Some(hint));
        }
        let numbers = [("tolerance", section.tolerance), ("near", section.near)];
        binder.search_limits("fit", section.budget, section.population, numbers);
        let window_s = [&section.from, &section.to].map(|time| time.as_ref().map(Time::si));
        binder.check_window(window_s, "fit");
        binder.check_channels(&section.channels);
        for (i, test) in section.tests.iter().enumerate() {
            binder.check_test(test, &format!("fit.tests[{i}]"));
        }
        let n = self.section.parameters.len();
        let fit = Fit {
            misfit: section.objective.unwrap_or_default(),
            filter: section.filter.unwrap_or_default(),
            channels: section.channels.clone(),
            tests: section.tests.clone(),
            window_s,
            seed: self.section.seed.unwrap_or(0),
            budget: section.budget.unwrap_or(BUDGET * n.max(1) as u64),
            population: population(section.population, n),
            tolerance: section.tolerance.unwrap_or(TOLERANCE),
            near: section.near,
        };
        if binder.problems.has_errors() { Err(binder.problems) } else { Ok(fit) }
    }

    /// Checks the study against the base scenario of a `test`: the additional entries of its scenario, and their position in the
    /// study; then come the `overrides` of a command line. A design, an ensemble and correlations of the study are for
    /// sweeps and count for nothing here.
    ///
    /// # Errors
    /// As [`StudyText::bind`]; a parameter without finite ends.
    pub fn bind_fit(
        &self,
        base: Draft,
        test: (&IndexMap<String, Value>, &str),
        overrides: &[String],
        resolver: Resolver,
    ) -> Result<Study, Diagnostics> {
        self.bind_for(Purpose::Fit(test), base, overrides, resolver)
    }

    /// A problem at a path of the study, such as `fit.channels[2].channel`.
    pub fn complaint(
        &self,
        path: &str,
        found: impl Into<String>,
        expected: impl Into<String>,
        hint: Option<String>,
    ) -> Diagnostics {
        let mut problems = Diagnostics::new();
        self.report(&mut problems, Problem::error(path, found, expected).with_hint(hint));
        problems
    }
}

/// Candidates of a generation for this many parameters: as written, or 4 + ⌊3 ln n⌋ and at least the standard.
pub(super) fn population(written: Option<u64>, parameters: usize) -> usize {
    let wanted = 4 + (3.0 * ln(parameters.max(1) as f64)) as usize;
    written.map_or(wanted.max(POPULATION), |p| p.min(MOST_CANDIDATES) as usize)
}

impl Binder<'_> {
    /// Checks the ranges of the numbers of a search in this section of the study.
    pub(super) fn search_limits<const N: usize>(
        &mut self,
        section: &str,
        budget: Option<u64>,
        population: Option<u64>,
        numbers: [(&str, Option<f64>); N],
    ) {
        let counts = [("budget", budget, MOST_EVALUATIONS), ("population", population, MOST_CANDIDATES)];
        for (key, count, most) in counts {
            if let Some(count) = count.filter(|n| *n > most) {
                let at = format!("{section}.{key}");
                self.error(&at, format!("`{count}`"), format!("at most {most}"), None);
            }
        }
        for (key, number) in numbers {
            if number.is_some_and(|x| !(x > 0.0 && x.is_finite())) {
                let at = format!("{section}.{key}");
                self.error(&at, "not a number above 0", "a number above 0", None);
            }
        }
    }

    /// Reports parameters without bounds to search between.
    pub(super) fn have_ends(&mut self, parameters: &[Parameter]) {
        // a broken parameter shifts the others, and so does one that stands for several
        let written = self.text.section.parameters.len();
        for (i, parameter) in parameters.iter().enumerate() {
            if parameter.law.bounds().is_none() {
                let at = if parameters.len() == written { format!("parameters[{i}]") } else { "parameters".to_owned() };
                let found = format!("`{}` has no range to search", parameter.name);
                let expected = "a `range`, a `grid`, or a distribution with `from` and `to`";
                let hint = "range = { from = …, to = … }".to_owned();
                self.error(&at, found, expected, Some(hint));
            }
        }
    }

    fn check_window(&mut self, [from_s, to_s]: [Option<f64>; 2], at: &str) {
        if from_s.zip(to_s).is_some_and(|(from_s, to_s)| from_s >= to_s) {
            self.error(&format!("{at}.to"), "`to` is not after `from`", "`from` before `to`", None);
        }
    }

    fn check_channels(&mut self, channels: &[FitChannel]) {
        for (i, channel) in channels.iter().enumerate() {
            let at = format!("fit.channels[{i}]");
            if channels[..i].iter().any(|c| c.name == channel.name) {
                let found = format!("the channel `{}` twice", channel.name);
                self.error(&format!("{at}.channel"), found, "each channel once", None);
            }
            self.check_weight(channel.weight(), &at);
        }
    }

    fn check_test(&mut self, test: &FitTest, at: &str) {
        if let Some(seat) = test.seat.as_ref().filter(|seat| seat.chars().count() != 1) {
            let expected = "one character, such as \"1\" or \"3\"";
            self.error(&format!("{at}.seat"), format!("\"{seat}\" is not a position"), expected, None);
        }
        self.check_window(test.window_s(), at);
        let [offset, gain] = test.nuisances();
        for (key, ends, least) in [("offset", offset, f64::NEG_INFINITY), ("gain", gain, 0.0)] {
            if ends.is_some_and(|[from, to]| !(least < from && from < to && to.is_finite())) {
                let expected = "`from` below `to`, of a gain both above 0";
                self.error(&format!("{at}.{key}"), "an empty range", expected, None);
            }
        }
        self.check_weight(test.weight(), at);
    }

    pub(super) fn check_weight(&mut self, weight: f64, at: &str) {
        if !(weight > 0.0 && weight.is_finite()) {
            self.error(&format!("{at}.weight"), format!("a weight of {weight}"), "a number above zero", None);
        }
    }
}

//! A study meets its base scenario: paths find their places, numbers their units, and everything that does not fit is reported.

mod constraints;
mod correlations;
mod design;
mod ensemble;
mod extremes;
mod fit;
mod law;
mod optimise;
mod parameters;
mod table;

pub use design::MOST_RUNS;
use indexmap::IndexMap;
pub use optimise::is_allowed;

use super::Study;
use super::copula::Copula;
use super::design::Design;
use super::ensemble::Ensemble;
use super::keep::Keep;
use super::parameter::Parameter;
use super::sobol::Sobol;
use super::text::StudyText;
use occupant_scenario::kind::UnitSystem;
use occupant_scenario::{Diagnostics, Draft, Resolver, Wanted};
use placed_text::{Problem, Value, with_key};

impl StudyText {
    /// Checks the study against its base scenario. What the study's `set` says is put into the base first, then the
    /// `overrides` of a command line, each `path=value`; `resolver` gives the files that the study names.
    ///
    /// # Errors
    /// Everything that is wrong with the base's words; else everything that is wrong with the study.
    pub fn bind(&self, base: Draft, overrides: &[String], resolver: Resolver) -> Result<Study, Diagnostics> {
        self.bind_for(Purpose::Sweep, base, overrides, resolver)
    }

    fn bind_for(
        &self,
        purpose: Purpose,
        mut base: Draft,
        overrides: &[String],
        resolver: Resolver,
    ) -> Result<Study, Diagnostics> {
        let mut binder = Binder::new(self, purpose);
        binder.prepare(&mut base, overrides)?;
        binder.base = Some(&base);
        let mut parameters = binder.parameters();
        let (design, copula, ensemble) = binder.varied(&base, &mut parameters, resolver);
        let keep = binder.keep();
        binder.sizes(&parameters, &design, ensemble.as_ref());
        let relations = binder.relations(&parameters, &design);
        extremes::check(&mut binder, &base, &parameters, overrides);
        if binder.problems.has_errors() {
            return Err(binder.problems);
        }
        let (warnings, changes) = (binder.problems, binder.changes);
        let dimensions = match design {
            Design::Saltelli { .. } => 2 * parameters.len(),
            _ => parameters.len(),
        };
        let output = self.section.output.as_ref();
        let study = Study {
            base: base.prepared(),
            base_name: self.section.base.clone(),
            changes,
            seed: self.section.seed.unwrap_or(0),
            parameters,
            design,
            sobol: Sobol::new(dimensions),
            copula,
            relations,
            ensemble,
            keep,
            csv: output.and_then(|o| o.csv).unwrap_or(false),
            measures: output.and_then(|o| o.measures.clone()).unwrap_or_default(),
            warnings,
        };
        if purpose == Purpose::Sweep {
            self.refuse_nothing_left(&study)?;
        }
        Ok(study)
    }
}

/// Largest number of entries in a list of a study.
const MOST_ENTRIES: usize = 1000;

/// Use of a study.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Purpose<'a> {
    /// A sweep of its design.
    Sweep,
    /// A fit to a test, which has its own scenario values at a path of the study.
    Fit((&'a IndexMap<String, Value>, &'a str)),
    /// An optimisation.
    Optimise,
}

/// Work on a study text, with the problems found so far.
pub(super) struct Binder<'a> {
    pub(super) text: &'a StudyText,
    pub(super) purpose: Purpose<'a>,
    pub(super) base: Option<&'a Draft>,
    pub(super) changes: Vec<(String, String)>,
    pub(super) problems: Diagnostics,
}

impl<'a> Binder<'a> {
    fn new(text: &'a StudyText, purpose: Purpose<'a>) -> Self {
        Binder { text, purpose, base: None, changes: Vec::new(), problems: Diagnostics::new() }
    }

    /// The units of bare numbers in the study.
    pub(super) fn units(&self) -> UnitSystem {
        self.text.section.units.unwrap_or_default()
    }

    pub(super) fn error(
        &mut self,
        path: &str,
        found: impl Into<String>,
        expected: impl Into<String>,
        hint: Option<String>,
    ) {
        self.report(Problem::error(path, found, expected).with_hint(hint));
    }

    /// Adds a problem at the place of the study that its path points to.
    pub(super) fn report(&mut self, problem: Problem) {
        self.text.report(&mut self.problems, problem);
    }

    /// The samples and the ensemble; a fit has neither, an optimisation no samples.
    fn varied(
        &mut self,
        base: &Draft,
        parameters: &mut Vec<Parameter>,
        resolver: Resolver,
    ) -> (Design, Option<Copula>, Option<Ensemble>) {
        if self.purpose != Purpose::Sweep {
            self.have_ends(parameters);
            let is_optimised = self.purpose == Purpose::Optimise;
            let ensemble = is_optimised.then(|| ensemble::bind(self, base, parameters)).flatten();
            return (Design::Single, None, ensemble);
        }
        let design = self.design(parameters, resolver);
        let copula = self.copula(parameters, &design);
        let ensemble = ensemble::bind(self, base, parameters);
        (design, copula, ensemble)
    }

    /// Sets the values common to all runs in the base scenario.
    fn prepare(&mut self, base: &mut Draft, overrides: &[String]) -> Result<(), Diagnostics> {
        let text = self.text;
        self.refuse_many();
        if self.problems.has_errors() {
            return Err(std::mem::take(&mut self.problems));
        }
        self.set(base, &text.section.set, "set");
        if let Purpose::Fit((set, at)) = self.purpose {
            self.set(base, set, at);
        }
        for assignment in overrides {
            base.set(assignment)?;
            if let Some((path, value)) = assignment.split_once('=') {
                let change = (path.trim().to_owned(), value.trim().to_owned());
                self.changes.push(change);
            }
        }
        let wrong = base.check();
        if wrong.has_errors() { Err(wrong) } else { Ok(()) }
    }

    /// Refuses lists too long to be hand-written: each entry is compared with all others and with the base.
    fn refuse_many(&mut self) {
        let section = &self.text.section;
        let (fit, optimise) = (section.fit.as_ref(), section.optimise.as_ref());
        let perturbations = section.ensemble.as_ref().map_or(&[][..], |ensemble| &ensemble.perturbations);
        // a parameter of several paths counts as often
        let times = |paths: &Option<Vec<String>>| paths.as_ref().map_or(1, |paths| paths.len().max(1));
        let lists = [
            ("parameters", section.parameters.iter().map(|parameter| times(&parameter.paths)).sum()),
            ("set", section.set.len()),
            ("correlations", section.correlations.len()),
            ("constraints", section.constraints.iter().map(|constraint| constraint.sum.len().max(1)).sum()),
            ("ensemble.perturbations", perturbations.iter().map(|each| times(&each.paths)).sum()),
            ("fit.channels", fit.map_or(0, |fit| fit.channels.len())),
            ("fit.tests", fit.map_or(0, |fit| fit.tests.len())),
            ("optimise.goals", optimise.and_then(|of| of.goals.as_ref()).map_or(0, Vec::len)),
            ("optimise.constraints", optimise.map_or(0, |of| of.constraints.len())),
            ("rating.places", section.rating.as_ref().map_or(0, |rating| rating.places.len())),
        ];
        for (at, entries) in lists.into_iter().filter(|(_, entries)| *entries > MOST_ENTRIES) {
            self.error(at, format!("{entries} entries"), format!("at most {MOST_ENTRIES}"), None);
        }
    }

    /// Sets the values of the `set` at `at` in the base scenario.
    fn set(&mut self, base: &mut Draft, set: &IndexMap<String, Value>, at: &str) {
        for (path, value) in set {
            let value = self.written(base, path, value);
            self.changes.push((path.clone(), value.clone()));
            if let Err(problems) = base.set_value(path, &value) {
                for d in problems.iter() {
                    let at = with_key(at, path);
                    self.error(&at, &d.problem.found, &d.problem.expected, None);
                }
            }
        }
    }

    /// A value of `set` in the form that the base reads; a bare number is in the study's units.
    fn written(&self, base: &Draft, path: &str, value: &Value) -> String {
        let wanted = base.places(path).ok().and_then(|p| p.into_iter().next());
        let unit = match wanted.map(|p| p.wanted) {
            Some(Wanted::Quantity(kind)) => kind.bare_unit(self.units()),
            _ => "",
        };
        match value {
            Value::Bool(b) => b.to_string(),
            Value::Integer(i) => format!("{i} {unit}").trim().to_owned(),
            Value::Float(x) => format!("{x:?} {unit}").trim().to_owned(),
            Value::String(text) => toml::Value::String(text.clone()).to_string(),
            // the check has refused all others
            Value::Null | Value::Array(_) | Value::Table(_) => String::new(),
        }
    }

    fn keep(&mut self) -> Keep {
        let Some(section) = &self.text.section.keep else { return Keep::default() };
        Keep::read(section).unwrap_or_else(|found| {
            let expected = "\"all\", \"none\", a list of indices, or such as \"worst 5 by hic15\"";
            self.error("keep", found, expected, None);
            Keep::default()
        })
    }
}

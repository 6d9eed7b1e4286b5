//! A study meets its base scenario: paths find their places, numbers their units, and everything that does not fit is told.

mod ensemble;
mod extremes;
mod law;
mod table;

use self::law::Quantities;
use super::copula::Copula;
use super::design::Design;
use super::keep::Keep;
use super::law::Law;
use super::model::{ApplyChoice, DesignSection, Free, ParameterSection};
use super::parameter::{Parameter, Target, si_unit};
use super::sobol::{MAX_DIMENSIONS, Sobol};
use super::text::{StudyText, problem};
use super::{Ensemble, Study};
use crate::problem::Severity;
use crate::scenario::kind::{KINDS, Kind, RATIO, UnitSystem};
use crate::scenario::path_text::with_key;
use crate::scenario::place::{Misplaced, Place, Wanted};
use crate::scenario::{Diagnostics, Draft, Resolver};

impl StudyText {
    /// Checks the study against its base scenario. What the study's `set` says is put into the base first, then the
    /// `overrides` of a command line, each `path=value`; `resolver` gives the files that the study names.
    ///
    /// # Errors
    /// Everything that is wrong with the base's words; else everything that is wrong with the study.
    pub fn bind(
        &self,
        mut base: Draft,
        overrides: &[String],
        resolver: Resolver,
    ) -> Result<Study, Diagnostics> {
        let mut binder = Binder::new(self);
        binder.prepare(&mut base, overrides)?;
        binder.base = Some(&base);
        let mut parameters = binder.parameters();
        let design = binder.design(&mut parameters, resolver);
        let copula = binder.copula(&parameters, &design);
        let ensemble = ensemble::bind(&mut binder, &base);
        let keep = binder.keep();
        binder.sizes(&parameters, &design, ensemble.as_ref());
        extremes::check(&mut binder, &base, &parameters, overrides);
        if binder.problems.has_errors() {
            return Err(binder.problems);
        }
        let warnings = binder.problems;
        let dimensions = match design {
            Design::Saltelli { .. } => 2 * parameters.len(),
            _ => parameters.len(),
        };
        Ok(Study {
            base,
            base_name: self.section.base.clone(),
            seed: self.section.seed.unwrap_or(0),
            parameters,
            design,
            sobol: Sobol::new(dimensions),
            copula,
            ensemble,
            keep,
            csv: self
                .section
                .output
                .as_ref()
                .and_then(|o| o.csv)
                .unwrap_or(false),
            warnings,
        })
    }
}

/// Work on a study text, with the problems found so far.
pub(super) struct Binder<'a> {
    pub(super) text: &'a StudyText,
    pub(super) base: Option<&'a Draft>,
    pub(super) problems: Diagnostics,
}

impl<'a> Binder<'a> {
    fn new(text: &'a StudyText) -> Self {
        Binder {
            text,
            base: None,
            problems: Diagnostics::new(),
        }
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
        let problem = problem(Severity::Error, path, found, expected, hint);
        self.text.report(&mut self.problems, problem);
    }

    fn misplaced(&mut self, path: &str, error: Misplaced) {
        self.error(path, error.found, error.expected, error.hint);
    }

    /// Puts what is the same in all runs into the base.
    fn prepare(&mut self, base: &mut Draft, overrides: &[String]) -> Result<(), Diagnostics> {
        for (path, value) in &self.text.section.set {
            let value = match value {
                Free::Truth(b) => b.to_string(),
                Free::Integer(i) => i.to_string(),
                Free::Float(x) => format!("{x:?}"),
                Free::Text(text) => toml::Value::String(text.clone()).to_string(),
            };
            if let Err(problems) = base.set_value(path, &value) {
                for d in problems.iter() {
                    let at = with_key("set", path);
                    self.error(&at, &d.problem.found, &d.problem.expected, None);
                }
            }
        }
        for assignment in overrides {
            base.set(assignment)?;
        }
        let wrong = base.check();
        match wrong.has_errors() {
            true => Err(wrong),
            false => Ok(()),
        }
    }

    /// The parameters that have found their places; a broken one is reported and left out.
    fn parameters(&mut self) -> Vec<Parameter> {
        let sections = &self.text.section.parameters;
        let mut found: Vec<Parameter> = Vec::new();
        for (i, section) in sections.iter().enumerate() {
            let at = format!("parameters[{i}]");
            if let Some(parameter) = self.parameter(section, &at) {
                self.clash(&parameter, &found, &at);
                found.push(parameter);
            }
        }
        found
    }

    fn parameter(&mut self, section: &ParameterSection, at: &str) -> Option<Parameter> {
        let paths: Vec<(String, &str)> = match (&section.path, &section.paths) {
            (Some(path), _) => vec![(format!("{at}.path"), path)],
            (None, Some(paths)) => paths
                .iter()
                .enumerate()
                .map(|(i, p)| (format!("{at}.paths[{i}]"), p.as_str()))
                .collect(),
            (None, None) => return None,
        };
        let places = self.places(&paths)?;
        let apply = section.apply.unwrap_or_default();
        let wanted = self.common(&places, &paths[0].0)?;
        let kind = match wanted {
            Wanted::Quantity(kind) => Some(kind),
            _ => None,
        };
        if apply != ApplyChoice::Value && !self.all_numbers(&places, &paths[0].0, apply) {
            return None;
        }
        let law = self.law(section, at, apply, &wanted)?;
        Some(Parameter {
            name: section
                .name
                .clone()
                .unwrap_or_else(|| paths[0].1.to_owned()),
            unit: match apply {
                ApplyChoice::Factor => "",
                _ => kind.map_or("", si_unit),
            },
            apply,
            law,
            targets: places.iter().map(Target::of).collect(),
        })
    }

    /// The places of several paths, each once; none if any path leads nowhere.
    pub(super) fn places(&mut self, paths: &[(String, &str)]) -> Option<Vec<Place>> {
        let base = self.base?;
        let mut places: Vec<Place> = Vec::new();
        let mut whole = true;
        for (at, path) in paths {
            match base.places(path) {
                Ok(found) => {
                    for place in found {
                        if !places.iter().any(|p| p.path == place.path) {
                            places.push(place);
                        }
                    }
                }
                Err(error) => {
                    self.misplaced(at, error);
                    whole = false;
                }
            }
        }
        (whole && !places.is_empty()).then_some(places)
    }

    /// What may stand at all of the places.
    pub(super) fn common(&mut self, places: &[Place], at: &str) -> Option<Wanted> {
        let first = places.first()?;
        let other = places.iter().find(|p| p.wanted != first.wanted);
        match other {
            None => Some(first.wanted.clone()),
            Some(other) => {
                let found = format!(
                    "`{}` is {}, `{}` is {}",
                    first.path,
                    noun(&first.wanted),
                    other.path,
                    noun(&other.wanted)
                );
                self.error(at, found, "places of one kind", None);
                None
            }
        }
    }

    /// Whether there are numbers to multiply or to add to.
    pub(super) fn all_numbers(&mut self, places: &[Place], at: &str, apply: ApplyChoice) -> bool {
        let Some(other) = places.iter().find(|p| p.si.is_none()) else {
            return true;
        };
        let word = match apply {
            ApplyChoice::Factor => "multiplied",
            _ => "added to",
        };
        let what = match other.value {
            Some(_) => format!("is {}", noun(&other.wanted)),
            None => "is not in the base scenario".to_owned(),
        };
        let found = format!("`{}` {what}, so it cannot be {word}", other.path);
        self.error(
            at,
            found,
            "a path to numbers that the base scenario has",
            None,
        );
        false
    }

    fn law(
        &mut self,
        section: &ParameterSection,
        at: &str,
        apply: ApplyChoice,
        wanted: &Wanted,
    ) -> Option<Law> {
        let by_table = matches!(self.text.section.design, Some(DesignSection::Table(_)));
        let given = section.grid.is_some()
            || section.list.is_some()
            || section.range.is_some()
            || section.distribution.is_some();
        if by_table && given {
            let expected = "no `grid`, `list`, `range` or `distribution`";
            self.error(
                at,
                "values for a parameter that the table of samples varies",
                expected,
                None,
            );
            return None;
        }
        if by_table {
            return Some(Law::Table);
        }
        if !given {
            let hint = "grid = { from = …, to = …, steps = … }".to_owned();
            let expected = "`grid`, `list`, `range` or `distribution`";
            self.error(
                at,
                "a parameter that does not say how it varies",
                expected,
                Some(hint),
            );
            return None;
        }
        let kind = match (apply, wanted) {
            (ApplyChoice::Factor, _) => Some(&KINDS[RATIO]),
            (_, Wanted::Quantity(kind)) => Some(*kind),
            (_, Wanted::Number) => Some(&KINDS[RATIO]),
            _ => None,
        };
        let quantities = Quantities {
            kind,
            wanted,
            units: self.units(),
        };
        quantities.law(self, section, at)
    }

    /// Tells of two parameters of one name, and of a value that an earlier parameter has already put there.
    fn clash(&mut self, parameter: &Parameter, earlier: &[Parameter], at: &str) {
        if earlier.iter().any(|p| p.name == parameter.name) {
            let found = format!("a second parameter named `{}`", parameter.name);
            self.error(at, found, "a name of its own", Some("name = \"…\"".into()));
        }
        if parameter.apply != ApplyChoice::Value {
            return;
        }
        for other in earlier {
            let shared = parameter
                .targets
                .iter()
                .find(|t| other.targets.iter().any(|o| o.path == t.path));
            if let Some(target) = shared {
                let found = format!("`{}` is already varied by `{}`", target.path, other.name);
                let hint = "a factor or an offset may follow a value, but not the other way round";
                self.error(
                    at,
                    found,
                    "each place varied by one value",
                    Some(hint.into()),
                );
            }
        }
    }

    fn design(&mut self, parameters: &mut Vec<Parameter>, resolver: Resolver) -> Design {
        let section = &self.text.section;
        let tail = |tail: &Option<crate::scenario::model::Ratio>| {
            tail.as_ref()
                .and_then(|t| t.si(UnitSystem::Si).ok())
                .unwrap_or(0.05)
        };
        let Some(design) = &section.design else {
            if !section.parameters.is_empty() {
                let hint = "design = { kind = \"latin_hypercube\", samples = 100 }".to_owned();
                self.error(
                    "",
                    "parameters without a `design`",
                    "how the samples are chosen",
                    Some(hint),
                );
            } else if section.ensemble.is_none() {
                let expected = "`parameters` and a `design`, or an `ensemble`";
                self.error("", "the study varies nothing", expected, None);
            }
            return Design::Single;
        };
        if let DesignSection::Table(table) = design {
            let rows = table::rows(self, &table.file, parameters, resolver);
            return Design::Table { rows };
        }
        if section.parameters.is_empty() {
            self.error(
                "design",
                "a design without parameters",
                "`[[parameters]]`",
                None,
            );
        }
        match design {
            DesignSection::FullFactorial(_) => Design::FullFactorial,
            DesignSection::LatinHypercube(d) => Design::LatinHypercube { samples: d.samples },
            DesignSection::MonteCarlo(d) => Design::MonteCarlo { samples: d.samples },
            DesignSection::Sobol(d) => Design::Sobol {
                samples: d.samples,
                scramble: d.scramble.unwrap_or(true),
            },
            DesignSection::OneAtATime(d) => Design::OneAtATime {
                tail: tail(&d.tail),
            },
            DesignSection::Saltelli(d) => Design::Saltelli {
                samples: d.samples,
                second_order: d.second_order.unwrap_or(false),
            },
            DesignSection::Morris(d) => Design::Morris {
                trajectories: d.trajectories,
                levels: d.levels.unwrap_or(4),
                tail: tail(&d.tail),
            },
            DesignSection::Table(_) => Design::Single,
        }
    }

    fn copula(&mut self, parameters: &[Parameter], design: &Design) -> Option<Copula> {
        let sections = &self.text.section.correlations;
        if sections.is_empty() {
            return None;
        }
        let sampled = matches!(
            design,
            Design::LatinHypercube { .. } | Design::Sobol { .. } | Design::MonteCarlo { .. }
        );
        if !sampled {
            let expected = "the design \"latin_hypercube\", \"sobol\" or \"monte_carlo\"";
            self.error(
                "correlations",
                "correlations in a design that has none",
                expected,
                None,
            );
            return None;
        }
        let mut ranks: Vec<(usize, usize, f64)> = Vec::new();
        for (n, section) in sections.iter().enumerate() {
            let [a, b] = [0, 1].map(|side| self.correlated(parameters, n, side));
            let (Some(a), Some(b)) = (a, b) else { continue };
            if !(-1.0..=1.0).contains(&section.rank) {
                let found = format!("a correlation of {}", section.rank);
                self.error(
                    &format!("correlations[{n}].rank"),
                    found,
                    "a number from -1 to 1",
                    None,
                );
            } else if a == b
                || ranks
                    .iter()
                    .any(|(x, y, _)| [*x, *y] == [a, b] || [*x, *y] == [b, a])
            {
                let found = "a pair of parameters a second time, or one with itself";
                self.error(&format!("correlations[{n}]"), found, "each pair once", None);
            } else {
                ranks.push((a, b, section.rank));
            }
        }
        let copula = Copula::new(parameters.len(), &ranks);
        if copula.is_none() {
            let hint =
                "if a goes with b and b with c, then a must go with c to some degree".to_owned();
            let found =
                "correlations that contradict each other: their matrix is not positive definite";
            self.error(
                "correlations",
                found,
                "a positive definite matrix",
                Some(hint),
            );
        }
        copula
    }

    /// The parameter that one side of a correlation names.
    fn correlated(&mut self, parameters: &[Parameter], n: usize, side: usize) -> Option<usize> {
        let name = &self.text.section.correlations[n].between[side];
        let found = parameters.iter().position(|p| p.name == *name);
        // a parameter that was left out as broken has been told of already
        if found.is_none() && parameters.len() == self.text.section.parameters.len() {
            let names: Vec<&str> = parameters.iter().map(|p| p.name.as_str()).collect();
            let at = format!("correlations[{n}].between[{side}]");
            self.unknown_name(&at, name, &names);
        }
        found
    }

    pub(super) fn unknown_name(&mut self, at: &str, name: &str, names: &[&str]) {
        use crate::scenario::check::one_of;
        use crate::scenario::nearest::nearest;
        let hint = nearest(name, names.iter().copied()).map(|n| format!("did you mean \"{n}\"?"));
        let found = format!("no parameter is named \"{name}\"");
        self.error(at, found, one_of(names, '"'), hint);
    }

    fn keep(&mut self) -> Keep {
        let Some(section) = &self.text.section.keep else {
            return Keep::default();
        };
        Keep::read(section).unwrap_or_else(|found| {
            let expected = "\"all\", \"none\", a list of indices, or such as \"worst 5 by hic15\"";
            self.error("keep", found, expected, None);
            Keep::default()
        })
    }

    /// Whether parameters and design fit each other in kind and number.
    fn sizes(&mut self, parameters: &[Parameter], design: &Design, ensemble: Option<&Ensemble>) {
        let levels: Vec<Option<u64>> = parameters.iter().map(|p| p.law.levels()).collect();
        if *design == Design::FullFactorial {
            for (parameter, _) in parameters.iter().zip(&levels).filter(|(_, l)| l.is_none()) {
                let found = format!("`{}` has no values to go through", parameter.name);
                let hint = "or choose another design, such as \"latin_hypercube\"".to_owned();
                self.error(
                    "design",
                    found,
                    "a `grid` or a `list` for each parameter",
                    Some(hint),
                );
            }
        }
        let most = match design {
            Design::Sobol { .. } => MAX_DIMENSIONS,
            Design::Saltelli { .. } => MAX_DIMENSIONS / 2,
            _ => usize::MAX,
        };
        if parameters.len() > most {
            let found = format!("{} parameters", parameters.len());
            self.error(
                "design",
                found,
                format!("at most {most} in this design"),
                None,
            );
        }
        if let Design::Morris { levels, .. } = design
            && levels % 2 == 1
        {
            let found = format!("`{levels}` is no even number");
            self.error(
                "design.levels",
                found,
                "an even number of levels, such as 4",
                None,
            );
        }
        if let Design::Morris { tail, .. } | Design::OneAtATime { tail } = design
            && *tail >= 0.5
        {
            self.error(
                "design.tail",
                format!("a tail of {tail}"),
                "a part below 0.5",
                None,
            );
        }
        let members = ensemble.map_or(1, |e| e.members);
        let runs = design.len(&levels).and_then(|n| n.checked_mul(members));
        if runs.is_none_or(|n| n > 1 << 52) {
            self.error(
                "design",
                "more runs than can be counted",
                "at most 2^52 runs",
                None,
            );
        }
        self.power_of_two(design);
    }

    fn power_of_two(&mut self, design: &Design) {
        let (Design::Sobol { samples, .. } | Design::Saltelli { samples, .. }) = design else {
            return;
        };
        if !samples.is_power_of_two() {
            let near = samples.checked_next_power_of_two().unwrap_or(*samples);
            let warning = problem(
                Severity::Warning,
                "design.samples",
                format!("{samples} points of Sobol's sequence, which is even only in powers of 2"),
                "a power of 2",
                Some(format!("samples = {} or {near}", near / 2)),
            );
            self.text.report(&mut self.problems, warning);
        }
    }
}

/// What may stand at a place, with its article.
pub(super) fn noun(wanted: &Wanted) -> &'static str {
    match wanted {
        Wanted::Quantity(Kind { noun, .. }) => noun,
        Wanted::Number => "a number",
        Wanted::Names(_) => "a name",
        Wanted::Text => "a text",
        Wanted::Truth => "true or false",
    }
}

//! The `[[parameters]]` of a study find their places and their laws.

use super::law::{Quantities, kind_of};
use super::{Binder, Purpose};
use crate::design::Design;
use crate::inputs::InputWord;
use crate::law::{Distribution, Law};
use crate::parameter::{Parameter, Target, si_unit};
use crate::section::{ApplyChoice, ParameterSection};
use crate::segments::{segments, size};
use occupant_scenario::{Draft, Place, Wanted};

/// Source of built-in distributions.
const USUAL: &str = "built in: see the guide to [car]";

impl Binder<'_> {
    /// The parameters whose paths exist; a wrong one is reported and left out.
    pub(super) fn parameters(&mut self) -> Vec<Parameter> {
        let sections = &self.text.section.parameters;
        let mut found: Vec<Parameter> = Vec::new();
        for (i, section) in sections.iter().enumerate() {
            let at = format!("parameters[{i}]");
            if section.segments.is_some() || section.input.is_some() {
                self.is_crossed(section, &at);
            }
            let ready = match (&section.segments, section.input) {
                (Some(most), _) => Some(self.segments(most.si(), &at)),
                (None, Some(word)) => Some(self.input(word, &at)),
                (None, None) => None,
            };
            for parameter in ready.unwrap_or_else(|| self.parameter(section, &at).into_iter().collect()) {
                self.clash(&parameter, &found, &at);
                found.push(parameter);
            }
        }
        let at = sections.iter().position(|section| section.segments.is_some());
        if let Some(at) = at.map(|i| format!("parameters[{i}].segments")) {
            self.refuse_size(&found, &at);
        }
        found
    }

    /// A factor per segment of the body, between 1 − `most` and 1 + `most`.
    fn segments(&mut self, most: f64, at: &str) -> Vec<Parameter> {
        let found = self.base.map(segments).unwrap_or_default();
        if found.is_empty() {
            self.error(at, "a body without segments that have a mass", "a body", None);
        }
        if self.has_table() {
            self.error(at, "`segments` beside a table of samples", "columns such as body.segments.head.mass", None);
        }
        let law = Law::Distribution(Distribution::Uniform { from: 1.0 - most, to: 1.0 + most });
        let of = |(name, targets)| Parameter {
            name: format!("segments.{name}"),
            unit: "",
            apply: ApplyChoice::Factor,
            law: law.clone(),
            crossed: false,
            targets,
            source: "",
        };
        found.into_iter().map(of).collect()
    }

    /// The parameters of an input by its word.
    fn input(&mut self, word: InputWord, at: &str) -> Vec<Parameter> {
        if self.has_table() {
            self.error(at, "`input` beside a table of samples", "columns such as path.strength", None);
        }
        match self.base {
            Some(base) => self.inputs(&[word], &format!("{at}.input"), base),
            None => Vec::new(),
        }
    }

    /// The parameters of several inputs; one that the scenario lacks is reported.
    pub(super) fn inputs(&mut self, words: &[InputWord], at: &str, base: &Draft) -> Vec<Parameter> {
        let mut all = Vec::new();
        for word in words {
            match word.parameters(base) {
                Ok(found) => all.extend(found),
                Err(needs) => {
                    let found = format!("the base scenario has no input `{}`", word.word());
                    self.error(at, found, needs, None);
                }
            }
        }
        all
    }

    /// Reports parameters that change the body while `segments` refers to the body of the base.
    pub(super) fn refuse_size(&mut self, parameters: &[Parameter], at: &str) {
        if let Some(path) = size(parameters.iter().flat_map(|parameter| &parameter.targets)) {
            let found = format!("`{path}` is varied, and with it all segments of the base scenario's body");
            let hint = "for a person's mass alone, use `segments`".to_owned();
            self.error(at, found, "a body of fixed size with `segments`", Some(hint));
        }
    }

    pub(super) fn parameter(&mut self, section: &ParameterSection, at: &str) -> Option<Parameter> {
        let paths = paths_at(&section.path, &section.paths, at)?;
        let places = self.places(&paths)?;
        let apply = section.apply.unwrap_or_default();
        let wanted = self.common(&places, &paths[0].0)?;
        if apply != ApplyChoice::Value && !self.all_numbers(&places, &paths[0].0, apply) {
            return None;
        }
        let law = self.law(section, at, apply, &wanted)?;
        Some(Parameter {
            name: section.name.clone().unwrap_or_else(|| paths[0].1.to_owned()),
            unit: match apply {
                ApplyChoice::Factor => "",
                _ => si_unit(&wanted),
            },
            apply,
            law,
            crossed: self.is_crossed(section, at),
            targets: places.iter().map(Target::of).collect(),
            source: if section.usual == Some(true) { USUAL } else { "" },
        })
    }

    /// Whether a parameter is crossed with the samples of the others.
    fn is_crossed(&mut self, section: &ParameterSection, at: &str) -> bool {
        if section.crossed != Some(true) {
            return false;
        }
        if section.grid.is_none() && section.list.is_none() {
            let found = "`crossed` without a list of values";
            self.error(&format!("{at}.crossed"), found, "a `list` or a `grid`", None);
        }
        if !self.text.section.design.as_ref().is_some_and(Design::is_sampled) {
            let expected = "the design \"latin_hypercube\", \"sobol\" or \"monte_carlo\"";
            let hint = "a full factorial design crosses all its parameters".to_owned();
            self.error(&format!("{at}.crossed"), "`crossed` in a design that does not sample", expected, Some(hint));
        }
        true
    }

    /// The targets of several paths, each once; none if a path does not exist.
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
                    self.error(at, error.found, error.expected, error.hint);
                    whole = false;
                }
            }
        }
        (whole && !places.is_empty()).then_some(places)
    }

    /// Kinds of values that all targets accept.
    pub(super) fn common(&mut self, places: &[Place], at: &str) -> Option<Wanted> {
        let first = places.first()?;
        let other = places.iter().find(|p| p.wanted != first.wanted);
        match other {
            None => Some(first.wanted.clone()),
            Some(other) => {
                let found =
                    format!("`{}` is {}, `{}` is {}", first.path, first.wanted.noun(), other.path, other.wanted.noun());
                self.error(at, found, "paths of one quantity", None);
                None
            }
        }
    }

    /// Whether all targets are numbers, which can be multiplied or added to.
    pub(super) fn all_numbers(&mut self, places: &[Place], at: &str, apply: ApplyChoice) -> bool {
        let Some(other) = places.iter().find(|p| p.si.is_none()) else { return true };
        let word = match apply {
            ApplyChoice::Factor => "multiplied",
            _ => "added to",
        };
        let what = match other.value {
            Some(_) => format!("is {}", other.wanted.noun()),
            None => "is not in the base scenario".to_owned(),
        };
        let found = format!("`{}` {what}, so it cannot be {word}", other.path);
        self.error(at, found, "the path of numbers in the base scenario", None);
        false
    }

    /// Whether a table gives the values of all parameters.
    fn has_table(&self) -> bool {
        self.purpose == Purpose::Sweep && matches!(self.text.section.design, Some(Design::Table { .. }))
    }

    pub(super) fn law(
        &mut self,
        section: &ParameterSection,
        at: &str,
        apply: ApplyChoice,
        wanted: &Wanted,
    ) -> Option<Law> {
        let by_table = self.has_table();
        let given = section.grid.is_some()
            || section.list.is_some()
            || section.range.is_some()
            || section.distribution.is_some()
            || section.usual == Some(true);
        if by_table && given {
            let expected = "no `grid`, `list`, `range`, `distribution` or `usual`";
            self.error(at, "values for a parameter that the table of samples varies", expected, None);
            return None;
        }
        if by_table {
            return Some(Law::Table);
        }
        if !given {
            let hint = "grid = { from = …, to = …, steps = … }".to_owned();
            let expected = "`grid`, `list`, `range` or `distribution`";
            self.error(at, "a parameter without values", expected, Some(hint));
            return None;
        }
        let quantities = Quantities { kind: kind_of(wanted, apply), wanted, units: self.units() };
        quantities.law(self, section, at)
    }

    /// Reports two parameters of one name, and a target used by an earlier parameter.
    pub(super) fn clash(&mut self, parameter: &Parameter, earlier: &[Parameter], at: &str) {
        if earlier.iter().any(|p| p.name == parameter.name) {
            let found = format!("two parameters named `{}`", parameter.name);
            self.error(at, found, "a unique name", Some("name = \"…\"".into()));
        }
        if parameter.apply != ApplyChoice::Value {
            return;
        }
        for other in earlier {
            let shared = parameter.targets.iter().find(|t| other.targets.iter().any(|o| o.path == t.path));
            if let Some(target) = shared {
                let found = format!("`{}` is already varied by `{}`", target.path, other.name);
                let hint = "a factor or an offset may come after a value, not before it";
                self.error(at, found, "each key varied by one parameter", Some(hint.into()));
            }
        }
    }
}

/// The paths of a section at `at`, each with its position in the study.
pub(super) fn paths_at<'s>(
    path: &'s Option<String>,
    paths: &'s Option<Vec<String>>,
    at: &str,
) -> Option<Vec<(String, &'s str)>> {
    match (path, paths) {
        (Some(path), _) => Some(vec![(format!("{at}.path"), path)]),
        (None, Some(paths)) => {
            Some(paths.iter().enumerate().map(|(i, p)| (format!("{at}.paths[{i}]"), p.as_str())).collect())
        }
        (None, None) => None,
    }
}

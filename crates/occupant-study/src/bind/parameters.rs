//! The `[[parameters]]` of a study find their places and their laws.

use super::Binder;
use super::law::{Quantities, kind_of};
use crate::design::Design;
use crate::law::Law;
use crate::parameter::{Parameter, Target, si_unit};
use crate::section::{ApplyChoice, ParameterSection};
use occupant_core::scenario::{Place, Wanted};

impl Binder<'_> {
    /// The parameters that have found their places; a broken one is reported and left out.
    pub(super) fn parameters(&mut self) -> Vec<Parameter> {
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
                    self.error(at, error.found, error.expected, error.hint);
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
                let found =
                    format!("`{}` is {}, `{}` is {}", first.path, first.wanted.noun(), other.path, other.wanted.noun());
                self.error(at, found, "places of one kind", None);
                None
            }
        }
    }

    /// Whether there are numbers to multiply or to add to.
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
        self.error(at, found, "a path to numbers that the base scenario has", None);
        false
    }

    pub(super) fn law(
        &mut self,
        section: &ParameterSection,
        at: &str,
        apply: ApplyChoice,
        wanted: &Wanted,
    ) -> Option<Law> {
        let by_table = self.test.is_none() && matches!(self.text.section.design, Some(Design::Table { .. }));
        let given = section.grid.is_some()
            || section.list.is_some()
            || section.range.is_some()
            || section.distribution.is_some();
        if by_table && given {
            let expected = "no `grid`, `list`, `range` or `distribution`";
            self.error(at, "values for a parameter that the table of samples varies", expected, None);
            return None;
        }
        if by_table {
            return Some(Law::Table);
        }
        if !given {
            let hint = "grid = { from = …, to = …, steps = … }".to_owned();
            let expected = "`grid`, `list`, `range` or `distribution`";
            self.error(at, "a parameter that does not say how it varies", expected, Some(hint));
            return None;
        }
        let quantities = Quantities { kind: kind_of(wanted, apply), wanted, units: self.units() };
        quantities.law(self, section, at)
    }

    /// Tells of two parameters of one name, and of a value that an earlier parameter has already put there.
    pub(super) fn clash(&mut self, parameter: &Parameter, earlier: &[Parameter], at: &str) {
        if earlier.iter().any(|p| p.name == parameter.name) {
            let found = format!("a second parameter named `{}`", parameter.name);
            self.error(at, found, "a name of its own", Some("name = \"…\"".into()));
        }
        if parameter.apply != ApplyChoice::Value {
            return;
        }
        for other in earlier {
            let shared = parameter.targets.iter().find(|t| other.targets.iter().any(|o| o.path == t.path));
            if let Some(target) = shared {
                let found = format!("`{}` is already varied by `{}`", target.path, other.name);
                let hint = "a factor or an offset may follow a value, but not the other way round";
                self.error(at, found, "each place varied by one value", Some(hint.into()));
            }
        }
    }
}

/// The paths of a section at `at`, each with its place in the study.
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

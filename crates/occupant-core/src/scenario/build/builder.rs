//! What every part of the build needs: numbers in SI, names looked up, problems with their place.

use nalgebra::Point3;

use super::super::check::one_of;
use super::super::diagnostic::{Diagnostic, Diagnostics};
use super::super::document::Node;
use super::super::kind::UnitSystem;
use super::super::loaded::place;
use super::super::model::{Length, Scenario};
use super::super::path_text::{locate, with_key};
use super::super::quantity::Quantity;
use super::super::source::Sources;
use crate::problem::nearest;
use crate::problem::{Problem, Severity};

/// Collects problems while the plain data are put together.
pub(super) struct Builder<'a> {
    pub(super) sources: &'a Sources,
    pub(super) root: &'a Node,
    pub(super) units: UnitSystem,
    pub(super) problems: Diagnostics,
}

impl<'a> Builder<'a> {
    pub(super) fn new(sources: &'a Sources, root: &'a Node, units: UnitSystem) -> Self {
        Builder { sources, root, units, problems: Diagnostics::new() }
    }

    /// The value in SI units, angles in radians.
    pub(super) fn si<const KIND: usize>(&mut self, path: &str, quantity: &Quantity<KIND>) -> f64 {
        match quantity.si(self.units) {
            Ok(value) => value,
            Err(error) => {
                self.report(Severity::Error, path, error.found, error.expected, error.hint);
                f64::NAN
            }
        }
    }

    /// The value in SI units, or `default` where nothing is written.
    pub(super) fn optional<const KIND: usize>(
        &mut self,
        path: &str,
        quantity: &Option<Quantity<KIND>>,
        default: f64,
    ) -> f64 {
        match quantity {
            Some(quantity) => self.si(path, quantity),
            None => default,
        }
    }

    /// The value in SI units of a key that must be there.
    pub(super) fn needed<const KIND: usize>(
        &mut self,
        path: &str,
        key: &str,
        quantity: &Option<Quantity<KIND>>,
    ) -> f64 {
        let whole = with_key(path, key);
        match quantity {
            Some(quantity) => self.si(&whole, quantity),
            None => {
                let kind = Quantity::<KIND>::KIND;
                let expected = format!("{key} = {}: {}", kind.noun, kind.example);
                self.error(path, format!("`{path}` has no key `{key}`"), expected);
                f64::NAN
            }
        }
    }

    /// Three values.
    pub(super) fn triple<const KIND: usize>(&mut self, path: &str, triple: &[Quantity<KIND>; 3]) -> [f64; 3] {
        std::array::from_fn(|i| self.si(&format!("{path}[{i}]"), &triple[i]))
    }

    /// A point.
    pub(super) fn point(&mut self, path: &str, point: &[Length; 3]) -> Point3<f64> {
        Point3::from(self.triple(path, point))
    }

    /// The index of a name among those that exist; 0 and a problem if it is none of them.
    pub(super) fn index_of<'n>(
        &mut self,
        path: &str,
        what: &str,
        name: &str,
        names: impl Iterator<Item = &'n str> + Clone,
    ) -> usize {
        if let Some(i) = names.clone().position(|n| n == name) {
            return i;
        }
        let hint = nearest(name, names.clone()).map(|n| format!("did you mean \"{n}\"?"));
        let all: Vec<&str> = names.collect();
        let expected = match all.as_slice() {
            [] => format!("a {what}; the scenario has none"),
            _ => one_of(&all, '"'),
        };
        self.report(Severity::Error, path, format!("no {what} is named \"{name}\""), expected, hint);
        0
    }

    /// Adds an error.
    pub(super) fn error(&mut self, path: &str, found: impl Into<String>, expected: impl Into<String>) {
        self.report(Severity::Error, path, found.into(), expected.into(), None);
    }

    /// Adds an error with a remedy.
    pub(super) fn error_with_hint(
        &mut self,
        path: &str,
        found: impl Into<String>,
        expected: impl Into<String>,
        hint: impl Into<String>,
    ) {
        self.report(Severity::Error, path, found.into(), expected.into(), Some(hint.into()));
    }

    /// Adds a warning with a remedy.
    pub(super) fn warning(
        &mut self,
        path: &str,
        found: impl Into<String>,
        expected: impl Into<String>,
        hint: impl Into<String>,
    ) {
        self.report(Severity::Warning, path, found.into(), expected.into(), Some(hint.into()));
    }

    fn report(&mut self, severity: Severity, path: &str, found: String, expected: String, hint: Option<String>) {
        let problem = Problem { severity, path: path.to_owned(), found, expected, hint };
        let main = self.root.span.source;
        let placed = place(self.sources, main, self.root, problem);
        self.problems.push(placed);
    }

    /// Warns of provenance notes that speak of nothing in the scenario.
    pub(super) fn check_provenance(&mut self, written: &Scenario) {
        for topic in written.provenance.keys() {
            let is_path = topic.contains('.') && !topic.contains(' ');
            if is_path && locate(self.root, topic).is_none() {
                let path = with_key("provenance", topic);
                let found = format!("`{topic}` is no part of the scenario");
                let expected = "a path such as materials.seat, or a topic in words".to_owned();
                self.report(Severity::Warning, &path, found, expected, None);
            }
        }
    }

    /// Adds a problem whose place is known.
    pub(super) fn push(&mut self, diagnostic: Diagnostic) {
        self.problems.push(diagnostic);
    }
}

//! Shared tools to convert sections to plain data: the text, and a list of problems.

use serde::de::DeserializeOwned;

use super::drive::Drives;
use super::quantity::Quantity;
use occupant_core::body::Body;
use placed_text::{Diagnostics, Document, Problem, did_you_mean, follow, one_of, parse_path, with_key};

/// Collects problems during the conversion.
pub(super) struct Builder<'a> {
    /// The explicit scenario.
    pub(super) document: &'a Document,
    pub(super) problems: Diagnostics,
    /// The drive; none while occupants are weighed, or if nothing drives.
    pub(super) drives: Option<&'a Drives>,
}

impl Builder<'_> {
    /// The value in SI units of a required key.
    pub(super) fn needed<const KIND: usize, const RANGE: usize>(
        &mut self,
        path: &str,
        key: &str,
        quantity: &Option<Quantity<KIND, RANGE>>,
    ) -> f64 {
        if quantity.is_none() {
            let expected = format!("{key} = {}", Quantity::<KIND, RANGE>::KIND.expected());
            self.error(path, format!("`{path}` has no key `{key}`"), expected);
        }
        quantity.as_ref().map_or(f64::NAN, Quantity::si)
    }

    /// The value of the checked explicit scenario at a path; none if there is none.
    pub(super) fn section<T: DeserializeOwned>(&self, path: &str) -> Option<T> {
        let node = follow(&self.document.root, &parse_path(path).ok()?)?;
        T::deserialize(node).ok()
    }

    /// Adds an error at each of `keys` that the section at `path` contains.
    pub(super) fn refuse_keys(&mut self, path: &str, keys: &[&str], found: impl Fn(&str) -> String, expected: &str) {
        let document = self.document;
        let section = parse_path(path).ok().and_then(|steps| follow(&document.root, &steps));
        for key in keys.iter().filter(|key| section.is_some_and(|s| s.get(key).is_some())) {
            self.error(&with_key(path, key), found(key), expected);
        }
    }

    /// The spheres of parts, or single spheres, named by a list at `path`.
    pub(super) fn spheres(&mut self, path: &str, names: &[String], body: &Body) -> Vec<usize> {
        let mut spheres = Vec::new();
        for (i, name) in names.iter().enumerate() {
            let called = body.spheres_called(name);
            if called.is_empty() {
                self.sphere(&format!("{path}[{i}]"), name, body);
            }
            spheres.extend(called);
        }
        spheres
    }

    /// The sphere named at `path`; none for a whole part.
    pub(super) fn sphere(&mut self, path: &str, name: &str, body: &Body) -> usize {
        body.sphere(name).unwrap_or_else(|| {
            let names: Vec<&str> = body.spheres.iter().map(|sphere| sphere.name.as_str()).collect();
            self.unknown(path, "sphere", name, &names);
            0
        })
    }

    /// Adds an error about an unknown name; `names` are the known ones.
    pub(super) fn unknown(&mut self, path: &str, what: &str, name: &str, names: &[&str]) {
        let problem = Problem::error(path, format!("no {what} is named \"{name}\""), one_of(names, '"'));
        self.report(problem.with_hint(did_you_mean(name, names, '"')));
    }

    /// Adds an error.
    pub(super) fn error(&mut self, path: &str, found: impl Into<String>, expected: impl Into<String>) {
        self.report(Problem::error(path, found, expected));
    }

    /// Adds a problem at its path in the text.
    pub(super) fn report(&mut self, problem: Problem) {
        let document = self.document;
        self.problems.add(problem, |problem| document.place(problem));
    }
}

/// The index of a name among the known ones; the check of references has refused all others.
pub(super) fn index_of<'n>(name: &str, mut names: impl Iterator<Item = &'n str>) -> usize {
    names.position(|n| n == name).unwrap_or(0)
}

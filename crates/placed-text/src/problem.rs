//! Problems of an input: values that name the place, what was found, what was expected and how to mend it.

use std::collections::HashSet;
use std::fmt;

use crate::shown::number;

/// Severity of a problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The run continues; the user is told.
    Warning,
    /// The input cannot be used.
    Error,
}

impl Severity {
    /// Its word in messages.
    pub(crate) const fn word(self) -> &'static str {
        ["warning", "error"][self as usize]
    }
}

/// One problem of an input.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Its severity.
    pub severity: Severity,
    /// Dotted path in the scenario, e.g. `belts.lap.anchors[1]`; empty for the whole text.
    pub path: String,
    /// What was found.
    pub found: String,
    /// What was expected.
    pub expected: String,
    /// How to correct it, if known.
    pub hint: Option<String>,
}

impl Problem {
    /// An error.
    pub fn error(path: impl Into<String>, found: impl Into<String>, expected: impl Into<String>) -> Self {
        Problem {
            severity: Severity::Error,
            path: path.into(),
            found: found.into(),
            expected: expected.into(),
            hint: None,
        }
    }

    /// A warning.
    pub fn warning(path: impl Into<String>, found: impl Into<String>, expected: impl Into<String>) -> Self {
        Problem { severity: Severity::Warning, ..Problem::error(path, found, expected) }
    }

    /// The same with a remedy, if there is one.
    pub fn with_hint(self, hint: Option<impl Into<String>>) -> Self {
        Problem { hint: hint.map(Into::into), ..self }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}: {}; expected {}", self.severity.word(), self.path, self.found, self.expected)?;
        match &self.hint {
            Some(hint) => write!(f, " ({hint})"),
            None => Ok(()),
        }
    }
}

/// All problems of an input, in the order found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Problems(Vec<Problem>);

impl Problems {
    /// No problems.
    pub const fn new() -> Self {
        Problems(Vec::new())
    }

    /// Adds one.
    pub fn push(&mut self, problem: Problem) {
        self.0.push(problem);
    }

    /// Adds an error.
    pub fn error(&mut self, path: impl Into<String>, found: impl Into<String>, expected: impl Into<String>) {
        self.0.push(Problem::error(path, found, expected));
    }

    /// Adds an error with a remedy.
    pub fn error_with_hint(
        &mut self,
        path: impl Into<String>,
        found: impl Into<String>,
        expected: impl Into<String>,
        hint: impl Into<String>,
    ) {
        self.0.push(Problem::error(path, found, expected).with_hint(Some(hint)));
    }

    /// Adds a warning.
    pub fn warning(&mut self, path: impl Into<String>, found: impl Into<String>, expected: impl Into<String>) {
        self.0.push(Problem::warning(path, found, expected));
    }

    /// Adds an error unless `value` is positive; returns whether it is.
    pub fn check_positive(&mut self, path: &str, value: f64, unit: &str) -> bool {
        let is_good = value > 0.0 && value.is_finite();
        if !is_good {
            self.error(path, format!("{} {unit}", number(value)).trim_end(), "a positive number");
        }
        is_good
    }

    /// Adds an error unless `value` is zero or positive.
    pub fn check_at_least_zero(&mut self, path: &str, value: f64, unit: &str) {
        if !(value >= 0.0 && value.is_finite()) {
            self.error(path, format!("{} {unit}", number(value)).trim_end(), "zero or a positive number");
        }
    }

    /// Adds an error for every item (`what`, such as a belt, under `path`) with a duplicate name.
    pub fn check_unique<'n>(&mut self, path: &str, what: &str, names: impl Iterator<Item = &'n str>) {
        let mut known = HashSet::new();
        for name in names.filter(|name| !known.insert(*name)) {
            self.error(format!("{path}.{name}"), format!("a second {what} named {name}"), "unique names");
        }
    }

    /// Appends all of `other`.
    pub fn extend(&mut self, other: Problems) {
        self.0.extend(other.0);
    }

    /// True if any problem is an error.
    pub fn has_errors(&self) -> bool {
        self.0.iter().any(|p| p.severity == Severity::Error)
    }

    /// True if there are no problems.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The problems.
    pub fn iter(&self) -> std::slice::Iter<'_, Problem> {
        self.0.iter()
    }
}

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, problem) in self.0.iter().enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            write!(f, "{problem}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Problems {}

/// A path with one more key.
pub fn with_key(path: &str, key: &str) -> String {
    let plain = !key.is_empty() && key.chars().all(|c| c.is_alphanumeric() || c == '_' || c == '-');
    let key = if plain { key.to_owned() } else { format!("\"{key}\"") };
    if path.is_empty() { key } else { format!("{path}.{key}") }
}

//! What is wrong with an input: values that name the place, what was found, what was expected and how to mend it.

use std::fmt;

/// How bad a problem is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The run goes on; the user should know.
    Warning,
    /// The input cannot be used.
    Error,
}

/// One problem of an input.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// How bad it is.
    pub severity: Severity,
    /// Dotted path in the scenario, e.g. `belts.lap.anchors[1]`; empty for the whole.
    pub path: String,
    /// What was found.
    pub found: String,
    /// What was expected.
    pub expected: String,
    /// How to mend it, where that can be said.
    pub hint: Option<String>,
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = match self.severity {
            Severity::Warning => "warning",
            Severity::Error => "error",
        };
        write!(f, "{word}: {}: {}; expected {}", self.path, self.found, self.expected)?;
        match &self.hint {
            Some(hint) => write!(f, " ({hint})"),
            None => Ok(()),
        }
    }
}

/// All problems of an input, in the order in which they were found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Problems(Vec<Problem>);

impl Problems {
    /// No problem yet.
    pub const fn new() -> Self {
        Problems(Vec::new())
    }

    /// Adds an error.
    pub fn error(&mut self, path: impl Into<String>, found: impl Into<String>, expected: impl Into<String>) {
        self.push(Severity::Error, path, found, expected, None);
    }

    /// Adds an error with a remedy.
    pub fn error_with_hint(
        &mut self,
        path: impl Into<String>,
        found: impl Into<String>,
        expected: impl Into<String>,
        hint: impl Into<String>,
    ) {
        self.push(Severity::Error, path, found, expected, Some(hint.into()));
    }

    /// Adds a warning.
    pub fn warning(&mut self, path: impl Into<String>, found: impl Into<String>, expected: impl Into<String>) {
        self.push(Severity::Warning, path, found, expected, None);
    }

    fn push(
        &mut self,
        severity: Severity,
        path: impl Into<String>,
        found: impl Into<String>,
        expected: impl Into<String>,
        hint: Option<String>,
    ) {
        self.0.push(Problem { severity, path: path.into(), found: found.into(), expected: expected.into(), hint });
    }

    /// Adds an error unless `value` is positive; returns whether it is.
    pub(crate) fn check_positive(&mut self, path: &str, value: f64, unit: &str) -> bool {
        let is_good = value > 0.0 && value.is_finite();
        if !is_good {
            self.error(path, format!("{value} {unit}").trim_end(), "a positive number");
        }
        is_good
    }

    /// Adds an error unless `value` is zero or positive.
    pub(crate) fn check_at_least_zero(&mut self, path: &str, value: f64, unit: &str) {
        if !(value >= 0.0 && value.is_finite()) {
            self.error(path, format!("{value} {unit}").trim_end(), "zero or a positive number");
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

    /// True if there is no problem at all.
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

/// The candidate most like `word`, if any is near enough to be meant: at most a third of the letters differ, or only
/// upper and lower case. The first of several equally near ones; else the only one that contains the word.
pub fn nearest<'a>(word: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let candidates: Vec<&str> = candidates.collect();
    alike(word, candidates.iter().copied()).or_else(|| {
        let mut longer = candidates.iter().filter(|c| word.len() > 3 && c.contains(word));
        longer.next().filter(|_| longer.next().is_none()).copied()
    })
}

fn alike<'a>(word: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let plain = plain(word);
    let limit = plain.chars().count().clamp(2, 60) / 3;
    candidates
        .map(|candidate| (strsim::osa_distance(&plain, &self::plain(candidate)), candidate))
        .filter(|(d, _)| *d <= limit.max(1))
        .min_by_key(|(d, _)| *d)
        .filter(|(d, candidate)| *d == 0 || plain.chars().count() > 2 || candidate.len() > 2)
        .map(|(_, candidate)| candidate)
}

/// Letters in lower case, `-` and blanks as `_`.
fn plain(word: &str) -> String {
    word.chars().take(80).flat_map(char::to_lowercase).map(|c| if c == '-' || c == ' ' { '_' } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_what_was_meant_and_nothing_else() {
        let names = ["damping", "stop", "twist_damping", "k1", "k2", "friction"];
        let find = |word| nearest(word, names.into_iter());
        assert_eq!(find("dampng"), Some("damping"));
        assert_eq!(find("Damping"), Some("damping"));
        assert_eq!(find("twist-damping"), Some("twist_damping"));
        assert_eq!(find("firction"), Some("friction"));
        assert_eq!(find("K1"), Some("k1"));
        assert_eq!(find("twist"), Some("twist_damping"));
        assert_eq!(find("colour"), None);
        assert_eq!(find(""), None);
    }
}

//! Problems of a file of measured signals, in the form of all messages.

use std::path::Path;

use placed_text::shown;

use crate::base::Failure;

/// One problem.
#[derive(Clone, Debug, thiserror::Error)]
#[error("error: {found}\n --> {place}\n = expected {expected}{}", .hint.as_ref().map_or(String::new(), |hint| format!("\n = help: {hint}")))]
pub struct Trouble {
    place: String,
    found: String,
    expected: String,
    hint: Option<String>,
}

impl Trouble {
    /// In a line (from 1) of a file.
    pub fn at(path: &Path, line: usize, found: impl Into<String>, expected: impl Into<String>) -> Self {
        Trouble { place: format!("{}:{line}", path.display()), ..Trouble::of(path, found, expected) }
    }

    /// In a file as a whole.
    pub fn of(path: &Path, found: impl Into<String>, expected: impl Into<String>) -> Self {
        let [place, found, expected] =
            [path.display().to_string(), found.into(), expected.into()].map(|text| shown(&text));
        Trouble { place, found, expected, hint: None }
    }

    /// Adds a remedy.
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(shown(&hint.into()));
        self
    }
}

impl From<Trouble> for Failure {
    fn from(trouble: Trouble) -> Self {
        Failure::CouldNotRun(trouble.to_string())
    }
}

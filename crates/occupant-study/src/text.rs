//! A study text that has been read and whose words are right; what they mean hangs on the base scenario.

use serde::Deserialize;

use crate::section::{StudySection, schema_json};
use occupant_core::problem::{Problem, Severity};
use occupant_core::scenario::check::check_words;
use occupant_core::scenario::diagnostic::Diagnostics;
use occupant_core::scenario::document::{Format, Node, parse};
use occupant_core::scenario::draft::{refuse, text_of};
use occupant_core::scenario::loaded::place;
use occupant_core::scenario::source::{SourceId, Sources};

/// A study text that has been read and whose words are right.
#[derive(Clone, Debug)]
pub struct StudyText {
    /// The study as it was written.
    pub section: StudySection,
    pub(super) sources: Sources,
    pub(super) main: SourceId,
    pub(super) root: Node,
}

impl StudyText {
    /// Reads and checks a text; `name` is what messages call it, such as its file name.
    ///
    /// # Errors
    /// Everything that is wrong with its syntax, or else with its words.
    pub fn read(text: &str, format: Format, name: &str) -> Result<StudyText, Diagnostics> {
        let mut sources = Sources::new();
        let main = sources.add(name, text);
        let root = parse(&sources, main, format)?;
        let problems = check_words(&sources, &root, schema_json(), "the study");
        if problems.has_errors() {
            return Err(problems);
        }
        let section = StudySection::deserialize(root.to_json()).map_err(|error| {
            let found = format!("the study cannot be read: {error}");
            refuse(name, found, "a study")
        })?;
        Ok(StudyText { section, sources, main, root })
    }

    /// Reads bytes that should be UTF-8 text; the format is told by [`Format::of_text`] unless given.
    ///
    /// # Errors
    /// The place of the first byte that is not UTF-8; else as [`StudyText::read`].
    pub fn read_bytes(bytes: &[u8], format: Option<Format>, name: &str) -> Result<StudyText, Diagnostics> {
        let text = text_of(bytes, name)?;
        StudyText::read(text, format.unwrap_or_else(|| Format::of_text(text)), name)
    }

    /// The name of the base scenario, relative to the study file.
    pub fn base(&self) -> &str {
        &self.section.base
    }

    /// The text that was read.
    pub fn text(&self) -> &str {
        self.sources.text(self.main)
    }

    /// Whether a text is a study and not a scenario: it names a base.
    pub fn is_study(text: &str, format: Format) -> bool {
        let mut sources = Sources::new();
        let main = sources.add("", text);
        parse(&sources, main, format).is_ok_and(|root| root.get("base").is_some())
    }

    /// Adds a problem at a path of the study, such as `parameters[2].grid`.
    pub(super) fn report(&self, problems: &mut Diagnostics, problem: Problem) {
        problems.push(place(&self.sources, self.main, &self.root, problem));
    }
}

/// A problem of a study.
pub(super) fn problem(
    severity: Severity,
    path: &str,
    found: impl Into<String>,
    expected: impl Into<String>,
    hint: Option<String>,
) -> Problem {
    Problem { severity, path: path.to_owned(), found: found.into(), expected: expected.into(), hint }
}

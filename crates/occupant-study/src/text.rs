//! A study text that has been read and whose words are right; what they mean depends on the base scenario.

use crate::section::{StudySection, schema_json};
use occupant_scenario::check_words;
use placed_text::{Diagnostics, Document, Format, Problem};

/// A study text that was read and passed its own checks.
#[derive(Clone, Debug)]
pub struct StudyText {
    /// The study as it was written.
    pub section: StudySection,
    document: Document,
}

impl StudyText {
    /// Reads and checks a text; `name` is its name in messages, such as its file name.
    ///
    /// # Errors
    /// Everything that is wrong with its syntax, or else with its words.
    pub fn read(text: &str, format: Format, name: &str) -> Result<StudyText, Diagnostics> {
        StudyText::of(Document::read(text, format, name)?)
    }

    /// Reads bytes of UTF-8 text; [`Format::of_text`] detects the format unless it is given.
    ///
    /// # Errors
    /// The place of the first byte that is not UTF-8; else as [`StudyText::read`].
    pub fn read_bytes(bytes: &[u8], format: Option<Format>, name: &str) -> Result<StudyText, Diagnostics> {
        StudyText::of(Document::read_bytes(bytes, format, name)?)
    }

    fn of(mut document: Document) -> Result<StudyText, Diagnostics> {
        let problems = check_words(&mut document, schema_json(), "the study");
        if problems.has_errors() {
            return Err(problems);
        }
        Ok(StudyText { section: document.sections("study")?, document })
    }

    /// The name of the base scenario, relative to the study file.
    pub fn base(&self) -> &str {
        &self.section.base
    }

    /// The text that was read.
    pub fn text(&self) -> &str {
        self.document.text()
    }

    /// Adds a problem at a path of the study, such as `parameters[2].grid`.
    pub(super) fn report(&self, problems: &mut Diagnostics, problem: Problem) {
        problems.add(problem, |problem| self.document.place(problem));
    }
}

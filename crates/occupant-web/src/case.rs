//! A case of the page: the text of a scenario, changes to it, and the tables that it refers to.

use std::collections::BTreeMap;
use std::path::Path;

use occupant_core::model::Model;
use occupant_files::scenario::{format_of, retitle};
use occupant_jobs::base::Failure;
use occupant_jobs::files::edited::with_changes;
use occupant_scenario::{Diagnostic, Diagnostics, Draft, Format, Loaded};
use placed_text::Severity;
use serde::{Deserialize, Serialize};

use crate::knobs::{Knob, knobs};

/// A scenario as the page has it.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct Case {
    /// Its file name.
    pub name: String,
    /// Its text, TOML or JSON.
    pub text: String,
    /// Changes, `path.to.key=value`.
    #[serde(default)]
    pub set: Vec<String>,
    /// The files that it names, and their texts.
    #[serde(default)]
    pub tables: BTreeMap<String, String>,
}

/// A scenario that can be run.
pub struct Opened {
    /// The scenario.
    pub loaded: Loaded,
    /// Its model.
    pub model: Model,
    /// Warnings.
    pub warnings: Diagnostics,
}

/// Why a request could not be met.
#[derive(Debug, Default, Serialize)]
pub struct Refused {
    refused: Why,
}

#[derive(Debug, Default, Serialize)]
struct Why {
    /// All of it, as the command prints it.
    words: String,
    problems: Vec<Problem>,
}

/// A problem at its place.
#[derive(Debug, Serialize)]
pub struct Problem {
    is_error: bool,
    /// The text it is in: the scenario, a change, a table.
    source: String,
    /// From 1; none for a text as a whole.
    line: Option<usize>,
    column: Option<usize>,
    found: String,
    expected: String,
    hint: Option<String>,
}

/// What is known of a case without running it.
#[derive(Serialize)]
pub struct Checked {
    problems: Vec<Problem>,
    /// The values that can be moved; none in a text that is no scenario.
    knobs: Vec<Knob>,
    /// The title, changes included.
    title: Option<String>,
}

impl Refused {
    /// A reason in words alone.
    pub fn plain(words: String) -> Self {
        Refused { refused: Why { words, problems: Vec::new() } }
    }
}

impl From<Diagnostics> for Refused {
    fn from(found: Diagnostics) -> Self {
        Refused { refused: Why { words: found.to_string(), problems: problems(&found) } }
    }
}

impl From<Failure> for Refused {
    fn from(failure: Failure) -> Self {
        Refused::plain(failure.words())
    }
}

/// The problems, in order.
pub fn problems(found: &Diagnostics) -> Vec<Problem> {
    let problem = |one: &Diagnostic| Problem {
        is_error: one.problem.severity == Severity::Error,
        source: one.source.clone(),
        line: one.position.map(|at| at.line),
        column: one.position.map(|at| at.column),
        found: one.problem.found.clone(),
        expected: one.problem.expected.clone(),
        hint: one.problem.hint.clone(),
    };
    found.iter().map(problem).collect()
}

impl Case {
    /// The text with the changes, as the command reads them.
    pub fn draft(&self) -> Result<Draft, Diagnostics> {
        let mut draft = self.untitled()?;
        retitle(&mut draft, &self.set);
        Ok(draft)
    }

    /// The same with the title of the text.
    fn untitled(&self) -> Result<Draft, Diagnostics> {
        let format = format_of(Path::new(&self.name));
        let mut draft = Draft::read_bytes(self.text.as_bytes(), format, &self.name)?;
        for assignment in &self.set {
            draft.set(assignment)?;
        }
        Ok(draft)
    }

    /// The scenario, ready to run.
    pub fn open(&self) -> Result<Opened, Diagnostics> {
        let loaded = self.draft()?.load(&|file| self.table(file))?;
        let (model, warnings) = loaded.model()?;
        Ok(Opened { loaded, model, warnings })
    }

    /// Its problems and what can be moved.
    pub fn checked(&self) -> Checked {
        let mut draft = match self.draft() {
            Ok(draft) => draft,
            Err(found) => return Checked { problems: problems(&found), knobs: Vec::new(), title: None },
        };
        let mut found = draft.check();
        let (knobs, title) = (knobs(&draft), title(&mut draft));
        if !found.has_errors() {
            match self.open() {
                Ok(opened) => found = opened.warnings,
                Err(refused) => found = refused,
            }
        }
        Checked { problems: problems(&found), knobs, title }
    }

    /// Its text with the changes written into it, comments and order kept.
    ///
    /// # Errors
    /// A text that cannot be changed; changes that would not say the same there.
    pub fn written(&self) -> Result<String, Refused> {
        let draft = self.untitled()?;
        let changes = self.set.iter().filter_map(|change| change.split_once('='));
        let document = with_changes(&self.text, changes.map(|(path, text)| (path.trim(), text.trim())), &draft);
        let meant = |draft: Draft| draft.load(&|file| self.table(file)).map(|loaded| loaded.scenario);
        let wanted = meant(draft)?;
        let says = |text: &String| {
            Draft::read(text, Format::Toml, &self.name).and_then(meant).is_ok_and(|found| found == wanted)
        };
        let refused = || {
            let help = "save the scenario as it is: the changes stand at its head, for `--set`";
            Refused::from(Failure::with_help("these changes cannot be written into this text", help))
        };
        document.map(|document| document.to_string()).filter(says).ok_or_else(refused)
    }

    /// The bytes of a file that it names.
    pub fn table(&self, file: &str) -> Result<Vec<u8>, String> {
        let found = self.tables.get(file).map(|text| text.clone().into_bytes());
        found.ok_or_else(|| "it is not among the tables of this page; add it with “Open”".to_owned())
    }
}

fn title(draft: &mut Draft) -> Option<String> {
    match draft.get("title").ok()?.pop()?.1 {
        placed_text::Value::String(title) => Some(title),
        _ => None,
    }
}

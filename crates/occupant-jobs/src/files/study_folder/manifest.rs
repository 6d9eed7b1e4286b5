//! The manifest of a folder of results: study, scenario, changes, program, columns.
//!
//! It is written when the sweep begins, and again when the study gets more samples. A process with another study does not touch
//! the folder: [`Manifest::identity`] tells studies apart, whatever comments and white space they have.

use serde::{Deserialize, Serialize};

use super::texts::NamedBy;
use crate::base::{build, sha256};

/// Version of the folder format.
const FORM: u32 = 3;

/// Identity of a sweep, independent of date, machine and number of threads.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Version of the folder format.
    pub form: u32,
    /// The program and its version.
    pub program: String,
    /// Its build; empty in a folder of form 2.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub build: String,
    /// Digest of all that decides on the first samples; empty if that is the manifest as it is.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub study: String,
    /// Digest of the rating of its runs, which decides on no row; empty without one.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub rating: String,
    /// Title of the study.
    pub title: String,
    /// Number of samples.
    pub samples: u64,
    /// Changes from the command line.
    pub overrides: Vec<String>,
    /// All input texts; the first is the study, the second its scenario.
    pub texts: Vec<Text>,
    /// Columns of the table between `index` and `status`, and between `reason` and `wall_time_s`.
    pub columns: Vec<Column>,
    /// Why the first samples would be others if there were more; none of a design that can be extended.
    #[serde(skip)]
    pub fixed: Option<&'static str>,
}

/// A file that the sweep was made from.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Text {
    /// File that refers to it.
    pub by: NamedBy,
    /// Its name there; the study without its folder.
    pub name: String,
    /// Name of the copy in the folder.
    pub copy: String,
    /// SHA-256 of its bytes.
    pub sha256: String,
}

/// A column of the table.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Unit; `1` for a plain number, empty for texts.
    pub unit: String,
    /// Its role.
    pub role: Role,
}

/// Role of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// A numeric parameter.
    Input,
    /// A text parameter.
    InputText,
    /// A result of the run.
    Figure,
}

impl Manifest {
    /// The manifest of a sweep with this program.
    pub fn new(program: String, title: String, samples: u64, overrides: Vec<String>) -> Self {
        Manifest {
            form: FORM,
            program,
            build: build().to_owned(),
            study: String::new(),
            rating: String::new(),
            title,
            samples,
            overrides,
            texts: Vec::new(),
            columns: Vec::new(),
            fixed: None,
        }
    }

    /// Its bytes.
    ///
    /// # Errors
    /// None for a manifest that was made here.
    pub fn to_bytes(&self) -> serde_json::Result<Vec<u8>> {
        let mut bytes = serde_json::to_vec_pretty(self)?;
        bytes.push(b'\n');
        Ok(bytes)
    }

    /// SHA-256 of what decides on the rows, included in every journal file and part.
    pub fn identity(&self) -> String {
        let decides = (self.form, &self.program, &self.build, &self.study, &self.overrides, &self.columns);
        let bytes = if self.study.is_empty() { self.to_bytes() } else { serde_json::to_vec(&decides) };
        // neither can fail: texts and whole numbers
        sha256(&bytes.unwrap_or_default())
    }

    /// Whether both are of one study, of which they may have different numbers of samples.
    pub fn is_of_study(&self, other: &Manifest) -> bool {
        self.identity() == other.identity()
    }

    /// Whether both are of the same rows: one study, as many samples, the same tables.
    pub fn is_of_rows(&self, other: &Manifest) -> bool {
        self.samples == other.samples && self.is_of_study(other) && self.tables().eq(other.tables())
    }

    /// Whether both are of the same rows, rated in the same way.
    pub fn is_of(&self, other: &Manifest) -> bool {
        self.rating == other.rating && self.is_of_rows(other)
    }

    /// Texts besides study and scenario, of which every byte counts.
    pub fn tables(&self) -> impl Iterator<Item = &Text> {
        self.texts.iter().skip(2).filter(|text| text.by != NamedBy::Rating)
    }

    /// Index of a measure's column.
    pub fn figure(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|c| c.role == Role::Figure && c.name == name)
    }

    /// One line per difference, `what: there → here`. `there` and `here` provide the texts.
    pub fn differences(
        &self,
        here: &Manifest,
        text_there: impl Fn(&Text) -> Option<Vec<u8>>,
        text_here: impl Fn(&Text) -> Option<Vec<u8>>,
    ) -> Vec<String> {
        let mut found = Vec::new();
        let mut differ = |what: &str, there: String, here: String| {
            if there != here {
                found.push(format!("{what}: {there} → {here}"));
            }
        };
        differ("form of the folder", self.form.to_string(), here.form.to_string());
        differ("program", self.program.clone(), here.program.clone());
        differ("build of the program", known(&self.build), known(&here.build));
        let because = match here.fixed {
            Some(why) if here.samples != self.samples => format!(" ({why})"),
            _ if here.samples < self.samples => " (the folder already has more)".to_owned(),
            _ => String::new(),
        };
        differ("samples", self.samples.to_string(), format!("{}{because}", here.samples));
        let listed = |overrides: &[String]| match overrides {
            [] => "none".to_owned(),
            some => some.join(", "),
        };
        differ("--set", listed(&self.overrides), listed(&here.overrides));
        for (there, ours) in self.texts.iter().zip(&here.texts).filter(|(there, ours)| there.sha256 != ours.sha256) {
            found.push(text_difference(&ours.name, text_there(there), text_here(ours)));
        }
        let more = self.texts.iter().skip(here.texts.len());
        found.extend(more.map(|there| format!("{}: there, not here", there.name)));
        let more = here.texts.iter().skip(self.texts.len());
        found.extend(more.map(|ours| format!("{}: here, not there", ours.name)));
        if found.is_empty() && self.columns != here.columns {
            found.push("the measures of a run: other columns".to_owned());
        }
        found
    }
}

/// A build in words.
fn known(build: &str) -> String {
    if build.is_empty() { "unknown" } else { build }.to_owned()
}

/// The first line in which two texts differ.
fn text_difference(name: &str, there: Option<Vec<u8>>, here: Option<Vec<u8>>) -> String {
    let (Some(there), Some(here)) = (there, here) else {
        return format!("{name}: another text");
    };
    let (there, here) = (String::from_utf8_lossy(&there), String::from_utf8_lossy(&here));
    let same = there.lines().zip(here.lines()).take_while(|(there, here)| there == here).count();
    let shown = |text: &str| match text.lines().nth(same) {
        Some(line) => format!("`{}`", line.trim().chars().take(60).collect::<String>()),
        None => "the end".to_owned(),
    };
    if [&there, &here].iter().all(|text| text.lines().count() == same) {
        return format!("{name}: other line ends");
    }
    format!("{name}, line {}: {} → {}", same + 1, shown(&there), shown(&here))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn manifest(study: &str) -> Manifest {
        let mut m = Manifest::new("occupant 1".to_owned(), String::new(), 10, Vec::new());
        m.texts.push(Text {
            by: NamedBy::CommandLine,
            name: "study.toml".to_owned(),
            copy: "inputs/0-study.toml".to_owned(),
            sha256: sha256(study.as_bytes()),
        });
        m
    }

    #[test]
    fn differences_are_named() {
        let (old, new) = ("a = 1\nb = 2\n", "a = 1\nb = 3\n");
        let there = manifest(old);
        let mut here = manifest(new);
        here.overrides.push("time.end=1".to_owned());
        here.program = "occupant 2".to_owned();
        let text = |t: &'static str| move |_: &Text| Some(t.as_bytes().to_vec());
        let found = there.differences(&here, text(old), text(new));
        assert_eq!(
            found,
            ["program: occupant 1 → occupant 2", "--set: none → time.end=1", "study.toml, line 2: `b = 2` → `b = 3`"]
        );
        assert!(there.differences(&manifest(old), text(old), text(old)).is_empty());
    }

    #[test]
    fn a_manifest_is_read_as_it_was_written() {
        let m = manifest("x");
        let read: Manifest = serde_json::from_slice(&m.to_bytes().unwrap()).unwrap();
        assert_eq!(read, m);
        assert!(read.is_of(&m));
    }
}

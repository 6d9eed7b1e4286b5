//! Inputs of a sweep, read once, from their original files or from the copies in a folder.

use std::cell::RefCell;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::folder::Folder;
use super::manifest::{Manifest, Text};
use crate::base::{file_name, input_file, sha256};

/// Origin of a reference to a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NamedBy {
    /// The command line: the study itself.
    CommandLine,
    /// The study, as the scenario to vary.
    StudyAsBase,
    /// The study, as a table of samples, a test or the scenario of a test.
    Study,
    /// The scenario.
    Scenario,
    /// A test given on the command line.
    CommandLineTest,
    /// The study, as values of its rating, which decide on no sample.
    Rating,
}

/// Source of texts.
#[derive(Clone, Debug)]
enum Source {
    /// The original files; paths in the study are relative to it, those in the scenario to the scenario.
    Files { study: PathBuf },
    /// The copies in the folder of a sweep.
    Copies { folder: Folder, texts: Vec<Text> },
}

/// Reads texts and keeps them.
#[derive(Debug)]
pub struct Texts {
    source: Source,
    /// Manifest entries and bytes.
    read: RefCell<Vec<(Text, Vec<u8>)>>,
    /// Folder of the scenario, the base of relative paths.
    base: RefCell<PathBuf>,
}

impl Texts {
    /// Reads the original files.
    pub fn of_files(study: &Path) -> Self {
        Texts::new(Source::Files { study: study.to_owned() })
    }

    /// Reads the copies in a folder.
    pub fn of_copies(folder: &Folder, manifest: &Manifest) -> Self {
        Texts::new(Source::Copies { folder: folder.clone(), texts: manifest.texts.clone() })
    }

    fn new(source: Source) -> Self {
        Texts { source, read: RefCell::default(), base: RefCell::default() }
    }

    /// Bytes of a referenced file; read once.
    ///
    /// # Errors
    /// Why it cannot be read.
    pub fn get(&self, by: NamedBy, name: &str) -> Result<Vec<u8>, String> {
        let known = |(text, _): &&(Text, Vec<u8>)| text.by == by && text.name == name;
        if let Some((_, bytes)) = self.read.borrow().iter().find(known) {
            return Ok(bytes.clone());
        }
        let bytes = self.fetch(by, name)?;
        self.add(by, name, bytes.clone());
        Ok(bytes)
    }

    fn fetch(&self, by: NamedBy, name: &str) -> Result<Vec<u8>, String> {
        match &self.source {
            Source::Files { study } => {
                input_file::bytes(&self.place(study, by, name)).map_err(|error| error.to_string())
            }
            Source::Copies { folder, texts } => {
                let text = texts.iter().find(|t| t.by == by && t.name == name);
                let text = text.ok_or("the sweep has no copy of it")?;
                let bytes = folder.copy_of(text).map_err(|e| e.to_string())?;
                if sha256(&bytes) != text.sha256 {
                    let mends = "the same command of `occupant sweep` writes it again";
                    return Err(format!("the copy {} was changed; {mends}", text.copy));
                }
                Ok(bytes)
            }
        }
    }

    /// Path of a file that a study or its scenario refers to.
    fn place(&self, study: &Path, by: NamedBy, name: &str) -> PathBuf {
        let beside = study.parent().unwrap_or(Path::new(""));
        match by {
            NamedBy::CommandLine => study.to_owned(),
            NamedBy::CommandLineTest => PathBuf::from(name),
            NamedBy::Study | NamedBy::Rating => beside.join(name),
            NamedBy::Scenario => self.base.borrow().join(name),
            NamedBy::StudyAsBase => {
                let path = beside.join(name);
                *self.base.borrow_mut() = path.parent().unwrap_or(Path::new("")).to_owned();
                path
            }
        }
    }

    /// Takes these bytes for a file, which need not exist.
    pub fn put(&self, by: NamedBy, name: &str, bytes: Vec<u8>) {
        if let Source::Files { study } = &self.source {
            self.place(study, by, name);
        }
        self.add(by, name, bytes);
    }

    /// Stores a text, or a substitute for something that is no single file.
    pub fn add(&self, by: NamedBy, name: &str, bytes: Vec<u8>) {
        let mut read = self.read.borrow_mut();
        let copy = format!("inputs/{}-{}", read.len(), file_name(Path::new(name)));
        read.push((Text { by, name: name.to_owned(), copy, sha256: sha256(&bytes) }, bytes));
    }

    /// All texts, for the manifest, with their bytes.
    pub fn all(&self) -> (Vec<Text>, Vec<Vec<u8>>) {
        self.read.borrow().iter().cloned().unzip()
    }
}

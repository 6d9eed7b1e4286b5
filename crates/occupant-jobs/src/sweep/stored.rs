//! A sweep as its folders hold it, read while others may still write it.

use std::path::{Path, PathBuf};

use super::Plan;
use crate::base::{Failure, program};
use crate::files::study_folder::{Checksums, Folder, Journal, Manifest, Problem, Role, SWEEP, Text, Texts};

/// A sweep, finished or not.
pub struct Stored {
    /// Its manifest.
    pub manifest: Manifest,
    /// SHA-256 of the manifest with which it was started.
    pub manifest_sha256: String,
    /// The study, read from the copies.
    pub plan: Plan,
    /// The existing rows.
    pub journal: Journal,
    /// Notes for the reader.
    pub notes: Vec<String>,
}

/// Accepted origin of a sweep.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum MadeBy {
    /// This program version only.
    ThisProgram,
    /// Any version.
    AnyProgram,
}

/// Opens the folders of one sweep, or of its shards.
///
/// # Errors
/// A folder that is none of a sweep, or of another one than the first; copies that were changed; a damaged journal.
pub fn open(folders: &[PathBuf], by: MadeBy) -> Result<Stored, Failure> {
    let folders: Vec<Folder> = folders.iter().map(|f| Folder::at(f)).collect();
    let manifest = common_manifest(&folders)?;
    let (Some(first), Some(study)) = (folders.first(), manifest.texts.first()) else {
        return Err(Failure::plain("the folder has no study"));
    };
    let texts = Texts::of_copies(first, &manifest);
    let (made_by, same): (String, fn(&Manifest, &Manifest) -> bool) = match by {
        MadeBy::ThisProgram => (program(), |a, b| a == b),
        // the study as the sweep saw it, whichever program that was
        MadeBy::AnyProgram => (manifest.program.clone(), |a, b| a.samples == b.samples && inputs(a) == inputs(b)),
    };
    let plan = Plan::open(Path::new(&study.name), &manifest.overrides, &texts, made_by)?;
    if !same(&plan.manifest, &manifest) {
        return Err(Failure::from(Problem::Differs {
            folder: first.path.to_owned(),
            holds: SWEEP,
            differences: manifest.differences(&plan.manifest, |_| None, |_| None),
        }));
    }
    let manifest_sha256 = sha256_of(&manifest)?;
    for folder in &folders {
        let sums = Checksums::open(&folder.path, |name| name.starts_with("journal/"))?;
        if let Some(path) = sums.damaged().into_iter().next() {
            let found = "was changed after it was written".to_owned();
            return Err(Problem::Damaged { path, found }.into());
        }
    }
    let journal = Journal::read(&folders, &manifest_sha256, manifest.samples)?;
    let mut notes = Vec::new();
    if manifest.program != program() {
        notes.push(format!(
            "The runs were made by {}, this is {}: only that program reproduces the numbers with the commands below.",
            manifest.program,
            program()
        ));
    }
    Ok(Stored { manifest_sha256, plan, journal, notes, manifest })
}

/// The manifest that all folders share.
///
/// # Errors
/// A folder without one, or with another; an error of the operating system.
fn common_manifest(folders: &[Folder]) -> Result<Manifest, Failure> {
    let manifest_of = |folder: &Folder| {
        folder.manifest()?.ok_or_else(|| {
            Failure::with_help(
                format!("{} does not contain a sweep", folder.path.display()),
                "give a folder written by `occupant sweep STUDY -o FOLDER`",
            )
        })
    };
    let (first, others) = folders.split_first().ok_or_else(|| Failure::plain("no folder was given"))?;
    let common = manifest_of(first)?;
    for folder in others {
        let other = manifest_of(folder)?;
        if other != common {
            let text = |f: &Folder, t: &Text| f.copy_of(t).ok();
            let lines = common.differences(&other, |t| text(first, t), |t| text(folder, t));
            return Err(Failure::plain(format!(
                "{} and {} contain parts of different sweeps:\n   {}",
                first.path.display(),
                folder.path.display(),
                lines.join("\n   ")
            )));
        }
    }
    Ok(common)
}

/// SHA-256 of a manifest.
///
/// # Errors
/// A study that cannot be written as text.
pub fn sha256_of(manifest: &Manifest) -> Result<String, Failure> {
    let sha256 = manifest.sha256();
    sha256.map_err(|error| Failure::plain(format!("the manifest cannot be written: {error}")))
}

/// Names of the input columns.
fn inputs(manifest: &Manifest) -> Vec<&str> {
    let inputs = manifest.columns.iter().filter(|c| c.role != Role::Figure);
    inputs.map(|c| c.name.as_str()).collect()
}

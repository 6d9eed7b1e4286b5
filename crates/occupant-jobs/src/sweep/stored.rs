//! A sweep as its folders hold it, read while others may still write it.

use std::path::{Path, PathBuf};

use super::Plan;
use crate::base::{Failure, program};
use crate::files::study_folder::{Checksums, Folder, Journal, Manifest, Problem, Role, SWEEP, Text, Texts};

/// A sweep, finished or not.
pub struct Stored {
    /// Its manifest.
    pub manifest: Manifest,
    /// Identity of the study: [`Manifest::identity`].
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
    open_with(folders, by, Journal::read)
}

/// The same with another way to read the rows, such as [`Journal::read_parts`].
///
/// # Errors
/// As [`open`].
pub fn open_with(
    folders: &[PathBuf],
    by: MadeBy,
    read: fn(&[Folder], &Manifest) -> Result<Journal, Problem>,
) -> Result<Stored, Failure> {
    let folders: Vec<Folder> = folders.iter().map(|given| Folder::given(given, None)).collect::<Result<_, _>>()?;
    let manifest = common_manifest(&folders)?;
    let (Some(first), Some(study)) = (folders.first(), manifest.texts.first()) else {
        return Err(Failure::plain("the folder has no study"));
    };
    let texts = Texts::of_copies(first, &manifest);
    let (made_by, same): (String, fn(&Manifest, &Manifest) -> bool) = match by {
        MadeBy::ThisProgram => (program(), Manifest::is_of),
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
    for folder in &folders {
        let sums = Checksums::open(&folder.path, |name| name.starts_with("journal/"))?;
        if let Some(path) = sums.damaged().into_iter().next() {
            let found = "was changed after it was written".to_owned();
            return Err(Problem::Damaged { path, found }.into());
        }
    }
    let journal = read(&folders, &manifest)?;
    let mut notes = Vec::new();
    if manifest.program != program() {
        notes.push(format!(
            "The runs were made by {}, this is {}: only that program reproduces the numbers with the commands below.",
            manifest.program,
            program()
        ));
    }
    Ok(Stored { manifest_sha256: manifest.identity(), plan, journal, notes, manifest })
}

/// The manifest that all folders share.
///
/// # Errors
/// A folder without one, or with another; an error of the operating system.
fn common_manifest(folders: &[Folder]) -> Result<Manifest, Failure> {
    let manifest_of = |folder: &Folder| {
        folder.manifest()?.ok_or_else(|| {
            Failure::with_help(
                format!("{} does not contain a sweep", folder.shown()),
                "give a folder written by `occupant sweep STUDY -o FOLDER`",
            )
        })
    };
    let (first, others) = folders.split_first().ok_or_else(|| Failure::plain("no folder was given"))?;
    let common = manifest_of(first)?;
    for folder in others {
        let other = manifest_of(folder)?;
        if !other.is_of(&common) {
            let text = |f: &Folder, t: &Text| f.copy_of(t).ok();
            let lines = common.differences(&other, |t| text(first, t), |t| text(folder, t));
            return Err(Failure::plain(format!(
                "{} and {} contain parts of different sweeps:\n   {}",
                first.shown(),
                folder.shown(),
                lines.join("\n   ")
            )));
        }
    }
    Ok(common)
}

/// Names of the input columns.
fn inputs(manifest: &Manifest) -> Vec<&str> {
    let inputs = manifest.columns.iter().filter(|c| c.role != Role::Figure);
    inputs.map(|c| c.name.as_str()).collect()
}

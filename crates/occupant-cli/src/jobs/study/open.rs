//! The folder of a sweep, opened to be read while others may still write it.

use std::path::{Path, PathBuf};

use crate::base::failure::Failure;
use crate::base::names::program;
use crate::files::study_folder::folder::{Folder, Holds};
use crate::files::study_folder::journal::Journal;
use crate::files::study_folder::manifest::{Manifest, Role};
use crate::files::study_folder::problem::Problem;
use crate::files::study_folder::texts::Texts;
use crate::jobs::sweep::parts::{common_manifest, read_journal, sha256_of};
use crate::jobs::sweep::plan::Plan;

/// A sweep, finished or not.
pub(crate) struct Opened {
    /// What it is the sweep of.
    pub(crate) manifest: Manifest,
    pub(crate) manifest_sha256: String,
    /// The study, made from the copies.
    pub(crate) plan: Plan,
    /// The rows that are there.
    pub(crate) journal: Journal,
    /// What a reader should know.
    pub(crate) notes: Vec<String>,
}

/// Opens the folders of one sweep, or of its shards.
///
/// # Errors
/// A folder that is none of a sweep, or of another one than the first; copies that were changed; a damaged journal.
pub(crate) fn open(folders: &[PathBuf]) -> Result<Opened, Failure> {
    let folders: Vec<Folder> = folders.iter().map(|f| Folder::at(f)).collect();
    let manifest = common_manifest(&folders)?;
    let (Some(first), Some(study)) = (folders.first(), manifest.texts.first()) else {
        return Err(Failure::plain("the folder holds no study"));
    };
    let texts = Texts::of_copies(first, &manifest);
    // the study as the sweep saw it, whichever program that was
    let name = Path::new(&study.name);
    let plan = Plan::open(name, &manifest.overrides, &texts, manifest.program.clone())?;
    if plan.manifest.samples != manifest.samples || inputs(&plan.manifest) != inputs(&manifest) {
        return Err(Failure::from(Problem::Differs {
            folder: first.path().to_owned(),
            holds: Holds::Sweep,
            differences: manifest.differences(&plan.manifest, |_| None, |_| None),
        }));
    }
    let manifest_sha256 = sha256_of(&manifest)?;
    let journal = read_journal(&folders, &manifest_sha256, &manifest)?;
    let mut notes = Vec::new();
    if manifest.program != program() {
        notes.push(format!(
            "The runs were made by {}, this is {}: the commands below give the same numbers with that program only.",
            manifest.program,
            program()
        ));
    }
    Ok(Opened { manifest_sha256, plan, journal, notes, manifest })
}

/// Names of the input columns.
fn inputs(manifest: &Manifest) -> Vec<&str> {
    let inputs = manifest.columns.iter().filter(|c| c.role != Role::Figure);
    inputs.map(|c| c.name.as_str()).collect()
}

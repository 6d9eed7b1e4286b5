//! The folders that hold parts of one sweep: the manifest that they share, and their journals.

use crate::base::failure::Failure;
use crate::files::study_folder::folder::Folder;
use crate::files::study_folder::journal::Journal;
use crate::files::study_folder::manifest::{Manifest, Text};

/// The manifest that all folders share.
///
/// # Errors
/// A folder without one, or with another; the operating system refuses.
pub(crate) fn common_manifest(folders: &[Folder]) -> Result<Manifest, Failure> {
    let mut common: Option<(&Folder, Manifest)> = None;
    for folder in folders {
        let found = folder.manifest()?;
        let shown = folder.path().display();
        let found = found.ok_or_else(|| {
            Failure::with_help(
                format!("{shown} holds no sweep"),
                "give the folder that `occupant sweep STUDY -o FOLDER` has written",
            )
        })?;
        match &common {
            None => common = Some((folder, found)),
            Some((_, first)) if *first == found => {}
            Some((there, first)) => {
                let text = |f: &Folder, t: &Text| f.copy_of(t).ok();
                let lines = first.differences(&found, |t| text(there, t), |t| text(folder, t));
                return Err(Failure::plain(format!(
                    "{} and {shown} hold parts of different sweeps:\n   {}",
                    there.path().display(),
                    lines.join("\n   ")
                )));
            }
        }
    }
    let common = common.map(|(_, manifest)| manifest);
    common.ok_or_else(|| Failure::plain("no folder was given"))
}

/// Reads through the journals.
pub(crate) fn read_journal(folders: &[Folder], sha256: &str, manifest: &Manifest) -> Result<Journal, Failure> {
    Ok(Journal::read(folders, sha256, manifest.samples)?)
}

/// What names a manifest.
pub(crate) fn sha256_of(manifest: &Manifest) -> Result<String, Failure> {
    let sha256 = manifest.sha256();
    sha256.map_err(|error| Failure::plain(format!("the manifest cannot be written: {error}")))
}

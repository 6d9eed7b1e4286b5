//! The part of the table that a range of samples becomes when it is finished.

use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use crate::base::{Existing, Failure, sync_folder};
use crate::files::study_folder::{About, Block, Folder, Journal, Manifest, Problem, StudyTable};
use occupant_files::table::Form;

/// Writes the part of a finished range with the hashes of its whole runs, unless it is there; its journal is removed then.
///
/// # Errors
/// A journal that cannot be read; an error of the operating system.
pub fn write(
    folder: &Folder,
    journal: &Journal,
    manifest: &Manifest,
    block: &Block,
    runs: &BTreeMap<String, String>,
) -> Result<(), Failure> {
    if journal.only_part().is_some_and(|part| part.about.runs == *runs) {
        return Ok(folder.clear_block(block)?);
    }
    let (beside, path) = (folder.beside_journal(block, "parquet"), folder.part(block));
    let mut table = StudyTable::create([(beside.clone(), Form::Parquet)], Existing::Replace, manifest)?;
    let mut about = About::new(manifest, &block.samples);
    about.runs.clone_from(runs);
    journal.each_row(|row| {
        about.see(&row);
        table.row(&row)
    })?;
    table.publish_part(&about)?;
    rename(&beside, &path)?;
    sync_folder(&path);
    Ok(folder.clear_block(block)?)
}

/// Gives a complete part its name. Of two processes without locks the later wins, with the same rows.
fn rename(beside: &Path, path: &Path) -> Result<(), Problem> {
    match fs::rename(beside, path) {
        Err(error) if error.kind() == ErrorKind::NotFound && path.exists() => Ok(()),
        renamed => renamed.map_err(Problem::io("rename to", path)),
    }
}

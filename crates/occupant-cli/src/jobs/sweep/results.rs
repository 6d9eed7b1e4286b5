//! From complete journals to the files that people read.

use std::path::PathBuf;

use occupant_study::Keep;

use super::census::Census;
use crate::base::failure::Failure;
use crate::files::study_folder::folder::Folder;
use crate::files::study_folder::journal::Journal;
use crate::files::study_folder::manifest::Manifest;
use crate::files::study_folder::problem::Problem;
use crate::files::study_folder::table::{StudyTable, write_columns};

/// Writes the table into `folder` and counts how samples ended.
///
/// # Errors
/// Samples that are missing or disagree; another process at the same work; the operating system refuses. A table that was
/// there stays until the new one is complete.
pub(crate) fn write(
    folder: &Folder,
    journal: &Journal,
    manifest: &Manifest,
    keep: &Keep,
    csv: bool,
) -> Result<(Census, Vec<PathBuf>), Failure> {
    refuse_gaps(journal, manifest)?;
    let _alone = folder.claim_table()?;
    let written = write_files(folder, journal, manifest, keep, csv);
    if written.is_err() {
        // what a full disk has left of a table is of no use, and the disk is full
        folder.remove_partial_tables();
    }
    written
}

/// Refuses journals that lack samples.
///
/// # Errors
/// Which are missing, by shards.
pub(crate) fn refuse_gaps(journal: &Journal, manifest: &Manifest) -> Result<(), Failure> {
    let (samples, gaps) = (manifest.samples, journal.finished.gaps(0..manifest.samples));
    if gaps.is_empty() {
        return Ok(());
    }
    Err(Problem::Incomplete { gaps, samples, shards: journal.lacking(samples) }.into())
}

fn write_files(
    folder: &Folder,
    journal: &Journal,
    manifest: &Manifest,
    keep: &Keep,
    csv: bool,
) -> Result<(Census, Vec<PathBuf>), Failure> {
    let mut census = Census::new(manifest);
    if let Keep::Worst { count, measure } = keep {
        let count = usize::try_from(*count).unwrap_or(usize::MAX);
        census.look_for(manifest, count, measure);
    }
    let mut table = StudyTable::create(folder.parquet(), csv.then(|| folder.csv()), manifest)?;
    journal.each_row(|row| {
        census.see(&row);
        table.row(&row)
    })?;
    let mut files = table.publish()?;
    if csv {
        files.push(write_columns(folder.columns(), manifest)?);
    }
    Ok((census, files))
}

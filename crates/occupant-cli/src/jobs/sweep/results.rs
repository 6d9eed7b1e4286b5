//! From complete journals to the files that people read.

use std::path::PathBuf;

use occupant_study::Keep;

use super::census::Census;
use crate::files::study_folder::csv_table::{CsvTable, write_columns};
use crate::files::study_folder::folder::Folder;
use crate::files::study_folder::journal::Journal;
use crate::files::study_folder::manifest::Manifest;
use crate::files::study_folder::parquet_table::ParquetTable;
use crate::files::study_folder::problem::Problem;
use crate::files::study_folder::table::{TableSink, stream};

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
) -> Result<(Census, Vec<PathBuf>), Problem> {
    let _alone = folder.claim_table()?;
    let written = write_files(folder, journal, manifest, keep, csv);
    if written.is_err() {
        // what a full disk has left of a table is of no use, and the disk is full
        folder.remove_partial_tables();
    }
    written
}

fn write_files(
    folder: &Folder,
    journal: &Journal,
    manifest: &Manifest,
    keep: &Keep,
    csv: bool,
) -> Result<(Census, Vec<PathBuf>), Problem> {
    let mut census = Census::new(manifest);
    if let Keep::Worst { count, measure } = keep {
        let count = usize::try_from(*count).unwrap_or(usize::MAX);
        census.look_for(manifest, count, measure);
    }
    let mut parquet = ParquetTable::create(folder.parquet(), manifest)?;
    let mut text = match csv {
        true => Some(CsvTable::create(folder.csv(), manifest)?),
        false => None,
    };
    let mut sinks: Vec<&mut dyn TableSink> = vec![&mut census, &mut parquet];
    if let Some(text) = &mut text {
        sinks.push(text);
    }
    stream(journal, manifest, &mut sinks)?;
    let mut files = vec![parquet.publish()?];
    if let Some(text) = text {
        files.push(text.publish()?);
        files.push(write_columns(folder.columns(), manifest)?);
    }
    Ok((census, files))
}

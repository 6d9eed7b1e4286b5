//! From complete journals to the files that people read.

use std::path::PathBuf;

use occupant_study::Keep;

use super::{Census, Ensembles, Extremes, Stable};
use crate::base::{Existing, Failure};
use crate::ensemble::text::is_shown;
use crate::files::study_folder::table::write_columns;
use crate::files::study_folder::{
    About, Checksums, Folder, Journal, Manifest, Problem, Role, Status, StudyTable, Waiting,
};
use occupant_files::table::{Cell, Form};

/// Results of a sweep.
pub struct Results {
    /// Outcomes of the runs.
    pub census: Census,
    /// Samples with the largest values of the measure chosen by `keep`, largest first.
    pub worst: Vec<u64>,
    /// Range of the shown figures: name, unit, values and samples.
    pub ranges: Vec<(String, String, Extremes<u64>)>,
    /// Stability of figures, for studies with ensembles.
    pub ensembles: Option<Ensembles>,
    /// Files that were written.
    pub files: Vec<PathBuf>,
}

/// Writes the tables into `folder` and counts the outcomes.
///
/// # Errors
/// Samples that are missing or disagree; another process at the same work; an error of the operating system. A table that was
/// there stays until the new one is complete.
pub fn write(
    (folder, sums): (&Folder, &Checksums),
    journal: &Journal,
    manifest: &Manifest,
    (keep, csv): (&Keep, bool),
    waiting: &Waiting<'_>,
) -> Result<Results, Failure> {
    refuse_gaps(journal, manifest)?;
    let _alone = waiting.claim(|| folder.claim_table())?;
    // a table that is damaged is made again, whatever is asked for today
    let csv = csv || sums.damaged().iter().any(|file| file.extension().is_some_and(|e| e == "csv"));
    let written = write_files((folder, sums), journal, manifest, keep, csv);
    if written.is_err() {
        // what a full disk has left of a table is of no use, and the disk is full
        folder.remove_partial_tables();
    }
    let written = written?;
    written.files.iter().try_for_each(|file| sums.add(file))?;
    Ok(written)
}

/// Refuses journals with missing samples.
///
/// # Errors
/// Missing samples.
pub fn refuse_gaps(journal: &Journal, manifest: &Manifest) -> Result<(), Failure> {
    let (samples, gaps) = (manifest.samples, journal.finished.gaps(0..manifest.samples));
    if gaps.is_empty() {
        return Ok(());
    }
    Err(Problem::Incomplete { gaps, samples }.into())
}

fn write_files(
    (folder, sums): (&Folder, &Checksums),
    journal: &Journal,
    manifest: &Manifest,
    keep: &Keep,
    csv: bool,
) -> Result<Results, Failure> {
    let (count, figure) = match keep {
        Keep::Worst { count, measure } => (*count, manifest.figure(measure)),
        _ => (0, None),
    };
    let mut extremes = Extremes::new(usize::try_from(count).unwrap_or(usize::MAX));
    let mut ranges = ranges(manifest);
    let mut stable = Stable::begin(folder, manifest, csv)?;
    // a table that is whole stays as it is
    let is_there = journal.only_part().is_some_and(|part| part.path == folder.parquet());
    let parquet = (!is_there).then(|| (folder.parquet(), Form::Parquet));
    let asked = parquet.into_iter().chain(csv.then(|| (folder.csv(), Form::Csv)));
    let mut about = About::new(manifest, &(0..manifest.samples));
    let mut table = StudyTable::create(asked, Existing::Replace, manifest)?;
    journal.each_row(|row| {
        let counts = about.see(&row);
        let value = figure.and_then(|at| row.cells.get(at)).and_then(Cell::number);
        if let (true, Some(value)) = (counts, value) {
            extremes.see(&row.index, value);
        }
        for (at, _, _, range) in ranges.iter_mut().filter(|_| counts) {
            range.see(&row.index, row.cells.get(*at).and_then(Cell::number).unwrap_or(f64::NAN));
        }
        if let Some(stable) = stable.as_mut().filter(|_| row.status != Status::Excluded) {
            stable.see(&row, counts)?;
        }
        table.row(&row)
    })?;
    about.runs = sums.runs_of(&(0..manifest.samples));
    let written = table.publish_part(&about)?;
    let mut files: Vec<PathBuf> = is_there.then(|| folder.parquet()).into_iter().chain(written).collect();
    if csv {
        files.push(write_columns(folder.columns(), manifest)?);
    }
    let ensembles = stable.map(Stable::finish).transpose()?;
    files.extend(ensembles.iter().flat_map(|e| e.files.clone()));
    let ranges = ranges.into_iter().map(|(_, name, unit, range)| (name, unit, range)).collect();
    Ok(Results {
        census: about.census,
        worst: extremes.worst.iter().map(|(_, index)| *index).collect(),
        ranges,
        ensembles,
        files,
    })
}

/// Figures shown in tables: column, name, unit, empty range.
fn ranges(manifest: &Manifest) -> Vec<(usize, String, String, Extremes<u64>)> {
    let all = manifest.columns.iter().enumerate();
    let shown = all.filter(|(_, column)| column.role == Role::Figure && is_shown(&column.name));
    shown.map(|(at, column)| (at, column.name.clone(), column.unit.clone(), Extremes::new(1))).collect()
}

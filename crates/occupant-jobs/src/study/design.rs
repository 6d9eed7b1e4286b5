//! The samples of a study as a table, without running any: it can be read as the samples of another study.

use std::path::Path;

use crate::base::{Existing, Failure};
use crate::files::study_folder::Role;
use crate::sweep::Plan;
use occupant_files::table::{Form, Kind, TableFile};

/// Writes one row for each sample that no constraint excludes, and gives their number; the columns are named as a table of samples
/// names them, in SI units.
///
/// # Errors
/// An ending that is no table's; a file that is there and may not be replaced; an error of the operating system.
pub fn write_design(plan: &Plan, path: &Path, existing: Existing) -> Result<u64, Failure> {
    let study = &plan.study;
    let count = study.parameters.len();
    if count == 0 {
        return Err(Failure::with_help("the study has no parameters: its samples are all the same", "vary something"));
    }
    let heading = |column: &crate::files::study_folder::Column| {
        let name = column.name.strip_prefix("input.").unwrap_or(&column.name);
        match (column.role, column.unit.as_str()) {
            (Role::InputText, _) => (name.to_owned(), Kind::MaybeText),
            (_, "" | "1") => (name.to_owned(), Kind::MaybeNumber),
            (_, unit) => (format!("{name}[{unit}]"), Kind::MaybeNumber),
        }
    };
    let columns: Vec<(String, Kind)> = plan.manifest.columns.iter().take(count).map(heading).collect();
    let mut table = TableFile::create(path.to_owned(), Form::of_output(path)?, existing, &columns, &[])?;
    let mut written = 0;
    for run in (0..study.samples()).map(|sample| sample * study.members()).filter(|run| study.excluded(*run).is_none())
    {
        let mut cells = plan.inputs(run);
        cells.truncate(count);
        table.row(cells)?;
        written += 1;
    }
    table.publish().map(|_| written)
}

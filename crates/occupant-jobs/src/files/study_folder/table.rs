//! Rows of a study as tables: Parquet for pyarrow, DuckDB and the like, other forms where asked for.
//!
//! `index`, the inputs, `status`, `reason`, `caveats`, the figures, `wall_time_s`, `kernel`. The metadata of a Parquet file hold the
//! manifest (`occupant.sweep`) and the units (`occupant.units`: a JSON object, column → unit); those of a part of a study what it is
//! a part of ([`super::part`]).

use std::path::PathBuf;

use super::manifest::{Column, Manifest, Role};
use super::part::{ABOUT, About, seal};
use super::row::Row;
use crate::base::{Existing, Failure};
use occupant_files::table::{Cell, Form, Kind, TableFile};

/// Files of a table under their temporary names.
pub struct StudyTable {
    files: Vec<TableFile>,
    /// Number of cells before `status`.
    inputs: usize,
}

impl StudyTable {
    /// Begins the files.
    ///
    /// # Errors
    /// A file is there and may not be replaced; an error of the operating system.
    pub fn create(
        files: impl IntoIterator<Item = (PathBuf, Form)>,
        existing: Existing,
        manifest: &Manifest,
    ) -> Result<Self, Failure> {
        let inputs = manifest.columns.iter().filter(|c| c.role != Role::Figure).count();
        let columns = columns(manifest, inputs);
        let units: serde_json::Map<String, serde_json::Value> =
            manifest.columns.iter().map(|column| (column.name.clone(), column.unit.clone().into())).collect();
        let whole = manifest.to_bytes().map_err(|e| Failure::plain(format!("the manifest cannot be written: {e}")))?;
        let about = [
            ("occupant.sweep", String::from_utf8_lossy(&whole).into_owned()),
            ("occupant.units", serde_json::Value::Object(units).to_string()),
        ];
        let create = |(path, form)| {
            let mut file = TableFile::create(path, form, existing, &columns, &about)?;
            file.beside("columns", &COLUMNS, described(manifest));
            Ok(file)
        };
        let files = files.into_iter().map(create).collect::<Result<_, Failure>>()?;
        Ok(StudyTable { files, inputs })
    }

    /// Adds a row.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn row(&mut self, row: &Row) -> Result<(), Failure> {
        let (inputs, figures) = row.cells.split_at_checked(self.inputs).unwrap_or((&[], &[]));
        let [reason, caveats] =
            [&row.reason, &row.caveats].map(|text| if text.is_empty() { Cell::Absent } else { Cell::text(text) });
        let begin = [Cell::count(row.index)];
        let ending = [Cell::text(row.status.word()), reason, caveats];
        let work = [Cell::Number(row.wall_time_s), Cell::text(&row.kernel)];
        let cells = [&begin[..], inputs, &ending, figures, &work].concat();
        let Some((last, others)) = self.files.split_last_mut() else { return Ok(()) };
        others.iter_mut().try_for_each(|file| file.row(cells.clone()))?;
        last.row(cells)
    }

    /// Describes the part of a study that a Parquet file is, and renames the complete files.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn publish_part(self, about: &About) -> Result<Vec<PathBuf>, Failure> {
        let about = serde_json::to_string(about);
        let about = about.map_err(|e| Failure::plain(format!("the part cannot be described: {e}")))?;
        let publish = |mut file: TableFile| match Form::of(file.path()) {
            Some(Form::Parquet) => {
                file.describe(ABOUT, about.clone());
                file.publish_after(seal)
            }
            _ => file.publish(),
        };
        self.files.into_iter().map(publish).collect()
    }

    /// Renames the complete files.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn publish(self) -> Result<Vec<PathBuf>, Failure> {
        self.files.into_iter().map(TableFile::publish).collect()
    }
}

/// Columns of a table; the first `inputs` of the manifest's come before `status`.
fn columns(manifest: &Manifest, inputs: usize) -> Vec<(&str, Kind)> {
    let of = |column: &Column| match column.role {
        Role::Input | Role::Figure => Kind::MaybeNumber,
        Role::InputText => Kind::MaybeText,
    };
    let named: Vec<(&str, Kind)> = manifest.columns.iter().map(|c| (c.name.as_str(), of(c))).collect();
    let (inputs, figures) = named.split_at(inputs);
    let ending = [("status", Kind::Text), ("reason", Kind::MaybeText), ("caveats", Kind::MaybeText)];
    let work = [("wall_time_s", Kind::Number), ("kernel", Kind::Text)];
    [&[("index", Kind::Count)][..], inputs, &ending, figures, &work].concat()
}

/// Columns of the table of columns.
const COLUMNS: [(&str, Kind); 3] = [("column", Kind::Text), ("unit", Kind::Text), ("role", Kind::Text)];

/// Names, units and roles of the columns.
fn described(manifest: &Manifest) -> impl Iterator<Item = Vec<Cell>> {
    let role = |column: &Column| if column.role == Role::Figure { "figure" } else { "input" };
    let columns = manifest.columns.iter().map(move |column| [column.name.as_str(), &column.unit, role(column)]);
    columns.chain([["wall_time_s", "s", "work"]]).map(|row| row.map(Cell::text).into())
}

/// Writes names, units and roles of the columns.
///
/// # Errors
/// An error of the operating system.
pub fn write_columns(path: PathBuf, manifest: &Manifest) -> Result<PathBuf, Failure> {
    let mut table = TableFile::create(path, Form::Csv, Existing::Replace, &COLUMNS, &[])?;
    described(manifest).try_for_each(|row| table.row(row))?;
    table.publish()
}

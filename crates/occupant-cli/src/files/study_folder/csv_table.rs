//! The table as CSV (RFC 4180), and a second file with the unit of each column.

use std::io::{self, Write};
use std::path::PathBuf;

use super::manifest::{Manifest, Role};
use super::problem::Problem;
use super::row::{Cell, Row};
use super::table::TableSink;
use crate::base::output_file::{Existing, PartialFile};

/// A table under its provisional name.
#[derive(Debug)]
pub(crate) struct CsvTable {
    path: PathBuf,
    file: PartialFile,
    /// Cells that stand before `status`.
    inputs: usize,
}

impl CsvTable {
    /// Begins the file; one that is there is replaced when the new one is complete.
    ///
    /// # Errors
    /// The operating system refuses.
    pub(crate) fn create(path: PathBuf, manifest: &Manifest) -> Result<Self, Problem> {
        let file = create(&path)?;
        let inputs = manifest.columns.iter().filter(|c| c.role != Role::Figure);
        let mut table = CsvTable { path, file, inputs: inputs.count() };
        let (inputs, figures) = manifest.columns.split_at(table.inputs);
        let names = std::iter::once("index")
            .chain(inputs.iter().map(|c| c.name.as_str()))
            .chain(["status", "reason"])
            .chain(figures.iter().map(|c| c.name.as_str()))
            .chain(["wall_time_s", "kernel"]);
        let header: Vec<String> = names.map(quoted).collect();
        let written = writeln!(table.file, "{}", header.join(","));
        written.map_err(Problem::io("write", &table.path))?;
        Ok(table)
    }

    /// Gives the file its name.
    ///
    /// # Errors
    /// The operating system refuses.
    pub(crate) fn publish(self) -> Result<PathBuf, Problem> {
        publish(self.file, &self.path)
    }

    fn write(&mut self, row: &Row) -> io::Result<()> {
        let (inputs, figures) = row.cells.split_at_checked(self.inputs).unwrap_or((&[], &[]));
        write!(self.file, "{}", row.index)?;
        for cell in inputs {
            write!(self.file, ",{}", shown(cell))?;
        }
        write!(self.file, ",{},{}", row.status.word(), quoted(&row.reason))?;
        for cell in figures {
            write!(self.file, ",{}", shown(cell))?;
        }
        writeln!(self.file, ",{},{}", row.wall_time_s, quoted(&row.kernel))
    }
}

impl TableSink for CsvTable {
    fn rows(&mut self, rows: &[Row]) -> Result<(), Problem> {
        let written = rows.iter().try_for_each(|row| self.write(row));
        written.map_err(Problem::io("write", &self.path))
    }
}

/// Writes names, units and roles of the columns.
///
/// # Errors
/// The operating system refuses.
pub(crate) fn write_columns(path: PathBuf, manifest: &Manifest) -> Result<PathBuf, Problem> {
    let mut file = create(&path)?;
    let mut write = || -> io::Result<()> {
        writeln!(file, "column,unit,role")?;
        for column in &manifest.columns {
            let role = match column.role {
                Role::Input | Role::InputText => "input",
                Role::Figure => "figure",
            };
            writeln!(file, "{},{},{role}", quoted(&column.name), quoted(&column.unit))?;
        }
        writeln!(file, "wall_time_s,s,work")
    };
    write().map_err(Problem::io("write", &path))?;
    publish(file, &path)
}

fn create(path: &std::path::Path) -> Result<PartialFile, Problem> {
    PartialFile::create(path, Existing::Replace)
        .map_err(|e| Problem::Table { path: path.to_owned(), reason: e.to_string() })
}

fn publish(file: PartialFile, path: &std::path::Path) -> Result<PathBuf, Problem> {
    file.publish().map_err(|e| Problem::Table { path: path.to_owned(), reason: e.to_string() })
}

/// Numbers as the shortest text that is read as the same number.
fn shown(cell: &Cell) -> String {
    match cell {
        Cell::Absent => String::new(),
        Cell::Number(x) => x.to_string(),
        Cell::Text(text) => quoted(text),
    }
}

fn quoted(text: &str) -> String {
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}

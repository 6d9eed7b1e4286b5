//! Tables of words and numbers as CSV (RFC 4180) or Parquet, row by row; of a Parquet file a group of rows is held at a time, a
//! workbook or MAT file as a whole.

mod stored;

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::{ColumnPath, Type};
use placed_text::plain;
use serde::{Deserialize, Serialize};

use super::book::{self, Sheet};
use crate::base::{Existing, Failure, PartialFile, by_ending, program};

pub use stored::StoredTable;

/// Number of values buffered, but at least and at most this many rows.
const CELLS: usize = 400_000;
const ROWS: [usize; 2] = [1024, 16_384];
/// After so many groups of rows they grow with their number: each keeps a description of each column in memory until the end.
const GROUPS: usize = 64;

/// Type of a column; only the `Maybe` types may lack values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Whole numbers.
    Count,
    /// Numbers.
    Number,
    /// Numbers, some of which are absent.
    MaybeNumber,
    /// Texts.
    Text,
    /// Texts, some of which are missing.
    MaybeText,
}

/// Columns from lists of names of the same type.
pub fn columns(lists: &[(Kind, &[&'static str])]) -> Vec<(&'static str, Kind)> {
    lists.iter().flat_map(|(kind, names)| names.iter().map(|name| (*name, *kind))).collect()
}

/// A value; in JSON null, a number or a text.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Cell {
    /// Nothing.
    Absent,
    /// A number.
    Number(f64),
    /// A text.
    Text(Box<str>),
}

impl Cell {
    /// A text.
    pub fn text(text: &str) -> Self {
        Cell::Text(text.into())
    }

    /// A whole number.
    pub fn count(n: u64) -> Self {
        Cell::Number(n as f64)
    }

    /// Absent if it is no finite number.
    pub fn finite(x: f64) -> Self {
        if x.is_finite() { Cell::Number(x) } else { Cell::Absent }
    }

    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            Cell::Number(x) => Some(*x),
            Cell::Absent | Cell::Text(_) => None,
        }
    }

    /// A number as the shortest text that reads back to the same number.
    fn shown(&self) -> String {
        match self {
            Cell::Absent => String::new(),
            Cell::Number(x) => x.to_string(),
            Cell::Text(text) => harmless(text),
        }
    }

    fn bytes(&self) -> Option<ByteArray> {
        match self {
            Cell::Text(text) => Some(ByteArray::from(text.as_bytes().to_vec())),
            Cell::Absent | Cell::Number(_) => None,
        }
    }
}

/// A text that no spreadsheet takes for a formula: an apostrophe is added if it begins like one. Hidden characters are
/// escaped.
fn harmless(text: &str) -> String {
    let is_formula = text.starts_with(['=', '+', '-', '@', '\t', '\r']) && text.parse::<f64>().is_err();
    let mark = if is_formula { "'" } else { "" };
    format!("{mark}{}", plain(text))
}

/// File format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Text with a heading line.
    Csv,
    /// Compressed columns.
    Parquet,
    /// A workbook of Excel.
    Xlsx,
    /// Variables of MATLAB.
    Mat,
}

/// Formats by extension.
const FORMS: [(&str, Form); 4] =
    [("csv", Form::Csv), ("parquet", Form::Parquet), ("xlsx", Form::Xlsx), ("mat", Form::Mat)];

impl Form {
    /// The format for the file's extension.
    pub fn of(path: &Path) -> Option<Form> {
        by_ending(path, &FORMS)
    }

    /// The format of a requested table.
    ///
    /// # Errors
    /// Another ending.
    pub fn of_output(path: &Path) -> Result<Form, Failure> {
        Form::of(path).ok_or_else(|| Failure::ending(path, ".csv, .parquet, .xlsx or .mat"))
    }
}

/// A table being written to `W`.
pub struct Table<W: Write + Send> {
    kinds: Vec<Kind>,
    /// Cells of the rows that no group has yet, by column.
    waiting: Vec<Vec<Cell>>,
    /// Groups of rows so far.
    groups: usize,
    writer: Writer<W>,
}

enum Writer<W: Write + Send> {
    Csv(Box<csv::Writer<W>>),
    Parquet(Box<SerializedFileWriter<W>>),
    Book(W, Form, Vec<Sheet>),
}

impl<W: Write + Send> Table<W> {
    /// Begins a table; `about` is in the metadata of a Parquet file.
    ///
    /// # Errors
    /// Two columns with one name; an error of the writer.
    pub fn new(to: W, form: Form, columns: &[(impl AsRef<str>, Kind)], about: &[(&str, String)]) -> io::Result<Self> {
        let mut names = std::collections::HashSet::new();
        if let Some((name, _)) = columns.iter().find(|(name, _)| !names.insert(name.as_ref())) {
            return Err(invalid(format!("two columns named `{}`; expected unique names", name.as_ref())));
        }
        let writer = match form {
            Form::Csv => {
                let mut writer = csv::Writer::from_writer(to);
                writer.write_record(columns.iter().map(|(name, _)| harmless(name.as_ref())))?;
                Writer::Csv(Box::new(writer))
            }
            Form::Parquet => Writer::Parquet(Box::new(begin(to, columns, about).map_err(reason)?)),
            Form::Xlsx | Form::Mat => Writer::Book(to, form, vec![Sheet::new("table", columns)]),
        };
        let kinds: Vec<Kind> = columns.iter().map(|(_, kind)| *kind).collect();
        Ok(Table { waiting: vec![Vec::new(); kinds.len()], kinds, groups: 0, writer })
    }

    /// Adds a row with a cell per column, of the column's type.
    ///
    /// # Errors
    /// More or fewer cells than columns; a text among numbers; an error of the writer.
    pub fn row(&mut self, cells: Vec<Cell>) -> io::Result<()> {
        if cells.len() != self.kinds.len() {
            let found = format!("a row of {} cells in a table of {} columns", cells.len(), self.kinds.len());
            return Err(invalid(found + "; expected one for each"));
        }
        let is_number = |kind: &Kind| matches!(kind, Kind::Count | Kind::Number | Kind::MaybeNumber);
        let misfit =
            cells.iter().zip(&self.kinds).find(|(cell, kind)| is_number(kind) && matches!(cell, Cell::Text(_)));
        if let Some((Cell::Text(text), _)) = misfit {
            return Err(invalid(format!("the text {text:?} in a column of numbers; expected a number")));
        }
        match &mut self.writer {
            Writer::Csv(writer) => writer.write_record(cells.iter().map(Cell::shown))?,
            Writer::Parquet(_) => {
                self.waiting.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
                if self.waiting.first().map_or(0, Vec::len) >= rows_of_group(self.kinds.len(), self.groups) {
                    self.flush()?;
                }
            }
            Writer::Book(.., sheets) => sheets[0].row(&cells),
        }
        Ok(())
    }

    /// Adds another table, where the format allows: a sheet of a workbook, a structure of a MAT file.
    pub fn beside(&mut self, name: &'static str, columns: &[(&str, Kind)], rows: impl IntoIterator<Item = Vec<Cell>>) {
        if let Writer::Book(.., sheets) = &mut self.writer {
            let mut sheet = Sheet::new(name, columns);
            rows.into_iter().for_each(|cells| sheet.row(&cells));
            sheets.push(sheet);
        }
    }

    /// Adds to the metadata of a Parquet file what is known only at its end.
    pub fn describe(&mut self, key: &str, value: String) {
        if let Writer::Parquet(writer) = &mut self.writer {
            writer.append_key_value_metadata(KeyValue::new(key.to_owned(), value));
        }
    }

    /// Ends the table and returns its target.
    ///
    /// # Errors
    /// An error of the writer.
    pub fn finish(mut self) -> io::Result<W> {
        self.flush()?;
        match self.writer {
            Writer::Csv(writer) => writer.into_inner().map_err(|e| e.into_error()),
            Writer::Parquet(writer) => writer.into_inner().map_err(reason),
            Writer::Book(mut to, form, sheets) => to.write_all(&book::bytes(form, &sheets)?).map(|()| to),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        let Writer::Parquet(writer) = &mut self.writer else { return Ok(()) };
        if self.waiting.iter().all(Vec::is_empty) {
            return Ok(());
        }
        write_group(writer, &self.kinds, &self.waiting).map_err(reason)?;
        self.groups += 1;
        self.waiting.iter_mut().for_each(Vec::clear);
        Ok(())
    }
}

/// Number of rows of a group after so many others.
fn rows_of_group(columns: usize, before: usize) -> usize {
    (CELLS / columns.max(1)).max(ROWS[0]).saturating_mul((before / GROUPS).max(1)).min(ROWS[1])
}

fn invalid(what: String) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, what)
}

fn begin<W: Write + Send, N: AsRef<str>>(
    to: W,
    columns: &[(N, Kind)],
    about: &[(&str, String)],
) -> Result<SerializedFileWriter<W>, ParquetError> {
    let column = |(name, kind): &(N, Kind)| {
        let (physical, logical) = match kind {
            Kind::Count => (Physical::INT64, None),
            Kind::Number | Kind::MaybeNumber => (Physical::DOUBLE, None),
            Kind::Text | Kind::MaybeText => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        let repetition = match kind {
            Kind::MaybeNumber | Kind::MaybeText => Repetition::OPTIONAL,
            Kind::Count | Kind::Number | Kind::Text => Repetition::REQUIRED,
        };
        let column = Type::primitive_type_builder(name.as_ref(), physical);
        column.with_repetition(repetition).with_logical_type(logical).build().map(Arc::new)
    };
    let fields = columns.iter().map(column).collect::<Result<Vec<_>, _>>()?;
    let schema = Type::group_type_builder("occupant_table").with_fields(fields).build()?;
    let about = about.iter().map(|(key, value)| KeyValue::new((*key).to_owned(), value.clone()));
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_created_by(program())
        .set_key_value_metadata(Some(about.collect()))
        // nobody looks for a page, and an index of them stays in memory until the end
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_offset_index_disabled(true);
    // numbers are seldom the same twice
    let numbers = columns.iter().filter(|(_, kind)| !matches!(kind, Kind::Text | Kind::MaybeText));
    let properties = numbers.fold(properties, |properties, (name, _)| {
        properties.set_column_dictionary_enabled(ColumnPath::new(vec![name.as_ref().to_owned()]), false)
    });
    SerializedFileWriter::new(to, Arc::new(schema), Arc::new(properties.build()))
}

fn write_group<W: Write + Send>(
    writer: &mut SerializedFileWriter<W>,
    kinds: &[Kind],
    columns: &[Vec<Cell>],
) -> Result<(), ParquetError> {
    let mut group = writer.next_row_group()?;
    for (kind, cells) in kinds.iter().zip(columns) {
        let no_column = || ParquetError::General("a column too many".to_owned());
        let mut column = group.next_column()?.ok_or_else(no_column)?;
        let cells = cells.iter();
        match kind {
            Kind::Count => put::<Int64Type>(&mut column, cells.map(|c| c.number().map(|x| x as i64)), Some(0)),
            Kind::Number => put::<DoubleType>(&mut column, cells.map(Cell::number), Some(f64::NAN)),
            Kind::MaybeNumber => put::<DoubleType>(&mut column, cells.map(Cell::number), None),
            Kind::Text => put::<ByteArrayType>(&mut column, cells.map(Cell::bytes), Some(ByteArray::from(Vec::new()))),
            Kind::MaybeText => put::<ByteArrayType>(&mut column, cells.map(Cell::bytes), None),
        }?;
        column.close()?;
    }
    group.close().map(|_| ())
}

/// Writes values, with a placeholder for missing ones in a column that may not lack any.
fn put<T: DataType>(
    column: &mut SerializedColumnWriter<'_>,
    values: impl Iterator<Item = Option<T::T>>,
    absent: Option<T::T>,
) -> Result<usize, ParquetError> {
    let all: Vec<Option<T::T>> = values.map(|value| value.or_else(|| absent.clone())).collect();
    // 1 for each value that is there
    let levels: Vec<i16> = all.iter().map(|value| value.is_some().into()).collect();
    let there: Vec<T::T> = all.into_iter().flatten().collect();
    column.typed::<T>().write_batch(&there, absent.is_none().then_some(&levels[..]), None)
}

fn reason(error: ParquetError) -> io::Error {
    match error {
        // the reason of the operating system, without the library's own words
        ParquetError::External(source) => io::Error::other(source),
        other => io::Error::other(other),
    }
}

/// A table under its temporary name.
pub struct TableFile {
    path: PathBuf,
    table: Table<PartialFile>,
}

impl TableFile {
    /// Begins a file; `about` is in the metadata of a Parquet file.
    ///
    /// # Errors
    /// The file is there and may not be replaced; an error of the operating system.
    pub fn create(
        path: PathBuf,
        form: Form,
        existing: Existing,
        columns: &[(impl AsRef<str>, Kind)],
        about: &[(&str, String)],
    ) -> Result<Self, Failure> {
        let file = PartialFile::create(&path, existing).map_err(|e| broke_off(&e))?;
        let table = Table::new(file, form, columns, about).map_err(|e| unwritten(&path, &e))?;
        Ok(TableFile { path, table })
    }

    /// Its final name.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Adds a row: [`Table::row`].
    ///
    /// # Errors
    /// As of [`Table::row`].
    pub fn row(&mut self, cells: Vec<Cell>) -> Result<(), Failure> {
        self.table.row(cells).map_err(|e| unwritten(&self.path, &e))
    }

    /// As [`Table::beside`].
    pub fn beside(&mut self, name: &'static str, columns: &[(&str, Kind)], rows: impl IntoIterator<Item = Vec<Cell>>) {
        self.table.beside(name, columns, rows);
    }

    /// As [`Table::describe`].
    pub fn describe(&mut self, key: &str, value: String) {
        self.table.describe(key, value);
    }

    /// Renames the complete file.
    ///
    /// # Errors
    /// An error of the writer or of the operating system.
    pub fn publish(self) -> Result<PathBuf, Failure> {
        self.publish_after(|_| Ok(()))
    }

    /// Renames the complete file after `last` has changed it.
    ///
    /// # Errors
    /// An error of the writer or of the operating system.
    pub fn publish_after(self, last: impl FnOnce(&mut PartialFile) -> io::Result<()>) -> Result<PathBuf, Failure> {
        let mut file = self.table.finish().map_err(|e| unwritten(&self.path, &e))?;
        last(&mut file).map_err(|e| unwritten(&self.path, &e))?;
        file.publish().map_err(|e| broke_off(&e))
    }
}

fn unwritten(path: &Path, error: &io::Error) -> Failure {
    broke_off(&format!("{} cannot be written: {error}", path.display()))
}

fn broke_off(reason: &dyn std::fmt::Display) -> Failure {
    Failure::BrokeOff(format!("error: {reason}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_table_has_few_groups_and_a_short_one_small_groups() {
        let (mut rows, mut groups) = (0, 0);
        while rows < 10_000_000 {
            let of = rows_of_group(205, groups);
            assert!(if groups < GROUPS { of == 1951 } else { (1951..=ROWS[1]).contains(&of) }, "{of}");
            rows += of;
            groups += 1;
        }
        // measured: 905; of equal size there would be 5126
        assert!(groups < 1000, "{groups}");
    }
}

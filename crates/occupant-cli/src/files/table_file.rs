//! Tables of words and numbers as CSV or Parquet, row by row.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical, ZstdLevel};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use crate::base::output_file::{Existing, PartialFile};

/// So many rows are written at a time.
const GROUP: usize = 20_000;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Text,
    /// Numbers, some of which may be absent.
    Number,
    /// Whole numbers.
    Count,
}

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Cell {
    Text(String),
    /// A number; absent if it is none.
    Number(f64),
    /// A whole number.
    Count(u64),
}

/// The form of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// Text, with a line of headings.
    Csv,
    /// Columns.
    Parquet,
}

impl Form {
    /// The form that the file's ending asks for.
    pub(crate) fn of(path: &Path) -> Option<Form> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "csv" => Some(Form::Csv),
            "parquet" => Some(Form::Parquet),
            _ => None,
        }
    }
}

/// A table under its provisional name.
pub(crate) struct TableFile {
    path: PathBuf,
    columns: Vec<(String, Kind)>,
    waiting: Vec<Vec<Cell>>,
    writer: Writer,
}

enum Writer {
    Csv(PartialFile),
    Parquet(Box<SerializedFileWriter<PartialFile>>),
}

impl TableFile {
    /// Begins a table; `about` stands in the metadata of a Parquet file.
    ///
    /// # Errors
    /// The file is there and may not be replaced; the operating system refuses.
    pub(crate) fn create(
        path: &Path,
        form: Form,
        existing: Existing,
        columns: &[(impl AsRef<str>, Kind)],
        about: &[(&str, String)],
    ) -> Result<Self, String> {
        let columns: Vec<(String, Kind)> =
            columns.iter().map(|(name, kind)| (name.as_ref().to_owned(), *kind)).collect();
        let mut file = PartialFile::create(path, existing).map_err(|e| e.to_string())?;
        let writer = match form {
            Form::Csv => {
                let names: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
                writeln!(file, "{}", names.join(",")).map_err(|e| unwritten(path, &e.to_string()))?;
                Writer::Csv(file)
            }
            Form::Parquet => {
                let writer = begin(file, &columns, about);
                Writer::Parquet(Box::new(writer.map_err(|e| unwritten(path, &words(&e)))?))
            }
        };
        Ok(TableFile { path: path.to_owned(), columns, waiting: Vec::new(), writer })
    }

    /// Adds a row, a cell for each column.
    ///
    /// # Errors
    /// The operating system refuses.
    pub(crate) fn row(&mut self, cells: Vec<Cell>) -> Result<(), String> {
        match &mut self.writer {
            Writer::Csv(file) => {
                let line: Vec<String> = cells.iter().map(shown).collect();
                let written = writeln!(file, "{}", line.join(","));
                written.map_err(|e| unwritten(&self.path, &e.to_string()))
            }
            Writer::Parquet(_) => {
                self.waiting.push(cells);
                match self.waiting.len() >= GROUP {
                    true => self.flush(),
                    false => Ok(()),
                }
            }
        }
    }

    /// Gives the complete file its name.
    ///
    /// # Errors
    /// The operating system refuses.
    pub(crate) fn publish(mut self) -> Result<PathBuf, String> {
        self.flush()?;
        let path = self.path;
        let file = match self.writer {
            Writer::Csv(file) => file,
            Writer::Parquet(writer) => {
                let finished = writer.into_inner();
                finished.map_err(|e| unwritten(&path, &words(&e)))?
            }
        };
        file.publish().map_err(|e| e.to_string())
    }

    fn flush(&mut self) -> Result<(), String> {
        let rows = std::mem::take(&mut self.waiting);
        match &mut self.writer {
            Writer::Parquet(writer) if !rows.is_empty() => {
                let written = write_group(writer, &self.columns, &rows);
                written.map_err(|e| unwritten(&self.path, &words(&e)))
            }
            _ => Ok(()),
        }
    }
}

fn begin(
    file: PartialFile,
    columns: &[(String, Kind)],
    about: &[(&str, String)],
) -> Result<SerializedFileWriter<PartialFile>, ParquetError> {
    let column = |(name, kind): &(String, Kind)| {
        let (physical, logical, repetition) = match kind {
            Kind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String), Repetition::REQUIRED),
            Kind::Number => (Physical::DOUBLE, None, Repetition::OPTIONAL),
            Kind::Count => (Physical::INT64, None, Repetition::REQUIRED),
        };
        let column = Type::primitive_type_builder(name, physical);
        let column = column.with_repetition(repetition).with_logical_type(logical);
        column.build().map(Arc::new)
    };
    let fields = columns.iter().map(column).collect::<Result<Vec<_>, _>>()?;
    let schema = Type::group_type_builder("occupant_table").with_fields(fields).build()?;
    let about = about.iter().map(|(key, value)| KeyValue::new((*key).to_owned(), value.clone()));
    let properties = WriterProperties::builder()
        .set_compression(Compression::ZSTD(ZstdLevel::try_new(3)?))
        .set_key_value_metadata(Some(about.collect()))
        .build();
    SerializedFileWriter::new(file, Arc::new(schema), Arc::new(properties))
}

fn write_group(
    writer: &mut SerializedFileWriter<PartialFile>,
    columns: &[(String, Kind)],
    rows: &[Vec<Cell>],
) -> Result<(), ParquetError> {
    let mut group = writer.next_row_group()?;
    for (i, (_, kind)) in columns.iter().enumerate() {
        let no_column = || ParquetError::General("a column too many".to_owned());
        let mut column = group.next_column()?.ok_or_else(no_column)?;
        let cells = rows.iter().map(|row| row.get(i));
        match kind {
            Kind::Text => {
                let text = |cell: Option<&Cell>| match cell {
                    Some(Cell::Text(text)) => ByteArray::from(text.as_bytes().to_vec()),
                    _ => ByteArray::from(Vec::new()),
                };
                let values: Vec<ByteArray> = cells.map(text).collect();
                column.typed::<ByteArrayType>().write_batch(&values, None, None)?;
            }
            Kind::Number => {
                let number = |cell: Option<&Cell>| match cell {
                    Some(Cell::Number(x)) if x.is_finite() => Some(*x),
                    _ => None,
                };
                let numbers: Vec<Option<f64>> = cells.map(number).collect();
                let levels: Vec<i16> = numbers.iter().map(|x| i16::from(x.is_some())).collect();
                let values: Vec<f64> = numbers.into_iter().flatten().collect();
                column.typed::<DoubleType>().write_batch(&values, Some(&levels), None)?;
            }
            Kind::Count => {
                let count = |cell: Option<&Cell>| match cell {
                    Some(Cell::Count(n)) => i64::try_from(*n).unwrap_or(i64::MAX),
                    _ => 0,
                };
                let values: Vec<i64> = cells.map(count).collect();
                column.typed::<Int64Type>().write_batch(&values, None, None)?;
            }
        }
        column.close()?;
    }
    group.close().map(|_| ())
}

fn shown(cell: &Cell) -> String {
    match cell {
        Cell::Text(text) if text.contains([',', '"', '\n', '\r']) => {
            format!("\"{}\"", text.replace('"', "\"\""))
        }
        Cell::Text(text) => text.clone(),
        Cell::Number(x) if x.is_finite() => x.to_string(),
        Cell::Number(_) => String::new(),
        Cell::Count(n) => n.to_string(),
    }
}

fn unwritten(path: &Path, reason: &str) -> String {
    format!("{} cannot be written: {reason}", path.display())
}

fn words(error: &ParquetError) -> String {
    match error {
        // the reason of the operating system, without the library's own words
        ParquetError::External(source) => source.to_string(),
        other => other.to_string(),
    }
}

//! The table as a Parquet file, for pyarrow, DuckDB and the like.
//!
//! `index`, the inputs, `status`, `reason`, the figures, `wall_time_s`, `kernel`. The metadata of the file hold the manifest
//! (`occupant.sweep`) and the units (`occupant.units`: a JSON object, column → unit).

use std::path::PathBuf;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical, ZstdLevel};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;

use super::manifest::{Manifest, Role};
use super::problem::Problem;
use super::row::{Cell, Row};
use super::table::TableSink;
use crate::base::output_file::{Existing, FileProblem, PartialFile};

/// A table under its provisional name.
pub(crate) struct ParquetTable {
    path: PathBuf,
    writer: SerializedFileWriter<PartialFile>,
    fields: Vec<Field>,
}

/// A column of the file.
#[derive(Clone, Copy, Debug)]
enum Field {
    Index,
    Number(usize),
    Text(usize),
    Status,
    Reason,
    WallTime,
    Kernel,
}

impl ParquetTable {
    /// Begins the file; one that is there is replaced when the new one is complete.
    ///
    /// # Errors
    /// The operating system refuses.
    pub(crate) fn create(path: PathBuf, manifest: &Manifest) -> Result<Self, Problem> {
        let file = PartialFile::create(&path, Existing::Replace).map_err(|e| refused(&path, &e))?;
        let named = fields(manifest);
        let schema = schema(&named);
        let writer = schema.and_then(|schema| {
            let properties = Arc::new(properties(manifest)?);
            SerializedFileWriter::new(file, Arc::new(schema), properties)
        });
        Ok(ParquetTable {
            writer: writer.map_err(|e| unwritten(&path, &e))?,
            path,
            fields: named.into_iter().map(|(_, field)| field).collect(),
        })
    }

    /// Writes the end of the file and gives it its name.
    ///
    /// # Errors
    /// The operating system refuses.
    pub(crate) fn publish(self) -> Result<PathBuf, Problem> {
        // writes the end of the file, too
        let file = self.writer.into_inner();
        let file = file.map_err(|e| unwritten(&self.path, &e))?;
        file.publish().map_err(|e| refused(&self.path, &e))
    }
}

impl TableSink for ParquetTable {
    fn rows(&mut self, rows: &[Row]) -> Result<(), Problem> {
        let mut write = || {
            let mut group = self.writer.next_row_group()?;
            for field in &self.fields {
                write_column(&mut group, *field, rows)?;
            }
            group.close()
        };
        write().map(|_| ()).map_err(|e| unwritten(&self.path, &e))
    }
}

/// The columns of the file in order, with their names.
fn fields(manifest: &Manifest) -> Vec<(&str, Field)> {
    let mut inputs = vec![("index", Field::Index)];
    let mut figures = vec![("status", Field::Status), ("reason", Field::Reason)];
    for (i, column) in manifest.columns.iter().enumerate() {
        let name = column.name.as_str();
        match column.role {
            Role::Input => inputs.push((name, Field::Number(i))),
            Role::InputText => inputs.push((name, Field::Text(i))),
            Role::Figure => figures.push((name, Field::Number(i))),
        }
    }
    figures.extend([("wall_time_s", Field::WallTime), ("kernel", Field::Kernel)]);
    inputs.extend(figures);
    inputs
}

fn schema(fields: &[(&str, Field)]) -> Result<Type, ParquetError> {
    let column = |(name, field): &(&str, Field)| {
        let (physical, logical, repetition) = match field {
            Field::Index => (Physical::INT64, None, Repetition::REQUIRED),
            Field::WallTime => (Physical::DOUBLE, None, Repetition::REQUIRED),
            Field::Number(_) => (Physical::DOUBLE, None, Repetition::OPTIONAL),
            Field::Status | Field::Kernel => (Physical::BYTE_ARRAY, Some(LogicalType::String), Repetition::REQUIRED),
            Field::Reason | Field::Text(_) => (Physical::BYTE_ARRAY, Some(LogicalType::String), Repetition::OPTIONAL),
        };
        let column = Type::primitive_type_builder(name, physical);
        let column = column.with_repetition(repetition).with_logical_type(logical);
        column.build().map(Arc::new)
    };
    let columns = fields.iter().map(column).collect::<Result<Vec<_>, _>>()?;
    Type::group_type_builder("occupant_sweep").with_fields(columns).build()
}

fn properties(manifest: &Manifest) -> Result<WriterProperties, ParquetError> {
    let units: serde_json::Map<String, serde_json::Value> =
        manifest.columns.iter().map(|column| (column.name.clone(), column.unit.clone().into())).collect();
    let whole = manifest.to_bytes().map_err(|e| ParquetError::General(e.to_string()))?;
    let metadata = vec![
        KeyValue::new("occupant.sweep".to_owned(), String::from_utf8_lossy(&whole).into_owned()),
        KeyValue::new("occupant.units".to_owned(), serde_json::Value::Object(units).to_string()),
    ];
    Ok(WriterProperties::builder()
        .set_compression(Compression::ZSTD(ZstdLevel::try_new(3)?))
        .set_created_by(manifest.program.clone())
        .set_key_value_metadata(Some(metadata))
        .build())
}

fn write_column(
    group: &mut SerializedRowGroupWriter<'_, PartialFile>,
    field: Field,
    rows: &[Row],
) -> Result<(), ParquetError> {
    let no_column = || ParquetError::General("a column too many".to_owned());
    let mut column = group.next_column()?.ok_or_else(no_column)?;
    let text = |text: &str| ByteArray::from(text.as_bytes().to_vec());
    match field {
        Field::Index => {
            let values: Vec<i64> = rows.iter().map(|r| r.index as i64).collect();
            column.typed::<Int64Type>().write_batch(&values, None, None)?;
        }
        Field::WallTime => {
            let values: Vec<f64> = rows.iter().map(|r| r.wall_time_s).collect();
            column.typed::<DoubleType>().write_batch(&values, None, None)?;
        }
        Field::Number(i) => {
            let (values, levels) = present(rows, |r| r.cells.get(i).and_then(Cell::number));
            let column = column.typed::<DoubleType>();
            column.write_batch(&values, Some(&levels), None)?;
        }
        Field::Text(i) => {
            let (values, levels) = present(rows, |r| match r.cells.get(i) {
                Some(Cell::Text(t)) => Some(text(t)),
                _ => None,
            });
            let column = column.typed::<ByteArrayType>();
            column.write_batch(&values, Some(&levels), None)?;
        }
        Field::Reason => {
            let reason = |r: &Row| (!r.reason.is_empty()).then(|| text(&r.reason));
            let (values, levels) = present(rows, reason);
            let column = column.typed::<ByteArrayType>();
            column.write_batch(&values, Some(&levels), None)?;
        }
        Field::Status => {
            let values: Vec<ByteArray> = rows.iter().map(|r| text(r.status.word())).collect();
            column.typed::<ByteArrayType>().write_batch(&values, None, None)?;
        }
        Field::Kernel => {
            let values: Vec<ByteArray> = rows.iter().map(|r| text(&r.kernel)).collect();
            column.typed::<ByteArrayType>().write_batch(&values, None, None)?;
        }
    }
    column.close()
}

/// The values that are there, and for each row 1 if it has one.
fn present<T>(rows: &[Row], value: impl Fn(&Row) -> Option<T>) -> (Vec<T>, Vec<i16>) {
    let (mut values, mut levels) = (Vec::new(), Vec::new());
    for row in rows {
        let value = value(row);
        levels.push(i16::from(value.is_some()));
        values.extend(value);
    }
    (values, levels)
}

fn refused(path: &std::path::Path, problem: &FileProblem) -> Problem {
    Problem::Table { path: path.to_owned(), reason: problem.to_string() }
}

fn unwritten(path: &std::path::Path, error: &ParquetError) -> Problem {
    Problem::Table {
        path: path.to_owned(),
        reason: match error {
            // the reason of the operating system, without the library's own words
            ParquetError::External(source) => source.to_string(),
            other => other.to_string(),
        },
    }
}

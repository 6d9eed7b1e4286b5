//! Parquet: a column of doubles for each channel, units, frames and filters as JSON in the file's key `occupant`.

use std::sync::Arc;

use parquet::basic::{Compression, Repetition, Type as Physical, ZstdLevel};
use parquet::data_type::DoubleType;
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use super::About;
use crate::files::history::{Histories, UnitChoice, shown};

/// The bytes of the file.
///
/// # Errors
/// What the writer refuses, in its words.
pub(crate) fn parquet(histories: &Histories, about: &About, units: UnitChoice) -> Result<Vec<u8>, ParquetError> {
    let mut fields = Vec::with_capacity(about.columns.len());
    for column in &about.columns {
        let field = Type::primitive_type_builder(&column.name, Physical::DOUBLE)
            .with_repetition(Repetition::REQUIRED)
            .build()?;
        fields.push(Arc::new(field));
    }
    let schema = Type::group_type_builder("run").with_fields(fields).build()?;
    let json = serde_json::to_string(about).map_err(|e| ParquetError::General(e.to_string()))?;
    let properties = WriterProperties::builder()
        .set_compression(Compression::ZSTD(ZstdLevel::default()))
        .set_created_by(about.program.clone())
        .set_key_value_metadata(Some(vec![KeyValue::new("occupant".to_owned(), json)]))
        .build();
    let mut bytes = Vec::new();
    let mut file = SerializedFileWriter::new(&mut bytes, Arc::new(schema), Arc::new(properties))?;
    let mut rows = file.next_row_group()?;
    let sizes = histories.columns.iter().map(|c| (shown(c.channel.unit, units).si, &c.values));
    for (size, values) in std::iter::once((1.0, &histories.time_s)).chain(sizes) {
        let Some(mut column) = rows.next_column()? else {
            break;
        };
        let shown: Vec<f64> = values.iter().map(|v| v / size).collect();
        column.typed::<DoubleType>().write_batch(&shown, None, None)?;
        column.close()?;
    }
    rows.close()?;
    file.close()?;
    Ok(bytes)
}

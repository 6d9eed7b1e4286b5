//! Bands as a table: a row for each channel and time.

use std::path::{Path, PathBuf};

use super::bands::Bands;
use crate::base::output_file::Existing;
use crate::files::table_file::{Cell, Form, Kind, TableFile};

const COLUMNS: [(&str, Kind); 9] = [
    ("channel", Kind::Text),
    ("unit", Kind::Text),
    ("time_s", Kind::Number),
    ("nominal", Kind::Number),
    ("q05", Kind::Number),
    ("q25", Kind::Number),
    ("median", Kind::Number),
    ("q75", Kind::Number),
    ("q95", Kind::Number),
];

/// Writes the bands; `about` is what the metadata of a Parquet file say of them.
///
/// # Errors
/// The file is there and may not be replaced; the operating system refuses.
pub(crate) fn write(
    bands: &Bands,
    path: &Path,
    form: Form,
    existing: Existing,
    about: String,
) -> Result<PathBuf, String> {
    let about = [("occupant.ensemble", about)];
    let mut table = TableFile::create(path, form, existing, &COLUMNS, &about)?;
    for band in &bands.channels {
        let (b, text) = (&band.band, |t: &str| Cell::Text(t.to_owned()));
        for (i, time_s) in bands.time_s.iter().enumerate() {
            let values = [&band.nominal, &b.q05, &b.q25, &b.median, &b.q75, &b.q95];
            let values = values.map(|v| Cell::Number(v.get(i).copied().unwrap_or(f64::NAN)));
            let mut row = vec![text(&band.name), text(band.unit), Cell::Number(*time_s)];
            row.extend(values);
            table.row(row)?;
        }
    }
    table.publish()
}

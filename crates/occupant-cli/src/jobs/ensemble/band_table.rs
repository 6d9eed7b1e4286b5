//! Bands as a table: a row for each channel and time.

use std::path::{Path, PathBuf};

use super::bands::{Bands, ChannelBand};
use crate::base::failure::Failure;
use crate::base::output_file::Existing;
use crate::files::table::{Cell, Form, Kind, TableFile};

const COLUMNS: [(&str, Kind); 9] = [
    ("channel", Kind::Text),
    ("unit", Kind::Text),
    ("time_s", Kind::MaybeNumber),
    ("nominal", Kind::MaybeNumber),
    ("q05", Kind::MaybeNumber),
    ("q25", Kind::MaybeNumber),
    ("median", Kind::MaybeNumber),
    ("q75", Kind::MaybeNumber),
    ("q95", Kind::MaybeNumber),
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
) -> Result<PathBuf, Failure> {
    let about = [("occupant.ensemble", about)];
    let mut table = TableFile::create(path.to_owned(), form, existing, &COLUMNS, &about)?;
    for band in &bands.channels {
        for i in 0..bands.time_s.len() {
            table.row(band.cells(&bands.time_s, i))?;
        }
    }
    table.publish()
}

impl ChannelBand {
    /// Channel, unit, time and the values of an output.
    pub(crate) fn cells(&self, time_s: &[f64], output: usize) -> Vec<Cell> {
        let b = &self.band;
        let values = [time_s, &self.nominal, &b.q05, &b.q25, &b.median, &b.q75, &b.q95];
        let mut cells = vec![Cell::text(&self.name), Cell::text(self.unit)];
        cells.extend(values.map(|v| v.get(output).map_or(Cell::Absent, |x| Cell::finite(*x))));
        cells
    }
}

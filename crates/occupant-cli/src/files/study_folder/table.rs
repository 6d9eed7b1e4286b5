//! From the journal to the table, group by group: memory does not grow with the number of samples.

use super::journal::Journal;
use super::manifest::Manifest;
use super::problem::Problem;
use super::row::Row;

/// So many values are held at a time.
const CELLS: usize = 400_000;
/// At most so many rows.
const ROWS: usize = 16_384;

/// Takes the rows of the table in order.
pub(crate) trait TableSink {
    /// The next rows.
    ///
    /// # Errors
    /// The table cannot be written.
    fn rows(&mut self, rows: &[Row]) -> Result<(), Problem>;
}

/// Hands all rows to every sink. How they are grouped depends on nothing but the number of columns.
///
/// # Errors
/// Samples that are missing or disagree; what a sink reports.
pub(crate) fn stream(journal: &Journal, manifest: &Manifest, sinks: &mut [&mut dyn TableSink]) -> Result<(), Problem> {
    let at_once = (CELLS / manifest.columns.len().max(1)).clamp(64, ROWS) as u64;
    let mut start = 0;
    while start < manifest.samples {
        let end = (start + at_once).min(manifest.samples);
        let rows = journal.rows(start..end)?;
        for sink in sinks.iter_mut() {
            sink.rows(&rows)?;
        }
        start = end;
    }
    Ok(())
}

//! Results that are written to a file, and said to be.

use std::path::Path;

use super::talk::say;
use super::{Failure, publish};

/// Writes a result file under a temporary name, renames it when complete, and reports it.
///
/// # Errors
/// As [`publish`].
pub(crate) fn deliver(path: &Path, force: bool, bytes: &[u8]) -> Result<(), Failure> {
    deliver_and(false, path, force, bytes)
}

/// As [`deliver`]; with `open` the system's default program then opens the file.
///
/// # Errors
/// As [`publish`]. Failure to open it is reported, without an error.
pub(crate) fn deliver_and(open: bool, path: &Path, force: bool, bytes: &[u8]) -> Result<(), Failure> {
    publish(path, force, bytes)?;
    said_and_opened(open, path);
    Ok(())
}

/// Reports that a file was written, and opens it with `open`.
pub(crate) fn said_and_opened(open: bool, path: &Path) {
    say(&format!("wrote {}", path.display()));
    if open && let Err(error) = open::that(path) {
        say(&format!("note: {} could not be opened: {error}", path.display()));
    }
}

//! Results that are written to a file, and said to be.

use std::path::Path;

use super::talk::say;
use super::{Failure, publish};

/// Writes a file of results that carries its name only when it is complete, and says so.
///
/// # Errors
/// As [`publish`].
pub(crate) fn deliver(path: &Path, force: bool, bytes: &[u8]) -> Result<(), Failure> {
    deliver_and(false, path, force, bytes)
}

/// The same, and opens it with the program that the system has for such files if `open` says so.
///
/// # Errors
/// As [`publish`]. That it cannot be opened is said, and no failure.
pub(crate) fn deliver_and(open: bool, path: &Path, force: bool, bytes: &[u8]) -> Result<(), Failure> {
    publish(path, force, bytes)?;
    said_and_opened(open, path);
    Ok(())
}

/// Says that a file was written, and opens it if `open` says so.
pub(crate) fn said_and_opened(open: bool, path: &Path) {
    say(&format!("wrote {}", path.display()));
    if open && let Err(error) = open::that(path) {
        say(&format!("note: {} could not be opened: {error}", path.display()));
    }
}

//! Files that are read whole.

use std::path::Path;

use super::failure::Failure;

/// The bytes of a file.
///
/// # Errors
/// A file that cannot be read.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    std::fs::read(path).map_err(|error| Failure::plain(format!("{} cannot be read: {error}", path.display())))
}

//! Measured signals: read from text tables and ISO-MME tests, matched to the channels of a run.
//!
//! Knows no run, only the channels that are wanted. Values stay in their file's unit until a channel claims them; then they are SI in that channel's axes.

mod pair;
mod table;

use std::path::Path;

use super::mme;
use super::signals::Recording;
use super::trouble::Trouble;
use crate::base::{Failure, ending, input_file, sha256};

pub(crate) use pair::{MapArgument, Pair, Wanted, pairs};

/// Whether a file or folder is read as measured signals, not as the results of a run.
pub(crate) fn is_recording(path: &Path) -> bool {
    ending(path) != "mcap"
}

/// Reads a text table (.csv, .txt, .tsv) or an ISO-MME test (its folder, or the .mme file in it).
///
/// # Errors
/// A file that cannot be read, or what is wrong in it, with file, line, what was found and what was expected.
pub(crate) fn read(path: &Path) -> Result<Recording, Failure> {
    if path.is_dir() || ending(path) == "mme" {
        return mme::read(path);
    }
    let bytes = input_file::read(path)?;
    let text = String::from_utf8(bytes.clone()).map_err(|e| {
        let at = e.utf8_error().valid_up_to();
        let line = 1 + bytes[..at].iter().filter(|b| **b == b'\n').count();
        Trouble::at(path, line, "bytes that are no UTF-8 text", "a text table")
            .hint("a run of this program has the ending .mcap, an ISO-MME test .mme")
    })?;
    table::read(path, &text, sha256(&bytes))
}

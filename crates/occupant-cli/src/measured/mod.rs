//! Measured signals: read from text tables and ISO-MME tests, matched to the channels of a run.
//!
//! Values stay in their file's unit until a channel claims them; then they are SI in that channel's axes.

mod pair;
mod table;
mod trouble;

use std::path::{Path, PathBuf};

use occupant_core::scenario::unit::Scale;

use crate::cli::exit::Failure;
use crate::mcap::about::sha256;
use crate::mme;
use crate::mme::Code;

pub use pair::{MapArgument, Pair, Wanted, pairs};
pub(crate) use table::scale_of;
pub use trouble::Trouble;

/// All signals of a file or test.
#[derive(Clone, Debug)]
pub struct Recording {
    /// File or folder.
    pub path: PathBuf,
    /// SHA-256 of the file; of the test's channel files one after the other.
    pub sha256: String,
    /// The signals in the file's order.
    pub signals: Vec<Signal>,
    /// What was taken for granted in reading it.
    pub notes: Vec<String>,
}

/// One measured signal.
#[derive(Clone, Debug)]
pub struct Signal {
    /// Column heading, or ISO-MME channel code; `2` for the second column of a table without headings.
    pub name: String,
    /// ISO-MME code.
    pub code: Option<Code>,
    /// Unit as written; none where the file gives none.
    pub unit: Option<String>,
    /// Its size and dimension; none also for a unit that is not known.
    pub scale: Option<Scale>,
    /// Times, s, increasing.
    pub time_s: Vec<f64>,
    /// Values in the file's unit, NaN where missing.
    pub values: Vec<f64>,
    /// Where it stands, for messages.
    pub place: String,
}

/// Whether a file or folder is read as measured signals, not as the results of a run.
pub fn is_recording(path: &Path) -> bool {
    let extension = path.extension().unwrap_or_default();
    !extension.eq_ignore_ascii_case("mcap")
}

/// Reads a text table (.csv, .txt, .tsv) or an ISO-MME test (its folder, or the .mme file in it).
///
/// # Errors
/// A file that cannot be read, or what is wrong in it, with file, line, what was found and what was expected.
pub fn read(path: &Path) -> Result<Recording, Failure> {
    let extension = path.extension().unwrap_or_default();
    if path.is_dir() || extension.eq_ignore_ascii_case("mme") {
        return mme::read(path);
    }
    let bytes = std::fs::read(path).map_err(|e| Failure::plain(format!("{} cannot be read: {e}", path.display())))?;
    let text = String::from_utf8(bytes.clone()).map_err(|e| {
        let at = e.utf8_error().valid_up_to();
        let line = 1 + bytes[..at].iter().filter(|b| **b == b'\n').count();
        Trouble::at(path, line, "bytes that are no UTF-8 text", "a text table")
            .hint("a run of this program has the ending .mcap, an ISO-MME test .mme")
            .failure()
    })?;
    table::read(path, &text, sha256(&bytes))
}

//! Measured signals: read from text tables, ISO-MME tests, tests of NHTSA and trajectories, matched to the channels of a run.
//!
//! Knows no run, only the channels that are wanted. Values stay in their file's unit until a channel claims them; then they are SI in that channel's axes.

mod nhtsa;
mod pair;
mod table;
mod trajectory;

use std::path::Path;

use super::mme;
use super::signals::Recording;
use super::trouble::Trouble;
use crate::base::{Failure, ending, input_file, sha256};

pub(crate) use nhtsa::TestRecord;
pub(crate) use pair::{MapArgument, Pair, Wanted, pairs};

/// Whether a file or folder is read as measured signals, not as the results of a run.
pub(crate) fn is_recording(path: &Path) -> bool {
    ending(path) != "mcap"
}

/// A test and what else its record says.
#[derive(Clone, Debug)]
pub(crate) struct Imported {
    pub(crate) record: TestRecord,
    pub(crate) recording: Recording,
    /// Whether places and angles are along axes forward, left, up.
    pub(crate) z_up: bool,
}

/// Reads whatever holds a test or a trajectory; `vehicle` and `object` are asked for where there are several.
///
/// # Errors
/// As [`read`].
pub(crate) fn import(path: &Path, vehicle: Option<u32>, object: Option<&str>) -> Result<Imported, Failure> {
    if let Some(header) = nhtsa::header(path) {
        let (record, recording) = nhtsa::read(&header, vehicle.unwrap_or(1))?;
        return Ok(Imported { record, recording, z_up: false });
    }
    let trajectory = if path.is_dir() { None } else { trajectory::read(path, vehicle, object)? };
    if trajectory.is_none() {
        trajectory::one_vehicle(path, vehicle)?;
    }
    let (recording, z_up) = trajectory.map_or_else(|| read(path).map(|recording| (recording, false)), Ok)?;
    Ok(Imported { record: TestRecord::default(), recording, z_up })
}

/// Reads a text table (.csv, .txt, .tsv), an ISO-MME test (its folder, or the .mme file in it) or a test of NHTSA (its folder, or the
/// .EV5 file in it).
///
/// # Errors
/// A file that cannot be read, or what is wrong in it, with file, line, what was found and what was expected.
pub(crate) fn read(path: &Path) -> Result<Recording, Failure> {
    if let Some(header) = nhtsa::header(path) {
        return nhtsa::read(&header, 1).map(|(_, recording)| recording);
    }
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

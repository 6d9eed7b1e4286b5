//! Prepares a result file for the printout of 1970: reads it and rebuilds its model from the attached scenario.

use std::path::Path;

use cardio_legacy::print::{Case, Recorded};
use occupant_files::mcap::StoredRun;
use occupant_files::mcap::about::RUN;
use occupant_files::scenario::stored;

use crate::base::{Failure, input_file};

/// Reads a result file: its case, and defects of the file.
///
/// # Errors
/// A file that `occupant run` has not written, that lacks its scenario or a table that it names, or whose scenario or
/// checkpoints this program refuses.
pub fn read(path: &Path) -> Result<(Case, Option<String>), Failure> {
    let name = path.display();
    let bytes = input_file::read(path)?;
    let refused = |reason: String| {
        Failure::with_help(
            format!("{name} cannot be printed: {reason}"),
            "give a file written by `occupant run` of this version",
        )
    };
    let file = StoredRun::read(&bytes).map_err(refused)?;
    if file.run.is_empty() {
        let why = file.because();
        let found = format!("it is an MCAP file without the record `{RUN}`, so not a result of `occupant run`{why}");
        return Err(refused(found));
    }
    let of_scenario = stored(path, &file)?;
    file.checkpoints.iter().try_for_each(|c| c.check(&of_scenario.1)).map_err(|e| refused(e.to_string()))?;
    let (ending, flaw) = (file.ending(), file.flaw());
    let StoredRun { run, result, attachments, checkpoints, .. } = file;
    Ok((Case::new(Recorded { run, result, ending, attachments, checkpoints }, of_scenario), flaw))
}

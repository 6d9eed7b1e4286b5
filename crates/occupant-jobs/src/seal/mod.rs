//! A sealed case: one HTML file with a run, its inputs and its page, in which an altered byte is named.
//!
//! The file is cut into sections, page and parts, that lie end to end. The seal, a comment at the end, lists the SHA-256 of
//! each; the last line is that of the list. Parts are base64 of gzip; a picture is base64 of its own bytes, and the page shows
//! that copy.

mod again;
mod inputs;
mod pack;
mod page;
mod quoted;
mod sheet;

pub use again::{Same, again};
pub use pack::{Case, Fault, MOST_BYTES, Part};

use std::path::Path;

use crate::base::{Failure, Units, file_name};
use crate::report;
use crate::sweep::Stored;
use again::states;
use occupant_files::mcap::about::RESOLVED;
use occupant_files::mcap::{self, StoredRun};
use occupant_files::results::Results;
use page::Listed;

/// Name of the part with the results: the state at every output.
const RUN: &str = "states.mcap";

/// What is sealed with a run.
#[derive(Default)]
pub struct Beside {
    /// Files of the user: films, tables.
    pub added: Vec<Part>,
    /// A study of its scenario, whose intervals are quoted.
    pub study: Option<Stored>,
}

/// A sealed case, and whether the results are in it.
pub struct Sealed {
    /// The file.
    pub bytes: Vec<u8>,
    /// Whether it holds the results. A case that would be too large with them goes without; it lists the SHA-256 of every
    /// output.
    pub holds_run: bool,
}

/// The sealed case of a run. `build` describes the program.
///
/// # Errors
/// A file that holds no run; a run that comes out otherwise here; names that two parts have; a case that is too large
/// without the results; a study that cannot be read.
pub fn seal(run: (&Path, &[u8]), build: &str, beside: Beside, units: Option<Units>) -> Result<Sealed, Failure> {
    let (path, bytes) = run;
    let results = Results::of_bytes(path, bytes)?;
    let stored = StoredRun::read(bytes).map_err(Failure::plain)?;
    let alone = mcap::states(&stored).map_err(|e| Failure::plain(format!("the states cannot be written: {e}")))?;
    let mut parts = vec![Part::new(RUN, alone), states(&results.checkpoints)];
    parts.extend(texts(&results, &stored));
    if let Same::No(why) = again(&parts)? {
        let found = format!("{} is not what this program computes: {why}", path.display());
        return Err(Failure::with_help(found, "seal the run with the program that made it, or run it again"));
    }
    let units = units.unwrap_or_else(|| Units::asked(None, results.loaded.scenario.units));
    let sheet = sheet::sheet(&results)?;
    parts.push(Part::new(sheet::MOTION, sheet.csv().into_bytes()));
    let study = beside.study.map(|study| quoted::quoted(study, &results, units)).transpose()?;
    parts.extend(study.iter().map(|study| study.part.clone()));
    parts.extend(beside.added);
    refuse_names(&parts)?;
    let inputs = inputs::inputs(&results);
    let page = report::page(std::slice::from_ref(&results), &[], units)?;
    let pack = |parts: &[Part], left: Option<&Part>| {
        let listed = Listed { name: file_name(path), build, parts, left };
        pack::pack(&page, &page::section(&results, (&inputs, &sheet, study.as_ref()), &listed), parts)
    };
    let whole = pack(&parts, None)?;
    let holds_run = whole.bytes.len() <= MOST_BYTES && parts[0].can_be_unpacked();
    let packed = if holds_run { whole } else { pack(&parts[1..], Some(&parts[0]))? };
    Ok(Sealed { bytes: packed.checked()?, holds_run })
}

/// The scenario with its presets written out, the same as written, and the tables that it names.
fn texts(results: &Results, stored: &StoredRun) -> Vec<Part> {
    let own = results.run.get("scenario").map(String::as_str).unwrap_or_default();
    let scenario = stored.attachments.iter().filter_map(|(name, bytes)| match name.as_str() {
        RESOLVED => Some(Part::new(name, bytes.clone())),
        written if written == own => Some(Part::new(&format!("as-written/{name}"), bytes.clone())),
        _ => None,
    });
    let tables = results.loaded.tables().into_iter().map(|(name, text)| Part::new(name, text.as_bytes().to_vec()));
    scenario.chain(tables).collect()
}

/// Refuses names that two parts have, and those that would leave the folder they are put into.
fn refuse_names(parts: &[Part]) -> Result<(), Failure> {
    for (i, part) in parts.iter().enumerate() {
        if parts[..i].iter().any(|other| other.name.eq_ignore_ascii_case(&part.name)) {
            let found = format!("two parts of the case are named {}", part.name);
            return Err(Failure::with_help(found, "rename one of the files"));
        }
        if !part.stays_inside() {
            let found = format!("{} is outside the folder of the scenario", part.name);
            return Err(Failure::with_help(
                found,
                "copy the file beside the scenario, name it so there, and run again",
            ));
        }
    }
    Ok(())
}

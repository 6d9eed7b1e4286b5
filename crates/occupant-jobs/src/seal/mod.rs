//! A sealed case: one HTML file with a run, its inputs and its page, in which an altered byte is named.
//!
//! The file is cut into sections, page and parts, that lie end to end. The seal, a comment at the end, lists the SHA-256 of
//! each; the last line is that of the list. Parts are base64 of gzip.

mod again;
mod inputs;
mod pack;
mod page;
mod sheet;

pub use again::{Same, again};
pub use pack::{Case, Fault, MOST_BYTES, Part};

use std::path::Path;

use crate::base::{Failure, Units, file_name};
use crate::report;
use occupant_files::mcap::StoredRun;
use occupant_files::mcap::about::RESOLVED;
use occupant_files::results::Results;

/// Name of the part with the results.
pub const RUN: &str = "run.mcap";

/// The sealed case of a run. `build` describes the program; `added` are files of the user: films, tables of intervals.
///
/// # Errors
/// A file that holds no run; a run that comes out otherwise here; names that two parts have; a case that is too large.
pub fn seal(run: (&Path, &[u8]), build: &str, added: Vec<Part>, units: Option<Units>) -> Result<Vec<u8>, Failure> {
    let (path, bytes) = run;
    let results = Results::of_bytes(path, bytes)?;
    if let Same::No(why) = again(&results)? {
        let found = format!("{} is not what this program computes: {why}", path.display());
        return Err(Failure::with_help(found, "seal the run with the program that made it, or run it again"));
    }
    let stored = StoredRun::read(bytes).map_err(Failure::plain)?;
    let units = units.unwrap_or_else(|| Units::asked(None, results.loaded.scenario.units));
    let sheet = sheet::sheet(&results)?;
    let mut parts = vec![Part::new(RUN, bytes.to_vec())];
    let own = results.run.get("scenario").map(String::as_str).unwrap_or_default();
    for (name, bytes) in &stored.attachments {
        let folder = if name == RESOLVED {
            ""
        } else if name == own {
            "as-written/"
        } else {
            continue;
        };
        parts.push(Part::new(&format!("{folder}{name}"), bytes.clone()));
    }
    parts.extend(results.loaded.tables().into_iter().map(|(name, text)| Part::new(name, text.as_bytes().to_vec())));
    parts.push(Part::new("motion.csv", sheet.csv().into_bytes()));
    parts.extend(added);
    refuse_names(&parts)?;
    let name = file_name(path);
    let inputs = inputs::inputs(&results);
    let page = report::page(std::slice::from_ref(&results), &[], units)?;
    let section = page::section(&name, build, &results, (&inputs, &sheet), &parts);
    pack::pack(&page, &section, &parts)
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

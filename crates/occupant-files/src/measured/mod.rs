//! Measured signals: read from text tables, ISO-MME tests, tests of NHTSA and trajectories, matched to the channels of a run.
//!
//! Knows no run, only the channels that are wanted. Values stay in their file's unit until a channel claims them; then they are SI in that channel's axes.

mod axes;
mod doubts;
mod locations;
mod motion;
mod nhtsa;
mod pair;
mod recorder;
mod table;
mod tdms;
mod trajectory;
mod xlsx;

use std::path::Path;

use placed_text::decoded;

use super::mme;
use super::signals::Recording;
use super::trouble::Trouble;
use crate::base::{Failure, ending, input_file, quoted, sha256};

pub use axes::{AXES, Axes};
pub use doubts::{Known, doubts, rounded_table};
pub use motion::{Motion, MotionKind, Placed};
pub use nhtsa::TestRecord;
pub use pair::{MapArgument, Pair, Wanted, pairs};
pub use recorder::{DELTA_V, DeltaV, Fired, Hints, Report, SIDES, recorded_speed};

/// Whether a file or folder contains measured signals instead of the results of a run.
pub fn is_recording(path: &Path) -> bool {
    ending(path) != "mcap"
}

/// A test with the metadata of its record.
#[derive(Clone, Debug)]
pub struct Imported {
    /// Metadata of the test.
    pub record: TestRecord,
    /// Its signals.
    pub recording: Recording,
    /// Direction of its axes, if the format defines it.
    pub axes: Option<Axes>,
    /// What the report of a recorder says beside its motion.
    pub report: Report,
}

/// Choices where a file has several vehicles, or does not define its columns.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reading<'a> {
    /// The vehicle.
    pub vehicle: Option<u32>,
    /// The object.
    pub object: Option<&'a str>,
    /// Names and units of a table's columns, instead of its headings.
    pub columns: Option<&'a str>,
    /// What the user says about a recorder's report; none if a table is not read as one.
    pub hints: Option<Hints<'a>>,
}

/// Reads a test or a trajectory in any format.
///
/// # Errors
/// As [`read`].
pub fn import(path: &Path, reading: Reading) -> Result<Imported, Failure> {
    let Reading { vehicle, object, columns, hints } = reading;
    if columns.is_some() {
        trajectory::one_vehicle(path, vehicle)?;
        let recording = table_of(path, columns)?;
        let report = match hints.filter(|_| is_text(path)) {
            Some(hints) => recorder::beside(path, &text_of(path)?.0, hints, &recording.sha256)?,
            None => Report::default(),
        };
        return Ok(Imported { record: TestRecord::default(), recording, axes: None, report });
    }
    if let Some(header) = nhtsa::header(path) {
        let (record, recording) = nhtsa::read(&header, vehicle.unwrap_or(1))?;
        return Ok(Imported { record, recording, axes: Some(Axes::ZDown), report: Report::default() });
    }
    let trajectory = if path.is_dir() { None } else { trajectory::read(path, vehicle, object)? };
    if trajectory.is_none() {
        trajectory::one_vehicle(path, vehicle)?;
    }
    if let Some(hints) = hints.filter(|_| trajectory.is_none() && is_text(path)) {
        return import_table(path, input_file::read(path)?, hints);
    }
    let (recording, axes) = match trajectory {
        Some((recording, axes)) => (recording, Some(axes)),
        None => (read(path)?, (path.is_dir() || ending(path) == "mme").then_some(Axes::ZDown)),
    };
    Ok(Imported { record: TestRecord::default(), recording, axes, report: Report::default() })
}

/// Reads the bytes of a table, a workbook or a report of a recorder; `path` is its name.
///
/// # Errors
/// As [`read`].
pub fn import_table(path: &Path, bytes: Vec<u8>, hints: Hints) -> Result<Imported, Failure> {
    let (text, bytes, encoding) = as_text(path, bytes)?;
    let hash = sha256(&bytes);
    let (mut recording, report) = match recorder::read(path, &text, hints, &hash)? {
        Some(read) => read,
        None => (table::read(path, &text, None, hash)?, Report::default()),
    };
    recording.notes.extend(encoding.map(|name| format!("{} was read as {name}", path.display())));
    Ok(Imported { record: TestRecord::default(), recording, axes: None, report })
}

/// Reads a text table (.csv, .txt, .tsv), an ISO-MME test (its folder, or the .mme file in it) or a test of NHTSA (its folder, or the
/// .EV5 file in it).
///
/// # Errors
/// A file that cannot be read, or what is wrong in it, with file, line, what was found and what was expected.
pub fn read(path: &Path) -> Result<Recording, Failure> {
    if let Some(header) = nhtsa::header(path) {
        return nhtsa::read(&header, 1).map(|(_, recording)| recording);
    }
    if path.is_dir() || ending(path) == "mme" {
        return mme::read(path);
    }
    if ending(path) == "tdms" {
        return tdms::read(path);
    }
    table_of(path, None)
}

/// Text of a table, or of a workbook's sheet as CSV.
///
/// # Errors
/// A file that cannot be read, or that is no text and no workbook.
pub fn text(path: &Path) -> Result<String, Failure> {
    text_from(path, input_file::read(path)?)
}

/// The same from bytes; `path` is their name.
///
/// # Errors
/// As [`text`].
pub fn text_from(path: &Path, bytes: Vec<u8>) -> Result<String, Failure> {
    as_text(path, bytes).map(|(text, ..)| text)
}

/// Refuses files written by this program that are no records.
fn refuse_own(path: &Path) -> Result<(), Failure> {
    let name = quoted(path.display());
    match ending(path).as_str() {
        "mcap" => Err(Failure::with_help(
            format!("{} holds the results of a run, not a record", path.display()),
            &format!(
                "look at it with `occupant report {name}`; write it as a table with `occupant export {name} -o NAME.csv`"
            ),
        )),
        "toml" | "json" => Err(Failure::with_help(
            format!("{} is a scenario or a study, not a record", path.display()),
            &format!("run it with `occupant run {name}`"),
        )),
        _ => Ok(()),
    }
}

/// Whether a file is a text or a workbook.
fn is_text(path: &Path) -> bool {
    !path.is_dir() && !matches!(ending(path).as_str(), "mme" | "tdms")
}

/// The text of a file or workbook, its bytes, and its encoding if it is not UTF-8.
fn text_of(path: &Path) -> Result<(String, Vec<u8>, Option<&'static str>), Failure> {
    as_text(path, input_file::read(path)?)
}

fn as_text(path: &Path, bytes: Vec<u8>) -> Result<(String, Vec<u8>, Option<&'static str>), Failure> {
    refuse_own(path)?;
    if xlsx::is_archive(&bytes) {
        let text = xlsx::text(&bytes).map_err(|found| {
            Trouble::of(
                path,
                format!("a ZIP archive that is no workbook: {found}"),
                "a workbook (XLSX) or a text table",
            )
            .hint("save it as XLSX or CSV")
        })?;
        return Ok((text, bytes, None));
    }
    let other = [
        (&b"%PDF"[..], "a PDF file", "copy its text into a file NAME.txt"),
        (b"\xd0\xcf\x11\xe0", "an old workbook (XLS)", "save it as XLSX or CSV"),
    ];
    if let Some((_, found, help)) = other.iter().find(|(mark, ..)| bytes.starts_with(mark)) {
        return Err(Trouble::of(path, *found, "a text table or a workbook (XLSX)").hint(*help).into());
    }
    let (text, encoding) = decoded(&bytes).map_err(|found| {
        Trouble::of(path, found, "a text table")
            .hint("give a CSV table, an ISO-MME test (.mme) or an NHTSA test (.EV5)")
    })?;
    Ok((text, bytes, encoding))
}

fn table_of(path: &Path, columns: Option<&str>) -> Result<Recording, Failure> {
    let (text, bytes, encoding) = text_of(path)?;
    let mut recording = table::read(path, &text, columns, sha256(&bytes))?;
    recording.notes.extend(encoding.map(|name| format!("{} was read as {name}", path.display())));
    Ok(recording)
}

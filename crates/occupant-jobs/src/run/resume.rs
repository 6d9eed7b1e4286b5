//! `occupant run --resume`: which checkpoint of which file a run resumes, and whether it may.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use occupant_core::model::Model;
use occupant_core::results::checkpoint::{Checkpoint, CheckpointError};
use occupant_core::results::outcome::Outcome;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::replay;
use occupant_scenario::Loaded;
use placed_text::number;
use serde::Serialize;

use super::difference::differences;
use crate::base::{Failure, file_name, input_file, note, program, say, sha256};
use crate::files::scenario::{self, Opened};
use occupant_files::mcap::StoredRun;

/// Largest number of differing keys in a message.
const SHOWN: usize = 8;

/// A run to continue.
pub struct Resumption {
    /// The output at which it starts.
    pub checkpoint: Checkpoint,
    /// The earlier outputs of the file.
    pub earlier: Vec<Checkpoint>,
    file: PathBuf,
    sha256: String,
}

/// The JSON description.
#[derive(Serialize)]
pub struct Resumed {
    file: String,
    at_s: f64,
    output: usize,
}

impl Resumption {
    /// Reads `file` and finds the last checkpoint shared with a run of the scenario.
    ///
    /// # Errors
    /// A file that cannot be read or holds no checkpoint; another scenario; an end that is not after the file's.
    pub fn find(file: &Path, opened: &Opened) -> Result<Self, Failure> {
        let name = file.display();
        let bytes =
            input_file::bytes(file).map_err(|e| Failure::plain(format!("{name} cannot be read to resume it: {e}")))?;
        let stored = StoredRun::read(&bytes).map_err(|e| Failure::plain(format!("{name} cannot be resumed: {e}")))?;
        let Some(last) = stored.checkpoints.last() else {
            return Err(Failure::with_help(
                format!("{name} has no checkpoint{}", stored.because()),
                "checkpoints are in results of `occupant run`, from the first complete chunk on; run the scenario from its start",
            ));
        };
        same_scenario(file, &stored, opened)?;
        let end_s = opened.model.setup().time.end_s;
        if end_s <= last.time_s {
            return Err(Failure::with_help(
                format!("{name} reaches t = {} s; the run ends at {} s", number(last.time_s), number(end_s)),
                "give a later end with --until TIME",
            ));
        }
        let sha256 = sha256(&bytes);
        let (checkpoint, earlier) = last_fitting(file, stored.checkpoints, &opened.model)?;
        Ok(Resumption { checkpoint, earlier, file: file.to_owned(), sha256 })
    }

    /// Metadata for the new file.
    pub fn notes(&self) -> BTreeMap<String, String> {
        let checkpoint = &self.checkpoint;
        [
            ("resumed_from", file_name(&self.file)),
            ("resumed_from_sha256", self.sha256.clone()),
            ("resumed_at_s", checkpoint.time_s.to_string()),
            ("resumed_output", checkpoint.index.to_string()),
        ]
        .map(|(key, value)| (key.to_owned(), value))
        .into()
    }

    /// Reports where the run continues, and the omissions of the summary.
    pub fn announce(&self) {
        let (file, at_s) = (self.file.display(), self.checkpoint.time_s);
        say(&format!("resumed {file} at t = {} s", number(at_s)));
        let first = self.earlier.first().unwrap_or(&self.checkpoint);
        if first.index > 0 {
            say(&format!(
                "note: {file} was itself resumed and starts at t = {} s; peaks and 3 ms levels of the summary count from there",
                first.time_s
            ));
        }
    }

    /// The JSON description.
    pub fn describe(&self) -> Resumed {
        Resumed { file: self.file.display().to_string(), at_s: self.checkpoint.time_s, output: self.checkpoint.index }
    }

    /// Refuses to overwrite the file being continued.
    ///
    /// # Errors
    /// `target`, or the name that it has until it is complete, is the file.
    pub fn keep_from(&self, target: &Path, partial: &Path) -> Result<(), Failure> {
        let same = |a: &Path| match (fs::canonicalize(a), fs::canonicalize(&self.file)) {
            (Ok(a), Ok(b)) => a == b,
            _ => false,
        };
        if !same(target) && !same(partial) {
            return Ok(());
        }
        let found = format!("{} would overwrite {}, which it resumes", target.display(), self.file.display());
        Err(Failure::with_help(found, "choose another name with -o FILE.mcap"))
    }
}

/// The last matching checkpoint, and those before it. A run that ended between two output times ended at no output of a
/// longer run: then the one before is used.
fn last_fitting(
    file: &Path,
    mut checkpoints: Vec<Checkpoint>,
    model: &Model,
) -> Result<(Checkpoint, Vec<Checkpoint>), Failure> {
    let refused = |e| Failure::plain(format!("{} cannot be resumed: {e}", file.display()));
    let mut reason = None;
    while let Some(last) = checkpoints.pop() {
        match last.check(model) {
            Ok(()) => return Ok((last, checkpoints)),
            Err(error @ CheckpointError::Time { .. }) => reason = reason.or(Some(error)),
            Err(error) => return Err(refused(error)),
        }
    }
    Err(match reason {
        Some(error) => refused(error),
        None => Failure::plain(format!("{} has no checkpoint", file.display())),
    })
}

/// Refuses a file of another scenario; warns about another program version.
fn same_scenario(file: &Path, stored: &StoredRun, opened: &Opened) -> Result<(), Failure> {
    let name = file.display();
    let (theirs, model, _) = scenario::stored(file, stored)?;
    let mut found = differences(theirs.explicit(), opened.loaded.explicit())
        .map_err(|e| Failure::plain(format!("the scenarios cannot be compared: {e}")))?;
    let texts = |loaded: &Loaded| -> Vec<String> { loaded.tables().iter().map(|(_, text)| text.to_string()).collect() };
    if texts(&theirs) != texts(&opened.loaded) {
        found.push("the content of a path's table".to_owned());
    }
    if found.is_empty() && model.setup().integrator != opened.model.setup().integrator {
        found.push("the tolerances, which depend on the length of the run unless given".to_owned());
    }
    if !found.is_empty() {
        let more = found.len().saturating_sub(SHOWN);
        let mut lines: String = found.iter().take(SHOWN).map(|line| format!("\n   {line}")).collect();
        if more > 0 {
            lines.push_str(&format!("\n   and {more} more"));
        }
        let count = match found.len() {
            1 => "one difference".to_owned(),
            n => format!("{n} differences"),
        };
        return Err(Failure::with_help(
            format!("{name} is a run of another scenario: {count} (there → here){lines}"),
            "resume with the same scenario and the same --set, or run from the start",
        ));
    }
    if let Some(flaw) = stored.flaw() {
        note(&format!("{name} is {flaw}"));
    }
    let theirs = stored.run.get("program").map_or("?", String::as_str);
    if theirs != program() {
        say(&format!(
            "warning: {name} was written by {theirs}, this is {}: the states before and after may differ in the last bits",
            program()
        ));
    }
    Ok(())
}

/// A recorder that first receives the outputs of the earlier run.
pub struct WithEarlier<R> {
    /// The earlier outputs.
    pub earlier: Vec<Checkpoint>,
    /// Recorder of the new outputs.
    pub recorder: R,
}

impl<R: Recorder> Recorder for WithEarlier<R> {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        self.recorder.begin(model)?;
        for checkpoint in &self.earlier {
            replay(model, checkpoint, &mut self.recorder)?;
        }
        Ok(())
    }

    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        self.recorder.record(sample)
    }

    fn end(&mut self, outcome: &Outcome) -> Result<(), RecorderError> {
        self.recorder.end(outcome)
    }
}

//! The MCAP file of a run, from its first byte to its name.

use std::collections::BTreeMap;
use std::error::Error;
use std::io::{Seek, Write};
use std::path::{Path, PathBuf};

use occupant_core::model::Model;
use occupant_core::results::outcome::Outcome;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;

use super::resume::Resumption;
use crate::base::{Existing, Failure, PartialFile, ending, file_name, input_file, partial_path, program, refuse_input};
use crate::files::scenario::{Opened, ScenarioArgs, inputs};
use occupant_files::mcap::about::RESOLVED;
use occupant_files::mcap::{About, Document, McapOptions, McapRecorder};
use occupant_scenario::Loaded;

/// A recorder that writes a file, or none.
pub struct Recording(Option<Open>);

struct Open {
    partial: PathBuf,
    recorder: McapRecorder<PartialFile>,
}

/// Outcome of writing the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Written {
    /// None was requested.
    Nothing,
    /// The whole run, in this file.
    Complete(PathBuf),
    /// The run did not complete; the file holds its outputs so far.
    Partial(PathBuf),
}

impl Written {
    /// Its name, if there is one.
    pub fn name(&self) -> Option<String> {
        match self {
            Written::Nothing => None,
            Written::Complete(path) | Written::Partial(path) => Some(path.display().to_string()),
        }
    }

    /// Position of the outputs, for messages of later failures.
    pub fn left(&self) -> String {
        match self.name() {
            Some(name) => format!("the run itself is in {name}"),
            None => "the run itself was completed, without a file".to_owned(),
        }
    }
}

impl Recording {
    /// No file.
    pub fn none() -> Self {
        Recording(None)
    }

    /// Begins the file.
    ///
    /// # Errors
    /// A file that exists, without `force`; the file that is being resumed; an error of the file system.
    pub fn begin(
        name: &Path,
        existing: Existing,
        args: &ScenarioArgs,
        opened: &Opened,
        from: Option<&Resumption>,
    ) -> Result<Self, Failure> {
        let overrides = &args.overrides;
        let mut about = about_run(&file_name(&args.scenario), overrides, opened)?;
        if let Some(from) = from {
            from.keep_from(name, &partial_path(name))?;
            about.notes.extend(from.notes());
        }
        inputs(&args.scenario, &opened.loaded).iter().try_for_each(|input| refuse_input(name, input))?;
        let file = PartialFile::create(name, existing)?.that_stays();
        let partial = file.partial_path().to_owned();
        let recorder = recorder(file, about, &opened.loaded).map_err(|e| unwritten(&partial, &e))?;
        Ok(Recording(Some(Open { partial, recorder })))
    }

    /// Position of the outputs of an aborted run.
    pub fn left(&self) -> String {
        self.0.iter().map(|open| there("what was written before", &open.partial)).collect()
    }

    /// Closes the file, and renames it if the run is complete.
    ///
    /// # Errors
    /// An error of the file system.
    pub fn close(self, completed: bool) -> Result<Written, Failure> {
        let Some(open) = self.0 else {
            return Ok(Written::Nothing);
        };
        let file = open.recorder.into_inner().map_err(|e| unwritten(&open.partial, &e))?;
        let closed = if completed { file.publish().map(Written::Complete) } else { file.keep().map(Written::Partial) };
        closed.map_err(|e| Failure::broke_off(format!("{e}{}", there("the run", &open.partial))))
    }

    /// Calls the file's recorder, if there is one.
    fn let_it<T>(
        &mut self,
        nothing: T,
        part: impl FnOnce(&mut McapRecorder<PartialFile>) -> Result<T, RecorderError>,
    ) -> Result<T, RecorderError> {
        let Some(open) = &mut self.0 else { return Ok(nothing) };
        part(&mut open.recorder).map_err(|error| reason(&open.partial, &*error).into())
    }
}

impl Recorder for Recording {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        self.let_it((), |recorder| recorder.begin(model))
    }

    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        self.let_it(Flow::Continue, |recorder| recorder.record(sample))
    }

    fn end(&mut self, outcome: &Outcome) -> Result<(), RecorderError> {
        self.let_it((), |recorder| recorder.end(outcome))
    }
}

/// Position of something, if it still exists.
fn there(what: &str, partial: &Path) -> String {
    if partial.exists() { format!("\n = done: {what} is in {}", partial.display()) } else { String::new() }
}

/// Reason why a file could not be written, from the operating system.
fn reason(partial: &Path, error: &(dyn Error + 'static)) -> String {
    let mut root = error;
    while let Some(source) = root.source() {
        root = source;
    }
    format!("cannot write {}: {root}", partial.display())
}

fn unwritten(partial: &Path, error: &(dyn Error + 'static)) -> Failure {
    Failure::broke_off(reason(partial, error))
}

/// Metadata about the origin of the run, independent of date and machine: the name and the bytes of its scenario, the
/// changes, and what came of them.
///
/// # Errors
/// A scenario that a result file cannot hold.
pub fn about(name: &str, bytes: &[u8], overrides: &[String], loaded: &Loaded) -> Result<About, Failure> {
    let resolved = loaded.explicit().to_toml();
    let resolved = resolved.map_err(|e| Failure::plain(format!("the scenario cannot be written: {e}")))?;
    // nothing is written that is refused when it is read
    input_file::scenario_fits(resolved.as_bytes()).map_err(|error| {
        let found = format!("the scenario, with all defaults written out, is too long for a result file: {error}");
        Failure::with_help(found, "shorten its lists and notes, or use --no-mcap")
    })?;
    let media_type = match ending(Path::new(name)).as_str() {
        "json" => "application/json",
        _ => "application/toml",
    };
    let mut notes = BTreeMap::new();
    if !overrides.is_empty() {
        notes.insert("overrides".to_owned(), overrides.join("\n"));
    }
    Ok(About {
        program: program(),
        scenario: document(name, media_type, bytes.to_vec()),
        resolved: Some(document(RESOLVED, "application/toml", resolved.into_bytes())),
        notes,
    })
}

/// The same of an opened scenario, or of the deck in its place.
///
/// # Errors
/// A scenario that a result file cannot hold.
pub fn about_run(name: &str, overrides: &[String], opened: &Opened) -> Result<About, Failure> {
    let mut about = about(name, &opened.bytes, overrides, &opened.loaded)?;
    if opened.deck.is_some() {
        about.scenario.media_type = "text/plain".to_owned();
    }
    Ok(about)
}

/// A recorder into `target`, with the tables that the scenario refers to.
///
/// # Errors
/// An error of `target`.
pub fn recorder<W: Write + Seek + Send + 'static>(
    target: W,
    about: About,
    loaded: &Loaded,
) -> Result<McapRecorder<W>, impl Error + use<W>> {
    let tables = loaded.tables();
    let attached = |recorder: McapRecorder<_>, (name, text): &(&str, &str)| {
        // by its name alone, where no other has the same in another folder
        let short = |name: &str| file_name(Path::new(name));
        let is_only = tables.iter().filter(|(other, _)| short(other) == short(name)).count() == 1;
        let name = if is_only { short(name) } else { name.to_string() };
        let kind = if ending(Path::new(&name)) == "toml" { "application/toml" } else { "text/csv" };
        recorder.with_table(document(&name, kind, text.as_bytes().to_vec()))
    };
    let recorder = McapRecorder::new(target, about, McapOptions::default());
    recorder.map(|recorder| tables.iter().fold(recorder, attached))
}

/// A text to be stored with the results.
pub fn document(name: &str, media_type: &str, content: Vec<u8>) -> Document {
    Document { name: name.to_owned(), media_type: media_type.to_owned(), content }
}

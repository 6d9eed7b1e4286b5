//! The folder of a sweep: manifest, copies of its inputs, journal, table, kept runs, and locks of working processes.
//!
//! ```text
//! sweep.json               what the folder is the sweep of
//! inputs/                  copies of study, scenario and tables
//! journal/*.rows           finished samples of the ranges that are computed, in pieces
//! journal/*.lock           locked while a process works on that range
//! parts/FIRST-LAST.parquet the table of a range that is finished, for a part of the study
//! results.parquet          the table, when all samples are finished
//! rating.xlsx              the rating of its runs, and rating.json
//! SHA256SUMS               what the files of results were when they were complete
//! runs/000123.mcap         whole runs that are kept
//! ```

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use occupant_study::MOST_RUNS;

use super::block::Block;
use super::checksums::SUMS;
use super::journal::is_named_by_rows;
use super::manifest::{Manifest, Text};
use super::piece::pieces_of;
use super::problem::Problem;
use crate::base::names::stays_within;
use crate::base::{Existing, file_name, input_file, is_at, partial_path, remove_if_there, sha256, write_whole};
use crate::files::store::Store;

/// How often a lock file that was removed is made again.
const MOST_TRIES: usize = 100;

const LOCK: &str = "sweep.lock";
const WORK: &str = "work.lock";
const INPUTS: &str = "inputs";
/// Folder of the journals.
pub(super) const JOURNAL: &str = "journal";
/// Folder of the parts of the table.
pub(super) const PARTS: &str = "parts";
pub(super) const RUNS: &str = "runs";
/// Rating of the runs: the filled template, and what `measures --json` prints.
const RATING: [&str; 2] = ["rating.xlsx", "rating.json"];

/// Kind of a result folder.
#[derive(Debug)]
pub struct Holds {
    /// Name of the kind.
    pub word: &'static str,
    manifest: &'static str,
    /// Files written into it; in its subfolders those with these extensions.
    results: &'static [&'static str],
    folders: &'static [(&'static str, &'static str)],
}

/// A sweep.
pub const SWEEP: &Holds = &Holds {
    word: "sweep",
    manifest: "sweep.json",
    results: &[
        "results.parquet",
        "results.damaged",
        "results.csv",
        "columns.csv",
        "ensemble.parquet",
        "ensemble.csv",
        RATING[0],
        RATING[1],
    ],
    folders: &[(RUNS, ".mcap"), (PARTS, ".parquet")],
};
const FIT: &Holds = &Holds {
    word: "fit",
    manifest: "search.json",
    results: &["fit.json", "fitted.toml", "history.parquet", "history.csv"],
    folders: &[("fitted", ".toml"), ("plots", ".svg")],
};
const OPTIMUM: &Holds = &Holds {
    word: "optimisation",
    manifest: "optimise.json",
    results: &["optimum.json", "best.toml", "history.parquet", "history.csv", "report.html"],
    folders: &[],
};

/// The folder of a sweep, of a fit, or of an optimisation.
#[derive(Clone, Debug)]
pub struct Folder {
    /// The path.
    pub path: PathBuf,
    /// The store in which its finished ranges are, if it is the folder for an address.
    pub store: Option<Store>,
    holds: &'static Holds,
}

/// Locks held until the process ends, for whatever reason.
#[derive(Debug)]
pub struct Held {
    // a lock lives as long as its file is open; a file system without locks gives none
    _files: Vec<File>,
    /// Error message of a file system without locks.
    pub unlocked: Option<String>,
    /// Manifest and copies that were damaged and rewritten.
    pub mended: Vec<PathBuf>,
}

impl Folder {
    /// The folder of a sweep at this path, existing or not.
    pub fn at(path: &Path) -> Self {
        Folder { path: path.to_owned(), store: None, holds: SWEEP }
    }

    /// The folder of a fit at this path, existing or not.
    pub fn of_fit(path: &Path) -> Self {
        Folder { path: path.to_owned(), store: None, holds: FIT }
    }

    /// The folder of an optimisation at this path, existing or not.
    pub fn of_optimum(path: &Path) -> Self {
        Folder { path: path.to_owned(), store: None, holds: OPTIMUM }
    }

    pub(super) fn manifest_path(&self) -> PathBuf {
        self.path.join(self.holds.manifest)
    }

    /// The message about what was done, unless the folder was removed meanwhile.
    pub fn still(&self, done: String) -> String {
        if self.manifest_path().exists() { done } else { format!("{} was removed", self.path.display()) }
    }

    /// The journal of finished rows.
    pub fn journal(&self) -> PathBuf {
        self.path.join(JOURNAL)
    }

    /// The parts of the table.
    pub fn parts(&self) -> PathBuf {
        self.path.join(PARTS)
    }

    /// The part of the table with these samples.
    pub fn part(&self, block: &Block) -> PathBuf {
        self.parts().join(format!("{}.parquet", block.stem()))
    }

    /// A file of a block that lives as long as it is computed.
    pub fn beside_journal(&self, block: &Block, ending: &str) -> PathBuf {
        self.journal().join(format!("{}.{ending}", block.stem()))
    }

    /// The table.
    pub fn parquet(&self) -> PathBuf {
        self.path.join("results.parquet")
    }

    /// The table as CSV.
    pub fn csv(&self) -> PathBuf {
        self.path.join("results.csv")
    }

    /// Names and units of the columns, beside the CSV table.
    pub fn columns(&self) -> PathBuf {
        self.path.join("columns.csv")
    }

    /// The rating of the runs: the filled template, and as JSON.
    pub fn rating(&self) -> [PathBuf; 2] {
        RATING.map(|name| self.path.join(name))
    }

    /// The folder of the kept runs.
    pub fn runs(&self) -> PathBuf {
        self.path.join(RUNS)
    }

    /// The kept run of a sample.
    pub fn run(&self, index: u64) -> PathBuf {
        self.runs().join(format!("{index:06}.mcap"))
    }

    /// The bytes of a copy.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn copy_of(&self, text: &Text) -> Result<Vec<u8>, Problem> {
        let path = self.path.join(&text.copy);
        input_file::bytes(&path).map_err(Problem::io("read", &path))
    }

    /// The manifest, if there is one.
    ///
    /// # Errors
    /// An error of the operating system; a file that is no manifest.
    pub fn manifest(&self) -> Result<Option<Manifest>, Problem> {
        let path = self.manifest_path();
        let bytes = match input_file::bytes(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            read => read.map_err(Problem::io("read", &path))?,
        };
        let read = serde_json::from_slice(&bytes).map_err(|error| error.to_string());
        let possible = |manifest: Manifest| match manifest.samples {
            0..=MOST_RUNS => match manifest.texts.iter().find(|text| !stays_within(&text.copy)) {
                Some(text) => Err(format!("`copy` is {}, which is not a file of the folder", text.copy)),
                None => Ok(manifest),
            },
            n => Err(format!("`samples` is {n}; at most {MOST_RUNS} are possible")),
        };
        read.and_then(possible).map(Some).map_err(|error| Problem::Damaged {
            found: format!("is not the manifest of a {}: {error}", self.holds.word),
            path,
        })
    }

    /// Claims the folder for these samples of this sweep, new or existing. What neighbours have done or do is not looked at,
    /// unless they and this process are in each other's way: all samples are claimed alone.
    ///
    /// # Errors
    /// It holds something else; another process is at work on it; an error of the operating system.
    pub fn claim(&self, manifest: &Manifest, texts: &[Vec<u8>], block: &Block, restart: bool) -> Result<Held, Problem> {
        fs::create_dir_all(&self.path).map_err(Problem::io("create", &self.path))?;
        self.refuse_other_files(manifest, restart)?;
        let alone = restart || block.is_all_of(manifest.samples);
        let working = self.lock(&self.path.join(WORK), !alone)?;
        let doing = if alone { "computes the same study" } else { "computes all samples of the study" };
        let working = working.ok_or_else(|| self.busy(doing.to_owned()))?;
        let mended = if restart || !self.is_ready(manifest) {
            let _one_at_a_time = self.wait()?;
            self.prepare(manifest, texts, restart)?
        } else {
            Vec::new()
        };
        let parts = (self.holds.word == SWEEP.word).then(|| self.parts());
        for folder in [self.journal()].into_iter().chain(parts) {
            fs::create_dir_all(&folder).map_err(Problem::io("create", &folder))?;
        }
        let held = self.lock(&self.beside_journal(block, "lock"), false)?;
        let mut held = held.ok_or_else(|| self.busy(format!("computes {block}")))?;
        held._files.extend(working._files);
        Ok(Held { mended, ..held })
    }

    /// Whether manifest and copies are those of this sweep, as they were written.
    fn is_ready(&self, manifest: &Manifest) -> bool {
        let ours = self.manifest().ok().flatten().filter(|there| there.is_of(manifest));
        ours.is_some_and(|there| self.changed(&there, manifest).is_empty())
    }

    /// Makes manifest and copies those of this sweep; those that were damaged.
    fn prepare(&self, manifest: &Manifest, texts: &[Vec<u8>], restart: bool) -> Result<Vec<PathBuf>, Problem> {
        if restart {
            self.clear()?;
        }
        let mended = match self.manifest() {
            Ok(Some(there)) if there.is_of_study(manifest) => {
                if !self.goes_on(&there, manifest, texts) {
                    return Err(self.differs(&there, manifest, texts));
                }
                self.changed(&there, manifest)
            }
            // the rows say whose they are, whatever has become of the manifest
            _ if is_named_by_rows(self, manifest)? => vec![self.manifest_path()],
            Ok(Some(there)) => return Err(self.differs(&there, manifest, texts)),
            Ok(None) => Vec::new(),
            Err(problem) => return Err(problem),
        };
        self.begin(manifest, texts)?;
        Ok(mended)
    }

    /// Whether this study begins with the samples that are there: it has as many or more, and so have its tables lines.
    fn goes_on(&self, there: &Manifest, here: &Manifest, texts: &[Vec<u8>]) -> bool {
        // those of the rating stand last
        let pairs = there.tables().zip(here.tables().zip(texts.iter().skip(2)));
        let begins = |(old, (new, bytes)): (&Text, (&Text, &Vec<u8>))| {
            let old = if old.sha256 == new.sha256 { Some(bytes.clone()) } else { self.copy_of(old).ok() };
            old.is_some_and(|old| bytes.starts_with(&old) && (old.ends_with(b"\n") || old.len() == bytes.len()))
        };
        there.samples <= here.samples && there.tables().count() == here.tables().count() && { pairs }.all(begins)
    }

    /// Manifest and copies that are not as they were written for `there`.
    fn changed(&self, there: &Manifest, here: &Manifest) -> Vec<PathBuf> {
        let same_texts = there.texts == here.texts && there.samples == here.samples;
        let bytes = |manifest: &Manifest| manifest.to_bytes().unwrap_or_default();
        let manifest = (same_texts && bytes(there) != bytes(here)).then(|| self.manifest_path());
        let is_whole = |text: &&Text| self.copy_of(text).is_ok_and(|bytes| sha256(&bytes) == text.sha256);
        let copies = there.texts.iter().filter(|text| !is_whole(text)).map(|text| self.path.join(&text.copy));
        manifest.into_iter().chain(copies).collect()
    }

    /// Makes this folder one that can be read by itself, where results of this sweep may be.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn describe(&self, manifest: &Manifest, texts: &[Vec<u8>]) -> Result<(), Problem> {
        if self.is_ready(manifest) { Ok(()) } else { self.begin(manifest, texts) }
    }

    /// Lock for writing the table.
    ///
    /// # Errors
    /// Another process has it; an error of the operating system.
    pub fn claim_table(&self) -> Result<Held, Problem> {
        self.lock(&self.path.join("table.lock"), false)?.ok_or_else(|| self.busy("writes the table".to_owned()))
    }

    /// Refuses a folder with tables or runs of another sweep.
    ///
    /// # Errors
    /// The existing manifest.
    pub fn refuse_other_results(&self, manifest: &Manifest) -> Result<(), Problem> {
        if self.manifest()?.is_some_and(|there| there.is_of_rows(manifest)) {
            return Ok(());
        }
        let mut results = self.files().into_iter().chain([self.runs(), self.manifest_path()]);
        match results.find(|path| path.exists()) {
            Some(path) => Err(Problem::Exists { path }),
            None => Ok(()),
        }
    }

    /// Result files, including their temporary names.
    fn files(&self) -> Vec<PathBuf> {
        let named = self.holds.results.iter().map(|name| self.path.join(name));
        named.flat_map(|path| [path.clone(), partial_path(&path)]).collect()
    }

    fn busy(&self, doing: String) -> Problem {
        Problem::Busy { folder: self.path.clone(), doing }
    }

    fn differs(&self, there: &Manifest, here: &Manifest, texts: &[Vec<u8>]) -> Problem {
        let text_here = |text: &Text| {
            let at = here.texts.iter().position(|t| t == text)?;
            texts.get(at).cloned()
        };
        Problem::Differs {
            folder: self.path.clone(),
            holds: self.holds,
            differences: there.differences(here, |t| self.copy_of(t).ok(), text_here),
        }
    }

    /// Waits for the short lock for opening the folder. File systems without locks have none.
    fn wait(&self) -> Result<File, Problem> {
        let path = self.path.join(LOCK);
        let file = open_lock(&path)?;
        let _no_locks_here = file.lock();
        Ok(file)
    }

    /// Refuses a folder with files but no manifest, and no rows of this sweep.
    fn refuse_other_files(&self, manifest: &Manifest, restart: bool) -> Result<(), Problem> {
        if self.manifest_path().exists() || (!restart && is_named_by_rows(self, manifest)?) {
            return Ok(());
        }
        let begun = partial_path(&self.manifest_path());
        let own = [LOCK, WORK, INPUTS, JOURNAL, PARTS];
        let ours = |name: &String| own.contains(&name.as_str()) || begun.ends_with(name);
        if names_in(&self.path)?.iter().all(ours) {
            return Ok(());
        }
        Err(Problem::NotOurs { folder: self.path.clone(), holds: self.holds })
    }

    /// Takes a lock, unless another process holds it; a `shared` one may be held by many.
    fn lock(&self, path: &Path, shared: bool) -> Result<Option<Held>, Problem> {
        for _ in 0..MOST_TRIES {
            let file = open_lock(path)?;
            let locked = if shared { file.try_lock_shared() } else { file.try_lock() };
            let unlocked = match locked {
                // the process that had it has removed the file
                Ok(()) if !is_at(&file, path) => continue,
                Ok(()) => None,
                Err(TryLockError::WouldBlock) => return Ok(None),
                Err(TryLockError::Error(error)) => Some(error.to_string()),
            };
            return Ok(Some(Held { _files: vec![file], unlocked, mended: Vec::new() }));
        }
        let unlocked = Some("a lock file does not keep its place".to_owned());
        Ok(Some(Held { _files: Vec::new(), unlocked, mended: Vec::new() }))
    }

    /// Writes copies first and the manifest last: a folder with a manifest is complete.
    fn begin(&self, manifest: &Manifest, texts: &[Vec<u8>]) -> Result<(), Problem> {
        let inputs = self.path.join(INPUTS);
        fs::create_dir_all(&inputs).map_err(Problem::io("create", &inputs))?;
        for (text, bytes) in manifest.texts.iter().zip(texts) {
            write_whole(&self.path.join(&text.copy), Existing::Replace, bytes)?;
        }
        let path = self.manifest_path();
        let bytes = manifest
            .to_bytes()
            .map_err(|error| Problem::Damaged { path: path.clone(), found: format!("cannot be written: {error}") })?;
        write_whole(&path, Existing::Replace, &bytes)?;
        Ok(())
    }

    /// Removes tables that were not completed.
    pub fn remove_partial_tables(&self) {
        for name in self.holds.results {
            // one that cannot be removed is replaced by the next table
            let _stays = fs::remove_file(partial_path(&self.path.join(name)));
        }
    }

    /// Removes what a finished block needs no more, without a look at others; its lock last.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn clear_block(&self, block: &Block) -> Result<(), Problem> {
        let own = ["sums", "parquet", "lock"].map(|ending| self.beside_journal(block, ending));
        let mut files = pieces_of(self, block).into_iter().chain(own);
        Ok(files.try_for_each(|file| remove_if_there(&file))?)
    }

    /// Removes all journals, whose rows stand in the table; nobody else may be at work.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn clear_journals(&self) -> Result<(), Problem> {
        let names = names_in(&self.journal())?;
        let ours = |name: &&String| [".rows", ".sums", ".parquet", ".lock"].iter().any(|ending| name.ends_with(ending));
        let mut files = names.iter().filter(ours).map(|name| self.journal().join(name));
        Ok(files.try_for_each(|file| remove_if_there(&file))?)
    }

    /// The same if nobody else is at work, as far as the file system tells.
    ///
    /// # Errors
    /// As [`Folder::clear_journals`].
    pub fn clear_journals_if_alone(&self) -> Result<(), Problem> {
        let held = self.lock(&self.path.join(WORK), false)?;
        let is_alone = held.as_ref().is_some_and(|held| held.unlocked.is_none());
        if is_alone && self.journal().exists() { self.clear_journals() } else { Ok(()) }
    }

    /// Removes the files of a sweep, and nothing else.
    fn clear(&self) -> Result<(), Problem> {
        let mut files = self.files();
        files.push(self.path.join(SUMS));
        for (folder, ending) in
            [(JOURNAL, ".rows"), (JOURNAL, ".damaged"), (JOURNAL, ".sums"), (JOURNAL, ".parquet"), (INPUTS, "")]
                .iter()
                .chain(self.holds.folders)
        {
            let folder = self.path.join(folder);
            if folder.exists() {
                let names = names_in(&folder)?;
                let ours = names.iter().filter(|n| n.ends_with(ending));
                files.extend(ours.map(|name| folder.join(name)));
            }
        }
        // the manifest goes last: without it the rest would be nobody's
        files.push(self.manifest_path());
        Ok(files.iter().try_for_each(|file| remove_if_there(file))?)
    }
}

/// The names in a folder, sorted.
///
/// # Errors
/// An error of the operating system.
pub fn names_in(folder: &Path) -> Result<Vec<String>, Problem> {
    let entries = input_file::entries(folder).map_err(Problem::io("read", folder))?;
    Ok(entries.iter().map(|path| file_name(path)).collect())
}

fn open_lock(path: &Path) -> Result<File, Problem> {
    let mut options = OpenOptions::new();
    let options = options.create(true).truncate(false).write(true);
    options.open(path).map_err(Problem::io("create", path))
}

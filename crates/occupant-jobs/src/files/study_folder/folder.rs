//! The folder of a sweep: manifest, copies of its inputs, journal, table, kept runs, and locks of working processes.
//!
//! ```text
//! sweep.json               what the folder is the sweep of
//! inputs/                  copies of study, scenario and tables
//! journal/*.rows           finished samples, in pieces
//! journal/*.lock           locked while a process works on that shard
//! results.parquet          the table, when all samples are finished
//! SHA256SUMS               what the files of results were when they were complete
//! runs/000123.mcap         whole runs that are kept
//! ```

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use occupant_study::MOST_RUNS;

use super::checksums::SUMS;
use super::journal::is_named_by_rows;
use super::manifest::{Manifest, Text};
use super::problem::Problem;
use super::shard::Shard;
use crate::base::names::stays_within;
use crate::base::{Existing, file_name, input_file, partial_path, remove_if_there, write_whole};

const LOCK: &str = "sweep.lock";
const INPUTS: &str = "inputs";
const JOURNAL: &str = "journal";
const RUNS: &str = "runs";

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
    results: &["results.parquet", "results.csv", "columns.csv", "ensemble.parquet", "ensemble.csv"],
    folders: &[(RUNS, ".mcap")],
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
    holds: &'static Holds,
}

/// A lock held until the process ends, for whatever reason.
#[derive(Debug)]
pub struct Held {
    // the lock lives as long as the file is open; a file system without locks gives none
    _file: File,
    /// Error message of a file system without locks.
    pub unlocked: Option<String>,
    /// Manifest and copies that were damaged and rewritten.
    pub mended: Vec<PathBuf>,
}

impl Folder {
    /// The folder of a sweep at this path, existing or not.
    pub fn at(path: &Path) -> Self {
        Folder { path: path.to_owned(), holds: SWEEP }
    }

    /// The folder of a fit at this path, existing or not.
    pub fn of_fit(path: &Path) -> Self {
        Folder { path: path.to_owned(), holds: FIT }
    }

    /// The folder of an optimisation at this path, existing or not.
    pub fn of_optimum(path: &Path) -> Self {
        Folder { path: path.to_owned(), holds: OPTIMUM }
    }

    fn manifest_path(&self) -> PathBuf {
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

    /// Claims the folder for part `shard` of this sweep, new or existing.
    ///
    /// # Errors
    /// It holds something else; another process is at work on it; an error of the operating system.
    pub fn claim(&self, manifest: &Manifest, texts: &[Vec<u8>], shard: Shard, restart: bool) -> Result<Held, Problem> {
        fs::create_dir_all(&self.path).map_err(Problem::io("create", &self.path))?;
        let _one_at_a_time = self.wait()?;
        // the rows say whose they are, whatever has become of the manifest
        let ours = !restart && is_named_by_rows(self, manifest)?;
        if !ours {
            self.refuse_other_files()?;
        }
        self.refuse_others(shard, restart)?;
        if restart {
            self.clear()?;
        }
        let mut mended = Vec::new();
        match self.manifest() {
            Ok(Some(there)) if there == *manifest => mended = self.mend_copies(manifest, texts)?,
            _ if ours => {
                self.begin(manifest, texts)?;
                mended.push(self.manifest_path());
            }
            Ok(Some(there)) => return Err(self.differs(&there, manifest, texts)),
            Ok(None) => self.begin(manifest, texts)?,
            Err(problem) => return Err(problem),
        }
        let name = format!("{}.lock", shard.file_stem());
        let held = self.lock(&self.journal().join(name))?.map(|held| Held { mended, ..held });
        held.ok_or_else(|| self.busy(format!("computes shard {shard}")))
    }

    /// Lock for writing the table.
    ///
    /// # Errors
    /// Another process has it; an error of the operating system.
    pub fn claim_table(&self) -> Result<Held, Problem> {
        self.lock(&self.path.join("table.lock"))?.ok_or_else(|| self.busy("writes the table".to_owned()))
    }

    /// Refuses a folder with tables or runs of another sweep.
    ///
    /// # Errors
    /// The existing manifest.
    pub fn refuse_other_results(&self, manifest: &Manifest) -> Result<(), Problem> {
        if self.manifest()?.as_ref() == Some(manifest) {
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

    /// Refuses a folder with files but no manifest.
    fn refuse_other_files(&self) -> Result<(), Problem> {
        if self.manifest_path().exists() {
            return Ok(());
        }
        let begun = partial_path(&self.manifest_path());
        let ours = |name: &String| [LOCK, INPUTS, JOURNAL].contains(&name.as_str()) || begun.ends_with(name);
        if names_in(&self.path)?.iter().all(ours) {
            return Ok(());
        }
        Err(Problem::NotOurs { folder: self.path.clone(), holds: self.holds })
    }

    /// Refuses processes that split the study differently, which would compute the same samples twice.
    fn refuse_others(&self, shard: Shard, all: bool) -> Result<(), Problem> {
        let journal = self.journal();
        if !journal.exists() {
            return Ok(());
        }
        for name in names_in(&journal)?.iter().filter(|n| n.ends_with(".lock")) {
            let Some(other) = Shard::of_file(name) else {
                continue;
            };
            if (all || other.count != shard.count) && self.lock(&journal.join(name))?.is_none() {
                return Err(self.busy(format!("computes shard {other}")));
            }
        }
        Ok(())
    }

    /// Takes a lock, unless another process holds it.
    fn lock(&self, path: &Path) -> Result<Option<Held>, Problem> {
        let file = open_lock(path)?;
        let unlocked = match file.try_lock() {
            Ok(()) => None,
            Err(TryLockError::WouldBlock) => return Ok(None),
            Err(TryLockError::Error(error)) => Some(error.to_string()),
        };
        Ok(Some(Held { _file: file, unlocked, mended: Vec::new() }))
    }

    /// Rewrites damaged copies; which ones.
    fn mend_copies(&self, manifest: &Manifest, texts: &[Vec<u8>]) -> Result<Vec<PathBuf>, Problem> {
        let copies = manifest.texts.iter().map(|text| self.path.join(&text.copy)).zip(texts);
        let changed = copies.filter(|(path, bytes)| fs::read(path).ok().as_ref() != Some(*bytes));
        changed.map(|(path, bytes)| Ok(write_whole(&path, Existing::Replace, bytes)?)).collect()
    }

    /// Writes copies first and the manifest last: a folder with a manifest is complete.
    fn begin(&self, manifest: &Manifest, texts: &[Vec<u8>]) -> Result<(), Problem> {
        for folder in [self.path.join(INPUTS), self.journal()] {
            fs::create_dir_all(&folder).map_err(Problem::io("create", &folder))?;
        }
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

    /// Removes the files of a sweep, and nothing else.
    fn clear(&self) -> Result<(), Problem> {
        let mut files = self.files();
        files.push(self.path.join(SUMS));
        for (folder, ending) in
            [(JOURNAL, ".rows"), (JOURNAL, ".damaged"), (INPUTS, "")].iter().chain(self.holds.folders)
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

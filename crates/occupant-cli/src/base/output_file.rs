//! A results file that carries its name only when it is complete: `run.partial.mcap` becomes `run.mcap`.
//!
//! The provisional name keeps the ending, so that viewers open what an interrupted run has left.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::failure::Failure;

/// What happens to files that stand where ours goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Existing {
    /// They are left alone and ours is refused.
    Keep,
    /// They are replaced.
    Replace,
}

impl Existing {
    /// As `--force` asks.
    pub(crate) fn by(force: bool) -> Self {
        if force { Existing::Replace } else { Existing::Keep }
    }
}

/// A file under its provisional name, buffered.
#[derive(Debug)]
pub(crate) struct PartialFile {
    target: PathBuf,
    partial: PathBuf,
    existing: Existing,
    writer: BufWriter<File>,
}

/// Why a results file cannot be made.
#[derive(Debug, thiserror::Error)]
pub(crate) enum FileProblem {
    #[error("{} exists; --force replaces it, -o gives another name", .path.display())]
    Exists { path: PathBuf },
    /// A provisional file is there.
    #[error("{} exists: a run that was interrupted or is still running; --force replaces it, -o gives another name", .path.display())]
    PartialExists { path: PathBuf },
    /// Something that is no ordinary file has that name: a folder, a device.
    #[error("{} is not an ordinary file; -o gives another name", .path.display())]
    NotAFile { path: PathBuf },
    #[error("{} is what the run reads and is not replaced; -o gives another name", .path.display())]
    IsInput { path: PathBuf },
    #[error("cannot {doing} {}: {source}", .path.display())]
    Io { doing: &'static str, path: PathBuf, source: io::Error },
}

impl From<FileProblem> for Failure {
    fn from(problem: FileProblem) -> Self {
        Failure::plain(problem.to_string())
    }
}

/// Refuses a target that is, under whatever name, a file that the run reads.
///
/// # Errors
/// [`FileProblem::IsInput`].
pub(crate) fn refuse_input(target: &Path, input: &Path) -> Result<(), FileProblem> {
    let same = |a: &Path, b: &Path| match (fs::canonicalize(a), fs::canonicalize(b)) {
        (Ok(a), Ok(b)) => a == b,
        _ => false,
    };
    for path in [target.to_owned(), partial_path(target)] {
        if same(&path, input) {
            return Err(FileProblem::IsInput { path });
        }
    }
    Ok(())
}

/// Refuses what a rename would destroy although it is no file of results.
fn refuse_irregular(target: &Path) -> Result<(), FileProblem> {
    if target.file_name().is_none() || fs::metadata(target).is_ok_and(|found| !found.is_file()) {
        return Err(FileProblem::NotAFile { path: target.to_owned() });
    }
    Ok(())
}

/// Removes a file, for which `doing` is the word.
///
/// # Errors
/// The operating system refuses.
pub(crate) fn remove_if_there(path: &Path, doing: &'static str) -> Result<(), FileProblem> {
    match fs::remove_file(path) {
        Err(source) if source.kind() != io::ErrorKind::NotFound => {
            Err(FileProblem::Io { doing, path: path.to_owned(), source })
        }
        _ => Ok(()),
    }
}

impl PartialFile {
    /// Begins the file that will be `target`.
    ///
    /// # Errors
    /// A file is there and may not be replaced; the operating system refuses.
    pub(crate) fn create(target: &Path, existing: Existing) -> Result<Self, FileProblem> {
        let partial = partial_path(target);
        match existing {
            Existing::Keep => refuse_existing(target)?,
            Existing::Replace => {
                refuse_irregular(target)?;
                // a run that still writes the old one keeps it, without its name
                remove_if_there(&partial, "replace")?;
            }
        }
        let file = File::create_new(&partial).map_err(|source| {
            let path = partial.clone();
            match source.kind() {
                io::ErrorKind::AlreadyExists => FileProblem::PartialExists { path },
                _ => FileProblem::Io { doing: "create", path, source },
            }
        })?;
        Ok(PartialFile { target: target.to_owned(), partial, existing, writer: BufWriter::new(file) })
    }

    /// The provisional name.
    pub(crate) fn partial_path(&self) -> &Path {
        &self.partial
    }

    /// Gives the complete file its name, safe against a loss of power.
    ///
    /// # Errors
    /// A file of that name has come meanwhile and may not be replaced; the operating system refuses. The file then keeps
    /// its provisional name.
    pub(crate) fn publish(self) -> Result<PathBuf, FileProblem> {
        let (target, existing) = (self.target.clone(), self.existing);
        let partial = self.keep()?;
        if existing == Existing::Keep {
            refuse_existing(&target)?;
        }
        fs::rename(&partial, &target).map_err(|source| FileProblem::Io {
            doing: "rename to",
            path: target.clone(),
            source,
        })?;
        sync_folder(&target);
        Ok(target)
    }

    /// Leaves the file under its provisional name, safe against a loss of power, and gives the name.
    ///
    /// # Errors
    /// The operating system refuses.
    pub(crate) fn keep(mut self) -> Result<PathBuf, FileProblem> {
        let written = self.writer.flush();
        let synced = written.and_then(|()| self.writer.get_ref().sync_all());
        synced.map_err(|source| FileProblem::Io { doing: "write", path: self.partial.clone(), source })?;
        Ok(self.partial)
    }
}

impl Write for PartialFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

impl Seek for PartialFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.writer.seek(to)
    }

    /// Without writing out the buffer.
    fn stream_position(&mut self) -> io::Result<u64> {
        self.writer.stream_position()
    }
}

/// Writes a file of results that carries its name only when it is complete.
///
/// # Errors
/// A file is there and may not be replaced; the operating system refuses.
pub(crate) fn publish(path: &Path, force: bool, bytes: &[u8]) -> Result<(), Failure> {
    write_whole(path, Existing::by(force), bytes).map(|_| ()).map_err(Failure::plain)
}

/// The same, with the reason alone.
///
/// # Errors
/// As [`publish`].
pub(crate) fn write_whole(path: &Path, existing: Existing, bytes: &[u8]) -> Result<PathBuf, String> {
    let mut file = PartialFile::create(path, existing).map_err(|e| e.to_string())?;
    file.write_all(bytes).map_err(|e| format!("{} cannot be written: {e}", path.display()))?;
    file.publish().map_err(|e| e.to_string())
}

/// `dir/run.mcap` → `dir/run.partial.mcap`.
pub(crate) fn partial_path(target: &Path) -> PathBuf {
    let mut name = OsString::from(target.file_stem().unwrap_or_default());
    name.push(".partial");
    if let Some(extension) = target.extension() {
        name.push(".");
        name.push(extension);
    }
    target.with_file_name(name)
}

fn refuse_existing(target: &Path) -> Result<(), FileProblem> {
    match fs::symlink_metadata(target) {
        Ok(_) => Err(FileProblem::Exists { path: target.to_owned() }),
        Err(_) => Ok(()),
    }
}

/// Makes the new name last. Where folders cannot be synced the rename stands all the same, so a failure is no error.
fn sync_folder(target: &Path) {
    let folder = target.parent().filter(|p| !p.as_os_str().is_empty());
    if let Ok(folder) = File::open(folder.unwrap_or(Path::new("."))) {
        let _ = folder.sync_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_provisional_name_keeps_folder_and_ending() {
        let name = |path: &str| partial_path(Path::new(path)).display().to_string();
        assert_eq!(name("a/run.mcap"), "a/run.partial.mcap");
        assert_eq!(name("run.1.mcap"), "run.1.partial.mcap");
        assert_eq!(name("run"), "run.partial");
    }
}

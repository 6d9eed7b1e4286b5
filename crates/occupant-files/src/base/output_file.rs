//! A results file that carries its name only when it is complete: `run.partial.mcap` becomes `run.mcap`.
//!
//! The provisional name keeps the ending, so that viewers open what an interrupted run has left. It belongs to one process
//! as long as that is at work: another one that may replace files takes `run.partial-2.mcap`. Nobody gives or takes away
//! the name of a file that it has not written. Links are followed: what they point to is replaced, not they.

use std::ffi::OsString;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, BufWriter, ErrorKind, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::failure::Failure;

/// Treatment of existing files with the same name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// They are kept, and writing is refused.
    Keep,
    /// They are replaced.
    Replace,
}

impl Existing {
    /// As given by `--force`.
    pub fn by(force: bool) -> Self {
        if force { Existing::Replace } else { Existing::Keep }
    }
}

/// A file under its temporary name, buffered. Dropped before completion, it is removed.
#[derive(Debug)]
pub struct PartialFile {
    /// The requested name.
    target: PathBuf,
    /// Its path, with links resolved.
    place: PathBuf,
    partial: PathBuf,
    existing: Existing,
    /// Whether it is kept even if incomplete.
    stays: bool,
    writer: BufWriter<File>,
}

/// Reason why a result file cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum FileProblem {
    /// It exists, and must not be replaced.
    #[error("{} exists; replace it with --force, or choose another name with -o", .path.display())]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// A temporary file exists.
    #[error("{} exists: a run that was interrupted or is still running; replace it with --force, or choose another name with -o", .path.display())]
    PartialExists {
        /// The temporary file.
        path: PathBuf,
    },
    /// The name belongs to something other than an ordinary file: a folder, a device.
    #[error("{} is not an ordinary file; choose another name with -o", .path.display())]
    NotAFile {
        /// Its path.
        path: PathBuf,
    },
    /// It is an input of the run.
    #[error("{} is an input of the command and is not replaced; choose another name with -o", .path.display())]
    IsInput {
        /// The file.
        path: PathBuf,
    },
    /// It was removed or replaced while being written.
    #[error("{} was removed or replaced while it was being written", .path.display())]
    Gone {
        /// The file.
        path: PathBuf,
    },
    /// An error of the operating system.
    #[error("cannot {doing} {}: {source}", .path.display())]
    Io {
        /// The operation that failed.
        doing: &'static str,
        /// The file.
        path: PathBuf,
        /// The error.
        source: io::Error,
    },
}

impl From<FileProblem> for Failure {
    fn from(problem: FileProblem) -> Self {
        let message = format!("error: {problem}");
        if problem.broke_off() { Failure::BrokeOff(message) } else { Failure::CouldNotRun(message) }
    }
}

impl FileProblem {
    /// Whether writing had begun, or failed for lack of space: there were results to write.
    pub fn broke_off(&self) -> bool {
        use ErrorKind::{FileTooLarge, QuotaExceeded, StorageFull};
        match self {
            FileProblem::Gone { .. } => true,
            FileProblem::Io { doing, source, .. } => {
                ["write", "rename to"].contains(doing)
                    || matches!(source.kind(), StorageFull | QuotaExceeded | FileTooLarge)
            }
            _ => false,
        }
    }
}

/// Refuses a target that is an input of the run, under whatever name.
///
/// # Errors
/// [`FileProblem::IsInput`].
pub fn refuse_input(target: &Path, input: &Path) -> Result<(), FileProblem> {
    let is_input =
        |path: &PathBuf| fs::canonicalize(path).is_ok_and(|place| fs::canonicalize(input).is_ok_and(|i| i == place));
    let taken = [target.to_owned(), partial_path(target)].into_iter().find(is_input);
    taken.map_or(Ok(()), |path| Err(FileProblem::IsInput { path }))
}

/// Largest number of links followed.
const MOST_LINKS: usize = 40;

/// Path of a target, with links resolved.
///
/// # Errors
/// To something that is no ordinary file.
fn place_of(target: &Path) -> Result<PathBuf, FileProblem> {
    let refused = || FileProblem::NotAFile { path: target.to_owned() };
    if target.file_name().is_none() || fs::metadata(target).is_ok_and(|found| !found.is_file()) {
        return Err(refused());
    }
    let mut place = target.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&place) {
            Ok(to) => place = place.parent().unwrap_or(Path::new("")).join(to),
            Err(_no_link) => return Ok(place),
        }
    }
    Err(refused())
}

/// Removes a file.
///
/// # Errors
/// An error of the operating system.
pub fn remove_if_there(path: &Path) -> Result<(), FileProblem> {
    let refused = |source: &io::Error| source.kind() != ErrorKind::NotFound;
    let refused = fs::remove_file(path).err().filter(refused);
    refused.map_or(Ok(()), |source| Err(FileProblem::Io { doing: "remove", path: path.to_owned(), source }))
}

impl PartialFile {
    /// Creates the temporary file that will become `target`.
    ///
    /// # Errors
    /// A file is there and may not be replaced; an error of the operating system.
    pub fn create(target: &Path, existing: Existing) -> Result<Self, FileProblem> {
        let place = place_of(target)?;
        if existing == Existing::Keep && fs::symlink_metadata(&place).is_ok() {
            return Err(FileProblem::Exists { path: place });
        }
        let (partial, file) = begun(&place, existing, |name| {
            let file = made(name);
            let is_taken = file.as_ref().is_err_and(|e| e.kind() == ErrorKind::AlreadyExists);
            // only the usual name: under another one may stand what the user kept
            let left = existing == Existing::Replace && is_taken && name == partial_path(&place);
            if left { taken_over(name).or(file) } else { file }
        })?;
        let (target, writer) = (target.to_owned(), BufWriter::new(file));
        Ok(PartialFile { target, place, partial, existing, stays: false, writer })
    }

    /// Keeps the file under its temporary name even if it is not completed.
    pub fn that_stays(mut self) -> Self {
        self.stays = true;
        self
    }

    /// The temporary name.
    pub fn partial_path(&self) -> &Path {
        &self.partial
    }

    /// Renames the complete file, durably (it survives a power failure).
    ///
    /// # Errors
    /// A file of that name has come meanwhile and may not be replaced; an error of the operating system. The file then keeps
    /// its provisional name.
    pub fn publish(mut self) -> Result<PathBuf, FileProblem> {
        self.finish()?;
        let PartialFile { target, place, partial, existing, .. } = &self;
        let named = match existing {
            Existing::Replace => fs::rename(partial, place),
            Existing::Keep => name_anew(partial, place),
        };
        named.map_err(|source| match source.kind() {
            ErrorKind::AlreadyExists => FileProblem::Exists { path: target.clone() },
            _ => FileProblem::Io { doing: "rename to", path: target.clone(), source },
        })?;
        sync_folder(place);
        Ok(target.clone())
    }

    /// Keeps the file under its temporary name, durably, and returns that name.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn keep(self) -> Result<PathBuf, FileProblem> {
        let mut file = self.that_stays();
        file.finish()?;
        Ok(file.partial.clone())
    }

    fn finish(&mut self) -> Result<(), FileProblem> {
        let path = || self.partial.clone();
        let written = self.writer.flush();
        let synced = written.and_then(|()| self.writer.get_ref().sync_all());
        synced.map_err(|source| FileProblem::Io { doing: "write", path: path(), source })?;
        if is_at(self.writer.get_ref(), &self.partial) { Ok(()) } else { Err(FileProblem::Gone { path: path() }) }
    }
}

impl Drop for PartialFile {
    fn drop(&mut self) {
        if !self.stays && is_at(self.writer.get_ref(), &self.partial) {
            let _it_may_stay = fs::remove_file(&self.partial);
        }
    }
}

/// Creates a new file, locked to show others that it is being written.
fn made(path: &Path) -> io::Result<File> {
    let file = File::create_new(path)?;
    match file.try_lock() {
        // another process was faster and writes it
        Err(TryLockError::WouldBlock) => Err(ErrorKind::AlreadyExists.into()),
        // a file system without locks: nobody takes over a file that he cannot lock
        Ok(()) | Err(TryLockError::Error(_)) => Ok(file),
    }
}

/// The leftover file of an interrupted run, emptied.
fn taken_over(name: &Path) -> io::Result<File> {
    let left = OpenOptions::new().write(true).open(name)?;
    if left.try_lock().is_err() || !is_at(&left, name) {
        return Err(ErrorKind::AlreadyExists.into());
    }
    left.set_len(0).map(|()| left)
}

/// Creates a temporary file or folder for `place`; if others may be replaced, under the first free name.
///
/// # Errors
/// It exists and may not be replaced; an error of the operating system.
pub fn begun<T>(
    place: &Path,
    existing: Existing,
    make: impl Fn(&Path) -> io::Result<T>,
) -> Result<(PathBuf, T), FileProblem> {
    let mut number = 1;
    loop {
        let path = match number {
            1 => partial_path(place),
            _ => with_word(place, &format!(".partial-{number}")),
        };
        match make(&path) {
            Ok(made) => return Ok((path, made)),
            Err(error) if error.kind() != ErrorKind::AlreadyExists => {
                return Err(FileProblem::Io { doing: "create", path, source: error });
            }
            Err(_) if existing == Existing::Keep || number == MOST_AT_WORK => {
                return Err(FileProblem::PartialExists { path });
            }
            Err(_) => number += 1,
        }
    }
}

/// Largest number of temporary names of one file.
const MOST_AT_WORK: usize = 1000;

/// Whether the open file is the one with this name.
#[cfg(unix)]
pub fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |found: fs::Metadata| (found.dev(), found.ino());
    let here = fs::symlink_metadata(path).map(identity);
    here.is_ok_and(|here| file.metadata().map(identity).is_ok_and(|own| own == here))
}

/// Whether the open file is the one with this name.
#[cfg(windows)]
pub fn is_at(file: &File, path: &Path) -> bool {
    let own = file.try_clone().and_then(same_file::Handle::from_file);
    same_file::Handle::from_path(path).is_ok_and(|here| own.is_ok_and(|own| own == here))
}

/// Whether the open file is the one with this name; where unknown, whether one exists.
#[cfg(not(any(unix, windows)))]
pub fn is_at(_file: &File, path: &Path) -> bool {
    path.exists()
}

/// Renames a file only if the name is free.
fn name_anew(partial: &Path, place: &Path) -> io::Result<()> {
    match fs::hard_link(partial, place) {
        Ok(()) => fs::remove_file(partial),
        Err(error) if error.kind() == ErrorKind::AlreadyExists => Err(error),
        // a file system without such links
        Err(_) if fs::symlink_metadata(place).is_ok() => Err(ErrorKind::AlreadyExists.into()),
        Err(_) => fs::rename(partial, place),
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

    /// Position without flushing the buffer.
    fn stream_position(&mut self) -> io::Result<u64> {
        self.writer.stream_position()
    }
}

/// Writes a result file under a temporary name and renames it when complete.
///
/// # Errors
/// A file is there and may not be replaced; an error of the operating system.
pub fn publish(path: &Path, force: bool, bytes: &[u8]) -> Result<(), Failure> {
    Ok(write_whole(path, Existing::by(force), bytes).map(|_| ())?)
}

/// As [`publish`], with a plain error.
///
/// # Errors
/// As [`publish`].
pub fn write_whole(path: &Path, existing: Existing, bytes: &[u8]) -> Result<PathBuf, FileProblem> {
    let mut file = PartialFile::create(path, existing)?;
    file.write_all(bytes).map_err(|source| FileProblem::Io { doing: "write", path: path.to_owned(), source })?;
    file.publish()
}

/// `dir/run.mcap` → `dir/run.partial.mcap`.
pub fn partial_path(target: &Path) -> PathBuf {
    with_word(target, ".partial")
}

/// The name with a word inserted before its extension.
pub fn with_word(target: &Path, word: &str) -> PathBuf {
    let mut name = OsString::from(target.file_stem().unwrap_or_default());
    name.push(word);
    if let Some(extension) = target.extension() {
        name.push(".");
        name.push(extension);
    }
    target.with_file_name(name)
}

/// Makes the rename durable. A failure is ignored, as some systems cannot sync folders.
pub fn sync_folder(target: &Path) {
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
        let name = |path: &str| partial_path(Path::new(path)).display().to_string().replace('\\', "/");
        assert_eq!(name("a/run.mcap"), "a/run.partial.mcap");
        assert_eq!(name("run.1.mcap"), "run.1.partial.mcap");
        assert_eq!(name("run"), "run.partial");
    }
}

//! The journal: every finished sample, in files that are only appended to.
//!
//! A file contains rows of one process in the order in which they were finished, as JSON Lines with checksums: the
//! first line names the sweep, each other line is a [`Row`]. An incomplete last row, left by a killed process or a full
//! disk, has no line end and is not read; the sample is computed again.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, Read, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::checksums::Checksums;
use super::finished::Finished;
use super::folder::{Folder, names_in};
use super::manifest::Manifest;
use super::problem::Problem;
use super::row::Row;
use super::shard::Shard;
use crate::base::{Failure, FileProblem, is_at};

/// Interval between syncs to disk.
const SYNC_EVERY: Duration = Duration::from_secs(10);
/// Number of samples read at a time.
const AT_ONCE: u64 = 2048;

/// Largest number of rows of a journal file.
const ROWS: usize = 1024;
const BYTES: usize = 4 << 20;
/// Size at which a journal file is closed, bytes.
const LARGEST: u64 = 8 << 20;
/// Longest first line, bytes.
const MOST_OF_HEAD: u64 = 1 << 10;

/// First line of a journal file.
#[derive(Serialize, Deserialize)]
struct Head {
    /// SHA-256 of the manifest.
    rows_of: String,
}

/// Text before the checksum of a line, between checksum and content, and at the end.
const FRAME: [&str; 3] = ["{\"crc32\":\"", "\",\"is\":", "}\n"];

/// A line of the journal, with the CRC-32 of its content.
fn line_of(holds: &impl Serialize) -> serde_json::Result<String> {
    let [before, between, behind] = FRAME;
    let json = serde_json::to_string(holds)?;
    Ok(format!("{before}{:08x}{between}{json}{behind}", crc32fast::hash(json.as_bytes())))
}

/// Content of a journal line; none if it is damaged.
fn held_by<T: DeserializeOwned>(line: &[u8]) -> Option<T> {
    let [before, between, behind] = FRAME.map(str::as_bytes);
    let (crc, rest) = line.strip_prefix(before)?.split_at_checked(8)?;
    let json = rest.strip_prefix(between)?.strip_suffix(behind)?;
    let whole = crc == format!("{:08x}", crc32fast::hash(json)).as_bytes();
    serde_json::from_slice(json).ok().filter(|_| whole)
}

/// Appends the rows of one process.
#[derive(Debug)]
pub struct JournalWriter {
    folder: PathBuf,
    manifest_sha256: String,
    shard: Shard,
    /// Number of the next journal file.
    next: u64,
    open: Option<OpenPiece>,
    synced: Instant,
}

#[derive(Debug)]
struct OpenPiece {
    path: PathBuf,
    file: File,
    rows: usize,
    bytes: usize,
}

impl OpenPiece {
    /// Appends a line in a single write.
    fn append(&mut self, line: &impl Serialize) -> io::Result<()> {
        let line = line_of(line)?;
        self.file.write_all(line.as_bytes())?;
        self.rows += 1;
        self.bytes += line.len();
        Ok(())
    }

    fn sync(&self) -> Result<(), Problem> {
        self.file.sync_data().map_err(Problem::io("write", &self.path))?;
        let gone = || Problem::File(FileProblem::Gone { path: self.path.clone() });
        is_at(&self.file, &self.path).then_some(()).ok_or_else(gone)
    }
}

impl JournalWriter {
    /// Continues after the existing journal files of the shard, whose lock must be held.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn new(folder: &Folder, manifest_sha256: &str, shard: Shard) -> Result<Self, Problem> {
        let folder = folder.journal();
        let number = |name: &String| {
            let number = name.strip_prefix(&shard.file_stem())?;
            number.strip_prefix('.')?.strip_suffix(".rows")?.parse::<u64>().ok()
        };
        let last = names_in(&folder)?.iter().filter_map(number).max();
        Ok(JournalWriter {
            folder,
            manifest_sha256: manifest_sha256.to_owned(),
            shard,
            next: last.map_or(0, |n| n + 1),
            open: None,
            synced: Instant::now(),
        })
    }

    /// Appends a row.
    ///
    /// # Errors
    /// An error of the operating system, e.g. because the disk is full; all rows before stand.
    pub fn append(&mut self, row: &Row) -> Result<(), Problem> {
        let mut piece = match self.open.take() {
            Some(open) => open,
            None => self.begin_piece()?,
        };
        // after a failed write the piece stays closed: nothing may follow a part of a row
        piece.append(row).map_err(Problem::io("write", &piece.path))?;
        let full = piece.rows > ROWS || piece.bytes >= BYTES;
        if full || self.synced.elapsed() > SYNC_EVERY {
            piece.sync()?;
            self.synced = Instant::now();
        }
        self.open = (!full).then_some(piece);
        Ok(())
    }

    /// Syncs everything to disk.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn close(self) -> Result<(), Problem> {
        self.open.map_or(Ok(()), |piece| piece.sync())
    }

    fn begin_piece(&mut self) -> Result<OpenPiece, Problem> {
        let path = self.folder.join(format!("{}.{:06}.rows", self.shard.file_stem(), self.next));
        self.next += 1;
        let begin = || {
            let mut piece = OpenPiece { file: File::create_new(&path)?, path: path.clone(), rows: 0, bytes: 0 };
            piece.append(&Head { rows_of: self.manifest_sha256.clone() })?;
            Ok(piece)
        };
        begin().map_err(Problem::io("write", &path))
    }
}

/// Index of the journals: positions of the finished rows, which stay on disk.
#[derive(Clone, Debug)]
pub struct Journal {
    manifest_sha256: String,
    samples: u64,
    pieces: Vec<Piece>,
    /// The finished samples.
    pub finished: Finished,
    /// Number of truncated rows, left by killed processes.
    pub torn: usize,
    /// Shards that have started.
    begun: BTreeSet<Shard>,
}

#[derive(Clone, Debug)]
struct Piece {
    path: PathBuf,
    /// From the smallest sample to one past the largest.
    samples: Range<u64>,
}

/// Whether a journal file of the folder refers to this manifest.
///
/// # Errors
/// An error of the operating system.
pub fn is_named_by_rows(folder: &Folder, manifest: &Manifest) -> Result<bool, Problem> {
    let (journal, sha256) = (folder.journal(), manifest.sha256().unwrap_or_default());
    let names = if journal.exists() { names_in(&journal)? } else { Vec::new() };
    let named = |name: &String| {
        let mut line = Vec::new();
        let file = File::open(journal.join(name)).map(|file| BufReader::new(file.take(MOST_OF_HEAD)));
        let read = file.and_then(|mut file| file.read_until(b'\n', &mut line));
        read.is_ok() && held_by(&line).is_some_and(|head: Head| head.rows_of == sha256)
    };
    Ok(names.iter().any(|name| name.ends_with(".rows") && named(name)))
}

impl Journal {
    /// Reads the journal of a claimed folder. Damaged files are set aside and returned: their samples are unfinished.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn mend(folder: &Folder, manifest: (&str, u64), sums: &Checksums) -> Result<(Self, Vec<PathBuf>), Problem> {
        let mut aside: Vec<PathBuf> = sums.damaged();
        aside.retain(|path| path.starts_with(folder.journal()));
        aside.iter().try_for_each(|path| sums.put_aside(path))?;
        loop {
            match Journal::read(std::slice::from_ref(folder), manifest.0, manifest.1) {
                Err(Problem::Damaged { path, .. }) => {
                    sums.put_aside(&path)?;
                    aside.push(path);
                }
                read => return read.map(|journal| (journal, aside)),
            }
        }
    }

    /// Adds checksums of the journal files of a shard that has ended.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn list(folder: &Folder, shard: Shard, sums: &Checksums) -> Result<(), Problem> {
        let own = |name: &String| name.ends_with(".rows") && Shard::of_file(name) == Some(shard);
        let pieces = names_in(&folder.journal())?.into_iter().filter(own).map(|name| folder.journal().join(name));
        pieces.filter(|piece| !sums.holds(piece)).try_for_each(|piece| sums.add(&piece))
    }

    /// Reads the journals of folders that contain parts of one sweep of `samples`.
    ///
    /// # Errors
    /// An error of the operating system; a file that is no piece, or of another sweep.
    pub fn read(folders: &[Folder], manifest_sha256: &str, samples: u64) -> Result<Self, Problem> {
        let mut journal = Journal {
            manifest_sha256: manifest_sha256.to_owned(),
            samples,
            pieces: Vec::new(),
            finished: Finished::none(samples),
            torn: 0,
            begun: BTreeSet::new(),
        };
        for folder in folders {
            let folder = folder.journal();
            for name in names_in(&folder)? {
                journal.begun.extend(Shard::of_file(&name));
                if name.ends_with(".rows") {
                    journal.look_through(folder.join(name))?;
                }
            }
        }
        journal.pieces.sort_by_key(|p| p.samples.start);
        Ok(journal)
    }

    fn look_through(&mut self, path: PathBuf) -> Result<(), Problem> {
        let (rows, torn) = self.piece(&path)?;
        self.torn += usize::from(torn);
        let indices = || rows.iter().map(|row| row.index);
        indices().for_each(|index| self.finished.add(index));
        if let (Some(least), Some(greatest)) = (indices().min(), indices().max()) {
            self.pieces.push(Piece { path, samples: least..greatest + 1 });
        }
        Ok(())
    }

    /// Rows of a journal file, and whether one was truncated.
    fn piece(&self, path: &Path) -> Result<(Vec<Row>, bool), Problem> {
        let damaged = |found: &str| Problem::Damaged { path: path.to_owned(), found: found.to_owned() };
        if fs::metadata(path).is_ok_and(|file| file.len() > LARGEST || !file.is_file()) {
            return Err(damaged("is too large for a piece of a journal, or not a file"));
        }
        let bytes = fs::read(path).map_err(Problem::io("read", path))?;
        let end = bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |at| at + 1);
        let mut lines = bytes[..end].split_inclusive(|byte| *byte == b'\n');
        let torn = end < bytes.len();
        let Some(head) = lines.next() else {
            return Ok((Vec::new(), torn));
        };
        match held_by::<Head>(head) {
            None => return Err(damaged("is not a piece of a journal")),
            Some(head) if head.rows_of != self.manifest_sha256 => {
                return Err(damaged("is a piece of another sweep's journal"));
            }
            Some(_) => {}
        }
        let row = |(i, line)| {
            let row = held_by(line).filter(|row: &Row| row.index < self.samples);
            row.ok_or_else(|| damaged(&format!("has a row of another sweep in line {}", i + 2)))
        };
        Ok((lines.enumerate().map(row).collect::<Result<_, _>>()?, torn))
    }

    /// Shards with missing samples, and how many, as far as the files show the number of shards.
    pub fn lacking(&self, samples: u64) -> Vec<(Shard, u64)> {
        let counts: BTreeSet<u64> = self.begun.iter().map(|s| s.count).collect();
        let Some(count) = counts.last().filter(|_| counts.len() == 1) else {
            return Vec::new();
        };
        let lack = |shard: Shard| {
            let range = shard.range(samples);
            (shard, range.end - range.start - self.finished.count(range.clone()))
        };
        let all = Shard::all(*count).map(lack);
        all.filter(|(_, missing)| *missing > 0).collect()
    }

    /// Passes all rows on in the order of their samples, read in portions of bounded memory. Duplicate results of a
    /// sample must agree.
    ///
    /// # Errors
    /// Results that disagree; an error of the operating system; what `see` says.
    pub fn each_row(&self, mut see: impl FnMut(Row) -> Result<(), Failure>) -> Result<(), Failure> {
        let mut starts = (0..self.samples).step_by(AT_ONCE as usize);
        starts.try_for_each(|start| self.rows(start..start + AT_ONCE)?.into_iter().try_for_each(&mut see))
    }

    /// Rows of the finished samples of a range, in order.
    ///
    /// # Errors
    /// As [`Journal::each_row`].
    pub fn rows(&self, range: Range<u64>) -> Result<Vec<Row>, Problem> {
        let mut found: BTreeMap<u64, (Row, &Path)> = BTreeMap::new();
        let overlapping = |p: &&Piece| p.samples.start < range.end && range.start < p.samples.end;
        for piece in self.pieces.iter().filter(overlapping) {
            for row in self.piece(&piece.path)?.0.into_iter().filter(|row| range.contains(&row.index)) {
                let index = row.index;
                match found.get(&index) {
                    Some((there, first)) if !there.agrees(&row) => {
                        let (first, second) = (first.to_path_buf(), piece.path.clone());
                        return Err(Problem::Disagree { index, first, second });
                    }
                    Some(_) => {}
                    None => _ = found.insert(index, (row, &piece.path)),
                }
            }
        }
        Ok(found.into_values().map(|(row, _)| row).collect())
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::files::study_folder::row::tests::row;

    const SHA: &str = "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef";

    /// A folder whose journal is one piece of four rows, and the piece.
    fn journal() -> (tempfile::TempDir, Folder, PathBuf) {
        let there = tempfile::tempdir().unwrap();
        let folder = Folder::at(there.path());
        fs::create_dir(folder.journal()).unwrap();
        let mut writer = JournalWriter::new(&folder, SHA, Shard::WHOLE).unwrap();
        (0..4).for_each(|i| writer.append(&row(i)).unwrap());
        writer.close().unwrap();
        let piece = folder.journal().join("shard-0001-of-0001.000000.rows");
        (there, folder, piece)
    }

    fn read(folder: &Folder, sha256: &str) -> Result<Journal, String> {
        Journal::read(std::slice::from_ref(folder), sha256, 4).map_err(|e| e.to_string())
    }

    #[test]
    fn cut_off_anywhere_a_piece_holds_the_rows_before() {
        let (_there, folder, piece) = journal();
        let bytes = fs::read(&piece).unwrap();
        let mut seen = 0;
        for end in 0..bytes.len() {
            fs::write(&piece, &bytes[..end]).unwrap();
            let found = read(&folder, SHA).unwrap();
            let rows = found.rows(0..4).unwrap();
            let expected: Vec<Row> = (0..rows.len() as u64).map(row).collect();
            assert_eq!(rows, expected);
            assert!(rows.len() >= seen && rows.len() < 4);
            seen = rows.len();
            let boundary = end == 0 || bytes[end - 1] == b'\n';
            assert_eq!(found.torn == 0, boundary, "{end}");
        }
        assert_eq!(seen, 3);
    }

    #[test]
    fn a_damaged_row_and_what_is_no_piece_are_refused() {
        let (_there, folder, piece) = journal();
        assert!(read(&folder, &SHA.replace('0', "f")).unwrap_err().contains("another sweep's"));
        let text = fs::read_to_string(&piece).unwrap();
        fs::write(&piece, text.replacen("\"index\":1", "\"index\":9", 1)).unwrap();
        assert!(read(&folder, SHA).unwrap_err().contains("of another sweep in line 3"));
        fs::write(&piece, text.replacen(":0.25", ":0.26", 1)).unwrap();
        assert!(read(&folder, SHA).unwrap_err().contains("in line 2"), "a digit that is another one is noticed");
        fs::write(&piece, "occupant rows 1\nhello\n").unwrap();
        assert!(read(&folder, SHA).unwrap_err().contains("not a piece of a journal"));
    }
}

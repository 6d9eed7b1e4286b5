//! A file of the journal: finished samples of a block, only appended to.
//!
//! A file contains rows of one process in the order in which they were finished, as JSON Lines with checksums: the
//! first line names the sweep, each other line is a [`Row`]. An incomplete last row, left by a killed process or a full
//! disk, has no line end and is not read; the sample is computed again.

use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::block::Block;
use super::folder::Folder;
use super::problem::Problem;
use super::row::Row;
use crate::base::{FileProblem, is_at};

/// Interval between syncs to disk.
const SYNC_EVERY: Duration = Duration::from_secs(10);
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
    /// Identity of the study.
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

/// Name of the journal file of a block with this number.
fn name_of(block: &Block, number: u64) -> String {
    format!("{}.{number:06}.rows", block.stem())
}

/// The journal files of a block, by their names alone: no folder is read, however many neighbours it has.
pub fn pieces_of(folder: &Folder, block: &Block) -> Vec<PathBuf> {
    let paths = (0..).map(|number| folder.journal().join(name_of(block, number)));
    // a damaged one that was set aside does not end the row
    let begun = paths.take_while(|path| path.exists() || path.with_extension("damaged").exists());
    begun.filter(|path| path.exists()).collect()
}

/// Whether a journal file names this study.
pub fn is_of(path: &Path, study: &str) -> bool {
    let mut line = Vec::new();
    let file = File::open(path).map(|file| BufReader::new(file.take(MOST_OF_HEAD)));
    let read = file.and_then(|mut file| file.read_until(b'\n', &mut line));
    read.is_ok() && held_by(&line).is_some_and(|head: Head| head.rows_of == study)
}

/// Rows of a journal file of a study of `samples` samples, and whether one was truncated.
///
/// # Errors
/// A file that is no piece, or of another sweep; an error of the operating system.
pub fn read(path: &Path, study: &str, samples: u64) -> Result<(Vec<Row>, bool), Problem> {
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
        Some(head) if head.rows_of != study => return Err(damaged("is a piece of another sweep's journal")),
        Some(_) => {}
    }
    let row = |(i, line)| {
        let row = held_by(line).filter(|row: &Row| row.index < samples);
        row.ok_or_else(|| damaged(&format!("has a row of another sweep in line {}", i + 2)))
    };
    Ok((lines.enumerate().map(row).collect::<Result<_, _>>()?, torn))
}

/// Appends the rows of one process.
#[derive(Debug)]
pub struct JournalWriter {
    folder: PathBuf,
    study: String,
    block: Block,
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
    /// Continues after the existing journal files of the block. Of two processes without locks each has its own files.
    pub fn new(folder: &Folder, study: &str, block: &Block) -> Self {
        JournalWriter {
            folder: folder.journal(),
            study: study.to_owned(),
            block: block.clone(),
            next: 0,
            open: None,
            synced: Instant::now(),
        }
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

    /// Begins the first file whose name is free, also of one that was set aside.
    fn begin_piece(&mut self) -> Result<OpenPiece, Problem> {
        loop {
            let path = self.folder.join(name_of(&self.block, self.next));
            self.next += 1;
            if path.with_extension("damaged").exists() {
                continue;
            }
            match File::create_new(&path) {
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
                made => return made.and_then(|file| self.headed(file, &path)).map_err(Problem::io("write", &path)),
            }
        }
    }

    fn headed(&self, file: File, path: &Path) -> io::Result<OpenPiece> {
        let mut piece = OpenPiece { file, path: path.to_owned(), rows: 0, bytes: 0 };
        piece.append(&Head { rows_of: self.study.clone() })?;
        Ok(piece)
    }
}

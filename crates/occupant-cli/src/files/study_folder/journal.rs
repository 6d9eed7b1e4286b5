//! The journal: every finished sample, in pieces that are only ever appended to.

use std::collections::BTreeSet;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::finished::Finished;
use super::folder::{Folder, names_in};
use super::piece::{NotOurs, PieceWriter, frames};
use super::problem::Problem;
use super::row::Row;
use super::shard::Shard;
use crate::base::failure::Failure;

/// What was written is made safe against a loss of power at least so often.
const SYNC_EVERY: Duration = Duration::from_secs(10);
/// So many samples are read at a time.
const AT_ONCE: u64 = 2048;

/// Appends the rows of one process.
#[derive(Debug)]
pub(crate) struct JournalWriter {
    folder: PathBuf,
    manifest_sha256: String,
    shard: Shard,
    /// Number of the next piece.
    next: u64,
    open: Option<(PathBuf, PieceWriter)>,
    synced: Instant,
}

impl JournalWriter {
    /// Begins after the pieces that the shard has. The shard's lock must be held.
    ///
    /// # Errors
    /// The operating system refuses.
    pub(crate) fn new(folder: &Folder, manifest_sha256: &str, shard: Shard) -> Result<Self, Problem> {
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
    /// The operating system refuses, e.g. because the disk is full; all rows before stand.
    pub(crate) fn append(&mut self, row: &Row) -> Result<(), Problem> {
        let (path, mut piece) = match self.open.take() {
            Some(open) => open,
            None => self.begin_piece()?,
        };
        // after a failed write the piece stays closed: nothing may follow a part of a row
        piece.append(row).map_err(Problem::io("write", &path))?;
        if piece.is_full() {
            piece.sync().map_err(Problem::io("write", &path))?;
            return Ok(());
        }
        if self.synced.elapsed() > SYNC_EVERY {
            piece.sync().map_err(Problem::io("write", &path))?;
            self.synced = Instant::now();
        }
        self.open = Some((path, piece));
        Ok(())
    }

    /// Makes everything safe against a loss of power.
    ///
    /// # Errors
    /// The operating system refuses.
    pub(crate) fn close(self) -> Result<(), Problem> {
        match &self.open {
            Some((path, piece)) => piece.sync().map_err(Problem::io("write", path)),
            None => Ok(()),
        }
    }

    fn begin_piece(&mut self) -> Result<(PathBuf, PieceWriter), Problem> {
        let name = format!("{}.{:06}.rows", self.shard.file_stem(), self.next);
        let path = self.folder.join(name);
        let piece = PieceWriter::create(&path, &self.manifest_sha256);
        self.next += 1;
        Ok((path.clone(), piece.map_err(Problem::io("create", &path))?))
    }
}

/// What journals hold: where the rows of which samples stand. The rows themselves stay on the disk.
#[derive(Clone, Debug)]
pub(crate) struct Journal {
    manifest_sha256: String,
    samples: u64,
    pieces: Vec<Piece>,
    /// The samples that are finished.
    pub(crate) finished: Finished,
    /// Rows that were cut off: what killed processes had in their hands.
    pub(crate) torn: usize,
    /// The shards that have begun.
    begun: BTreeSet<Shard>,
}

#[derive(Clone, Debug)]
struct Piece {
    path: PathBuf,
    /// From the least to after the greatest sample.
    samples: Range<u64>,
}

impl Journal {
    /// Reads through the journals of folders that hold parts of one sweep of `samples`.
    ///
    /// # Errors
    /// The operating system refuses; a file that is no piece, or of another sweep.
    pub(crate) fn read(folders: &[Folder], manifest_sha256: &str, samples: u64) -> Result<Self, Problem> {
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
                    journal.look_through(folder.join(name), samples)?;
                }
            }
        }
        journal.pieces.sort_by_key(|p| p.samples.start);
        Ok(journal)
    }

    fn look_through(&mut self, path: PathBuf, samples: u64) -> Result<(), Problem> {
        let bytes = fs::read(&path).map_err(Problem::io("read", &path))?;
        let frames = frames(&bytes, &self.manifest_sha256).map_err(|e| not_ours(&path, e))?;
        let mut range: Option<Range<u64>> = None;
        for row in frames {
            let index = Row::index_of(row).filter(|i| *i < samples);
            let index = index.ok_or_else(|| no_row(&path))?;
            self.finished.add(index);
            range = Some(match range {
                Some(r) => r.start.min(index)..r.end.max(index + 1),
                None => index..index + 1,
            });
        }
        self.torn += usize::from(frames.torn() > 0);
        if let Some(samples) = range {
            self.pieces.push(Piece { path, samples });
        }
        Ok(())
    }

    /// The shards that lack samples and how many, as far as the files tell into how many shards the study was cut.
    pub(crate) fn lacking(&self, samples: u64) -> Vec<(Shard, u64)> {
        let counts: BTreeSet<u64> = self.begun.iter().map(|s| s.count()).collect();
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

    /// Hands over all rows in the order of their samples, read in portions: memory does not grow with their number. Where
    /// two processes have computed one sample its results must agree.
    ///
    /// # Errors
    /// Results that disagree; the operating system refuses; what `see` says.
    pub(crate) fn each_row(&self, mut see: impl FnMut(Row) -> Result<(), Failure>) -> Result<(), Failure> {
        let mut start = 0;
        while start < self.samples {
            let end = (start + AT_ONCE).min(self.samples);
            self.rows(start..end)?.into_iter().try_for_each(&mut see)?;
            start = end;
        }
        Ok(())
    }

    /// The rows of those of a range of samples that are finished, in order.
    ///
    /// # Errors
    /// As [`Journal::each_row`].
    pub(crate) fn rows(&self, range: Range<u64>) -> Result<Vec<Row>, Problem> {
        let mut found: Vec<Option<(Row, &Path)>> = Vec::new();
        found.resize_with((range.end - range.start) as usize, || None);
        let overlapping = |p: &&Piece| p.samples.start < range.end && range.start < p.samples.end;
        for piece in self.pieces.iter().filter(overlapping) {
            let path = &piece.path;
            let bytes = fs::read(path).map_err(Problem::io("read", path))?;
            let frames = frames(&bytes, &self.manifest_sha256).map_err(|e| not_ours(path, e))?;
            for bytes in frames {
                let index = Row::index_of(bytes).filter(|i| range.contains(i));
                let Some(index) = index else {
                    continue;
                };
                let row = Row::decode(bytes).ok_or_else(|| no_row(path))?;
                match &mut found[(index - range.start) as usize] {
                    Some((there, first)) if !there.agrees(&row) => {
                        return Err(Problem::Disagree { index, first: first.to_path_buf(), second: path.clone() });
                    }
                    Some(_) => {}
                    empty => *empty = Some((row, path)),
                }
            }
        }
        Ok(found.into_iter().flatten().map(|(row, _)| row).collect())
    }
}

fn not_ours(path: &Path, found: NotOurs) -> Problem {
    Problem::Damaged {
        path: path.to_owned(),
        found: match found {
            NotOurs::NoPiece => "is no piece of a journal".to_owned(),
            NotOurs::OtherSweep => "is a piece of another sweep's journal".to_owned(),
        },
    }
}

fn no_row(path: &Path) -> Problem {
    Problem::Damaged { path: path.to_owned(), found: "holds a row that is none of this sweep".to_owned() }
}

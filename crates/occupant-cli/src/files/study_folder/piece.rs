//! A piece of the journal: rows of one process in the order in which they were finished, each with its checksum.
//!
//! A piece is only ever appended to, by the process that began it. What a killed process or a full disk has left of its
//! last row does not fit its checksum and is not read; the row is computed again.
//!
//! ```text
//! piece = "occupant rows 1\n" · SHA-256 of the manifest, 64 characters · "\n" · frame …
//! frame = length of the row, u32 · CRC-32 of the row, u32 · row          (little endian)
//! ```

use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::Path;

use super::row::Row;

const MAGIC: &[u8] = b"occupant rows 1\n";

/// A piece is closed after so many rows or bytes.
const ROWS: usize = 1024;
const BYTES: usize = 4 << 20;

/// A piece that is being written.
#[derive(Debug)]
pub(crate) struct PieceWriter {
    file: File,
    rows: usize,
    bytes: usize,
    frame: Vec<u8>,
}

impl PieceWriter {
    /// Begins a piece of the sweep with this manifest; no file of that name may be there.
    ///
    /// # Errors
    /// The operating system refuses.
    pub(crate) fn create(path: &Path, manifest_sha256: &str) -> io::Result<Self> {
        let mut file = OpenOptions::new().write(true).create_new(true).open(path)?;
        let head = [MAGIC, manifest_sha256.as_bytes(), b"\n"].concat();
        file.write_all(&head)?;
        Ok(PieceWriter { file, rows: 0, bytes: head.len(), frame: Vec::new() })
    }

    /// Appends a row, in one write.
    ///
    /// # Errors
    /// The operating system refuses. A part of the row may then stand in the file; nothing may be appended to it.
    pub(crate) fn append(&mut self, row: &Row) -> io::Result<()> {
        self.frame.clear();
        self.frame.extend([0; 8]);
        row.encode(&mut self.frame);
        let length = u32::try_from(self.frame.len() - 8).map_err(|_| io::Error::other("a row of more than 4 GiB"))?;
        let checksum = crc32fast::hash(&self.frame[8..]);
        self.frame[..4].copy_from_slice(&length.to_le_bytes());
        self.frame[4..8].copy_from_slice(&checksum.to_le_bytes());
        self.file.write_all(&self.frame)?;
        self.rows += 1;
        self.bytes += self.frame.len();
        Ok(())
    }

    /// Whether the next row belongs into a new piece.
    pub(crate) fn is_full(&self) -> bool {
        self.rows >= ROWS || self.bytes >= BYTES
    }

    /// Makes what was written safe against a loss of power.
    ///
    /// # Errors
    /// The operating system refuses.
    pub(crate) fn sync(&self) -> io::Result<()> {
        self.file.sync_data()
    }
}

/// What a piece holds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frames<'a> {
    rest: &'a [u8],
}

/// Why a file is no piece of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NotOurs {
    NoPiece,
    /// It belongs to another sweep.
    OtherSweep,
}

/// The rows of a piece, as bytes; a piece cut off in its head has none.
///
/// # Errors
/// A file that is something else, or of another sweep.
pub(crate) fn frames<'a>(bytes: &'a [u8], manifest_sha256: &str) -> Result<Frames<'a>, NotOurs> {
    let head = [MAGIC, manifest_sha256.as_bytes(), b"\n"].concat();
    if let Some(rest) = bytes.strip_prefix(&head[..]) {
        return Ok(Frames { rest });
    }
    match bytes {
        _ if head.starts_with(bytes) => Ok(Frames { rest: &[] }),
        _ if bytes.starts_with(MAGIC) => Err(NotOurs::OtherSweep),
        _ => Err(NotOurs::NoPiece),
    }
}

impl Frames<'_> {
    /// Bytes that are no whole row: what is left of a row that was cut off.
    pub(crate) fn torn(mut self) -> usize {
        while self.next().is_some() {}
        self.rest.len()
    }
}

impl<'a> Iterator for Frames<'a> {
    type Item = &'a [u8];

    /// The next row that is whole; the first that is not ends the piece.
    fn next(&mut self) -> Option<&'a [u8]> {
        let (length, rest) = self.rest.split_first_chunk::<4>()?;
        let (checksum, rest) = rest.split_first_chunk::<4>()?;
        let (row, rest) = rest.split_at_checked(u32::from_le_bytes(*length) as usize)?;
        if crc32fast::hash(row) != u32::from_le_bytes(*checksum) {
            return None;
        }
        self.rest = rest;
        Some(row)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::study_folder::row::tests::row;

    const SHA: &str = "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef";

    fn piece_of(rows: u64) -> Vec<u8> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.rows");
        let mut piece = PieceWriter::create(&path, SHA).unwrap();
        (0..rows).for_each(|i| piece.append(&row(i)).unwrap());
        std::fs::read(&path).unwrap()
    }

    fn indices(bytes: &[u8]) -> Vec<u64> {
        let rows = frames(bytes, SHA).unwrap().map(Row::decode);
        rows.map(|r| r.unwrap().index).collect()
    }

    #[test]
    fn cut_off_anywhere_a_piece_holds_the_rows_before() {
        let bytes = piece_of(4);
        assert_eq!(indices(&bytes), [0, 1, 2, 3]);
        let head = MAGIC.len() + SHA.len() + 1;
        let mut seen = 0;
        for end in 0..bytes.len() {
            let there = indices(&bytes[..end]);
            assert_eq!(there, (0..there.len() as u64).collect::<Vec<_>>());
            assert!(there.len() >= seen && there.len() < 4);
            seen = there.len();
            let whole = frames(&bytes[..end], SHA).unwrap().torn() == 0;
            let boundary = end <= head || indices(&bytes[..end]).len() > indices(&bytes[..end - 1]).len();
            assert_eq!(whole, boundary, "{end}");
        }
    }

    #[test]
    fn a_damaged_row_ends_the_piece() {
        let mut bytes = piece_of(4);
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        let there = indices(&bytes);
        assert!(there.len() < 4, "{there:?}");
        assert!(frames(&bytes, SHA).unwrap().torn() > 0);
    }

    #[test]
    fn a_piece_of_another_sweep_is_told_from_what_is_none() {
        let bytes = piece_of(1);
        let other = SHA.replace('0', "f");
        assert_eq!(frames(&bytes, &other).unwrap_err(), NotOurs::OtherSweep);
        assert_eq!(frames(b"hello", SHA).unwrap_err(), NotOurs::NoPiece);
    }
}

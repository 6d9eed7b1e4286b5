//! A part of the table of a study: the rows of a range of samples, complete and never changed again.
//!
//! It is a Parquet file with the columns of the whole table, and so is `results.parquet`. The last entry of its metadata,
//! `occupant.part`, says in JSON what it is a part of. It begins with two CRC-32: of the whole file, and of its end from the
//! metadata on; both take the digits of both as zeros. So the description is believed without a look at the rows.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};

use serde::{Deserialize, Serialize};

use super::census::Census;
use super::folder::Folder;
use super::manifest::Manifest;
use super::problem::Problem;
use super::row::Row;
use crate::base::{Failure, PartialFile, each_portion};
use crate::files::store::Store;
use occupant_files::table::StoredTable;

/// Name of the metadata with the description.
pub const ABOUT: &str = "occupant.part";
/// Text before each checksum in the file, and its digits before it is known.
const MARKS: [&str; 2] = ["{\"crc32\":\"", "\",\"end_crc32\":\""];
const UNKNOWN: &str = "00000000";
/// Longest end of a file, bytes.
const MOST_OF_END: u64 = 256 << 20;
/// Bytes behind the metadata of a Parquet file: its length and the file's mark.
const TAIL: u64 = 8;
/// Bytes fetched at a time.
const AT_ONCE: u64 = 8 << 20;
/// Bytes of the end of a part in a store that are fetched at first: more than most ends have.
const USUAL_END: u64 = 256 << 10;
/// Number of ends fetched at a time.
const ENDS_AT_ONCE: usize = 32;

/// What a part says of itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct About {
    crc32: String,
    end_crc32: String,
    /// Identity of the study: [`super::Manifest::identity`].
    pub study: String,
    /// Identity of the build that wrote it.
    pub build: String,
    /// First sample.
    pub first: u64,
    /// Last sample.
    pub last: u64,
    /// SHA-256 of the whole runs that were kept of these samples, by name.
    pub runs: BTreeMap<String, String>,
    /// Outcomes of the runs.
    pub census: Census,
    /// Time of threads for all runs, s: [`Row::thread_time_s`].
    #[serde(alias = "wall_time_s")]
    pub thread_time_s: f64,
}

/// A part that is there.
#[derive(Clone, Debug)]
pub struct Part {
    /// Its path; of one in a store its address.
    pub path: PathBuf,
    /// Its description.
    pub about: About,
    stored: Option<Stored>,
    /// Set once all its bytes have been checked.
    checked: Arc<OnceLock<()>>,
}

/// Where a part in a store is.
#[derive(Clone, Debug)]
struct Stored {
    store: Store,
    name: String,
    size: u64,
    /// The folder of this machine that it is fetched to.
    to: PathBuf,
}

impl About {
    /// Description of the rows of these samples of a study, none seen yet.
    pub fn new(manifest: &Manifest, samples: &Range<u64>) -> Self {
        About {
            crc32: UNKNOWN.to_owned(),
            end_crc32: UNKNOWN.to_owned(),
            study: manifest.identity(),
            build: manifest.build.clone(),
            first: samples.start,
            last: samples.end.saturating_sub(1),
            runs: BTreeMap::new(),
            census: Census { planned: samples.end - samples.start, ..Census::default() },
            thread_time_s: 0.0,
        }
    }

    /// Counts a row; whether its figures are valid.
    pub fn see(&mut self, row: &Row) -> bool {
        self.thread_time_s += row.thread_time_s();
        self.census.see(row)
    }

    /// Its samples.
    pub fn samples(&self) -> Range<u64> {
        self.first..self.last + 1
    }

    /// The description at the end of a file, if that is whole and of this study.
    fn of_end(end: Option<End>, study: &str, path: &Path) -> Result<About, Problem> {
        let damaged = |found: &str| Problem::Damaged { path: path.to_owned(), found: found.to_owned() };
        let about = end.and_then(|end| end.about()).ok_or_else(|| damaged("was changed after it was written"))?;
        if about.study == study { Ok(about) } else { Err(damaged("is a part of another sweep")) }
    }
}

impl Part {
    /// The part with this name, by its description; none if there is no such file.
    ///
    /// # Errors
    /// A file that is no complete part, or one of another study; an error of the operating system.
    pub fn open(path: &Path, study: &str) -> Result<Option<Part>, Problem> {
        let mut file = match File::open(path) {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            opened => opened.map_err(Problem::io("read", path))?,
        };
        let end = End::read(&mut file).map_err(Problem::io("read", path))?;
        let about = About::of_end(end, study, path)?;
        Ok(Some(Part { path: path.to_owned(), about, stored: None, checked: Arc::default() }))
    }

    /// Parts with these names and sizes in a store, by their descriptions; one is fetched each time its rows are read.
    ///
    /// # Errors
    /// As [`Part::open`]; what the store says.
    pub fn in_store(
        folder: &Folder,
        store: &Store,
        listed: &[(String, u64)],
        study: &str,
    ) -> Result<Vec<Part>, Problem> {
        let mut parts = Vec::new();
        for some in listed.chunks(ENDS_AT_ONCE) {
            let tails = some.iter().map(|(name, size)| (name.as_str(), size.saturating_sub(USUAL_END)..*size));
            let tails = store
                .ranges(&tails.collect::<Vec<_>>())
                .map_err(|found| of_store(Path::new(store.address()), found))?;
            for ((name, size), tail) in some.iter().zip(tails) {
                let path = PathBuf::from(format!("{}/{name}", store.address()));
                let from = size.saturating_sub(tail.len() as u64);
                let read = |bytes: Range<u64>| match bytes.start.checked_sub(from) {
                    // a part that was replaced since it was listed has another length
                    Some(first) => tail
                        .get(first as usize..bytes.end.saturating_sub(from) as usize)
                        .map_or_else(|| Err(ErrorKind::UnexpectedEof.into()), |bytes| Ok(bytes.to_vec())),
                    None => store.range(name, bytes),
                };
                let end = End::of(*size, read).map_err(|found| of_store(&path, found))?;
                let about = About::of_end(end, study, &path)?;
                let stored = Stored { store: store.clone(), name: name.clone(), size: *size, to: folder.journal() };
                parts.push(Part { path, about, stored: Some(stored), checked: Arc::default() });
            }
        }
        Ok(parts)
    }

    /// Checks all bytes, once.
    ///
    /// # Errors
    /// A file that was changed; an error of the operating system.
    pub fn check(&self) -> Result<(), Problem> {
        if self.checked.get().is_none() {
            self.refuse_damage(&mut self.file()?)?;
        }
        Ok(())
    }

    fn refuse_damage(&self, file: &mut File) -> Result<(), Problem> {
        let mut crc32 = || End::read(file)?.map(|end| end.of_file(file)).transpose();
        if crc32().map_err(Problem::io("read", &self.path))?.as_ref() == Some(&self.about.crc32) {
            self.checked.get_or_init(|| ());
            return Ok(());
        }
        Err(Problem::Damaged { path: self.path.clone(), found: "was changed after it was written".to_owned() })
    }

    /// Passes the rows of a range on, in order, after the first look at all bytes.
    ///
    /// # Errors
    /// A file that was changed; an error of the operating system; what `see` says.
    pub fn each_row(
        &self,
        samples: &Range<u64>,
        see: &mut impl FnMut(Row) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let mut file = self.file()?;
        // each copy that is fetched is another
        if self.stored.is_some() || self.checked.get().is_none() {
            self.refuse_damage(&mut file)?;
        }
        let table = StoredTable::of(file).map_err(Problem::io("read", &self.path))?;
        let inputs = table.columns().skip(1).take_while(|name| *name != "status").count();
        let mut next = self.about.first;
        for (number, count) in table.groups().enumerate() {
            let group = next..next.saturating_add(count);
            next = group.end;
            if group.start >= samples.end || group.end <= samples.start {
                continue;
            }
            let rows = table.group(number).map_err(Problem::io("read", &self.path))?;
            for (index, cells) in group.zip(rows) {
                let row = Row::from_cells(cells, inputs).filter(|row| row.index == index);
                let row = row.ok_or_else(|| self.without_row())?;
                if samples.contains(&index) {
                    see(row)?;
                }
            }
        }
        if next == self.about.samples().end { Ok(()) } else { Err(self.without_row().into()) }
    }

    /// The file to read: its own, or one fetched from its store, which no other reader sees.
    fn file(&self) -> Result<File, Problem> {
        let Some(Stored { store, name, size, to }) = &self.stored else {
            return File::open(&self.path).map_err(Problem::io("read", &self.path));
        };
        let mut file = unnamed(to).map_err(Problem::io("write in", to))?;
        for from in (0..*size).step_by(AT_ONCE as usize) {
            let bytes = store.range(name, from..(from + AT_ONCE).min(*size));
            let bytes = bytes.map_err(|found| of_store(&self.path, found))?;
            file.write_all(&bytes).map_err(Problem::io("write in", to))?;
        }
        Ok(file)
    }

    fn without_row(&self) -> Problem {
        Problem::Damaged { path: self.path.clone(), found: "has other rows than it says".to_owned() }
    }
}

fn of_store(address: &Path, found: io::Error) -> Problem {
    Problem::Store { address: address.display().to_string(), found }
}

/// A new file in a folder, without a name: it is gone when it is closed, also by a process that is killed.
fn unnamed(folder: &Path) -> io::Result<File> {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    fs::create_dir_all(folder)?;
    loop {
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let path = folder.join(format!("{}.{number}.fetched", std::process::id()));
        match OpenOptions::new().read(true).write(true).create_new(true).open(&path) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            opened => return opened.and_then(|file| fs::remove_file(&path).map(|()| file)),
        }
    }
}

/// The end of a Parquet file from its metadata on, and where it begins.
struct End {
    from: u64,
    bytes: Vec<u8>,
}

impl End {
    /// Reads it; none of a file that has none.
    fn read(file: &mut File) -> io::Result<Option<End>> {
        End::of(file.metadata()?.len(), |bytes| {
            file.seek(SeekFrom::Start(bytes.start))?;
            let mut read = Vec::new();
            file.take(bytes.end - bytes.start).read_to_end(&mut read)?;
            Ok(read)
        })
    }

    /// The same of a file of so many bytes, some of which `read` gives.
    fn of(length: u64, mut read: impl FnMut(Range<u64>) -> io::Result<Vec<u8>>) -> io::Result<Option<End>> {
        let Some(at) = length.checked_sub(TAIL) else { return Ok(None) };
        let tail = read(at..length)?;
        let Ok([a, b, c, d, mark @ ..]) = <[u8; TAIL as usize]>::try_from(tail) else { return Ok(None) };
        let size = u64::from(u32::from_le_bytes([a, b, c, d])) + TAIL;
        if mark != *b"PAR1" || size > length || size > MOST_OF_END {
            return Ok(None);
        }
        let from = length - size;
        Ok(Some(End { from, bytes: read(from..length)? }))
    }

    /// Places of the digits of both checksums, of the file first.
    fn places(&self) -> Option<[Range<usize>; 2]> {
        let [first, second] = MARKS.map(str::as_bytes);
        let is_mark = |at: &usize| self.bytes[*at..].starts_with(first);
        let begin = (0..self.bytes.len()).rev().find(is_mark)? + first.len();
        let of_file = begin..begin + UNKNOWN.len();
        let begin = of_file.end + second.len();
        (self.bytes.get(of_file.end..begin)? == second).then_some([of_file, begin..begin + UNKNOWN.len()])
    }

    /// The bytes with zeros for both checksums.
    fn without_sums(&self) -> Option<Vec<u8>> {
        let mut bytes = self.bytes.clone();
        for place in self.places()? {
            bytes.get_mut(place)?.copy_from_slice(UNKNOWN.as_bytes());
        }
        Some(bytes)
    }

    /// The description, if the end is as it was written.
    fn about(&self) -> Option<About> {
        let [of_file, _] = self.places()?;
        let text = self.bytes.get(of_file.start - MARKS[0].len()..)?;
        let about: About = serde_json::Deserializer::from_slice(text).into_iter().next()?.ok()?;
        let is_ours = about.first <= about.last && about.last < u64::MAX;
        (is_ours && about.end_crc32 == self.crc32()?).then_some(about)
    }

    fn crc32(&self) -> Option<String> {
        self.without_sums().map(|bytes| format!("{:08x}", crc32fast::hash(&bytes)))
    }

    /// Checksum of the whole file.
    fn of_file(&self, file: &mut File) -> io::Result<String> {
        let mut hash = crc32fast::Hasher::new();
        file.rewind()?;
        each_portion(&mut file.take(self.from), |bytes| hash.update(bytes))?;
        hash.update(&self.without_sums().unwrap_or_default());
        Ok(format!("{:08x}", hash.finalize()))
    }
}

/// Writes the checksums into a file that is complete but for them.
///
/// # Errors
/// An error of the operating system; a file without description.
pub fn seal(file: &mut PartialFile) -> io::Result<()> {
    file.flush()?;
    let mut written = File::open(file.partial_path())?;
    let end = End::read(&mut written)?.ok_or(ErrorKind::InvalidData)?;
    let sums = [end.of_file(&mut written)?, end.crc32().ok_or(ErrorKind::InvalidData)?];
    for (place, sum) in end.places().ok_or(ErrorKind::InvalidData)?.into_iter().zip(sums) {
        file.seek(SeekFrom::Start(end.from + place.start as u64))?;
        file.write_all(sum.as_bytes())?;
    }
    file.seek(SeekFrom::End(0)).map(|_| ())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::base::Existing;
    use crate::files::study_folder::manifest::{Column, Manifest, Role};
    use crate::files::study_folder::row::tests::row;
    use crate::files::study_folder::table::StudyTable;
    use occupant_files::table::Form;

    /// A part of samples 3 to 42, whose rows are those of [`row`].
    fn part() -> (tempfile::TempDir, PathBuf, String) {
        let there = tempfile::tempdir().unwrap();
        let mut manifest = Manifest::new("occupant 1".to_owned(), String::new(), 100, Vec::new());
        let column = |name: &str, role| Column { name: name.to_owned(), unit: "1".to_owned(), role };
        let roles = [("input.a", Role::Input), ("input.b", Role::Input), ("input.c", Role::InputText)];
        manifest.columns.extend(roles.map(|(name, role)| column(name, role)));
        manifest.columns.push(column("{\"crc32\":\"", Role::Figure));
        let path = there.path().join("3-42.parquet");
        let mut table = StudyTable::create([(path.clone(), Form::Parquet)], Existing::Replace, &manifest).unwrap();
        let mut about = About::new(&manifest, &(3..43));
        for index in 3..43 {
            about.see(&row(index));
            table.row(&row(index)).unwrap();
        }
        table.publish_part(&about).unwrap();
        (there, path, manifest.identity())
    }

    fn read(path: &Path, study: &str) -> Result<Vec<Row>, String> {
        let part = Part::open(path, study).map_err(|e| e.to_string())?.ok_or("none")?;
        let mut rows = Vec::new();
        let read = part.each_row(&(0..100), &mut |row| {
            rows.push(row);
            Ok(())
        });
        read.map(|()| rows).map_err(Failure::words)
    }

    #[test]
    fn a_part_holds_its_rows_to_the_bit_and_what_they_are_of() {
        let (_there, path, study) = part();
        assert_eq!(read(&path, &study).unwrap(), (3..43).map(row).collect::<Vec<_>>());
        let part = Part::open(&path, &study).unwrap().unwrap();
        part.check().unwrap();
        assert_eq!(part.about.samples(), 3..43);
        assert_eq!((part.about.census.planned, part.about.census.finished()), (40, 40));
        assert_eq!(part.about.thread_time_s, 10.0);
        assert!(Part::open(&path, "other").unwrap_err().to_string().contains("another sweep"));
        assert!(Part::open(&path.with_extension("none"), &study).unwrap().is_none());
    }

    #[test]
    fn any_changed_byte_and_any_cut_is_noticed() {
        let (_there, path, study) = part();
        let whole = fs::read(&path).unwrap();
        for at in 0..whole.len() {
            let mut other = whole.clone();
            other[at] ^= 1 << (at % 8);
            fs::write(&path, &other).unwrap();
            assert!(read(&path, &study).is_err(), "byte {at} of {}", whole.len());
        }
        for at in (0..whole.len()).step_by(7) {
            fs::write(&path, &whole[..at]).unwrap();
            assert!(read(&path, &study).is_err(), "cut at {at}");
        }
    }
}

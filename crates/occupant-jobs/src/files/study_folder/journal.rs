//! What a study has of finished samples: parts of its table, the table itself, and journals of blocks that are computed.
//!
//! Of a sample that stands in two parts the first counts. Journals are read where no part is.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::block::Block;
use super::census::Census;
use super::checksums::Checksums;
use super::finished::Finished;
use super::folder::{Folder, names_in};
use super::manifest::Manifest;
use super::part::Part;
use super::piece;
use super::problem::Problem;
use super::row::Row;
use crate::base::{Failure, FileProblem};

/// Number of samples read at a time from journals.
const AT_ONCE: u64 = 2048;

/// Index of finished rows, which stay on disk.
#[derive(Clone, Debug)]
pub struct Journal {
    study: String,
    samples: u64,
    /// By their first samples; of equal ones the longer first.
    parts: Vec<Part>,
    pieces: Vec<Piece>,
    /// The finished samples.
    pub finished: Finished,
    /// Number of truncated rows, left by killed processes.
    pub torn: usize,
}

#[derive(Clone, Debug)]
struct Piece {
    path: PathBuf,
    /// From the smallest sample to one past the largest.
    samples: Range<u64>,
}

/// Whether a file of the folder holds rows of this study, whatever its manifest says.
///
/// # Errors
/// An error of the operating system.
pub fn is_named_by_rows(folder: &Folder, manifest: &Manifest) -> Result<bool, Problem> {
    let study = manifest.identity();
    let is_part = |path: &PathBuf| matches!(Part::open(path, &study), Ok(Some(_)));
    let mut pieces = paths_in(&folder.journal(), ".rows")?.into_iter();
    Ok(is_part(&folder.parquet())
        || pieces.any(|path| piece::is_of(&path, &study))
        || paths_in(&folder.parts(), ".parquet")?.iter().any(is_part))
}

/// Files of a folder with this ending; none of a folder that is not there.
fn paths_in(folder: &Path, ending: &str) -> Result<Vec<PathBuf>, Problem> {
    let names = if folder.exists() { names_in(folder)? } else { Vec::new() };
    Ok(names.iter().filter(|name| name.ends_with(ending)).map(|name| folder.join(name)).collect())
}

impl Journal {
    fn none(manifest: &Manifest) -> Self {
        Journal {
            study: manifest.identity(),
            samples: manifest.samples,
            parts: Vec::new(),
            pieces: Vec::new(),
            finished: Finished::none(manifest.samples),
            torn: 0,
        }
    }

    /// Reads with `read`. Damaged files of a claimed folder are set aside and returned: their samples are unfinished.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn mend(
        folder: &Folder,
        sums: &Checksums,
        read: impl Fn() -> Result<Journal, Problem>,
    ) -> Result<(Self, Vec<PathBuf>), Problem> {
        let mut aside: Vec<PathBuf> = sums.damaged();
        aside.retain(|path| path.starts_with(folder.journal()) || *path == folder.parquet());
        aside.iter().try_for_each(|path| sums.put_aside(path))?;
        loop {
            match read().and_then(Journal::checked) {
                Err(Problem::Damaged { path, .. }) => {
                    sums.put_aside(&path)?;
                    aside.push(path);
                }
                read => return read.map(|journal| (journal, aside)),
            }
        }
    }

    /// The same after a look at all bytes of all parts.
    fn checked(self) -> Result<Self, Problem> {
        self.parts.iter().try_for_each(Part::check)?;
        Ok(self)
    }

    /// Adds checksums of the journal files of a block that has ended.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn list(folder: &Folder, block: &Block, sums: &Checksums) -> Result<(), Problem> {
        let pieces = piece::pieces_of(folder, block).into_iter();
        pieces.filter(|piece| !sums.holds(piece)).try_for_each(|piece| sums.add(&piece))
    }

    /// Reads what there is of a block alone. The files of its neighbours are not touched.
    ///
    /// # Errors
    /// As [`Journal::read`].
    pub fn of_block(folder: &Folder, manifest: &Manifest, block: &Block) -> Result<Self, Problem> {
        let mut journal = Journal::none(manifest);
        journal.add_part(&folder.part(block))?;
        piece::pieces_of(folder, block).into_iter().try_for_each(|path| journal.add_piece(path))?;
        Ok(journal.in_order())
    }

    /// Reads folders that contain parts of one sweep: the table, if it has all samples, or else everything.
    ///
    /// # Errors
    /// An error of the operating system; a file that is no part or piece, or of another sweep.
    pub fn read(folders: &[Folder], manifest: &Manifest) -> Result<Self, Problem> {
        let mut journal = Journal::none(manifest);
        journal.add_tables(folders, manifest)?;
        if !journal.finished.is_full() {
            journal.add_parts(folders)?;
        }
        Ok(journal.in_order())
    }

    /// As [`Journal::read`], with the table only where no part is: to make it again.
    ///
    /// # Errors
    /// As [`Journal::read`].
    pub fn read_parts(folders: &[Folder], manifest: &Manifest) -> Result<Self, Problem> {
        let mut journal = Journal::none(manifest);
        journal.add_parts(folders)?;
        if !journal.finished.is_full() {
            journal.add_tables(folders, manifest)?;
        }
        Ok(journal.in_order())
    }

    /// Pieces before parts: a block that ends meanwhile has its rows in one of the two.
    fn add_parts(&mut self, folders: &[Folder]) -> Result<(), Problem> {
        for folder in folders {
            paths_in(&folder.journal(), ".rows")?.into_iter().try_for_each(|path| self.add_piece(path))?;
        }
        for folder in folders {
            folder.stored_parts(&self.study)?.into_iter().try_for_each(|part| self.take(part))?;
            let parts = paths_in(&folder.parts(), ".parquet")?;
            parts.iter().try_for_each(|path| self.add_part(path))?;
        }
        Ok(())
    }

    /// Tables of form 2 describe no part, and their journals hold the same rows.
    fn add_tables(&mut self, folders: &[Folder], manifest: &Manifest) -> Result<(), Problem> {
        let mut tables = folders.iter().map(Folder::parquet).filter(|_| manifest.form > 2);
        tables.try_for_each(|path| self.add_part(&path))
    }

    fn add_part(&mut self, path: &Path) -> Result<(), Problem> {
        Part::open(path, &self.study)?.map_or(Ok(()), |part| self.take(part))
    }

    fn take(&mut self, part: Part) -> Result<(), Problem> {
        if part.about.last >= self.samples {
            let found = format!("has samples beyond the study's {}", self.samples);
            return Err(Problem::Damaged { path: part.path, found });
        }
        self.finished.add(part.about.samples());
        self.parts.push(part);
        Ok(())
    }

    fn add_piece(&mut self, path: PathBuf) -> Result<(), Problem> {
        let (rows, torn) = match piece::read(&path, &self.study, self.samples) {
            // its block has ended meanwhile
            Err(problem) if is_gone(&problem) => return Ok(()),
            read => read?,
        };
        self.torn += usize::from(torn);
        let indices = || rows.iter().map(|row| row.index);
        indices().for_each(|index| self.finished.add(index..index + 1));
        if let (Some(least), Some(greatest)) = (indices().min(), indices().max()) {
            self.pieces.push(Piece { path, samples: least..greatest + 1 });
        }
        Ok(())
    }

    fn in_order(mut self) -> Self {
        self.pieces.sort_by_key(|piece| piece.samples.start);
        self.parts.sort_by_key(|part| (part.about.first, Reverse(part.about.last)));
        let mut end = 0;
        // one whose samples all stand in those before is not read
        self.parts.retain(|part| {
            let counts = part.about.samples().end > end;
            end = end.max(part.about.samples().end);
            counts
        });
        self
    }

    /// The only part, if it has all rows that are there.
    pub fn only_part(&self) -> Option<&Part> {
        match (&self.parts[..], &self.pieces[..]) {
            ([part], []) => Some(part),
            ([part], pieces) => pieces.iter().all(|p| contains(&part.about.samples(), &p.samples)).then_some(part),
            _ => None,
        }
    }

    /// Hashes of whole runs that parts in a folder have kept.
    pub fn runs_in(&self, folder: &Folder) -> impl Iterator<Item = (&String, &String)> {
        let parts = self.parts.iter().filter(|part| part.path.starts_with(&folder.path));
        parts.flat_map(|part| &part.about.runs)
    }

    /// Outcomes of the finished samples and the time of threads for them in s: from the descriptions of parts where these count as a whole.
    ///
    /// # Errors
    /// As [`Journal::each_row`].
    pub fn census(&self) -> Result<(Census, f64), Failure> {
        let (mut census, mut spent_s) = (Census { planned: self.samples, ..Census::default() }, 0.0);
        for (part, samples) in self.stretches() {
            match part {
                Some(part) if part.about.samples() == samples => {
                    census.add(&part.about.census);
                    spent_s += part.about.thread_time_s;
                }
                part => self.each_row_of(part, &samples, &mut |row| {
                    census.see(&row);
                    spent_s += row.thread_time_s();
                    Ok(())
                })?,
            }
        }
        Ok((census, spent_s))
    }

    /// Passes all rows on in the order of their samples, read in portions of bounded memory. Duplicate results of a
    /// sample in journals must agree.
    ///
    /// # Errors
    /// Results that disagree; a part that was changed; an error of the operating system; what `see` says.
    pub fn each_row(&self, mut see: impl FnMut(Row) -> Result<(), Failure>) -> Result<(), Failure> {
        let mut stretches = self.stretches().into_iter();
        stretches.try_for_each(|(part, samples)| self.each_row_of(part, &samples, &mut see))
    }

    /// Rows of the finished samples of a range, in order.
    ///
    /// # Errors
    /// As [`Journal::each_row`].
    pub fn rows(&self, range: Range<u64>) -> Result<Vec<Row>, Failure> {
        let mut rows = Vec::new();
        for (part, samples) in self.stretches() {
            let samples = samples.start.max(range.start)..samples.end.min(range.end);
            self.each_row_of(part, &samples, &mut |row| {
                rows.push(row);
                Ok(())
            })?;
        }
        Ok(rows)
    }

    /// All samples in order: those of a part, and those between parts, of which journals may have some.
    fn stretches(&self) -> Vec<(Option<&Part>, Range<u64>)> {
        let (mut stretches, mut next) = (Vec::new(), 0);
        for part in &self.parts {
            let samples = part.about.samples();
            let begin = samples.start.max(next);
            stretches.push((None, next..begin));
            stretches.push((Some(part), begin..samples.end));
            next = samples.end;
        }
        stretches.push((None, next..self.samples));
        stretches.retain(|(_, samples)| !samples.is_empty());
        stretches
    }

    fn each_row_of(
        &self,
        part: Option<&Part>,
        samples: &Range<u64>,
        see: &mut impl FnMut(Row) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        if samples.is_empty() {
            return Ok(());
        }
        if let Some(part) = part {
            return part.each_row(samples, see);
        }
        let mut starts = samples.clone().step_by(AT_ONCE as usize);
        starts.try_for_each(|start| {
            let portion = start..samples.end.min(start + AT_ONCE);
            self.rows_of_pieces(portion)?.into_iter().try_for_each(&mut *see)
        })
    }

    fn rows_of_pieces(&self, range: Range<u64>) -> Result<Vec<Row>, Failure> {
        let mut found: BTreeMap<u64, (Row, &Path)> = BTreeMap::new();
        let overlapping = |p: &&Piece| p.samples.start < range.end && range.start < p.samples.end;
        for piece in self.pieces.iter().filter(overlapping) {
            for row in self.rows_of(piece, &range)?.into_iter().filter(|row| range.contains(&row.index)) {
                let index = row.index;
                match found.get(&index) {
                    Some((there, first)) if !there.agrees(&row) => {
                        let (first, second) = (first.to_path_buf(), piece.path.clone());
                        return Err(Problem::Disagree { index, first, second }.into());
                    }
                    Some(_) => {}
                    None => _ = found.insert(index, (row, &piece.path)),
                }
            }
        }
        Ok(found.into_values().map(|(row, _)| row).collect())
    }

    /// Rows of a piece; if its block has ended meanwhile, the same rows from what that has become.
    fn rows_of(&self, piece: &Piece, range: &Range<u64>) -> Result<Vec<Row>, Failure> {
        match piece::read(&piece.path, &self.study, self.samples) {
            Err(problem) if is_gone(&problem) => {
                let mut rows = Vec::new();
                let part = self.successor(piece)?.ok_or(problem)?;
                part.each_row(range, &mut |row| {
                    rows.push(row);
                    Ok(())
                })?;
                Ok(rows)
            }
            read => Ok(read?.0),
        }
    }

    /// The part, or the table, that a journal file has become.
    fn successor(&self, piece: &Piece) -> Result<Option<Part>, Problem> {
        let folder = piece.path.parent().and_then(Path::parent).map(Folder::at);
        let block = piece.path.file_name().and_then(|name| Block::of_file(&name.to_string_lossy()));
        let (Some(folder), Some(block)) = (folder, block) else { return Ok(None) };
        match Part::open(&folder.part(&block), &self.study)? {
            None => Part::open(&folder.parquet(), &self.study),
            part => Ok(part),
        }
    }
}

fn contains(outer: &Range<u64>, inner: &Range<u64>) -> bool {
    outer.start <= inner.start && inner.end <= outer.end
}

fn is_gone(problem: &Problem) -> bool {
    matches!(problem, Problem::File(FileProblem::Io { source, .. }) if source.kind() == ErrorKind::NotFound)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::super::part::About;
    use super::super::piece::JournalWriter;
    use super::super::table::StudyTable;
    use super::*;
    use crate::base::Existing;
    use crate::files::study_folder::manifest::{Column, Role};
    use crate::files::study_folder::row::tests::row;
    use occupant_files::table::Form;

    fn manifest(samples: u64) -> Manifest {
        let mut manifest = Manifest::new("occupant 1".to_owned(), String::new(), samples, Vec::new());
        manifest.study = "study".to_owned();
        for (name, role) in [("a", Role::Figure), ("b", Role::Figure), ("c", Role::InputText), ("d", Role::Figure)] {
            manifest.columns.push(Column { name: name.to_owned(), unit: "1".to_owned(), role });
        }
        manifest.columns.sort_by_key(|column| column.role == Role::Figure);
        manifest
    }

    /// A row whose cells fit the columns.
    fn fitting(index: u64) -> Row {
        let mut row = row(index);
        row.cells.swap(0, 2);
        row
    }

    fn folder() -> (tempfile::TempDir, Folder) {
        let there = tempfile::tempdir().unwrap();
        let folder = Folder::at(there.path());
        [folder.journal(), folder.parts()].iter().for_each(|path| fs::create_dir(path).unwrap());
        (there, folder)
    }

    fn block(samples: Range<u64>) -> Block {
        Block::new(samples).unwrap()
    }

    fn journal(folder: &Folder, manifest: &Manifest, samples: Range<u64>) -> PathBuf {
        let mut writer = JournalWriter::new(folder, &manifest.identity(), &block(samples.clone()));
        samples.clone().for_each(|i| writer.append(&fitting(i)).unwrap());
        writer.close().unwrap();
        piece::pieces_of(folder, &block(samples)).pop().unwrap()
    }

    fn part(path: PathBuf, manifest: &Manifest, samples: Range<u64>) {
        let mut table = StudyTable::create([(path, Form::Parquet)], Existing::Replace, manifest).unwrap();
        let mut about = About::new(manifest, &samples);
        for index in samples {
            about.see(&fitting(index));
            table.row(&fitting(index)).unwrap();
        }
        table.publish_part(&about).unwrap();
    }

    fn read(folder: &Folder, manifest: &Manifest) -> Result<Journal, String> {
        Journal::read(std::slice::from_ref(folder), manifest).map_err(|e| e.to_string())
    }

    fn rows(journal: &Journal) -> Vec<Row> {
        let mut rows = Vec::new();
        let read = journal.each_row(|row| {
            rows.push(row);
            Ok(())
        });
        read.unwrap();
        rows
    }

    #[test]
    fn cut_off_anywhere_a_piece_holds_the_rows_before() {
        let (_there, folder) = folder();
        let manifest = manifest(4);
        let piece = journal(&folder, &manifest, 0..4);
        let bytes = fs::read(&piece).unwrap();
        let mut seen = 0;
        for end in 0..bytes.len() {
            fs::write(&piece, &bytes[..end]).unwrap();
            let found = read(&folder, &manifest).unwrap();
            let rows = found.rows(0..4).unwrap();
            let expected: Vec<Row> = (0..rows.len() as u64).map(fitting).collect();
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
        let (_there, folder) = folder();
        let manifest = manifest(4);
        let piece = journal(&folder, &manifest, 0..4);
        let mut other = manifest.clone();
        other.study = "other".to_owned();
        assert!(read(&folder, &other).unwrap_err().contains("another sweep's"));
        let text = fs::read_to_string(&piece).unwrap();
        fs::write(&piece, text.replacen("\"index\":1", "\"index\":9", 1)).unwrap();
        assert!(read(&folder, &manifest).unwrap_err().contains("of another sweep in line 3"));
        fs::write(&piece, text.replacen(":0.25", ":0.26", 1)).unwrap();
        assert!(read(&folder, &manifest).unwrap_err().contains("in line 2"), "a digit that is another one is noticed");
        fs::write(&piece, "occupant rows 1\nhello\n").unwrap();
        assert!(read(&folder, &manifest).unwrap_err().contains("not a piece of a journal"));
    }

    #[test]
    fn parts_that_overlap_gaps_and_journals_are_one_row_of_samples() {
        let (_there, folder) = folder();
        let manifest = manifest(100);
        for samples in [0..30, 10..20, 25..40, 60..70, 60..65] {
            part(folder.part(&block(samples.clone())), &manifest, samples);
        }
        journal(&folder, &manifest, 38..50);
        journal(&folder, &manifest, 69..75);
        let found = read(&folder, &manifest).unwrap();
        let there: Vec<u64> = (0..50).chain(60..75).collect();
        assert_eq!(found.finished.gaps(0..100), [50..60, 75..100]);
        assert_eq!(rows(&found), there.iter().map(|i| fitting(*i)).collect::<Vec<_>>());
        assert_eq!(
            found.rows(39..62).unwrap(),
            [39..50, 60..62].into_iter().flatten().map(fitting).collect::<Vec<_>>()
        );
        let (census, spent_s) = found.census().unwrap();
        let mut counted = Census { planned: 100, ..Census::default() };
        rows(&found).iter().for_each(|row| _ = counted.see(row));
        assert_eq!((census, spent_s), (counted, 0.25 * there.len() as f64));
        assert!(found.only_part().is_none());
    }

    #[test]
    fn a_whole_table_is_read_alone_and_left_out_to_make_it_again() {
        let (_there, folder) = folder();
        let manifest = manifest(20);
        part(folder.parquet(), &manifest, 0..20);
        fs::write(folder.part(&block(0..20)), "garbage").unwrap();
        let found = read(&folder, &manifest).unwrap();
        assert_eq!(found.only_part().unwrap().path, folder.parquet());
        assert_eq!(rows(&found).len(), 20);
        let again = Journal::read_parts(std::slice::from_ref(&folder), &manifest);
        assert!(again.unwrap_err().to_string().contains("was changed after it was written"));
    }

    #[test]
    fn a_block_that_ends_while_it_is_read_is_read_from_its_part() {
        let (_there, folder) = folder();
        let manifest = manifest(20);
        let piece = journal(&folder, &manifest, 5..9);
        let found = read(&folder, &manifest).unwrap();
        part(folder.part(&block(5..9)), &manifest, 5..9);
        fs::remove_file(piece).unwrap();
        assert_eq!(rows(&found), (5..9).map(fitting).collect::<Vec<_>>());
    }

    /// As on a file system without locks.
    #[test]
    fn two_writers_of_one_block_have_files_of_their_own_and_their_rows_count_once() {
        let (_there, folder) = folder();
        let (manifest, block) = (manifest(9), block(3..9));
        let mut writers = [0, 1].map(|_| JournalWriter::new(&folder, &manifest.identity(), &block));
        for index in 3..9 {
            writers.iter_mut().for_each(|writer| writer.append(&fitting(index)).unwrap());
        }
        writers.into_iter().for_each(|writer| writer.close().unwrap());
        assert_eq!(piece::pieces_of(&folder, &block).len(), 2);
        let found = Journal::of_block(&folder, &manifest, &block).unwrap();
        assert_eq!(rows(&found), (3..9).map(fitting).collect::<Vec<_>>());
        folder.clear_block(&block).unwrap();
        assert!(piece::pieces_of(&folder, &block).is_empty());
    }
}

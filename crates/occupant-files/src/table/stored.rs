//! Tables of this program read back from Parquet, a group of rows at a time.

use std::fs::File;
use std::io;
use std::path::Path;

use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::{ByteArray, DataType};
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};
use parquet::file::statistics::Statistics;

use super::{Cell, ROWS, invalid, reason};

/// A table that [`super::Table`] has written as Parquet.
pub struct StoredTable(SerializedFileReader<File>);

impl StoredTable {
    /// Reads what the end of the file says of it.
    ///
    /// # Errors
    /// An error of the operating system; a file that is no table.
    pub fn open(path: &Path) -> io::Result<Self> {
        StoredTable::of(File::open(path)?)
    }

    /// The same of an open file.
    ///
    /// # Errors
    /// As [`StoredTable::open`].
    pub fn of(file: File) -> io::Result<Self> {
        Ok(StoredTable(SerializedFileReader::new(file).map_err(reason)?))
    }

    /// Names of the columns.
    pub fn columns(&self) -> impl Iterator<Item = &str> {
        self.0.metadata().file_metadata().schema_descr().columns().iter().map(|column| column.name())
    }

    /// Number of rows of each group.
    pub fn groups(&self) -> impl Iterator<Item = u64> {
        self.0.metadata().row_groups().iter().map(|group| group.num_rows().max(0) as u64)
    }

    /// The rows of a group.
    ///
    /// # Errors
    /// An error of the operating system; a group that is none of a table of this program.
    pub fn group(&self, number: usize) -> io::Result<Vec<Vec<Cell>>> {
        let group = self.0.get_row_group(number).map_err(reason)?;
        let count = group.metadata().num_rows();
        let count = usize::try_from(count).ok().filter(|count| *count <= ROWS[1]);
        let count = count.ok_or_else(|| invalid(format!("a group of more than {} rows", ROWS[1])))?;
        let mut rows = vec![Vec::with_capacity(group.num_columns()); count];
        for column in 0..group.num_columns() {
            read(group.as_ref(), column, &mut rows).map_err(reason)?;
        }
        Ok(rows)
    }
}

/// Adds the cells of a column to rows.
fn read(group: &dyn RowGroupReader, column: usize, rows: &mut [Vec<Cell>]) -> Result<(), ParquetError> {
    let about = group.metadata().column(column);
    let lacks = about.column_descr().max_def_level() > 0;
    // a column of which nothing is there needs no reading
    if about.statistics().and_then(Statistics::null_count_opt) == Some(rows.len() as u64) && lacks {
        rows.iter_mut().for_each(|row| row.push(Cell::Absent));
        return Ok(());
    }
    match group.get_column_reader(column)? {
        ColumnReader::Int64ColumnReader(reader) => take(reader, lacks, rows, |n| Ok(Cell::Number(n as f64))),
        ColumnReader::DoubleColumnReader(reader) => take(reader, lacks, rows, |x| Ok(Cell::Number(x))),
        ColumnReader::ByteArrayColumnReader(reader) => {
            take(reader, lacks, rows, |text: ByteArray| text.as_utf8().map(Cell::text))
        }
        _ => Err(ParquetError::General(format!("column {column} is of a type that no table has"))),
    }
}

fn take<T: DataType>(
    mut reader: ColumnReaderImpl<T>,
    lacks: bool,
    rows: &mut [Vec<Cell>],
    cell: impl Fn(T::T) -> Result<Cell, ParquetError>,
) -> Result<(), ParquetError> {
    let (mut values, mut levels, mut seen) = (Vec::with_capacity(rows.len()), Vec::new(), 0);
    while seen < rows.len() {
        let more = reader.read_records(rows.len() - seen, lacks.then_some(&mut levels), None, &mut values)?.0;
        if more == 0 {
            return Err(ParquetError::General(format!("{seen} values in a column of {} rows", rows.len())));
        }
        seen += more;
    }
    let mut values = values.into_iter();
    for (i, row) in rows.iter_mut().enumerate() {
        let there = !lacks || levels.get(i).is_some_and(|level| *level > 0);
        let value = if there { values.next() } else { None };
        row.push(value.map_or(Ok(Cell::Absent), &cell)?);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::super::{Form, Kind, TableFile};
    use super::*;
    use crate::base::Existing;

    fn written(folder: &Path, rows: &[Vec<Cell>]) -> PathBuf {
        let columns = [
            ("index", Kind::Count),
            ("x", Kind::MaybeNumber),
            ("none", Kind::MaybeNumber),
            ("word", Kind::Text),
            ("more", Kind::MaybeText),
            ("time", Kind::Number),
        ];
        let path = folder.join("table.parquet");
        let mut table = TableFile::create(path, Form::Parquet, Existing::Replace, &columns, &[]).unwrap();
        rows.iter().for_each(|row| table.row(row.clone()).unwrap());
        table.publish().unwrap()
    }

    #[test]
    fn a_table_is_read_back_to_the_bit_group_by_group() {
        let there = tempfile::tempdir().unwrap();
        let row = |i: u64| {
            let x = f64::from_bits(i.wrapping_mul(0x9e37_79b9_7f4a_7c15));
            let more = if i.is_multiple_of(2) { Cell::Absent } else { Cell::text("ä, \"b\"\nc") };
            let x = if i.is_multiple_of(5) { Cell::Absent } else { Cell::finite(x) };
            vec![Cell::count(i), x, Cell::Absent, Cell::text(&i.to_string()), more, Cell::Number(-0.0)]
        };
        let rows: Vec<_> = (0..40_000).map(row).collect();
        let table = StoredTable::open(&written(there.path(), &rows)).unwrap();
        assert_eq!(table.columns().collect::<Vec<_>>(), ["index", "x", "none", "word", "more", "time"]);
        assert!(table.groups().count() > 1);
        let read: Vec<_> = (0..table.groups().count()).flat_map(|i| table.group(i).unwrap()).collect();
        let bits = |rows: &[Vec<Cell>]| format!("{rows:?}");
        assert!(bits(&read) == bits(&rows), "other rows");
    }

    #[test]
    fn an_empty_table_and_what_is_none_are_told_apart() {
        let there = tempfile::tempdir().unwrap();
        let path = written(there.path(), &[]);
        assert_eq!(StoredTable::open(&path).unwrap().groups().count(), 0);
        std::fs::write(&path, "PAR1").unwrap();
        assert!(StoredTable::open(&path).is_err());
    }
}

//! One sample's line of the table, and its bytes in the journal.

use occupant_study::ending::Ending;
use occupant_study::engine::Finished;

use crate::files::table::Cell;

/// How a sample ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Status {
    /// At its end time.
    Completed,
    /// The integration failed.
    Failed,
    /// The scenario of the sample is refused: nothing was run.
    Refused,
    /// The program broke off: a defect.
    Broken,
}

impl Status {
    /// All of them; the position is the byte in the journal.
    const ALL: [Status; 4] = [Status::Completed, Status::Failed, Status::Refused, Status::Broken];

    /// The word in the table.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Status::Completed => "completed",
            Status::Failed => "failed",
            Status::Refused => "refused",
            Status::Broken => "broken",
        }
    }
}

/// One sample's line of the table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Row {
    /// Number of the sample, from 0.
    pub(crate) index: u64,
    /// How it ended.
    pub(crate) status: Status,
    /// Why, where it did not complete; else empty.
    pub(crate) reason: String,
    /// Values, by [`super::manifest::Column`]: inputs, then figures.
    pub(crate) cells: Vec<Cell>,
    /// Time it took, s. It differs from run to run.
    pub(crate) wall_time_s: f64,
    /// Which form of the kernel ran it. All give the same bits.
    pub(crate) kernel: String,
}

impl Row {
    /// The row of a run. One that is out of balance counts as completed here: its balance stands in the table.
    pub(crate) fn of<R>(run: &Finished<R>, cells: Vec<Cell>) -> Row {
        let (status, reason) = match &run.ending {
            Ending::Completed | Ending::OutOfBalance(_) => (Status::Completed, String::new()),
            Ending::Failed(reason) => (Status::Failed, reason.clone()),
            Ending::Refused(reason) => (Status::Refused, reason.clone()),
            Ending::Broken(reason) => (Status::Broken, reason.clone()),
        };
        let kernel = run.ran.as_ref().map_or("", |ran| ran.kernel.name()).to_owned();
        Row { index: run.index, status, reason, cells, wall_time_s: run.wall_time_s, kernel }
    }

    /// Whether two rows are the same bits, wall time and kernel aside.
    pub(crate) fn agrees(&self, other: &Row) -> bool {
        let same = |(a, b): (&Cell, &Cell)| match (a, b) {
            (Cell::Number(a), Cell::Number(b)) => a.to_bits() == b.to_bits(),
            _ => a == b,
        };
        self.index == other.index
            && (self.status, &self.reason) == (other.status, &other.reason)
            && self.cells.len() == other.cells.len()
            && self.cells.iter().zip(&other.cells).all(same)
    }

    /// Appends the row's bytes, little endian: number, status, wall time, kernel, reason, cells.
    pub(crate) fn encode(&self, to: &mut Vec<u8>) {
        to.extend(self.index.to_le_bytes());
        let status = Status::ALL.iter().position(|s| *s == self.status);
        to.push(status.unwrap_or(Status::ALL.len()) as u8);
        to.extend(self.wall_time_s.to_le_bytes());
        put_text(&self.kernel, to);
        put_text(&self.reason, to);
        for cell in &self.cells {
            match cell {
                Cell::Absent => to.push(0),
                Cell::Number(x) => {
                    to.push(1);
                    to.extend(x.to_le_bytes());
                }
                Cell::Text(text) => {
                    to.push(2);
                    put_text(text, to);
                }
            }
        }
    }

    /// Reads the bytes of [`Row::encode`]; `None` where they are no row.
    pub(crate) fn decode(bytes: &[u8]) -> Option<Row> {
        let mut rest = bytes;
        let index = u64::from_le_bytes(take(&mut rest)?);
        let [status] = take(&mut rest)?;
        let wall_time_s = f64::from_le_bytes(take(&mut rest)?);
        let kernel = take_text(&mut rest)?;
        let reason = take_text(&mut rest)?;
        let mut cells = Vec::with_capacity(rest.len() / 9);
        while !rest.is_empty() {
            let [tag] = take(&mut rest)?;
            cells.push(match tag {
                0 => Cell::Absent,
                1 => Cell::Number(f64::from_le_bytes(take(&mut rest)?)),
                2 => Cell::Text(take_text(&mut rest)?.into()),
                _ => return None,
            });
        }
        Some(Row { index, status: *Status::ALL.get(usize::from(status))?, reason, cells, wall_time_s, kernel })
    }

    /// Number of the sample whose row these bytes are.
    pub(crate) fn index_of(bytes: &[u8]) -> Option<u64> {
        bytes.first_chunk().map(|b| u64::from_le_bytes(*b))
    }
}

fn put_text(text: &str, to: &mut Vec<u8>) {
    // a text beyond 4 GiB is no text of a study: it is cut
    let length = u32::try_from(text.len()).unwrap_or(0);
    to.extend(length.to_le_bytes());
    to.extend(&text.as_bytes()[..length as usize]);
}

fn take<const N: usize>(rest: &mut &[u8]) -> Option<[u8; N]> {
    let (head, tail) = rest.split_first_chunk::<N>()?;
    *rest = tail;
    Some(*head)
}

fn take_text(rest: &mut &[u8]) -> Option<String> {
    let length = u32::from_le_bytes(take(rest)?) as usize;
    let (text, tail) = rest.split_at_checked(length)?;
    *rest = tail;
    String::from_utf8(text.to_vec()).ok()
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    pub(crate) fn row(index: u64) -> Row {
        Row {
            index,
            status: Status::ALL[(index % 4) as usize],
            reason: "ä reason, \"quoted\"\nin two lines".repeat((index % 3) as usize),
            cells: vec![
                Cell::Number(index as f64 * 0.1),
                Cell::Absent,
                Cell::Text("50 kN/m".into()),
                Cell::Number(-0.0),
            ],
            wall_time_s: 0.25,
            kernel: "scalar".to_owned(),
        }
    }

    #[test]
    fn a_row_is_read_as_it_was_written() {
        for index in [0, 1, 2, 3, 1 << 40] {
            let mut bytes = Vec::new();
            row(index).encode(&mut bytes);
            let read = Row::decode(&bytes).unwrap();
            assert!(read.agrees(&row(index)));
            assert_eq!(read, row(index));
            assert_eq!(Row::index_of(&bytes), Some(index));
            // any shorter bytes are no row, or one with fewer cells, never a panic
            for end in 0..bytes.len() {
                assert_ne!(Row::decode(&bytes[..end]).as_ref(), Some(&read));
            }
        }
    }

    #[test]
    fn rows_agree_to_the_bit_and_whatever_the_clock_said() {
        let mut other = row(1);
        other.wall_time_s = 7.0;
        assert!(other.agrees(&row(1)));
        other.cells[3] = Cell::Number(0.0);
        assert!(!other.agrees(&row(1)), "0 is not -0");
    }
}

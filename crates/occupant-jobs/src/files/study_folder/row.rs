//! One sample's line of the table, and of the journal.

use occupant_core::results::summary::Caveat;
use occupant_core::run::batch::Kernel;
use occupant_scenario::ending::Ending;
use occupant_study::engine::Finished;
use serde::{Deserialize, Serialize};

use occupant_files::table::Cell;

/// Outcome of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// It reached its end time.
    Completed,
    /// The integration failed.
    Failed,
    /// Its scenario was refused: nothing was run.
    Refused,
    /// A constraint of its study leaves it out: nothing was run.
    Excluded,
    /// The program broke off: a defect.
    Broken,
}

impl Status {
    /// The status with a word, which is its name in JSON too.
    pub fn of_word(word: &str) -> Option<Self> {
        serde_json::from_value(word.into()).ok()
    }

    /// The word in the table.
    pub fn word(self) -> &'static str {
        match self {
            Status::Completed => "completed",
            Status::Failed => "failed",
            Status::Refused => "refused",
            Status::Excluded => "excluded",
            Status::Broken => "broken",
        }
    }
}

/// Number of cells of a row besides inputs and figures.
const FRAME: usize = 6;

/// A row of the table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Index of the sample, from 0.
    pub index: u64,
    /// Outcome.
    pub status: Status,
    /// The reason, if it did not complete; else empty.
    pub reason: String,
    /// Caveats, separated by blanks: each name with the affected figures in brackets.
    #[serde(default)]
    pub caveats: String,
    /// Values, by [`super::manifest::Column`]: inputs, then figures.
    pub cells: Vec<Cell>,
    /// Wall time, s. It differs from run to run.
    pub wall_time_s: f64,
    /// Kernel used. All give the same bits.
    pub kernel: String,
}

impl Row {
    /// The row of a run. A run out of balance counts as completed here: its balance is in the table.
    pub fn of<R>(run: &Finished<R>, cells: Vec<Cell>) -> Row {
        let (status, reason) = match &run.ending {
            Ending::Completed | Ending::OutOfBalance(_) => (Status::Completed, String::new()),
            Ending::Failed(reason) => (Status::Failed, reason.clone()),
            Ending::Refused(reason) => (Status::Refused, reason.clone()),
            Ending::Excluded(reason) => (Status::Excluded, reason.clone()),
            Ending::Broken(reason) => (Status::Broken, reason.clone()),
        };
        let kernel = run.ran.as_ref().map_or("", |ran| ran.kernel.name()).to_owned();
        Row { index: run.index, status, reason, caveats: String::new(), cells, wall_time_s: run.wall_time_s, kernel }
    }

    /// The row of a table with these cells, of which `inputs` come before the status; none if they are no row.
    pub fn from_cells(cells: Vec<Cell>, inputs: usize) -> Option<Row> {
        let words = |cell: Cell| match cell {
            Cell::Text(text) => String::from(text),
            Cell::Absent | Cell::Number(_) => String::new(),
        };
        let index = cells.first()?.number()? as u64;
        let figures = cells.len().checked_sub(inputs + FRAME)?;
        let mut cells = cells.into_iter().skip(1);
        let mut own: Vec<Cell> = cells.by_ref().take(inputs).collect();
        let status = Status::of_word(&words(cells.next()?))?;
        let [reason, caveats] = [words(cells.next()?), words(cells.next()?)];
        own.extend(cells.by_ref().take(figures));
        let wall_time_s = cells.next()?.number()?;
        Some(Row { index, status, reason, caveats, cells: own, wall_time_s, kernel: words(cells.next()?) })
    }

    /// Time that its thread had for it, s: its wall time over the number of runs side by side.
    pub fn thread_time_s(&self) -> f64 {
        self.wall_time_s / Kernel::named(&self.kernel).map_or(1, Kernel::lanes) as f64
    }

    /// Adds the caveats of its run.
    pub fn warn_of(&mut self, caveats: &[Caveat]) {
        let words = caveats.iter().map(|caveat| format!("{}({})", caveat.name, caveat.figures.join(";")));
        self.caveats = words.collect::<Vec<_>>().join(" ");
    }

    /// The caveats, without their texts.
    pub fn caveats(&self) -> impl Iterator<Item = Caveat> {
        self.caveats.split_whitespace().map(|word| {
            let (name, figures) = word.trim_end_matches(')').split_once('(').unwrap_or((word, ""));
            let figures = figures.split(';').filter(|figure| !figure.is_empty()).map(str::to_owned).collect();
            Caveat { name: name.to_owned(), text: String::new(), figures }
        })
    }

    /// Whether two rows are equal bit for bit, except wall time and kernel.
    pub fn agrees(&self, other: &Row) -> bool {
        let same = |(a, b): (&Cell, &Cell)| match (a, b) {
            (Cell::Number(a), Cell::Number(b)) => a.to_bits() == b.to_bits(),
            _ => a == b,
        };
        self.index == other.index
            && (self.status, &self.reason, &self.caveats) == (other.status, &other.reason, &other.caveats)
            && self.cells.len() == other.cells.len()
            && self.cells.iter().zip(&other.cells).all(same)
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    pub fn row(index: u64) -> Row {
        Row {
            index,
            status: [Status::Completed, Status::Failed, Status::Refused, Status::Broken][(index % 4) as usize],
            reason: "ä reason, \"quoted\"\nin two lines".repeat((index % 3) as usize),
            caveats: "neck_beyond_stop(nij;neck_*)".repeat((index % 2) as usize),
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
    fn a_row_is_read_as_it_was_written_to_the_bit() {
        let mut seed = 1_u64;
        for index in [0, 1, 2, 3, 1 << 40] {
            let mut written = row(index);
            // any bits that are a number
            written.cells.extend((0..200).map(|_| {
                seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                Cell::finite(f64::from_bits(seed.rotate_left(20)))
            }));
            let read: Row = serde_json::from_str(&serde_json::to_string(&written).unwrap()).unwrap();
            assert!(read.agrees(&written));
            assert_eq!(read, written);
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

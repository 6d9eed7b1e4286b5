//! A CSV file of recorded accelerations and rates, read on its own.

use super::number_table::read_csv;
use super::sensors::{COLUMNS, RECORDED};
use occupant_core::vehicle::AccelerationRecord;
use placed_text::{Diagnostic, Diagnostics, Problem, Separator, Sources, Span, table_text};

/// Recorded accelerations and rates in SI, in the file's axes, with the positions of its lines.
#[derive(Clone, Debug)]
pub struct RecordFile {
    /// The record.
    pub record: AccelerationRecord,
    sources: Sources,
    header: Span,
    rows: Vec<Span>,
}

/// Reads a CSV file whose first line names `t` and any of `ax`, `ay`, `az`, `wx`, `wy`, `wz` (or `roll_rate`,
/// `pitch_rate`, `yaw_rate`) with their units, such as `t[s],ax[g],wz[deg/s]`, or as recorders do; or `columns` names them so, `-` for one
/// that is left out, in place of the file's own headings. `name` is its name in messages.
///
/// # Errors
/// All problems of it: bytes that are no text, unknown, doubled and missing columns, wrong units, cells that
/// are no number, lines that are too long or too short, times that do not increase, fewer than two lines, no channel.
pub fn read_record(bytes: &[u8], name: &str, columns: Option<&str>) -> Result<RecordFile, Diagnostics> {
    let mut sources = Sources::new();
    let id = sources.add(name, table_text(bytes, name)?);
    let given = columns.map(|columns| sources.add("columns", columns));
    let table = {
        let names = given.map(|given| {
            let all = Span { end: sources.text(given).len(), ..sources.start_of(given) };
            (Separator::of(sources.slice(all)).cells(&sources, all), all)
        });
        read_csv(&sources, id, &COLUMNS[..RECORDED], names)?
    };
    let channels = |from: usize| [0, 1, 2].map(|axis| table.column(from + axis));
    let file = RecordFile {
        record: AccelerationRecord {
            time_s: table.column(0).unwrap_or_default(),
            acceleration_m_s2: channels(1),
            rate_rad_s: channels(4),
        },
        sources,
        header: table.header,
        rows: table.row_spans,
    };
    let problems = file.problems();
    if problems.is_empty() { Ok(file) } else { Err(problems) }
}

impl RecordFile {
    /// A problem of the sample `station`, at its line.
    pub fn at(&self, station: usize, found: String, expected: &str, hint: Option<&str>) -> Diagnostic {
        self.place(station, Problem::error("", found, expected).with_hint(hint))
    }

    fn place(&self, station: usize, problem: Problem) -> Diagnostic {
        let span = self.rows.get(station).copied().unwrap_or(self.header);
        Diagnostic::at(&self.sources, span, problem)
    }

    fn problems(&self) -> Diagnostics {
        let mut problems = Diagnostics::new();
        let time_s = &self.record.time_s;
        let channels = self.record.acceleration_m_s2.iter().chain(&self.record.rate_rad_s);
        if channels.flatten().next().is_none() {
            let expected = "at least one of `ax`, `ay`, `az`, `wx`, `wy`, `wz` with its unit";
            problems.push(self.at(usize::MAX, "no acceleration and no rate".into(), expected, None));
        }
        if time_s.len() < 2 {
            let found = format!("{} lines of numbers", time_s.len());
            problems.push(self.at(usize::MAX, found, "at least 2", None));
        }
        for (i, pair) in time_s.windows(2).enumerate() {
            if pair[1] <= pair[0] {
                let found = format!("t = {} s after {} s", pair[1], pair[0]);
                problems.add(Problem::error("", found, "times that increase"), |problem| self.place(i + 1, problem));
            }
        }
        problems
    }
}

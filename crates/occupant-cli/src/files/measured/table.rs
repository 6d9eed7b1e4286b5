//! Text tables: a line of headings with units, `t[s],head_x[g]`, and a line of numbers for each time.
//!
//! Commas, semicolons, tabs or blanks between cells (with semicolons a comma is a decimal point); lines that start with `#`
//! are comments. Units may also stand in a line of their own below the headings. Without headings the first column is the
//! time in seconds. An empty cell, `NaN` or `NOVALUE` is a missing value. A cell may stand in double quotes (RFC 4180).

use std::path::Path;

use crash_measures::unit::parse;
use csv::{ReaderBuilder, StringRecord, Trim};
use placed_text::{CELL, shortened};

use crate::base::Failure;
use crate::files::signals::{Recording, Signal, finite, scale_of, seconds_in};
use crate::files::trouble::{Trouble, failure};

/// No table has more columns.
const MOST_COLUMNS: usize = 10_000;

/// Stands for any number of blanks between cells.
const BLANKS: char = ' ';
/// Round units in a line of their own.
const BRACKETS: [char; 4] = ['[', ']', '(', ')'];

#[derive(Clone, Debug, Default)]
struct Heading {
    name: String,
    unit: Option<String>,
    line: usize,
}

/// A line of a table: its number in the file, from 1, and its cells.
type Line = (usize, StringRecord);

/// Reads a table.
///
/// # Errors
/// What is wrong with it.
pub(crate) fn read(path: &Path, text: &str, sha256: String) -> Result<Recording, Failure> {
    let (lines, separator) = lines(text.trim_start_matches('\u{feff}'));
    if lines.is_empty() {
        return Err(Trouble::of(path, "an empty table", "headings and numbers").into());
    }
    if let Some((line, cells)) = lines.iter().find(|(_, cells)| cells.len() > MOST_COLUMNS) {
        let found = format!("{} cells in line {line}", cells.len());
        return Err(Trouble::of(path, found, format!("at most {MOST_COLUMNS}")).into());
    }
    let mut notes = Vec::new();
    let (headings, used) = headings(&lines, separator);
    let time = time_column(&headings);
    let mut reader = Reader { path, separator, headings, problems: Vec::new() };
    let time_factor = reader.time_factor(time, used > 0, &mut notes);
    let columns = reader.columns(&lines[used..]);
    let time_s: Vec<f64> = columns.get(time).map(|c| c.iter().map(|t| t * time_factor).collect()).unwrap_or_default();
    reader.check_times(&time_s, &lines[used..]);
    if !reader.problems.is_empty() {
        return Err(failure(&reader.problems));
    }
    let signals = reader.signals(columns, time, &time_s);
    if signals.is_empty() {
        let found = "a table with one column";
        return Err(Trouble::of(path, found, "a column of times and one of values").into());
    }
    Ok(Recording { path: path.to_owned(), sha256, signals, notes })
}

/// The lines that are neither blank nor comments, and what stands between their cells.
fn lines(text: &str) -> (Vec<Line>, char) {
    let is_comment = |line: &str| matches!(line.trim_start().chars().next(), None | Some('#'));
    let lines: Vec<(usize, &str)> = (1..).zip(text.lines()).filter(|(_, line)| !is_comment(line)).collect();
    let used = |sign: &char| lines.first().is_some_and(|(_, line)| line.trim_end().contains(*sign));
    let separator = [';', '\t', ','].into_iter().find(used).unwrap_or(BLANKS);
    let plain = lines.iter().map(|(_, line)| match separator {
        BLANKS => line.split_whitespace().collect::<Vec<_>>().join(" ") + "\n",
        _ => format!("{}\n", line.trim_end()),
    });
    let plain: String = plain.collect();
    let mut reader = ReaderBuilder::new();
    reader.has_headers(false).flexible(true).delimiter(separator as u8).trim(Trim::All);
    let records = reader.from_reader(plain.as_bytes()).into_records().flatten();
    let numbered = records.filter_map(|record| {
        let at = record.position()?.line() as usize - 1;
        Some((lines.get(at)?.0, record))
    });
    (numbered.collect(), separator)
}

fn number(cell: &str, separator: char) -> Option<f64> {
    match cell.to_ascii_lowercase().as_str() {
        "" | "nan" | "novalue" => Some(f64::NAN),
        _ if separator == ';' => finite(&cell.replace(',', ".")),
        _ => finite(cell),
    }
}

/// Headings, and how many lines they take.
fn headings(lines: &[Line], separator: char) -> (Vec<Heading>, usize) {
    let is_number = |cell: &str| !cell.is_empty() && number(cell, separator).is_some();
    let (line, first) = &lines[0];
    if first.iter().any(is_number) {
        let plain = |i: usize| Heading { name: (i + 1).to_string(), unit: None, line: *line };
        return ((0..first.len()).map(plain).collect(), 0);
    }
    let heading = |cell: &str| {
        let (name, unit) = name_and_unit(cell);
        Heading { name: name.to_owned(), unit: unit.map(str::to_owned), line: *line }
    };
    let mut headings: Vec<Heading> = first.iter().map(heading).collect();
    let is_unit = |cell: &str| matches!(cell, "" | "-") || parse(cell.trim_matches(BRACKETS), 0).is_ok();
    let units = |(_, second): &&Line| !second.iter().any(is_number) && second.iter().all(is_unit);
    let Some((line, units)) = lines.get(1).filter(units) else {
        return (headings, 1);
    };
    for (heading, unit) in headings.iter_mut().zip(units) {
        let unit = unit.trim_matches(BRACKETS);
        if !unit.is_empty() && heading.unit.is_none() {
            (heading.unit, heading.line) = (Some(unit.to_owned()), *line);
        }
    }
    (headings, 2)
}

/// `x[m]` or `x (m)` → `x` and `m`.
pub(crate) fn name_and_unit(text: &str) -> (&str, Option<&str>) {
    let text = text.trim();
    for (open, close) in [('[', ']'), ('(', ')')] {
        if let Some((name, unit)) = text.strip_suffix(close).and_then(|t| t.split_once(open)) {
            return (name.trim(), Some(unit.trim()));
        }
    }
    (text, None)
}

/// The column called time, else the first.
fn time_column(headings: &[Heading]) -> usize {
    let names = ["t", "time", "time_s", "zeit", "temps"];
    let named = |h: &Heading| names.contains(&h.name.to_lowercase().as_str());
    headings.iter().position(named).unwrap_or(0)
}

struct Reader<'a> {
    path: &'a Path,
    separator: char,
    headings: Vec<Heading>,
    problems: Vec<Trouble>,
}

impl Reader<'_> {
    fn time_factor(&mut self, time: usize, has_headings: bool, notes: &mut Vec<String>) -> f64 {
        let Some(heading) = self.headings.get(time) else {
            return 1.0;
        };
        let Some(unit) = &heading.unit else {
            if !(has_headings && heading.name.ends_with("_s")) {
                notes.push(format!("{} gives no unit for the time: taken as seconds", self.path.display()));
            }
            return 1.0;
        };
        seconds_in(unit).unwrap_or_else(|| {
            let found = format!("`{unit}` as the unit of the time column `{}`", heading.name);
            let trouble = Trouble::at(self.path, heading.line, found, "a unit of time, such as s or ms");
            self.problems.push(trouble.hint("the time is the column called `t` or `time`, or the first"));
            1.0
        })
    }

    fn wrong(&mut self, line: usize, found: impl Into<String>, expected: impl Into<String>) {
        self.problems.push(Trouble::at(self.path, line, found, expected));
    }

    /// Numbers column by column, as far as lines are right.
    fn columns(&mut self, lines: &[Line]) -> Vec<Vec<f64>> {
        let mut columns = vec![Vec::with_capacity(lines.len()); self.headings.len()];
        for (line, cells) in lines {
            // a separator at the line's end opens no cell
            let more = usize::from(cells.len() == columns.len() + 1 && cells.iter().next_back() == Some(""));
            if cells.len() != columns.len() + more {
                let expected = format!("{}, one for each column", columns.len());
                self.wrong(*line, format!("{} cells", cells.len()), expected);
                columns.iter_mut().for_each(|c| c.push(f64::NAN));
                continue;
            }
            for (column, cell) in columns.iter_mut().zip(cells) {
                let value = number(cell, self.separator);
                if value.is_none() {
                    self.wrong(*line, format!("`{}`", shortened(cell, CELL)), "a number");
                }
                column.push(value.unwrap_or(f64::NAN));
            }
        }
        columns
    }

    fn check_times(&mut self, time_s: &[f64], lines: &[Line]) {
        if !self.problems.is_empty() {
            return;
        }
        if time_s.is_empty() {
            self.problems.push(Trouble::of(self.path, "headings without numbers", "a line for each time"));
        }
        for (i, (t, (line, _))) in time_s.iter().zip(lines).enumerate() {
            let found = match i.checked_sub(1).map(|before| time_s[before]) {
                _ if t.is_nan() => "a line without its time".to_owned(),
                Some(before) if *t <= before => format!("time {t} s after {before} s"),
                _ => continue,
            };
            self.wrong(*line, found, "times that increase");
        }
    }

    fn signals(&self, columns: Vec<Vec<f64>>, time: usize, time_s: &[f64]) -> Vec<Signal> {
        let signal = |(heading, values): (&Heading, Vec<f64>)| Signal {
            name: heading.name.clone(),
            code: heading.name.parse().ok(),
            unit: heading.unit.clone(),
            scale: heading.unit.as_deref().and_then(scale_of),
            time_s: time_s.to_vec(),
            values,
            place: format!("{}:{}", self.path.display(), heading.line),
        };
        let named = self.headings.iter().zip(columns).enumerate();
        named.filter(|(i, _)| *i != time).map(|(_, column)| signal(column)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(text: &str) -> Result<Recording, String> {
        read(Path::new("t.csv"), text, String::new()).map_err(|f| match f {
            Failure::CouldNotRun(m) | Failure::BrokeOff(m) => m,
        })
    }

    #[test]
    fn headings_carry_units() {
        let found = table("# a comment\nt[ms], head_x[g]\n0, 1\n1, -2.5\n").unwrap();
        let signal = &found.signals[0];
        assert_eq!(signal.name, "head_x");
        assert_eq!(signal.time_s, [0.0, 1e-3]);
        assert_eq!(signal.values, [1.0, -2.5]);
        assert_eq!(signal.scale.map(|s| s.factor), Some(9.80665));
        assert!(found.notes.is_empty());
    }

    #[test]
    fn units_may_stand_below_and_cells_may_be_quoted() {
        let found = table("\"Time\";\"Head, x\";force\ns;m/s^2;kN\n0,5;1,5;2\n0,6;NaN;3\n").unwrap();
        assert_eq!(found.signals[0].name, "Head, x");
        assert_eq!(found.signals[0].time_s, [0.5, 0.6]);
        assert_eq!(found.signals[0].values[0], 1.5);
        assert!(found.signals[0].values[1].is_nan());
        assert_eq!(found.signals[1].scale.map(|s| s.factor), Some(1000.0));
    }

    #[test]
    fn two_columns_need_no_headings() {
        let found = table("0.0  5\n0.1\t6\n").unwrap();
        assert_eq!(found.signals[0].name, "2");
        assert_eq!(found.signals[0].values, [5.0, 6.0]);
        assert_eq!(found.signals[0].scale, None);
        assert!(found.notes[0].contains("taken as seconds"));
    }

    /// Any text is read or refused.
    #[test]
    fn no_text_brings_the_reader_down() {
        let letters: Vec<char> = "t,;\t \n\r\"[](01.-e#µg\u{feff}\u{0}NaN".chars().collect();
        let mut seed = 1_u64;
        for _ in 0..3000 {
            let text: String = (0..40)
                .map(|_| {
                    seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                    letters[(seed >> 33) as usize % letters.len()]
                })
                .collect();
            let _ = table(&text);
        }
    }

    #[test]
    fn a_table_of_too_many_columns_is_refused() {
        let message = table(&format!("t[s]{}\n", ",a".repeat(10_000))).unwrap_err();
        assert!(message.contains("10001 cells in line 1") && message.contains("at most 10000"), "{message}");
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        for (text, line, found) in [
            ("t[s],a\n0,1\n0.1,x\n", "t.csv:3", "`x`"),
            ("t[s],a\n0,1\n0.1\n", "t.csv:3", "1 cells"),
            ("t[s],a\n0,1\n0,2\n", "t.csv:3", "time 0 s after 0 s"),
            ("t[kg],a\n0,1\n", "t.csv:1", "`kg`"),
            ("t[s],a\n,1\n", "t.csv:2", "without its time"),
            ("t[s],a\n", "t.csv", "without numbers"),
            ("", "t.csv", "empty"),
            ("t\n1\n2\n", "t.csv", "one column"),
        ] {
            let message = table(text).unwrap_err();
            assert!(message.contains(line) && message.contains(found), "{message}");
            assert!(message.contains("= expected"), "{message}");
        }
    }
}

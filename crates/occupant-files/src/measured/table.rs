//! Text tables: a line of headings with units, `t[s],head_x[g]`, and a line of numbers for each time.
//!
//! They are read as tables of scenarios are ([`TextTable`]); but without headings the first column is the time in seconds, an
//! empty cell, `N/A`, `NaN` or `NOVALUE` is a missing value, and a column of words is left out.

use std::path::Path;

use occupant_scenario::column_named;
use placed_text::{
    CELL, Cell, Diagnostic, Diagnostics, MOST_CELLS, Problem, Separator, Sources, Span, TextTable, is_missing,
    name_and_unit, shortened,
};

use crate::base::Failure;
use crate::signals::{Recording, Signal, scale_of, seconds_in};
use crash_measures::signal::usual_interval;

/// Largest number of problems shown.
const SHOWN: usize = 8;
/// Largest number of non-increasing times shown.
const EACH: usize = 3;

#[derive(Clone, Debug)]
struct Heading {
    name: String,
    unit: Option<String>,
    /// Sign: −1 if reversed by `--columns`.
    sign: f64,
    /// Position of its unit, or of the heading.
    span: Span,
}

impl Heading {
    /// A heading of the file, or of `--columns`; `below` is the unit from a separate line.
    fn of(cell: &Cell, below: Option<(&str, Span)>) -> Self {
        let (name, unit) = name_and_unit(cell.text);
        let (name, sign) = match name.strip_prefix('-').filter(|rest| !rest.is_empty()) {
            Some(rest) => (rest, -1.0),
            None => (name, 1.0),
        };
        // `MPH [km/h]`: the first of two
        let unit = unit.map(|unit| (unit.split('[').next().unwrap_or(unit).trim(), cell.span)).or(below);
        let (name, unit) = match unit {
            Some(unit) => (name, Some(unit)),
            None => in_words(name).map_or((name, None), |(name, unit)| (name, Some((unit, cell.span)))),
        };
        let span = unit.map_or(cell.span, |(_, span)| span);
        Heading { name: name.to_owned(), unit: unit.map(|(unit, _)| unit.to_owned()), sign, span }
    }

    fn is_left_out(&self) -> bool {
        self.name == "-"
    }
}

/// Name and unit of a heading whose last word is a unit, as in `dV long MPH`; a unit of time alone means the time.
fn in_words(heading: &str) -> Option<(&str, &str)> {
    if seconds_in(heading).is_some_and(|_| heading.len() > 1) {
        return Some(("t", heading));
    }
    let (name, unit) = heading.rsplit_once([' ', '_', ','])?;
    let is_told = unit.len() > 1 || unit.eq_ignore_ascii_case("g");
    (is_told && !name.trim().is_empty() && scale_of(unit).is_some())
        .then(|| (name.trim_end_matches(['_', ',', ' ']), unit))
}

/// Reads a table; `columns` replaces its headings: `-` skips a column, `-NAME` reverses its sign.
///
/// # Errors
/// Problems of it.
pub fn read(path: &Path, text: &str, columns: Option<&str>, sha256: String) -> Result<Recording, Failure> {
    let mut sources = Sources::new();
    let id = sources.add_named(path.display().to_string(), text);
    let given = columns.map(|columns| sources.add("--columns", columns));
    let problems = Diagnostics::new();
    let Some(table) = TextTable::of(&sources, id, |unit| scale_of(unit).is_some()) else {
        let mut reader = Reader { sources: &sources, separator: Separator::of(""), headings: Vec::new(), problems };
        reader.wrong(sources.start_of(id), "an empty table", "headings and numbers");
        return Err(reader.failure());
    };
    let headings = match given {
        Some(given) => {
            let all = Span { end: sources.text(given).len(), ..sources.start_of(given) };
            Separator::of(sources.slice(all)).cells(&sources, all).iter().map(|cell| Heading::of(cell, None)).collect()
        }
        None => headings(&table, table.separator.cells(&sources, table.first).len()),
    };
    let mut reader = Reader { sources: &sources, separator: table.separator, headings, problems };
    let mut notes = reader.about(&table);
    let time = time_column(&reader.headings);
    let time_factor = reader.time_factor(time, !table.headings.is_empty(), path, &mut notes);
    let mut columns = reader.columns(&table.lines, time, &mut notes);
    let time_s: Vec<f64> = columns.get(time).map(|c| c.iter().map(|t| t * time_factor).collect()).unwrap_or_default();
    reader.check_times(&time_s, &table);
    reader.ask_for_the_unit(time, &time_s, table.first);
    for (column, heading) in columns.iter_mut().zip(&reader.headings).filter(|(_, heading)| heading.sign < 0.0) {
        column.iter_mut().for_each(|value| *value *= heading.sign);
    }
    if columns.len() < 2 && reader.problems.is_empty() {
        reader.wrong(table.first, "a table with one column", "a column of times and one of values");
    }
    if !reader.problems.is_empty() {
        return Err(reader.failure());
    }
    let signals = reader.signals(columns, time, &time_s);
    Ok(Recording { path: path.to_owned(), sha256, signals, notes })
}

/// Headings; numbers from 1 if the table has none.
fn headings(table: &TextTable, columns: usize) -> Vec<Heading> {
    if table.headings.is_empty() {
        let number = |i: usize| Heading { name: i.to_string(), unit: None, sign: 1.0, span: table.first };
        return (1..=columns).map(number).collect();
    }
    let heading = |(i, cell): (usize, &Cell)| {
        // in its heading, or below
        let below = table.unit(i).filter(|_| name_and_unit(cell.text).1.is_none());
        Heading::of(cell, below)
    };
    table.headings.iter().enumerate().map(heading).collect()
}

/// The column named time, else the first.
fn time_column(headings: &[Heading]) -> usize {
    let named = |h: &Heading| h.name == "time_s" || column_named(&h.name) == Some("t");
    headings.iter().position(named).unwrap_or(0)
}

struct Reader<'a> {
    sources: &'a Sources,
    separator: Separator,
    headings: Vec<Heading>,
    problems: Diagnostics,
}

impl Reader<'_> {
    fn time_factor(&mut self, time: usize, has_headings: bool, path: &Path, notes: &mut Vec<String>) -> f64 {
        let Some(heading) = self.headings.get(time).cloned() else {
            return 1.0;
        };
        let Some(unit) = &heading.unit else {
            if !(has_headings && heading.name.ends_with("_s")) {
                notes.push(format!("{} gives no unit for the time: seconds are assumed", path.display()));
            }
            return 1.0;
        };
        seconds_in(unit).unwrap_or_else(|| {
            let found = format!("`{unit}` as the unit of the time column `{}`", heading.name);
            let problem = Problem::error("", found, "a unit of time, such as s or ms");
            let hint = "the time column is named `t` or `time`, or is the first";
            self.report(heading.span, problem.with_hint(Some(hint)));
            1.0
        })
    }

    /// Notes on skipped lines.
    fn about(&self, table: &TextTable) -> Vec<String> {
        let mut notes = Vec::new();
        let line = |span: Span| self.sources.position(span).line;
        if table.before > 0 {
            notes.push(format!("the table begins in line {}; earlier lines are ignored", line(table.first)));
        }
        notes.extend(
            table.behind.map(|span| format!("the table ends before line {}; later lines are ignored", line(span))),
        );
        notes
    }

    /// Reports times without a unit in steps of 5 or more, or over a minute or more: they may be milliseconds or
    /// seconds.
    fn ask_for_the_unit(&mut self, time: usize, time_s: &[f64], first: Span) {
        let is_told = self.headings.get(time).is_none_or(|h| h.unit.is_some() || h.name.ends_with("_s"));
        if is_told || time_s.len() < 3 || !self.problems.is_empty() {
            return;
        }
        if usual_interval(time_s) < 5.0 && time_s[time_s.len() - 1] - time_s[0] < 60.0 {
            return;
        }
        let found = format!("times from {} to {} without a unit", time_s[0], time_s[time_s.len() - 1]);
        let problem = Problem::error("", found, "a unit in the heading, such as `t[ms]`");
        let names: Vec<String> = (1..self.headings.len()).map(|_| "-".to_owned()).collect();
        let hint = format!("name all columns and units with --columns, such as 't[ms],{}'", names.join(","));
        self.report(first, problem.with_hint(Some(&hint)));
    }

    fn wrong(&mut self, span: Span, found: impl Into<String>, expected: impl Into<String>) {
        self.report(span, Problem::error("", found, expected));
    }

    fn report(&mut self, span: Span, problem: Problem) {
        self.problems.add(problem, |problem| Diagnostic::at(self.sources, span, problem));
    }

    fn failure(self) -> Failure {
        Failure::CouldNotRun(self.problems.abridged(SHOWN).to_string())
    }

    /// Numbers by column, as far as lines are valid.
    fn columns(&mut self, lines: &[Span], time: usize, notes: &mut Vec<String>) -> Vec<Vec<f64>> {
        let words = self.columns_of_words(lines, time);
        for (heading, _) in
            self.headings.iter().zip(&words).filter(|(heading, words)| **words && !heading.is_left_out())
        {
            notes.push(format!("the column `{}` contains text: skipped", shortened(&heading.name, CELL)));
        }
        let mut columns = vec![Vec::with_capacity(lines.len()); self.headings.len()];
        if columns.len() > MOST_CELLS {
            let span = self.headings[0].span;
            self.wrong(span, format!("more than {MOST_CELLS} columns"), format!("at most {MOST_CELLS}"));
            return columns;
        }
        for line in lines {
            let cells = self.separator.cells(self.sources, *line);
            // a separator at the line's end opens no cell
            let more = usize::from(cells.len() == columns.len() + 1 && cells.last().is_some_and(|c| c.text.is_empty()));
            if cells.len() != columns.len() + more {
                let expected = format!("{}, one for each column", columns.len());
                self.wrong(*line, format!("{} cells", cells.len()), expected);
                columns.iter_mut().for_each(|c| c.push(f64::NAN));
                continue;
            }
            for (i, (column, cell)) in columns.iter_mut().zip(&cells).enumerate() {
                column.push(if words.get(i) == Some(&true) { f64::NAN } else { self.number(cell) });
            }
        }
        columns
    }

    /// Columns to leave out: those with the heading `-`, and those with mostly text.
    fn columns_of_words(&self, lines: &[Span], time: usize) -> Vec<bool> {
        let mut counts = vec![[0, 0]; self.headings.len()];
        for line in lines {
            for (count, cell) in counts.iter_mut().zip(self.separator.cells(self.sources, *line)) {
                let is_number = number_in(self.separator, &cell).is_some();
                count[usize::from(is_number)] += usize::from(is_number || !is_missing(cell.text));
            }
        }
        let of = |(i, ([words, numbers], heading)): (usize, (&[usize; 2], &Heading))| {
            heading.is_left_out() || (i != time && words > numbers)
        };
        counts.iter().zip(&self.headings).enumerate().map(of).collect()
    }

    /// A number; NaN if the cell marks a missing value.
    fn number(&mut self, cell: &Cell) -> f64 {
        if let Some(number) = number_in(self.separator, cell) {
            return number;
        }
        if !is_missing(cell.text) {
            self.wrong(cell.span, format!("`{}`", shortened(cell.text, CELL)), "a number");
        }
        f64::NAN
    }

    fn check_times(&mut self, time_s: &[f64], table: &TextTable) {
        if !self.problems.is_empty() {
            return;
        }
        if time_s.is_empty() {
            self.wrong(table.first, "headings without numbers", "a line for each time");
        }
        let late = |i: usize| i > 0 && time_s[i] <= time_s[i - 1];
        let timeless = (0..time_s.len()).find(|&i| time_s[i].is_nan());
        if let Some(i) = timeless {
            self.wrong(table.lines[i], "a line without a time", "times that increase");
        }
        let all: Vec<usize> = (0..time_s.len()).filter(|&i| late(i)).collect();
        let goes_back = (all.len() + 1 == time_s.len()).then_some("times decrease: reverse the order of the rows");
        // many are one mistake
        let more = if all.len() > EACH { format!(" (and {} more like it)", all.len() - 1) } else { String::new() };
        for &i in all.iter().take(if all.len() > EACH { 1 } else { EACH }) {
            let found = format!("time {} s after {} s{more}", time_s[i], time_s[i - 1]);
            let problem = Problem::error("", found, "times that increase").with_hint(goes_back);
            self.report(table.lines[i], problem);
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
            place: self.place(heading.span),
        };
        let named = self.headings.iter().zip(columns).enumerate();
        let holds_something = |values: &[f64]| values.iter().any(|value| !value.is_nan());
        let is_kept = |i: usize, heading: &Heading, values: &[f64]| {
            i != time && !heading.is_left_out() && holds_something(values)
        };
        named.filter(|(i, (heading, values))| is_kept(*i, heading, values)).map(|(_, column)| signal(column)).collect()
    }

    fn place(&self, span: Span) -> String {
        format!("{}:{}", self.sources.name(span.source), self.sources.position(span).line)
    }
}

/// Number of a cell; if there are two, `-12.4 [-20]`, the first.
fn number_in(separator: Separator, cell: &Cell) -> Option<f64> {
    let first = || {
        let (first, _) = cell.text.strip_suffix(']')?.split_once('[')?;
        separator.number(&Cell { text: first.trim(), span: cell.span }).ok()
    };
    separator.number(cell).ok().or_else(first)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(text: &str) -> Result<Recording, String> {
        read(Path::new("t.csv"), text, None, String::new()).map_err(Failure::words)
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
        assert!(found.notes[0].contains("seconds are assumed"));
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
        assert!(message.contains("more than 10000 columns") && message.contains("at most 10000"), "{message}");
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        for (text, line, found) in [
            ("t[s],a\n0,1\n0.1,x\n", "t.csv:3", "`x`"),
            ("t[s],a\n0,1\n0.1\n", "t.csv:3", "1 cells"),
            ("t[s],a\n0,1\n0,2\n", "t.csv:3", "time 0 s after 0 s"),
            ("t[kg],a\n0,1\n", "t.csv:1", "`kg`"),
            ("t[s],a\n,1\n", "t.csv:2", "without a time"),
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

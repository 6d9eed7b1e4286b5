//! Tables of numbers, in a CSV file beside the scenario or in the scenario itself.
//!
//! The first line names the columns with their units, `t[s],x[m],yaw[deg]`, or in the style of recorders, `Time (ms)`;
//! units may be in a separate line below it. Every further line has one number for each column. Commas, semicolons,
//! tabs or blanks separate them; blank lines and lines that start with `#` are skipped. If the scenario names the
//! columns of a file, the file's own headings are ignored.

use super::heading::{heading, heading_in};
use crate::kind::{KINDS, UnitSystem};
use occupant_units::unit::parse_heading;
use placed_text::{
    CELL, Cell, Diagnostic, Diagnostics, Node, Problem, Separator, SourceId, Sources, Span, TextTable, did_you_mean,
    name_and_unit, one_of, shortened,
};

/// A possible column of a table.
#[derive(Clone, Copy, Debug)]
pub(super) struct Column {
    /// Its name.
    pub name: &'static str,
    /// An alias; empty if it has none.
    pub alias: &'static str,
    /// Index of its kind of quantity.
    pub kind: usize,
    /// Whether it is required; other columns default to zero.
    pub required: bool,
}

pub(super) const fn column(name: &'static str, kind: usize, required: bool) -> Column {
    Column { name, alias: "", kind, required }
}

/// A table in SI units, angles in radians, with the requested columns.
#[derive(Clone, Debug)]
pub(super) struct NumberTable {
    /// Lines of numbers.
    pub rows: Vec<Vec<f64>>,
    /// The position of each line.
    pub row_spans: Vec<Span>,
    /// The position of the column names.
    pub header: Span,
    /// Which of the requested columns exist.
    pub present: Vec<bool>,
}

impl NumberTable {
    fn new(header: Span) -> Self {
        NumberTable { rows: Vec::new(), row_spans: Vec::new(), header, present: Vec::new() }
    }

    /// A column in SI, if it is there.
    pub(crate) fn column(&self, i: usize) -> Option<Vec<f64>> {
        self.present[i].then(|| self.rows.iter().map(|row| row[i]).collect())
    }
}

/// Reads a CSV text; `names` gives columns with units instead of its own headings.
///
/// # Errors
/// Unknown, doubled and missing columns, wrong units, lines with too few or too many cells, cells that are no number.
pub(super) fn read_csv(
    sources: &Sources,
    id: SourceId,
    columns: &[Column],
    names: Option<(Vec<Cell>, Span)>,
) -> Result<NumberTable, Diagnostics> {
    let Some(text) = TextTable::of(sources, id, |unit| parse_heading(unit).is_ok()) else {
        let mut reader = Reader::new(sources, columns, Separator::of(""));
        reader.error(sources.start_of(id), "an empty table", "a line that names the columns");
        return Err(reader.problems);
    };
    let mut reader = Reader::new(sources, columns, text.separator);
    let mut table = NumberTable::new(text.first);
    match names {
        Some((names, span)) => reader.header(&names, |_| None, span),
        None => {
            let is_known = |(i, cell): (usize, &Cell)| {
                let unit = text.unit(i).and_then(|(unit, _)| parse_heading(unit).ok());
                let name = name_and_unit(cell.text).0;
                reader.place(name).or_else(|| reader.place(heading_in(name, unit?.dimension)?)).is_some()
            };
            if !text.headings.iter().enumerate().any(is_known) {
                // any file can be named in a scenario: what is no such table is not shown
                let expected = one_of(&reader.names(), '`');
                reader.error(text.first, "a first line without any known column", expected);
                return Err(reader.problems);
            }
            reader.header(&text.headings, |i| text.unit(i).map(|(unit, _)| unit), text.first);
        }
    }
    if let Some(behind) = text.behind {
        reader.error(behind, "a line that does not belong to the table", "only numbers up to the end of the file");
    }
    for line in text.lines {
        let cells = text.separator.cells(sources, line);
        let numbers = cells.iter().enumerate().map(|(i, cell)| reader.number(i, cell)).collect();
        reader.row(&mut table, numbers, line);
    }
    reader.finish(table)
}

/// The names in `columns` of a section of the scenario, and their positions.
pub(super) fn names_of(section: &Node) -> Option<(Vec<Cell<'_>>, Span)> {
    let columns = section.get("columns")?;
    let cells = columns.items().iter().filter_map(|node| Some(Cell { text: node.as_str()?, span: node.span }));
    Some((cells.collect(), columns.span))
}

/// Reads the `columns` and `rows` of a section of the scenario; both have passed the check.
///
/// # Errors
/// As for [`read_csv`].
pub(super) fn read_inline(sources: &Sources, section: &Node, columns: &[Column]) -> Result<NumberTable, Diagnostics> {
    let mut reader = Reader::new(sources, columns, Separator::of(""));
    let (header, span) = names_of(section).unwrap_or((Vec::new(), section.span));
    reader.header(&header, |_| None, span);
    let mut table = NumberTable::new(span);
    for row in section.get("rows").map_or(&[][..], Node::items) {
        let numbers = row.items().iter().map(|n| n.value.number().unwrap_or(f64::NAN)).collect();
        reader.row(&mut table, numbers, row.span);
    }
    reader.finish(table)
}

struct Reader<'a> {
    sources: &'a Sources,
    wanted: &'a [Column],
    separator: Separator,
    /// For each column of the table, the requested column and the SI units in one of its unit.
    columns: Vec<Option<(usize, f64)>>,
    /// Columns of the table that are ignored.
    left_out: Vec<usize>,
    problems: Diagnostics,
}

impl<'a> Reader<'a> {
    fn new(sources: &'a Sources, wanted: &'a [Column], separator: Separator) -> Self {
        Reader { sources, wanted, separator, columns: Vec::new(), left_out: Vec::new(), problems: Diagnostics::new() }
    }

    fn finish(self, mut table: NumberTable) -> Result<NumberTable, Diagnostics> {
        let there = |i| self.columns.iter().flatten().any(|(at, _)| *at == i);
        table.present = (0..self.wanted.len()).map(there).collect();
        if self.problems.is_empty() { Ok(table) } else { Err(self.problems) }
    }

    fn error(&mut self, span: Span, found: impl Into<String>, expected: impl Into<String>) {
        self.report(span, Problem::error("", found, expected));
    }

    fn report(&mut self, span: Span, problem: Problem) {
        self.problems.add(problem, |problem| Diagnostic::at(self.sources, span, problem));
    }

    /// Headings; `unit` gives the units stated by the table.
    fn header<'u>(&mut self, cells: &[Cell], unit: impl Fn(usize) -> Option<&'u str>, span: Span) {
        for (i, cell) in cells.iter().enumerate() {
            let column = self.column(cell, unit(i));
            self.columns.push(column);
        }
        let wanted = self.wanted;
        for (i, column) in wanted.iter().enumerate() {
            let there = cells.iter().any(|c| self.place(name_and_unit(c.text).0) == Some(i));
            let known = self.columns.iter().flatten().any(|(at, _)| *at == i);
            if column.required && !there && !known {
                let unit = KINDS[column.kind].bare_unit(UnitSystem::Si);
                let expected = format!("a column `{}[{unit}]`", column.name);
                self.error(span, format!("no column `{}`", column.name), expected);
            }
        }
    }

    fn names(&self) -> Vec<&'a str> {
        self.wanted.iter().map(|column| column.name).collect()
    }

    /// The column with this name, or with this recorder heading.
    fn place(&self, name: &str) -> Option<usize> {
        let named =
            |name: &str| self.wanted.iter().position(|c| c.name == name || (c.alias == name && !name.is_empty()));
        named(name).or_else(|| named(heading(name)?))
    }

    fn column(&mut self, cell: &Cell, unit_below: Option<&str>) -> Option<(usize, f64)> {
        let (name, unit) = name_and_unit(cell.text);
        let unit_text = unit.or(unit_below);
        if name == "-" {
            self.left_out.push(self.columns.len());
            return None;
        }
        let by_unit = || heading_in(name, parse_heading(unit_text?).ok()?.dimension).and_then(|name| self.place(name));
        let Some(i) = by_unit().or_else(|| self.place(name)) else {
            let names = self.names();
            let problem =
                Problem::error("", format!("unknown column `{}`", shortened(name, CELL)), one_of(&names, '`'));
            self.report(cell.span, problem.with_hint(did_you_mean(name, &names, '`')));
            return None;
        };
        if self.columns.iter().flatten().any(|(at, _)| *at == i) {
            self.error(cell.span, format!("column `{name}` twice"), "each column once");
            return None;
        }
        match KINDS[self.wanted[i].kind].column_factor(name, unit_text) {
            Ok(factor) => Some((i, factor)),
            Err(e) => {
                self.report(cell.span, Problem::error("", e.found, e.expected).with_hint(e.hint));
                None
            }
        }
    }

    /// The number of column `i` in a line.
    fn number(&mut self, i: usize, cell: &Cell) -> f64 {
        let is_left_out = self.left_out.contains(&i);
        self.separator.number(cell).unwrap_or_else(|found| {
            if is_left_out {
                return f64::NAN;
            }
            self.error(cell.span, found, "a number");
            f64::NAN
        })
    }

    fn row(&mut self, table: &mut NumberTable, numbers: Vec<f64>, span: Span) {
        if numbers.len() != self.columns.len() {
            let expected = format!("{}, one for each column", self.columns.len());
            return self.error(span, format!("{} numbers", numbers.len()), expected);
        }
        let mut row = vec![0.0; self.wanted.len()];
        for (number, column) in numbers.into_iter().zip(&self.columns) {
            if let Some((i, factor)) = column {
                row[*i] = number * factor;
            }
        }
        table.rows.push(row);
        table.row_spans.push(span);
    }
}

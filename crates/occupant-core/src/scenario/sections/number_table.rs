//! Tables of numbers, in a CSV file beside the scenario or in the scenario itself.
//!
//! The first line names the columns with their units, `t[s],x[m],yaw[deg]`. Every further line holds one number for each
//! column. Blank lines and lines that start with `#` are skipped.

use crate::scenario::kind::{KINDS, UnitSystem};
use placed_text::{
    CELL, Cell, Diagnostic, Diagnostics, Node, Problem, SourceId, Sources, Span, cells, did_you_mean, lines,
    name_and_unit, number, one_of, shortened,
};

/// A column that a table may have.
#[derive(Clone, Copy, Debug)]
pub(super) struct Column {
    /// Its name.
    pub name: &'static str,
    /// Another name that means the same; empty if it has none.
    pub alias: &'static str,
    /// Index of its kind of quantity.
    pub kind: usize,
    /// Whether it must be there; others are zero where they are not.
    pub required: bool,
}

pub(super) const fn column(name: &'static str, kind: usize, required: bool) -> Column {
    Column { name, alias: "", kind, required }
}

/// A table in SI units, angles in radians; one value for each of the columns asked for.
#[derive(Clone, Debug)]
pub(super) struct NumberTable {
    /// Lines of numbers.
    pub rows: Vec<Vec<f64>>,
    /// Where each line stands.
    pub row_spans: Vec<Span>,
    /// Where the names of the columns stand.
    pub header: Span,
    /// Which of the columns asked for are there.
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

/// Reads a CSV text.
///
/// # Errors
/// Unknown, doubled and missing columns, wrong units, lines with too few or too many cells, cells that are no number.
pub(super) fn read_csv(sources: &Sources, id: SourceId, columns: &[Column]) -> Result<NumberTable, Diagnostics> {
    let mut reader = Reader::new(sources, columns);
    let mut lines = lines(sources, id);
    let Some(header) = lines.next() else {
        reader.error(sources.start_of(id), "an empty table", "a line that names the columns");
        return Err(reader.problems);
    };
    let named = cells(sources, header);
    let mut table = NumberTable::new(header);
    if named.iter().all(|cell| reader.place(name_and_unit(cell.text).0).is_none()) {
        // any file can be named in a scenario: what is no such table is not shown
        let expected = one_of(&reader.names(), '`');
        reader.error(header, "a first line that names no column of such a table", expected);
        return Err(reader.problems);
    }
    reader.header(&named, header);
    for line in lines {
        let cells = cells(sources, line);
        let numbers = cells.iter().map(|c| reader.number(c)).collect();
        reader.row(&mut table, numbers, line);
    }
    reader.finish(table)
}

/// Reads the `columns` and `rows` of a section of the scenario; both have passed the check.
///
/// # Errors
/// As for [`read_csv`].
pub(super) fn read_inline(sources: &Sources, section: &Node, columns: &[Column]) -> Result<NumberTable, Diagnostics> {
    let mut reader = Reader::new(sources, columns);
    let items = |key: &str| section.get(key).map_or(&[][..], Node::items);
    let header: Vec<Cell> =
        items("columns").iter().filter_map(|n| n.as_str().map(|text| Cell { text, span: n.span })).collect();
    let span = section.get("columns").map_or(section.span, |n| n.span);
    reader.header(&header, span);
    let mut table = NumberTable::new(span);
    for row in items("rows") {
        let numbers = row.items().iter().map(|n| n.value.number().unwrap_or(f64::NAN)).collect();
        reader.row(&mut table, numbers, row.span);
    }
    reader.finish(table)
}

struct Reader<'a> {
    sources: &'a Sources,
    wanted: &'a [Column],
    /// For each column of the table, the wanted column and SI units in one of its own.
    columns: Vec<Option<(usize, f64)>>,
    problems: Diagnostics,
}

impl<'a> Reader<'a> {
    fn new(sources: &'a Sources, wanted: &'a [Column]) -> Self {
        Reader { sources, wanted, columns: Vec::new(), problems: Diagnostics::new() }
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

    fn header(&mut self, cells: &[Cell], span: Span) {
        for cell in cells {
            let column = self.column(cell);
            self.columns.push(column);
        }
        let wanted = self.wanted;
        for (i, column) in wanted.iter().enumerate() {
            let there = cells.iter().any(|c| name_and_unit(c.text).0 == column.name);
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

    /// Which of the columns has this name.
    fn place(&self, name: &str) -> Option<usize> {
        self.wanted.iter().position(|c| c.name == name || (c.alias == name && !name.is_empty()))
    }

    fn column(&mut self, cell: &Cell) -> Option<(usize, f64)> {
        let (name, unit_text) = name_and_unit(cell.text);
        let Some(i) = self.place(name) else {
            let names = self.names();
            let problem =
                Problem::error("", format!("unknown column `{}`", shortened(name, CELL)), one_of(&names, '`'));
            self.report(cell.span, problem.with_hint(did_you_mean(name, &names, '`')));
            return None;
        };
        if self.columns.iter().flatten().any(|(at, _)| *at == i) {
            self.error(cell.span, format!("column `{name}` a second time"), "each column once");
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

    fn number(&mut self, cell: &Cell) -> f64 {
        number(cell).unwrap_or_else(|found| {
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

//! Lines and cells of a text table, with their places: numbers and the names of columns.

use crate::shown::shortened;
use crate::source::{SourceId, Sources, Span};

/// A cell: its words and place.
#[derive(Clone, Copy)]
pub struct Cell<'a> {
    /// Its words, trimmed.
    pub text: &'a str,
    /// Their place.
    pub span: Span,
}

/// Cells of a line that are read: none has as many columns, so one that does is refused for what it is read as.
pub const MOST_CELLS: usize = 10_000;

/// Characters of a cell that messages show.
pub const CELL: usize = 40;

/// `x[m]` or `x (m)` → `x` and `m`.
pub fn name_and_unit(text: &str) -> (&str, Option<&str>) {
    let text = text.trim();
    for (open, close) in [('[', ']'), ('(', ')')] {
        if let Some((name, unit)) = text.strip_suffix(close).and_then(|t| t.rsplit_once(open)) {
            return (name.trim(), Some(unit.trim()));
        }
    }
    (text, None)
}

/// What stands between the cells of a text: semicolons, tabs, commas, or any number of blanks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Separator(char);

impl Separator {
    /// That of the text of which `line` is the first.
    pub fn of(line: &str) -> Self {
        let used = |sign: &char| line.trim_end().contains(*sign);
        Separator([';', '\t', ','].into_iter().find(used).unwrap_or(' '))
    }

    /// The pieces of a line with where each begins. Nothing separates within double quotes, no blank a name from its unit.
    fn pieces(self, line: &str) -> Vec<(usize, &str)> {
        let (mut pieces, mut start, mut quoted) = (Vec::new(), 0, false);
        for (at, sign) in line.char_indices() {
            quoted ^= sign == '"';
            let separates = match self.0 {
                ' ' => sign.is_whitespace() && !line[at..].trim_start().starts_with(['[', '(']),
                separator => sign == separator,
            };
            if separates && !quoted {
                pieces.push((start, &line[start..at]));
                start = at + sign.len_utf8();
            }
        }
        pieces.push((start, &line[start..]));
        pieces.retain(|(_, piece)| self.0 != ' ' || !piece.is_empty());
        pieces
    }

    /// The cells of a line, trimmed and without their quotes. A byte-order mark is no part of the first.
    pub fn cells(self, sources: &Sources, line: Span) -> Vec<Cell<'_>> {
        let text = sources.slice(line);
        let padding = |c: char| c.is_whitespace() || c == '"' || c == '\u{feff}';
        let cell = |(from, piece): (usize, &'_ str)| {
            let from = line.start + from;
            let lead = piece.len() - piece.trim_start_matches(padding).len();
            let text = piece.trim_matches(padding).len();
            let (start, end) = if text == 0 { (from, from + piece.len()) } else { (from + lead, from + lead + text) };
            let span = Span { source: line.source, start, end };
            Cell { text: if text == 0 { "" } else { sources.slice(span) }, span }
        };
        self.pieces(text).into_iter().take(MOST_CELLS + 1).map(cell).collect()
    }

    /// The number in a cell; the decimal sign may be a comma where none stands between cells.
    ///
    /// # Errors
    /// What was found instead of a finite number.
    pub fn number(self, cell: &Cell) -> Result<f64, String> {
        let point = if self.0 == ',' { cell.text.to_owned() } else { cell.text.replace(',', ".") };
        match (cell.text, point.parse::<f64>()) {
            (_, Ok(x)) if x.is_finite() => Ok(x),
            ("", _) => Err("an empty cell".to_owned()),
            (text, _) => Err(format!("`{}`", shortened(text, CELL))),
        }
    }
}

/// A text table: headings, units that may stand below them, and lines of cells.
pub struct TextTable<'a> {
    /// What stands between its cells.
    pub separator: Separator,
    /// Its first line.
    pub first: Span,
    /// Its headings; none where it begins with numbers.
    pub headings: Vec<Cell<'a>>,
    /// Units in a line of their own below the headings; none where there is no such line.
    pub units: Vec<Cell<'a>>,
    /// The lines below.
    pub lines: Vec<Span>,
}

impl<'a> TextTable<'a> {
    /// The table in a text, none in an empty one; `is_unit` says of a cell without brackets whether it is a unit.
    pub fn of(sources: &'a Sources, id: SourceId, is_unit: impl Fn(&str) -> bool) -> Option<Self> {
        let mut lines = lines(sources, id).peekable();
        let first = lines.peek().copied()?;
        let separator = Separator::of(sources.slice(first));
        let cells = |line: Span| separator.cells(sources, line);
        let has_number = |line: Span| cells(line).iter().any(|cell| separator.number(cell).is_ok());
        let headings = lines.next_if(|line| !has_number(*line)).map(cells);
        let names_units = |cell: &Cell| matches!(cell.text, "" | "-") || is_unit(bare(cell.text));
        let units =
            lines.next_if(|line| headings.is_some() && !has_number(*line) && cells(*line).iter().all(names_units));
        let (headings, units) = (headings.unwrap_or_default(), units.map(cells).unwrap_or_default());
        Some(TextTable { separator, first, headings, units, lines: lines.collect() })
    }

    /// The unit of a column, in its heading or below, with its place; none where there is none.
    pub fn unit(&self, column: usize) -> Option<(&'a str, Span)> {
        let heading = self.headings.get(column)?;
        let below =
            || self.units.get(column).map(|cell| (bare(cell.text), cell.span)).filter(|(unit, _)| !unit.is_empty());
        name_and_unit(heading.text).1.map(|unit| (unit, heading.span)).or_else(below)
    }
}

/// A unit without the brackets round it.
fn bare(unit: &str) -> &str {
    unit.trim_matches(['[', ']', '(', ')'])
}

/// The lines of a text that hold something.
pub fn lines(sources: &Sources, id: SourceId) -> impl Iterator<Item = Span> {
    let mut start = 0;
    sources
        .text(id)
        .split_inclusive('\n')
        .map(move |line| {
            let from = start;
            start += line.len();
            (line, from)
        })
        .filter(|(line, _)| {
            let line = line.trim_start_matches('\u{feff}').trim();
            !line.is_empty() && !line.starts_with('#')
        })
        .map(move |(line, from)| Span { source: id, start: from, end: from + line.trim_end().len() })
}

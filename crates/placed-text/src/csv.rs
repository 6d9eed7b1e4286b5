//! Lines and cells of a text table, with their places: numbers and the names of columns.

use crate::shown::shortened;
use crate::source::{SourceId, Sources, Span};

/// A cell: its words and place.
pub struct Cell<'a> {
    /// Its words, trimmed.
    pub text: &'a str,
    /// Their place.
    pub span: Span,
}

/// Cells of a line that are read: none has as many columns, so one that does is refused for what it is read as.
const MOST_CELLS: usize = 10_000;

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
        self.pieces(text).into_iter().take(MOST_CELLS).map(cell).collect()
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

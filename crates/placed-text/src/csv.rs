//! Lines and cells of a CSV text, with their places. Cells hold numbers and column names, so there is no quoting.

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

/// `x[m]` → `x` and `m`.
pub fn name_and_unit(text: &str) -> (&str, Option<&str>) {
    match text.split_once('[') {
        Some((name, rest)) => (name.trim(), Some(rest.trim_end().strip_suffix(']').unwrap_or(rest).trim())),
        None => (text.trim(), None),
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

/// The cells of a line, trimmed. A byte-order mark is no part of the first.
pub fn cells(sources: &Sources, line: Span) -> Vec<Cell<'_>> {
    let mut start = line.start;
    sources
        .slice(line)
        .split(',')
        .take(MOST_CELLS)
        .map(|raw| {
            let from = start;
            start += raw.len() + 1;
            let blank = |c: char| c.is_whitespace() || c == '\u{feff}';
            let text = raw.trim_matches(blank);
            let lead = raw.len() - raw.trim_start_matches(blank).len();
            let span = match text {
                "" => Span { source: line.source, start: from, end: from + raw.len() },
                _ => Span { source: line.source, start: from + lead, end: from + lead + text.len() },
            };
            Cell { text, span }
        })
        .collect()
}

/// The number in a cell.
///
/// # Errors
/// What was found instead of a finite number.
pub fn number(cell: &Cell) -> Result<f64, String> {
    match (cell.text, cell.text.parse::<f64>()) {
        (_, Ok(x)) if x.is_finite() => Ok(x),
        ("", _) => Err("an empty cell".to_owned()),
        (text, _) => Err(format!("`{}`", shortened(text, CELL))),
    }
}

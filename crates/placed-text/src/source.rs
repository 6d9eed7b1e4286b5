//! Named texts, and places in them.
//!
//! A scenario may come from several texts: its own file, command line overrides, a preset, tables in CSV files. Every
//! value keeps the [`Span`] it was read from, so that a problem found much later still points at the words that caused it.

use std::sync::Arc;

/// Index of a text in [`Sources`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SourceId(usize);

/// A range of bytes of one text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Span {
    /// The text.
    pub source: SourceId,
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

impl Span {
    /// A part of this span: bytes `from..to` counted from its start.
    pub fn part(self, from: usize, to: usize) -> Span {
        Span { source: self.source, start: (self.start + from).min(self.end), end: (self.start + to).min(self.end) }
    }
}

/// A named text.
#[derive(Clone, Debug, PartialEq)]
struct Source {
    /// File name as the user gave it, or a description such as `--set path.speed`.
    name: Arc<str>,
    /// The text.
    text: Arc<str>,
    /// Whether messages quote its lines.
    is_quoted: bool,
}

/// Line and column of a position, both from 1; the column counts characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// Line.
    pub line: usize,
    /// Column.
    pub column: usize,
}

/// All texts of a scenario.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sources(Vec<Source>);

impl Sources {
    /// No texts.
    pub fn new() -> Self {
        Sources::default()
    }

    /// Adds a text. Copies of the set share it.
    pub fn add(&mut self, name: impl Into<Arc<str>>, text: impl Into<Arc<str>>) -> SourceId {
        self.0.push(Source { name: name.into(), text: text.into(), is_quoted: true });
        SourceId(self.0.len() - 1)
    }

    /// Adds a text that another one refers to. It may be any file of the user, so messages give positions in it but
    /// quote no line.
    pub fn add_named(&mut self, name: impl Into<Arc<str>>, text: impl Into<Arc<str>>) -> SourceId {
        self.0.push(Source { name: name.into(), text: text.into(), is_quoted: false });
        SourceId(self.0.len() - 1)
    }

    /// Whether messages quote lines of the text.
    pub(crate) fn quotes(&self, id: SourceId) -> bool {
        self.0.get(id.0).is_some_and(|s| s.is_quoted)
    }

    /// The text with this name, if there is one.
    pub fn named(&self, name: &str) -> Option<SourceId> {
        self.0.iter().position(|s| *s.name == *name).map(SourceId)
    }

    /// The text, or an empty one for an id of another set.
    pub fn text(&self, id: SourceId) -> &str {
        self.0.get(id.0).map_or("", |s| &s.text)
    }

    /// The text, shared.
    pub fn shared(&self, id: SourceId) -> Arc<str> {
        self.0.get(id.0).map_or_else(|| "".into(), |s| s.text.clone())
    }

    /// The name of the text.
    pub fn name(&self, id: SourceId) -> &str {
        self.0.get(id.0).map_or("", |s| &s.name)
    }

    /// A span that covers the first character of a text.
    pub fn start_of(&self, id: SourceId) -> Span {
        Span { source: id, start: 0, end: self.text(id).chars().next().map_or(0, char::len_utf8) }
    }

    /// Text of a span; empty if it lies outside its text or splits a character.
    pub fn slice(&self, span: Span) -> &str {
        self.text(span.source).get(span.start..span.end).unwrap_or("")
    }

    /// Line and column where the span starts.
    pub fn position(&self, span: Span) -> Position {
        let text = self.text(span.source);
        let before = &text[..floor_char_boundary(text, span.start)];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        Position { line: before.matches('\n').count() + 1, column: before[line_start..].chars().count() + 1 }
    }

    /// The whole line where the span starts, without its line end.
    pub fn line(&self, span: Span) -> &str {
        let text = self.text(span.source);
        let at = floor_char_boundary(text, span.start);
        let start = text[..at].rfind('\n').map_or(0, |i| i + 1);
        let end = text[at..].find('\n').map_or(text.len(), |i| at + i);
        text[start..end].trim_end_matches('\r')
    }
}

/// The largest character boundary of `text` at or before `index`.
fn floor_char_boundary(text: &str, index: usize) -> usize {
    let mut at = index.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_lines_and_characters_from_one() {
        let mut sources = Sources::new();
        let id = sources.add("f", "ab\r\nγδ = 1\n");
        let span = |start, end| Span { source: id, start, end };
        assert_eq!(sources.position(span(0, 1)), Position { line: 1, column: 1 });
        // γ is two bytes: δ starts at byte 6 but is the second character.
        assert_eq!(sources.position(span(6, 8)), Position { line: 2, column: 2 });
        assert_eq!(sources.line(span(0, 1)), "ab");
        assert_eq!(sources.line(span(6, 8)), "γδ = 1");
        assert_eq!(sources.slice(span(6, 8)), "δ");
        // In the middle of a character and past the end: no panic.
        assert_eq!(sources.slice(span(5, 8)), "");
        assert_eq!(sources.position(span(5, 6)).column, 1);
        assert_eq!(sources.position(span(500, 600)).line, 3);
    }
}

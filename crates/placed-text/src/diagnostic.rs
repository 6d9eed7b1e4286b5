//! Problems with the place they come from, and their text for people.

use std::fmt;

use crate::DID_YOU_MEAN;
use crate::problem::{Problem, Severity};
use crate::shown::{quoted, shown};
use crate::source::{Position, Sources, Span};

/// A problem with its position.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// Severity, what was found, what was expected, and the remedy.
    pub problem: Problem,
    /// Name of the text: a file, an override, a preset.
    pub source: String,
    /// Line and column, from 1; `None` without a position in a text.
    pub position: Option<Position>,
    /// The line of the problem, shortened around it if it is long; `None` if no line is shown.
    pub line: Option<String>,
    /// First character of the problem in the line, and the one after its last.
    words: [usize; 2],
}

/// Problems of a scenario, in the order found: the first 50 of each severity are kept, the others counted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diagnostics {
    kept: Vec<Diagnostic>,
    /// Numbers of further warnings and errors.
    more: [usize; 2],
}

/// Number of problems kept per severity.
const MOST: usize = 50;

/// Characters shown on each side of the problem in a long line.
const CONTEXT_CHARS: usize = 60;

impl Diagnostic {
    /// A problem at a known position.
    pub fn at(sources: &Sources, span: Span, problem: Problem) -> Self {
        let position = sources.position(span);
        let words = sources.slice(span).lines().next().unwrap_or("").chars().take(2 * CONTEXT_CHARS).count();
        let quoted = sources.quotes(span.source).then(|| excerpt(sources.line(span), position.column - 1, words));
        let (line, words) = quoted.map_or((None, [0; 2]), |(line, words)| (Some(line), words));
        Diagnostic { position: Some(position), line, words, ..Diagnostic::of(sources.name(span.source), problem) }
    }

    /// A problem of a text as a whole.
    pub fn of(source: impl Into<String>, problem: Problem) -> Self {
        Diagnostic { problem, source: source.into(), position: None, line: None, words: [0; 2] }
    }
}

/// A line, shortened around the problem if it is long, and the problem's characters in it.
fn excerpt(line: &str, start: usize, words: usize) -> (String, [usize; 2]) {
    let is_long = line.chars().nth(2 * CONTEXT_CHARS).is_some();
    let from = if is_long { start.saturating_sub(CONTEXT_CHARS) } else { 0 };
    let mut rest = line.chars().skip(from);
    let most = start - from + words.min(CONTEXT_CHARS) + CONTEXT_CHARS;
    let kept: Vec<char> = rest.by_ref().take(if is_long { most } else { usize::MAX }).collect();
    let (lead, tail) = (if from > 0 { "…" } else { "" }, if rest.next().is_some() { "…" } else { "" });
    let column = |at: usize| quoted(&kept[..(at - from).min(kept.len())]).chars().count() + lead.chars().count();
    (format!("{lead}{}{tail}", quoted(&kept)).trim_end().to_owned(), [column(start), column(start + words)])
}

impl fmt::Display for Diagnostic {
    /// Several lines, plain text, without a line end after the last.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let problem = &self.problem;
        write!(f, "{}: {}", problem.severity.word(), shown(&problem.found))?;
        let source = shown(&self.source);
        let pad = " ".repeat(self.position.map_or(1, |p| p.line.to_string().len()));
        match self.position {
            None => write!(f, "\n --> {source}")?,
            Some(Position { line, column }) => write!(f, "\n{pad}--> {source}:{line}:{column}")?,
        }
        if let (Some(line), Some(Position { line: number, .. })) = (&self.line, self.position) {
            let [start, end] = self.words;
            let (gap, carets) = (" ".repeat(start), "^".repeat((end - start).max(1)));
            let bar = if line.is_empty() { " |" } else { " | " };
            write!(f, "\n{pad} |\n{number}{bar}{line}\n{pad} | {gap}{carets}")?;
        }
        // a name that was meant says more than a long list of those that could be
        let hint = problem.hint.as_deref().unwrap_or_default();
        let (meant, remedy) = if hint.starts_with(DID_YOU_MEAN) { (hint, "") } else { ("", hint) };
        let notes = [("help", meant), ("in", &problem.path), ("expected", &problem.expected), ("help", remedy)];
        notes
            .into_iter()
            .filter(|(_, text)| !text.is_empty())
            .try_for_each(|(word, text)| write!(f, "\n{pad} = {word}: {}", shown(text)))
    }
}

impl Diagnostics {
    /// No problems.
    pub fn new() -> Self {
        Diagnostics::default()
    }

    /// Adds a problem, unless the same text is already there for the same position (as for both joints of a pair).
    pub fn push(&mut self, diagnostic: Diagnostic) {
        let same = |d: &Diagnostic| {
            d.position.is_some()
                && d.position == diagnostic.position
                && d.source == diagnostic.source
                && d.problem.found == diagnostic.problem.found
        };
        if self.kept.iter().any(same) {
            return;
        }
        if self.is_full(diagnostic.problem.severity) {
            self.more[diagnostic.problem.severity as usize] += 1;
        } else {
            self.kept.push(diagnostic);
        }
    }

    /// Adds a problem; its position is determined only if it is kept.
    pub fn add(&mut self, problem: Problem, place: impl FnOnce(Problem) -> Diagnostic) {
        if self.is_full(problem.severity) {
            self.more[problem.severity as usize] += 1;
        } else {
            self.push(place(problem));
        }
    }

    /// Whether further problems of a severity are only counted.
    pub fn is_full(&self, severity: Severity) -> bool {
        self.kept.iter().filter(|d| d.problem.severity == severity).count() >= MOST
    }

    /// Adds all of `other`.
    pub fn extend(&mut self, other: Diagnostics) {
        for (more, others) in self.more.iter_mut().zip(other.more) {
            *more += others;
        }
        for diagnostic in other.kept {
            self.push(diagnostic);
        }
    }

    /// Number of problems of a severity.
    pub fn count(&self, severity: Severity) -> usize {
        self.kept.iter().filter(|d| d.problem.severity == severity).count() + self.more[severity as usize]
    }

    /// True if any is an error.
    pub fn has_errors(&self) -> bool {
        self.count(Severity::Error) > 0
    }

    /// True if there are none.
    pub fn is_empty(&self) -> bool {
        self.kept.is_empty()
    }

    /// Number of problems.
    pub fn len(&self) -> usize {
        self.kept.len() + self.more.iter().sum::<usize>()
    }

    /// The same with at most `most` to show; the others are counted.
    #[must_use]
    pub fn abridged(mut self, most: usize) -> Self {
        let left_out = self.kept.split_off(most.min(self.kept.len()));
        left_out.iter().for_each(|diagnostic| self.more[diagnostic.problem.severity as usize] += 1);
        self
    }

    /// The kept problems.
    pub fn iter(&self) -> std::slice::Iter<'_, Diagnostic> {
        self.kept.iter()
    }
}

impl From<Diagnostic> for Diagnostics {
    fn from(one: Diagnostic) -> Self {
        Diagnostics { kept: vec![one], more: [0; 2] }
    }
}

impl fmt::Display for Diagnostics {
    /// Each as in [`Diagnostic`], separated by empty lines, then the number of further ones.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, diagnostic) in self.kept.iter().enumerate() {
            let gap = if i > 0 { "\n\n" } else { "" };
            write!(f, "{gap}{diagnostic}")?;
        }
        for (more, what) in self.more.iter().zip(["warnings", "errors"]).filter(|(more, _)| **more > 0) {
            write!(f, "\n\nand {more} more {what}, not shown")?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostics {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_hidden_in_a_quoted_line_is_shown_and_the_carets_stand_below_its_words() {
        let mut sources = Sources::new();
        let source = sources.add("f", "a\u{1b}\t= \"\u{202e}b\"\n");
        let at = Diagnostic::at(&sources, Span { source, start: 5, end: 11 }, Problem::error("b", "no word", "one"));
        let expected = "1 | a\\u001b = \"\\u202eb\"\n  |           ^^^^^^^^^\n";
        assert!(at.to_string().contains(expected), "{at}");
    }

    #[test]
    fn a_long_line_is_cut_round_its_words_in_what_was_written() {
        let line = format!("{}word{}", "\u{1b}".repeat(100), "x".repeat(100));
        let (text, words) = excerpt(&line, 100, 4);
        let (lead, tail) = ("\\u001b".repeat(CONTEXT_CHARS), "x".repeat(CONTEXT_CHARS));
        assert_eq!(text, format!("…{lead}word{tail}…"));
        assert_eq!(words, [1 + 6 * CONTEXT_CHARS, 5 + 6 * CONTEXT_CHARS]);
    }
}

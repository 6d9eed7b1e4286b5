//! Problems with the place they come from, and their text for people.

use std::fmt;

use crate::problem::{Problem, Severity};
use crate::source::{Position, Sources, Span};

/// A problem and where it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// How bad it is, what was found, what was expected, how to mend it.
    pub problem: Problem,
    /// Name of the text: the file, an override, a preset.
    pub source: String,
    /// Line and column, from 1; `None` where no text can be pointed at.
    pub position: Option<Position>,
    /// The offending words.
    pub words: String,
    /// The line they stand in.
    pub line: String,
}

/// All problems of a scenario, in the order in which they were found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diagnostics(Vec<Diagnostic>);

/// Characters of a long line shown on each side of the offending words.
const CONTEXT_CHARS: usize = 60;

impl Diagnostic {
    /// A problem whose words are known.
    pub fn at(sources: &Sources, span: Span, problem: Problem) -> Self {
        let line = sources.line(span);
        let words = sources.slice(span).lines().next().unwrap_or("");
        Diagnostic {
            problem,
            source: sources.name(span.source).to_owned(),
            position: Some(sources.position(span)),
            words: words.to_owned(),
            line: line.to_owned(),
        }
    }

    /// A problem of a text as a whole.
    pub fn of(source: impl Into<String>, problem: Problem) -> Self {
        Diagnostic { problem, source: source.into(), position: None, words: String::new(), line: String::new() }
    }

    /// The line, shortened around the words if long, and the two columns (characters) between which the caret runs.
    fn excerpt(&self, column: usize) -> (String, usize, usize) {
        let chars: Vec<char> = self.line.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        let start = (column - 1).min(chars.len());
        let end = (start + self.words.chars().count()).min(chars.len());
        let from = if chars.len() > 2 * CONTEXT_CHARS { start.saturating_sub(CONTEXT_CHARS) } else { 0 };
        let to = chars.len().min(end.min(start + CONTEXT_CHARS) + CONTEXT_CHARS);
        let (lead, tail) = (if from > 0 { "…" } else { "" }, if to < chars.len() { "…" } else { "" });
        let text: String = chars[from..to].iter().collect();
        let shift = lead.chars().count();
        (format!("{lead}{text}{tail}").trim_end().to_owned(), start - from + shift, end.min(to) - from + shift)
    }
}

impl fmt::Display for Diagnostic {
    /// Several lines, plain text, without a line end after the last.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let problem = &self.problem;
        let word = match problem.severity {
            Severity::Warning => "warning",
            Severity::Error => "error",
        };
        write!(f, "{word}: {}", problem.found)?;
        let margin = match self.position {
            None => {
                write!(f, "\n --> {}", self.source)?;
                1
            }
            Some(position) => {
                let number = position.line.to_string();
                let margin = number.len();
                let (line, start, end) = self.excerpt(position.column);
                let carets = "^".repeat((end - start).max(1));
                let (pad, gap) = (" ".repeat(margin), " ".repeat(start));
                let Position { line: row, column } = position;
                write!(f, "\n{pad}--> {}:{row}:{column}", self.source)?;
                let bar = if line.is_empty() { " |" } else { " | " };
                write!(f, "\n{pad} |\n{number}{bar}{line}\n{pad} | {gap}{carets}")?;
                margin
            }
        };
        let pad = " ".repeat(margin);
        if !problem.path.is_empty() {
            write!(f, "\n{pad} = in: {}", problem.path)?;
        }
        if !problem.expected.is_empty() {
            write!(f, "\n{pad} = expected: {}", problem.expected)?;
        }
        match &problem.hint {
            Some(hint) => write!(f, "\n{pad} = help: {hint}"),
            None => Ok(()),
        }
    }
}

impl Diagnostics {
    /// No problem yet.
    pub fn new() -> Self {
        Diagnostics::default()
    }

    /// Adds one, unless the same is said of the same place already (of both joints of a pair, say).
    pub fn push(&mut self, diagnostic: Diagnostic) {
        let same = |d: &Diagnostic| {
            d.position.is_some()
                && d.position == diagnostic.position
                && d.source == diagnostic.source
                && d.problem.found == diagnostic.problem.found
        };
        if !self.0.iter().any(same) {
            self.0.push(diagnostic);
        }
    }

    /// Adds all of `other`.
    pub fn extend(&mut self, other: Diagnostics) {
        self.0.extend(other.0);
    }

    /// True if any is an error.
    pub fn has_errors(&self) -> bool {
        self.0.iter().any(|d| d.problem.severity == Severity::Error)
    }

    /// True if there is none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// How many.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Each in turn.
    pub fn iter(&self) -> std::slice::Iter<'_, Diagnostic> {
        self.0.iter()
    }
}

impl From<Diagnostic> for Diagnostics {
    fn from(one: Diagnostic) -> Self {
        Diagnostics(vec![one])
    }
}

impl fmt::Display for Diagnostics {
    /// Each as in [`Diagnostic`], an empty line between two.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, diagnostic) in self.0.iter().enumerate() {
            if i > 0 {
                write!(f, "\n\n")?;
            }
            write!(f, "{diagnostic}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostics {}

//! Common part of the readers of TOML and JSON: the text and a list of its problems.

use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::node::{Node, Value};
use crate::problem::Problem;
use crate::source::{SourceId, Sources, Span};

/// A text being read.
pub(super) struct Reader<'a> {
    pub(super) sources: &'a Sources,
    pub(super) id: SourceId,
    problems: Diagnostics,
}

impl<'a> Reader<'a> {
    pub(super) fn new(sources: &'a Sources, id: SourceId) -> Self {
        Reader { sources, id, problems: Diagnostics::new() }
    }

    pub(super) fn finish(self, node: Node) -> Result<Node, Diagnostics> {
        if self.problems.is_empty() { Ok(node) } else { Err(self.problems) }
    }

    pub(super) fn span(&self, range: std::ops::Range<usize>) -> Span {
        Span { source: self.id, start: range.start, end: range.end }
    }

    /// Reports an error at a position; the value there becomes `null`.
    pub(super) fn reject(&mut self, span: Span, found: &str, expected: &str) -> Value {
        let problem = Problem::error("", found, expected);
        self.problems.add(problem, |problem| Diagnostic::at(self.sources, span, problem));
        Value::Null
    }
}

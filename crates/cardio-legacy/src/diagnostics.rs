//! Problems of a deck: collected, never the first only.

use std::fmt;

use crate::cards::{CardId, Field};
use crate::deck::DeckCard;
use crate::punched::{Columns, PunchedCard};
use crate::rule::{Rule, Severity, Strictness};

/// Largest number of names in a message.
pub(crate) const LISTED: usize = 24;

/// One problem, with its location and remedy.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnostic {
    /// Severity.
    pub severity: Severity,
    /// Violated rule.
    pub rule: Rule,
    /// Name of the file.
    pub file: String,
    /// Line in the file, from 1; `None` for the file as a whole.
    pub line: Option<usize>,
    /// Series and letter of the card, if known.
    pub card: Option<CardId>,
    /// Columns.
    pub columns: Option<Columns>,
    /// The report's name of the variable.
    pub variable: Option<String>,
    /// Text of the card in the file, without trailing blanks.
    pub raw: Option<String>,
    /// Description of the problem.
    pub message: String,
    /// Expected value.
    pub expected: Option<String>,
    /// Remedy.
    pub remedy: Option<String>,
}

/// Builder of a problem; reporting it adds the file and the severity.
impl Diagnostic {
    pub(crate) fn new(rule: Rule, message: impl Into<String>) -> Self {
        let [expected, remedy] = rule.expected_and_remedy().map(|text| text.map(str::to_owned));
        Self {
            severity: Severity::Error,
            rule,
            file: String::new(),
            line: None,
            card: None,
            columns: None,
            variable: None,
            raw: None,
            message: message.into(),
            expected,
            remedy,
        }
    }

    pub(crate) fn on(self, card: &PunchedCard) -> Self {
        Self { raw: Some(card.text()), ..self.at_line(card.line) }
    }

    /// Location on a card of a deck, with line and text if it was read from a file.
    pub(crate) fn on_card_of_deck(self, card: &DeckCard) -> Self {
        Self { card: Some(card.id), line: card.line.or(self.line), raw: card.raw.clone().or(self.raw), ..self }
    }

    pub(crate) fn at_line(self, line: usize) -> Self {
        Self { line: Some(line), ..self }
    }

    pub(crate) fn in_card(self, card: CardId) -> Self {
        Self { card: Some(card), ..self }
    }

    pub(crate) fn at(self, columns: Columns) -> Self {
        Self { columns: Some(columns), ..self }
    }

    pub(crate) fn in_field(self, field: &Field) -> Self {
        self.at(field.columns).variable(&field.variable)
    }

    pub(crate) fn variable(self, name: impl Into<String>) -> Self {
        Self { variable: Some(name.into()), ..self }
    }

    pub(crate) fn expected(self, text: impl Into<String>) -> Self {
        Self { expected: Some(text.into()), ..self }
    }

    pub(crate) fn remedy(self, text: impl Into<String>) -> Self {
        Self { remedy: Some(text.into()), ..self }
    }

    pub(crate) fn report(self, sink: &mut Sink) {
        let severity = self.rule.grade().severity(sink.strictness);
        sink.found.items.push(Self { severity, file: sink.file.clone(), ..self });
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}[{}]: {}", self.severity, self.rule.name(), self.message)?;
        let line = self.line.map(|line| format!(":{line}"));
        let card = self.card.map(|card| format!(", card {card}"));
        let columns = self.columns.map(|columns| format!(", {columns}"));
        let variable = self.variable.as_ref().map(|variable| format!(", {variable}"));
        let place: String = [line, card, columns, variable].into_iter().flatten().collect();
        writeln!(f, "  --> {}{place}", self.file)?;
        if let Some(raw) = &self.raw {
            writeln!(f, "   | {raw}")?;
            if let Some(columns) = self.columns {
                let indent = " ".repeat(usize::from(columns.first.max(1)) - 1);
                writeln!(f, "   | {indent}{}", "^".repeat(columns.width()))?;
            }
        }
        if let Some(expected) = &self.expected {
            writeln!(f, "   = expected: {expected}")?;
        }
        if let Some(remedy) = &self.remedy {
            writeln!(f, "   = remedy: {remedy}")?;
        }
        Ok(())
    }
}

/// Number of problems shown per rule.
const SHOWN: usize = 5;
/// Rules violated as a consequence of shifted columns.
const OF_MOVED_COLUMNS: [Rule; 3] = [Rule::SeriesMissing, Rule::UnexpectedCard, Rule::NoTerminator];

/// All problems of a file, in the order of detection.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Diagnostics {
    items: Vec<Diagnostic>,
}

impl Diagnostics {
    /// The problems one by one.
    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.items.iter()
    }

    /// Number of problems of one severity.
    pub fn count(&self, severity: Severity) -> usize {
        self.items.iter().filter(|d| d.severity == severity).count()
    }

    /// Whether any deck of the file is unusable.
    pub fn has_errors(&self) -> bool {
        self.count(Severity::Error) > 0
    }

    /// Whether there are no problems, not even a note.
    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }
}

impl fmt::Display for Diagnostics {
    /// The first problems of each rule, then one line with all counts.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut seen: Vec<(Rule, usize)> = Vec::new();
        let moved = self.items.iter().filter(|item| item.rule == Rule::Tab && item.severity == Severity::Error).count();
        let shown = self.items.iter().filter(|item| moved < SHOWN || !OF_MOVED_COLUMNS.contains(&item.rule));
        for item in shown {
            let at = seen.iter().position(|(rule, _)| *rule == item.rule).unwrap_or_else(|| {
                seen.push((item.rule, 0));
                seen.len() - 1
            });
            seen[at].1 += 1;
            if seen[at].1 <= SHOWN {
                writeln!(f, "{item}")?;
            }
        }
        for (rule, count) in seen.iter().filter(|(_, count)| *count > SHOWN) {
            writeln!(f, "and {} more of the kind [{}]\n", count - SHOWN, rule.name())?;
        }
        if moved >= SHOWN {
            writeln!(f, "{moved} lines contain tabs: what cards are missing is told once they have columns\n")?;
        }
        let counted = |severity, name: &str| {
            let n = self.count(severity);
            format!("{n} {name}{}", if n == 1 { "" } else { "s" })
        };
        write!(
            f,
            "{}, {}, {}",
            counted(Severity::Error, "error"),
            counted(Severity::Warning, "warning"),
            counted(Severity::Note, "note")
        )
    }
}

/// Collector of problems, with the file and the strictness.
#[derive(Debug)]
pub(crate) struct Sink {
    file: String,
    strictness: Strictness,
    found: Diagnostics,
}

impl Sink {
    pub(crate) fn new(file: &str, strictness: Strictness) -> Self {
        Self { file: file.into(), strictness, found: Diagnostics::default() }
    }

    pub(crate) fn errors(&self) -> usize {
        self.found.count(Severity::Error)
    }

    /// Whether an error was found on one of these lines, as by the reading of lines before that of decks.
    pub(crate) fn has_error_in(&self, first: usize, last: usize) -> bool {
        let errors = self.found.items.iter().filter(|d| d.severity == Severity::Error);
        errors.filter_map(|d| d.line).any(|line| (first..=last).contains(&line))
    }

    /// Replaces equal problems of many fields by one.
    fn fold_lone_points(&mut self) {
        let (mut points, others): (Vec<_>, Vec<_>) =
            std::mem::take(&mut self.found.items).into_iter().partition(|d| d.rule == Rule::LonePoint);
        self.found.items = others;
        if points.len() > 1 {
            let names: Vec<&str> = points.iter().filter_map(|d| d.variable.as_deref()).take(LISTED).collect();
            let more = points.len() - names.len();
            let more = if more > 0 { format!(" and {more} more") } else { String::new() };
            let message = format!(
                "{} fields hold a point without a digit, which was zero on the 360: {}{more}",
                points.len(),
                names.join(", ")
            );
            points.truncate(1);
            points[0].message = message;
        }
        self.found.items.append(&mut points);
    }

    pub(crate) fn into_diagnostics(mut self) -> Diagnostics {
        self.fold_lone_points();
        self.found.items.sort_by_key(|d| d.line.unwrap_or(usize::MAX));
        self.found
    }
}

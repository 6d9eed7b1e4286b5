//! TOML text, block by block, with numbers by their card's name.

use std::fmt::Write as _;

use super::{Conversion, ConversionError, Report};
use crate::cards::field_named;
use crate::deck::{Deck, Number};

/// Column of the comments after short lines.
const COMMENT_COLUMN: usize = 40;

/// A scenario being written.
pub(super) struct Writer<'a> {
    pub deck: &'a Deck,
    pub report: Report,
    text: String,
    /// Table of the following lines.
    table: String,
    missing: Option<String>,
}

impl<'a> Writer<'a> {
    pub fn new(deck: &'a Deck) -> Self {
        let report = Report { blanks: deck.blank_fields(), ..Report::default() };
        Self { deck, report, text: String::new(), table: String::new(), missing: None }
    }

    /// Text and report; an error if the deck lacked a requested field.
    ///
    /// # Errors
    /// A text that is no scenario.
    pub fn finish(self) -> Result<Conversion, ConversionError> {
        match self.missing {
            Some(name) => Err(ConversionError::MissingField(name)),
            None => Ok(Conversion { toml: self.text.trim_end().to_owned() + "\n", report: self.report }),
        }
    }

    fn number(&mut self, name: &str) -> Option<&'a Number> {
        let number = self.deck.number(name);
        if number.is_none() {
            self.missing.get_or_insert_with(|| name.to_owned());
        }
        number
    }

    /// Value of a field, in the card's unit; zero if absent, which [`Writer::finish`] reports.
    pub fn value(&mut self, name: &str) -> f64 {
        self.number(name).map_or(0.0, |n| n.value)
    }

    /// Digits of a field as a number without unit.
    pub fn bare(&mut self, name: &str) -> String {
        self.number(name).map_or_else(|| "0".to_owned(), |n| n.digits.clone())
    }

    /// A field as a quantity with its unit, quoted: `"13.71 in"`.
    pub fn quantity(&mut self, name: &str) -> String {
        let digits = self.bare(name);
        match field_named(name).map_or("", |field| field.unit.in_scenarios) {
            "" => digits,
            unit => format!("\"{digits} {unit}\""),
        }
    }

    /// Line of a field with its own key: `end = "0.2 s"  # TF`.
    pub fn field(&mut self, name: &str) {
        self.field_with(name, name);
    }

    /// Line of a field with its own key, with another comment.
    pub fn field_with(&mut self, name: &str, comment: &str) {
        let key = field_named(name).and_then(|field| field.key.as_deref()).unwrap_or_default();
        let in_table = key.strip_prefix(&self.table).and_then(|key| key.strip_prefix('.')).unwrap_or(key);
        let value = self.quantity(name);
        self.set_with(in_table, &value, comment);
    }

    pub fn blank_line(&mut self) {
        self.text.push('\n');
    }

    pub fn comment(&mut self, text: &str) {
        for line in text.lines() {
            let _ = writeln!(self.text, "{}", format!("# {line}").trim_end());
        }
    }

    /// Table header, after an empty line and a comment.
    pub fn table(&mut self, name: &str, comment: &str) {
        self.blank_line();
        self.comment(comment);
        let _ = writeln!(self.text, "[{name}]");
        name.clone_into(&mut self.table);
    }

    /// A line `key = value`.
    pub fn set(&mut self, key: &str, value: &str) {
        let _ = writeln!(self.text, "{key} = {value}");
    }

    /// A line `key = value  # comment`.
    pub fn set_with(&mut self, key: &str, value: &str, comment: &str) {
        let line = format!("{key} = {value}");
        let _ = writeln!(self.text, "{line:COMMENT_COLUMN$} # {comment}");
    }

    /// Text, unchanged.
    pub fn raw(&mut self, text: &str) {
        self.text.push_str(text);
    }
}

/// A text as a TOML string on one line.
pub(super) fn quoted(text: &str) -> String {
    format!("\"{}\"", escaped(text))
}

/// A text with TOML's special characters escaped.
pub(super) fn escaped(text: &str) -> String {
    text.replace('\\', "\\\\").replace('"', "\\\"")
}

/// The digits of the negative of a number.
pub(super) fn negated(digits: &str) -> String {
    match digits.strip_prefix('-') {
        Some(positive) => positive.to_owned(),
        None if digits.trim_matches(['0', '.']).is_empty() => digits.to_owned(),
        None => format!("-{digits}"),
    }
}

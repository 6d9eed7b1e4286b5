//! The header lines of ISO-MME files: `Name of the line   :value`.

use std::fmt::Write as _;

/// Text of a file: UTF-8, else ISO 8859-1 as in older tests.
pub fn text_of(bytes: Vec<u8>) -> String {
    match String::from_utf8(bytes) {
        Ok(text) => text,
        Err(error) => error.as_bytes().iter().map(|b| char::from(*b)).collect(),
    }
}

/// A header line's name and value.
pub fn entry(line: &str) -> Option<(&str, &str)> {
    let (name, value) = line.split_once(':')?;
    let name = name.trim();
    (!name.is_empty()).then_some((name, value.trim()))
}

/// Header lines by name.
#[derive(Clone, Debug, Default)]
pub struct Header(Vec<(String, String, usize)>);

impl Header {
    /// Adds a line (from 1).
    pub fn push(&mut self, name: &str, value: &str, line: usize) {
        self.0.push((name.to_owned(), value.to_owned(), line));
    }

    /// Value of a name, ignoring case, with its line; none for `NOVALUE` and blanks.
    pub fn get(&self, name: &str) -> Option<(&str, usize)> {
        let found = self.0.iter().find(|(n, ..)| n.eq_ignore_ascii_case(name))?;
        let value = found.1.as_str();
        let missing = value.is_empty() || value.eq_ignore_ascii_case("NOVALUE");
        (!missing).then_some((value, found.2))
    }
}

/// Writes a header line, the value from column 29 on.
pub fn write(text: &mut String, name: &str, value: &str) {
    // one line a value
    let value: String = value.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let value = match value.trim() {
        "" => "NOVALUE",
        value => value,
    };
    let _ = writeln!(text, "{name:<28}:{value}");
}

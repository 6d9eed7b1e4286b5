//! What a conversion assumed, left away and counted.

use std::fmt;

/// The record of one conversion.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Report {
    /// Decisions that no card makes: the wheel's place, the reconstructed surfaces, ….
    pub assumptions: Vec<String>,
    /// Cards and fields that the scenario does not use, or has no place for.
    pub ignored: Vec<String>,
    /// Blank fields that were taken as zero.
    pub blanks: Vec<String>,
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut list = |title: &str, items: &[String]| {
            writeln!(f, "{title}:{}", if items.is_empty() { " none" } else { "" })?;
            items.iter().try_for_each(|item| writeln!(f, "  - {item}"))
        };
        list("Assumptions", &self.assumptions)?;
        list("Not used", &self.ignored)?;
        let names = self.blanks.join(", ");
        match self.blanks.len() {
            0 => write!(f, "Blank fields read as zero: 0"),
            count => write!(f, "Blank fields read as zero: {count} ({names})"),
        }
    }
}

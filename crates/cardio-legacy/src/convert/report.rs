//! Assumptions, omissions and counts of a conversion.

use std::fmt;

/// Record of one conversion.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Report {
    /// Choices that no card determines: the wheel's position, the reconstructed surfaces, ….
    pub assumptions: Vec<String>,
    /// Cards and fields that the scenario does not use or cannot hold.
    pub ignored: Vec<String>,
    /// Blank fields read as zero.
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

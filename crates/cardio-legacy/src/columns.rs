//! Columns of a card.

use std::fmt;

/// A run of columns of a card, counted from 1, both ends included.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Columns {
    /// First column, 1–80.
    pub first: u8,
    /// Last column, `first`–80.
    pub last: u8,
}

impl Columns {
    /// Columns `first` to `last`, both counted from 1.
    pub const fn new(first: u8, last: u8) -> Self {
        Self { first, last }
    }

    /// Number of columns.
    pub const fn width(self) -> usize {
        (self.last + 1 - self.first) as usize
    }
}

impl fmt::Display for Columns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.first == self.last {
            write!(f, "column {}", self.first)
        } else {
            write!(f, "columns {}–{}", self.first, self.last)
        }
    }
}

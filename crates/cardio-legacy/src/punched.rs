//! A card as it stands in the file: 80 columns, whatever they mean.

use std::fmt;

/// Range of columns of a card, counted from 1, both ends included.
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

/// Number of columns of a card.
pub(crate) const CARD_WIDTH: usize = 80;

/// A card: 80 columns of Latin-1, and its line in the file.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PunchedCard {
    /// Line in the file, from 1.
    pub line: usize,
    columns: [u8; CARD_WIDTH],
}

impl PunchedCard {
    /// Card with `bytes` from column 1, padded with blanks; bytes beyond column 80 are dropped.
    pub fn new(line: usize, bytes: &[u8]) -> Self {
        let mut columns = [b' '; CARD_WIDTH];
        for (column, byte) in columns.iter_mut().zip(bytes) {
            *column = *byte;
        }
        Self { line, columns }
    }

    /// Bytes of some columns, without columns beyond the card.
    pub fn field(&self, columns: Columns) -> &[u8] {
        let first = usize::from(columns.first.max(1)) - 1;
        let last = usize::from(columns.last).min(CARD_WIDTH);
        self.columns.get(first..last).unwrap_or_default()
    }

    /// The text of some columns.
    pub fn text_of(&self, columns: Columns) -> String {
        latin1(self.field(columns))
    }

    /// The card without its trailing blanks.
    pub fn text(&self) -> String {
        latin1(&self.columns).trim_end_matches(' ').to_owned()
    }

    /// Whether these columns are blank.
    pub fn is_blank_in(&self, columns: Columns) -> bool {
        self.field(columns).iter().all(|b| *b == b' ')
    }

    /// Whether the card is blank.
    pub fn is_blank(&self) -> bool {
        self.columns.iter().all(|b| *b == b' ')
    }
}

/// Bytes of Latin-1 as text; control characters become `·`, so that columns stay aligned.
pub(crate) fn latin1(bytes: &[u8]) -> String {
    bytes.iter().map(|b| if is_control(*b) { '·' } else { char::from(*b) }).collect()
}

pub(crate) fn is_control(byte: u8) -> bool {
    byte < 0x20 || (0x7f..0xa0).contains(&byte)
}

//! Lines of a file as cards of 80 columns.

use crate::columns::Columns;
use crate::diagnostic::{Finding, Sink};
use crate::rule::Rule;

/// Columns of a card.
pub const CARD_WIDTH: usize = 80;
const TAB_WIDTH: usize = 8;
const END_MARK: u8 = 0x1a;

/// One card: 80 columns of Latin-1, and the line where it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Card {
    /// Line in the file, from 1.
    pub line: usize,
    columns: [u8; CARD_WIDTH],
}

impl Card {
    /// A card with `bytes` from column 1, padded with blanks; what stands behind column 80 is not part of a card.
    pub fn new(line: usize, bytes: &[u8]) -> Self {
        let mut columns = [b' '; CARD_WIDTH];
        for (column, byte) in columns.iter_mut().zip(bytes) {
            *column = *byte;
        }
        Self { line, columns }
    }

    /// The bytes of some columns; columns beyond the card are left away.
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

    /// Whether nothing is punched in these columns.
    pub fn is_blank_in(&self, columns: Columns) -> bool {
        self.field(columns).iter().all(|b| *b == b' ')
    }

    /// Whether nothing is punched at all.
    pub fn is_blank(&self) -> bool {
        self.columns.iter().all(|b| *b == b' ')
    }
}

/// Bytes of Latin-1 as text; control characters are shown as `·`, so that a column stays a column.
pub fn latin1(bytes: &[u8]) -> String {
    bytes.iter().map(|b| if is_control(*b) { '·' } else { char::from(*b) }).collect()
}

fn is_control(byte: u8) -> bool {
    byte < 0x20 || (0x7f..0xa0).contains(&byte)
}

/// Cuts a file into cards. Lines end with LF, CR LF or CR; a DOS end-of-file mark and what follows it are left away.
pub(crate) fn read_cards(bytes: &[u8], sink: &mut Sink) -> Vec<Card> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let bytes = until_end_mark(bytes, sink);
    lines(bytes).into_iter().enumerate().map(|(index, line)| read_card(index + 1, line, sink)).collect()
}

fn until_end_mark<'a>(bytes: &'a [u8], sink: &mut Sink) -> &'a [u8] {
    let Some(end) = bytes.iter().position(|b| *b == END_MARK) else {
        return bytes;
    };
    if bytes[end..].iter().any(|b| !matches!(*b, END_MARK | b' ' | b'\r' | b'\n')) {
        let line = lines(&bytes[..end]).len().max(1);
        sink.report(
            Finding::new(
                Rule::ControlCharacter,
                "a DOS end-of-file mark (0x1a) stands in the file; what follows it is not read",
            )
            .at_line(line)
            .expected("the mark at the very end, or none")
            .remedy("remove the character if the deck goes on behind it"),
        );
    }
    &bytes[..end]
}

fn lines(bytes: &[u8]) -> Vec<&[u8]> {
    let mut lines = Vec::new();
    let mut start = 0;
    let mut at = 0;
    while at < bytes.len() {
        let end = at;
        match bytes[at] {
            b'\r' if bytes.get(at + 1) == Some(&b'\n') => at += 2,
            b'\r' | b'\n' => at += 1,
            _ => {
                at += 1;
                continue;
            }
        }
        lines.push(&bytes[start..end]);
        start = at;
    }
    if start < bytes.len() {
        lines.push(&bytes[start..]);
    }
    lines
}

fn read_card(line: usize, bytes: &[u8], sink: &mut Sink) -> Card {
    let expanded = expand_tabs(bytes);
    let card = Card::new(line, &expanded);
    if bytes.contains(&b'\t') {
        sink.report(
            Finding::new(Rule::Tab, "the line contains a tab, which has no columns")
                .on(&card)
                .expected("blanks only, so that every character has its column")
                .remedy("replace tabs by blanks; it was read as if tab stops stood every 8 columns"),
        );
    }
    let behind = expanded.get(CARD_WIDTH..).unwrap_or_default();
    let last = behind.iter().rposition(|b| *b != b' ');
    if let Some(last) = last {
        sink.report(
            Finding::new(
                Rule::LineTooLong,
                format!(
                    "columns 81–{} are not part of a card: {:?} is not read",
                    CARD_WIDTH + last + 1,
                    latin1(&behind[..=last])
                ),
            )
            .on(&card)
            .expected("80 columns")
            .remedy("check that no field has slipped to the right, and cut the line"),
        );
    }
    if let Some(offset) = bytes.iter().position(|b| is_control(*b) && *b != b'\t') {
        sink.report(
            Finding::new(
                Rule::ControlCharacter,
                format!("control character 0x{:02x} at column {}", bytes[offset], offset + 1),
            )
            .on(&card)
            .expected("printable characters")
            .remedy("remove it; in a numeric field it is an error of its own"),
        );
    }
    if !bytes.is_ascii() && std::str::from_utf8(bytes).is_ok() {
        sink.report(
            Finding::new(
                Rule::LooksLikeUtf8,
                "the line holds UTF-8 characters of several bytes; each byte was given a column",
            )
            .on(&card)
            .expected("Latin-1, one byte a column")
            .remedy("save the deck as Latin-1 (ISO 8859-1) or use plain ASCII"),
        );
    }
    card
}

fn expand_tabs(bytes: &[u8]) -> Vec<u8> {
    let mut expanded = Vec::with_capacity(bytes.len());
    for byte in bytes {
        if *byte == b'\t' {
            let stop = (expanded.len() / TAB_WIDTH + 1) * TAB_WIDTH;
            expanded.resize(stop, b' ');
        } else {
            expanded.push(*byte);
        }
    }
    expanded
}

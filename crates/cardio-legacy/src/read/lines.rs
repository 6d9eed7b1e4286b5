//! Lines of a file as cards of 80 columns.

use crate::diagnostics::{Diagnostic, Sink};
use crate::punched::{CARD_WIDTH, PunchedCard, is_control, latin1};
use crate::rule::Rule;

const TAB_WIDTH: usize = 8;
const END_MARK: u8 = 0x1a;

/// Splits a file into cards. Lines end with LF, CR LF or CR; a DOS end-of-file mark and everything after it are
/// dropped.
pub(super) fn read_cards(bytes: &[u8], sink: &mut Sink) -> Vec<PunchedCard> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let bytes = until_end_mark(bytes, sink);
    let mut long = Vec::new();
    let mut read = |(index, line)| read_card(index + 1, line, &mut long, sink);
    let cards = lines(bytes).into_iter().enumerate().map(&mut read).collect();
    report_long(&long, sink);
    cards
}

/// Text beyond the last column of a card, and its end.
struct Behind {
    card: PunchedCard,
    last_column: usize,
    text: String,
}

/// Number of lines beyond column 80 up to which they are mistakes; more are a property of the file.
const MOST_SLIPS: usize = 3;

/// Reports lines beyond column 80: mistakes one by one, additions to all cards once.
fn report_long(long: &[Behind], sink: &mut Sink) {
    let column =
        |last| if last == CARD_WIDTH + 1 { "column 81 is".to_owned() } else { format!("columns 81–{last} are") };
    if long.len() <= MOST_SLIPS {
        for Behind { card, last_column, text } in long {
            let message = format!("{} not part of a card: {text:?} is not read", column(*last_column));
            Diagnostic::new(Rule::LineTooLong, message).on(card).report(sink);
        }
        return;
    }
    let Some(Behind { card, text, .. }) = long.first() else { return };
    let last = long.iter().map(|behind| behind.last_column).max().unwrap_or_default();
    let message = format!(
        "{} lines go on beyond column 80: {} not part of a card and not read; the first holds {text:?} there",
        long.len(),
        column(last)
    );
    Diagnostic::new(Rule::BeyondTheCard, message).on(card).report(sink);
}

fn until_end_mark<'a>(bytes: &'a [u8], sink: &mut Sink) -> &'a [u8] {
    let Some(end) = bytes.iter().position(|b| *b == END_MARK) else { return bytes };
    if bytes[end..].iter().any(|b| !matches!(*b, END_MARK | b' ' | b'\r' | b'\n')) {
        let line = lines(&bytes[..end]).len().max(1);
        let message = "the file has a DOS end-of-file mark (0x1a); text after it is not read";
        Diagnostic::new(Rule::ControlCharacter, message)
            .at_line(line)
            .expected("the mark at the very end, or none")
            .remedy("remove the character if the deck continues behind it")
            .report(sink);
    }
    &bytes[..end]
}

fn lines(bytes: &[u8]) -> Vec<&[u8]> {
    let mut lines = Vec::new();
    let mut rest = bytes;
    while !rest.is_empty() {
        let end = rest.iter().position(|b| matches!(b, b'\r' | b'\n')).unwrap_or(rest.len());
        let (line, behind) = rest.split_at(end);
        lines.push(line);
        rest = behind.strip_prefix(b"\r\n").or(behind.get(1..)).unwrap_or_default();
    }
    lines
}

fn read_card(line: usize, bytes: &[u8], long: &mut Vec<Behind>, sink: &mut Sink) -> PunchedCard {
    let expanded = expand_tabs(bytes);
    let card = PunchedCard::new(line, &expanded);
    if bytes.contains(&b'\t') {
        Diagnostic::new(Rule::Tab, "the line contains a tab, which has no columns").on(&card).report(sink);
    }
    let behind = expanded.get(CARD_WIDTH..).unwrap_or_default();
    if let Some(last) = behind.iter().rposition(|b| *b != b' ') {
        long.push(Behind { card: card.clone(), last_column: CARD_WIDTH + last + 1, text: latin1(&behind[..=last]) });
    }
    report_strange_bytes(bytes, &card, sink);
    card
}

fn report_strange_bytes(bytes: &[u8], card: &PunchedCard, sink: &mut Sink) {
    if let Some(offset) = bytes.iter().position(|b| is_control(*b) && *b != b'\t') {
        let message = format!("control character 0x{:02x} at column {}", bytes[offset], offset + 1);
        Diagnostic::new(Rule::ControlCharacter, message)
            .on(card)
            .expected("printable characters")
            .remedy("remove it; in a numeric field it is an error of its own")
            .report(sink);
    }
    if !bytes.is_ascii() && std::str::from_utf8(bytes).is_ok() {
        let message = "the line holds UTF-8 characters of several bytes; each byte was given a column";
        Diagnostic::new(Rule::LooksLikeUtf8, message).on(card).report(sink);
    }
}

fn expand_tabs(bytes: &[u8]) -> Vec<u8> {
    let mut expanded = Vec::with_capacity(bytes.len());
    for byte in bytes {
        if *byte == b'\t' {
            expanded.resize((expanded.len() / TAB_WIDTH + 1) * TAB_WIDTH, b' ');
        } else {
            expanded.push(*byte);
        }
    }
    expanded
}

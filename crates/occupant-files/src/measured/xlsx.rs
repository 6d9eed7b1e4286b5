//! The sheets of a workbook (XLSX: a ZIP archive of SpreadsheetML) as text: a line for each row, tabs between its cells, the name of each
//! sheet above it.

use std::io::Read;

use flate2::read::DeflateDecoder;
use roxmltree::{Document, Node};

/// Largest unpacked part, bytes.
const MOST: u64 = 64_000_000;
/// Largest column that is read.
const MOST_COLUMNS: usize = 1000;
/// Number of directory entries that are read.
const MOST_PARTS: usize = 10_000;

/// Whether bytes are a ZIP archive.
pub(super) fn is_archive(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04")
}

/// The text of all sheets.
///
/// # Errors
/// What is wrong in the workbook.
pub(super) fn text(bytes: &[u8]) -> Result<String, String> {
    let parts = directory(bytes)?;
    let part = |name: &str| parts.iter().find(|part| part.name == name).map(|part| part.text(bytes)).transpose();
    let shared = part("xl/sharedStrings.xml")?.map_or(Ok(Vec::new()), |xml| strings(&xml))?;
    let names = part("xl/workbook.xml")?.map_or(Ok(Vec::new()), |xml| sheet_names(&xml))?;
    let mut sheets: Vec<(usize, &Part)> = parts.iter().filter_map(|part| Some((part.sheet()?, part))).collect();
    sheets.sort_unstable_by_key(|(number, _)| *number);
    if sheets.is_empty() {
        return Err("no worksheet in it".to_owned());
    }
    let mut all = String::new();
    for (i, (_, part)) in sheets.iter().enumerate() {
        all += names.get(i).map_or("", String::as_str);
        all += "\n";
        all += &rows(&part.text(bytes)?, &shared)?;
    }
    Ok(all)
}

struct Part {
    name: String,
    is_packed: bool,
    start: usize,
    length: usize,
}

impl Part {
    /// The number of a worksheet.
    fn sheet(&self) -> Option<usize> {
        self.name.strip_prefix("xl/worksheets/sheet")?.strip_suffix(".xml")?.parse().ok()
    }

    fn text(&self, bytes: &[u8]) -> Result<String, String> {
        let broken = || format!("its part {} is damaged", self.name);
        let head = bytes.get(self.start..self.start + 30).ok_or_else(broken)?;
        let from = self.start + 30 + usize::from(short(head, 26)) + usize::from(short(head, 28));
        let data = bytes.get(from..).and_then(|rest| rest.get(..self.length)).ok_or_else(broken)?;
        let mut text = String::new();
        let read = match self.is_packed {
            true => DeflateDecoder::new(data).take(MOST + 1).read_to_string(&mut text),
            false => data.take(MOST + 1).read_to_string(&mut text),
        };
        match read {
            Ok(length) if length as u64 > MOST => Err(format!("its part {} is larger than 64 MB", self.name)),
            Ok(_) => Ok(text),
            Err(_) => Err(broken()),
        }
    }
}

fn short(bytes: &[u8], at: usize) -> u16 {
    bytes.get(at..at + 2).map_or(0, |b| u16::from_le_bytes([b[0], b[1]]))
}

fn long(bytes: &[u8], at: usize) -> usize {
    usize::from(short(bytes, at)) | usize::from(short(bytes, at + 2)) << 16
}

/// The parts by the central directory at the end of the archive.
fn directory(bytes: &[u8]) -> Result<Vec<Part>, String> {
    let from = bytes.len().saturating_sub(66_000);
    let end =
        bytes[from..].windows(4).rposition(|mark| mark == b"PK\x05\x06").ok_or("its directory is missing")? + from;
    let (mut at, count) = (long(bytes, end + 16), usize::from(short(bytes, end + 10)));
    let mut parts = Vec::new();
    for _ in 0..count.min(MOST_PARTS) {
        let entry = bytes.get(at..).filter(|rest| rest.starts_with(b"PK\x01\x02")).ok_or("its directory is damaged")?;
        let length = usize::from(short(entry, 28));
        let name = entry.get(46..46 + length).ok_or("its directory is damaged")?;
        parts.push(Part {
            name: String::from_utf8_lossy(name).into_owned(),
            is_packed: short(entry, 10) == 8,
            start: long(entry, 42),
            length: long(entry, 20),
        });
        at += 46 + length + usize::from(short(entry, 30)) + usize::from(short(entry, 32));
    }
    Ok(parts)
}

fn document(xml: &str) -> Result<Document<'_>, String> {
    Document::parse(xml).map_err(|error| format!("its XML is damaged: {error}"))
}

/// Texts of a node's `t`, which may be cut in runs.
fn words(node: Node) -> String {
    let is_text = |n: &Node| n.has_tag_name_local("t") && n.parent().is_none_or(|up| !up.has_tag_name_local("rPh"));
    node.descendants().filter(is_text).filter_map(|t| t.text()).collect()
}

trait Local {
    fn has_tag_name_local(&self, name: &str) -> bool;
}

impl Local for Node<'_, '_> {
    fn has_tag_name_local(&self, name: &str) -> bool {
        self.tag_name().name() == name
    }
}

fn strings(xml: &str) -> Result<Vec<String>, String> {
    Ok(document(xml)?.descendants().filter(|node| node.has_tag_name_local("si")).map(words).collect())
}

fn sheet_names(xml: &str) -> Result<Vec<String>, String> {
    let document = document(xml)?;
    let sheets = document.descendants().filter(|node| node.has_tag_name_local("sheet"));
    Ok(sheets.map(|sheet| sheet.attribute("name").unwrap_or_default().to_owned()).collect())
}

fn rows(xml: &str, shared: &[String]) -> Result<String, String> {
    let document = document(xml)?;
    let (mut text, mut line) = (String::new(), 0_usize);
    for row in document.descendants().filter(|node| node.has_tag_name_local("row")) {
        let mut cells: Vec<String> = Vec::new();
        for cell in row.children().filter(|node| node.has_tag_name_local("c")) {
            let at = cell.attribute("r").and_then(column).unwrap_or(cells.len());
            if at >= MOST_COLUMNS {
                continue;
            }
            cells.resize(cells.len().max(at + 1), String::new());
            cells[at] = value(cell, shared);
        }
        // rows that are empty are not written
        let number = row.attribute("r").and_then(|r| r.parse().ok()).unwrap_or(line + 1);
        text += &"\n".repeat(usize::saturating_sub(number, line + 1).min(MOST_COLUMNS));
        line = line.max(number.saturating_sub(1)) + 1;
        text += cells.join("\t").trim_end();
        text += "\n";
    }
    Ok(text)
}

fn value(cell: Node, shared: &[String]) -> String {
    let raw = cell.children().find(|node| node.has_tag_name_local("v")).and_then(|v| v.text()).unwrap_or_default();
    let text = match cell.attribute("t") {
        Some("s") => raw.trim().parse().ok().and_then(|i: usize| shared.get(i)).cloned().unwrap_or_default(),
        Some("inlineStr") => words(cell),
        Some("b") => if raw.trim() == "1" { "on" } else { "off" }.to_owned(),
        Some("e") => "N/A".to_owned(),
        Some("str") => raw.to_owned(),
        // 0.1 + 0.2 as a spreadsheet shows it
        _ => raw.parse::<f64>().map_or_else(|_| raw.to_owned(), |x| placed_text::number((x * 1e9).round() / 1e9)),
    };
    text.replace(['\t', '\n', '\r'], " ")
}

/// Column of a place, `AB12` → 27.
fn column(place: &str) -> Option<usize> {
    let letters = place.bytes().take_while(u8::is_ascii_uppercase).take(4);
    letters.fold(None, |at, b| Some(at.map_or(0, |at: usize| (at + 1) * 26) + usize::from(b - b'A')))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_columns() {
        assert_eq!([column("A1"), column("Z9"), column("AA3"), column("7")], [Some(0), Some(25), Some(26), None]);
    }

    #[test]
    fn what_is_no_workbook_is_refused() {
        for bytes in [
            &b"PK\x03\x04"[..],
            b"PK\x03\x04PK\x05\x06",
            b"",
            b"PK\x05\x06\0\0\0\0\0\0\x01\0\0\0\0\0\xff\xff\xff\x7f\0\0",
        ] {
            assert!(text(bytes).is_err());
        }
    }
}

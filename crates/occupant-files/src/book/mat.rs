//! A MAT file of version 5 (The MathWorks, "MAT-File Format"), uncompressed: of the first table each column is a variable, every
//! other table is a structure with its columns as fields. Numbers are columns of doubles, texts cell arrays.

use std::io;

use super::{Column, Sheet, Values};
use crate::base::program;

/// Types of data elements.
const INT8: u32 = 1;
const INT32: u32 = 5;
const UINT32: u32 = 6;
const DOUBLE: u32 = 9;
const MATRIX: u32 = 14;
const UTF8: u32 = 16;

/// Classes of arrays.
const CELL: u32 = 1;
const STRUCT: u32 = 2;
const CHAR: u32 = 4;
const DOUBLES: u32 = 6;

/// Largest length of a name, and of its field with the final zero.
const LONGEST_NAME: usize = 63;
const NAME_ROOM: usize = LONGEST_NAME + 1;
/// Length of the header text.
const TEXT: usize = 116;
/// Largest variable that MATLAB reads from such a file, bytes.
const MOST_BYTES: usize = 1 << 31;

pub(super) fn bytes(sheets: &[Sheet]) -> io::Result<Vec<u8>> {
    let mut out = format!("{:<TEXT$}", format!("MATLAB 5.0 MAT-file, by {}", program())).into_bytes();
    // no data of subsystems; version 1; least byte first
    out.extend([0; 8]);
    out.extend(*b"\x00\x01IM");
    for (i, sheet) in sheets.iter().enumerate() {
        let names = names(&sheet.columns);
        let variables: Vec<Vec<u8>> = match i {
            0 => sheet.columns.iter().zip(&names).map(|(column, name)| variable(name, &column.values)).collect(),
            _ => vec![structure(sheet, &names)],
        };
        if let Some(large) = variables.iter().find(|variable| variable.len() >= MOST_BYTES) {
            return Err(io::Error::other(format!(
                "a variable of {} bytes; the limit of a MAT file is 2 GiB",
                large.len()
            )));
        }
        variables.into_iter().for_each(|variable| out.extend(variable));
    }
    Ok(out)
}

/// Valid variable names: letters, digits and `_`, a letter first, unique.
fn names(columns: &[Column]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for (number, column) in (1..).zip(columns) {
        let legal = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
        let mut name: String = column.name.chars().map(legal).collect();
        if !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
            name.insert(0, 'x');
        }
        if name.len() > LONGEST_NAME || names.contains(&name) {
            let number = format!("_{number}");
            name.truncate(LONGEST_NAME - number.len());
            name += &number;
        }
        names.push(name);
    }
    names
}

fn structure(sheet: &Sheet, names: &[String]) -> Vec<u8> {
    let room = |name: &String| [name.as_bytes(), &vec![0; NAME_ROOM - name.len()]].concat();
    let fields: Vec<u8> = names.iter().flat_map(room).collect();
    let mut data = element(INT32, &(NAME_ROOM as i32).to_le_bytes());
    data.extend(element(INT8, &fields));
    data.extend(sheet.columns.iter().flat_map(|column| variable("", &column.values)));
    matrix(sheet.name, STRUCT, [1, 1], &data)
}

fn variable(name: &str, values: &Values) -> Vec<u8> {
    match values {
        Values::Numbers(numbers) => {
            let bytes: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
            matrix(name, DOUBLES, [numbers.len(), 1], &element(DOUBLE, &bytes))
        }
        Values::Texts(texts) => {
            let cells: Vec<u8> = texts.iter().flat_map(|text| letters(text)).collect();
            matrix(name, CELL, [texts.len(), 1], &cells)
        }
    }
}

/// A text with its size in characters, not bytes. Readers disagree on characters beyond the Basic Multilingual Plane
/// and refuse the file: they are replaced by U+FFFD.
fn letters(text: &str) -> Vec<u8> {
    let plain = |c: char| if c.len_utf16() == 1 { c } else { char::REPLACEMENT_CHARACTER };
    let text: String = text.chars().map(plain).collect();
    let sizes = [usize::from(!text.is_empty()), text.chars().count()];
    matrix("", CHAR, sizes, &element(UTF8, text.as_bytes()))
}

/// An array: class, sizes, name, content.
fn matrix(name: &str, class: u32, sizes: [usize; 2], content: &[u8]) -> Vec<u8> {
    let flags: Vec<u8> = [class, 0].iter().flat_map(|x| x.to_le_bytes()).collect();
    let sizes: Vec<u8> = sizes.iter().flat_map(|n| (*n as i32).to_le_bytes()).collect();
    let head = [element(UINT32, &flags), element(INT32, &sizes), element(INT8, name.as_bytes())].concat();
    element(MATRIX, &[&head, content].concat())
}

/// A data element with type and size, padded to a multiple of eight bytes; up to four bytes in the short form.
fn element(of: u32, data: &[u8]) -> Vec<u8> {
    let size = data.len() as u32;
    let tag = match data.len() {
        1..=4 => vec![(size << 16) | of],
        _ => vec![of, size],
    };
    let mut out: Vec<u8> = tag.into_iter().flat_map(u32::to_le_bytes).collect();
    out.extend(data);
    out.resize(out.len().next_multiple_of(8), 0);
    out
}

#[cfg(test)]
mod tests {
    use super::letters;

    /// The second size of an array stands behind its tag, its flags (16 bytes), and the tag and first of its sizes.
    #[test]
    fn every_letter_of_a_text_counts_once_for_every_reader() {
        for (text, size) in [("car", 3), ("é—", 2), ("a 🚗 b", 5)] {
            assert_eq!(letters(text)[36..40], i32::to_le_bytes(size), "{text}");
        }
        assert_eq!(letters("a 🚗 é"), letters("a \u{fffd} é"));
    }
}

//! Tables as sheets of a workbook (XLSX) or variables of a MAT file: held as a whole and written at the end.

mod mat;
mod xlsx;

use std::io;

use super::table::{Cell, Form, Kind};

/// A table, column by column.
#[derive(Clone, Debug)]
pub(super) struct Sheet {
    name: &'static str,
    columns: Vec<Column>,
}

#[derive(Clone, Debug)]
struct Column {
    name: String,
    values: Values,
}

#[derive(Clone, Debug)]
enum Values {
    /// Numbers; NaN where missing.
    Numbers(Vec<f64>),
    Texts(Vec<String>),
}

impl Sheet {
    pub(super) fn new(name: &'static str, columns: &[(impl AsRef<str>, Kind)]) -> Self {
        let column = |(name, kind): &(_, Kind)| Column {
            name: AsRef::<str>::as_ref(name).to_owned(),
            values: match kind {
                Kind::Count | Kind::Number | Kind::MaybeNumber => Values::Numbers(Vec::new()),
                Kind::Text | Kind::MaybeText => Values::Texts(Vec::new()),
            },
        };
        Sheet { name, columns: columns.iter().map(column).collect() }
    }

    pub(super) fn row(&mut self, cells: &[Cell]) {
        for (column, cell) in self.columns.iter_mut().zip(cells) {
            match (&mut column.values, cell) {
                (Values::Numbers(numbers), cell) => numbers.push(cell.number().unwrap_or(f64::NAN)),
                (Values::Texts(texts), Cell::Text(text)) => texts.push(text.to_string()),
                (Values::Texts(texts), _) => texts.push(String::new()),
            }
        }
    }

    fn rows(&self) -> usize {
        self.columns.first().map_or(0, |column| match &column.values {
            Values::Numbers(numbers) => numbers.len(),
            Values::Texts(texts) => texts.len(),
        })
    }
}

/// The file with these tables.
///
/// # Errors
/// More than such a file can hold.
pub(super) fn bytes(form: Form, sheets: &[Sheet]) -> io::Result<Vec<u8>> {
    if form == Form::Mat { mat::bytes(sheets) } else { xlsx::bytes(sheets) }
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use flate2::read::DeflateDecoder;

    use super::*;

    fn sheets() -> Vec<Sheet> {
        let mut table =
            Sheet::new("table", &[("time[s]", Kind::Number), ("head.x", Kind::MaybeNumber), ("8 & \"<", Kind::Text)]);
        table.row(&[Cell::Number(0.5), Cell::Absent, Cell::text("=1+1")]);
        table.row(&[Cell::Number(1e-7), Cell::Number(-2.0), Cell::text("β\u{1}")]);
        let mut columns = Sheet::new("columns", &[("unit", Kind::Text)]);
        columns.row(&[Cell::text("m/s")]);
        vec![table, columns]
    }

    fn number(bytes: &[u8], at: usize) -> usize {
        u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize
    }

    #[test]
    fn a_workbook_is_an_archive_of_sheets() {
        let bytes = bytes(Form::Xlsx, &sheets()).unwrap();
        assert_eq!(bytes, super::bytes(Form::Xlsx, &sheets()).unwrap());
        // by the directory at the end, as every reader goes
        let end = bytes.len() - 22;
        assert_eq!(&bytes[end..end + 4], b"PK\x05\x06");
        let (mut at, mut texts) = (number(&bytes, end + 16), Vec::new());
        for _ in 0..bytes[end + 10] {
            assert_eq!(&bytes[at..at + 4], b"PK\x01\x02");
            let (sum, size, offset) = (number(&bytes, at + 16), number(&bytes, at + 20), number(&bytes, at + 42));
            let name = usize::from(bytes[at + 28]);
            assert_eq!(bytes[at + 46..at + 46 + name], bytes[offset + 30..offset + 30 + name]);
            let mut text = String::new();
            DeflateDecoder::new(&bytes[offset + 30 + name..][..size]).read_to_string(&mut text).unwrap();
            assert_eq!((crc32fast::hash(text.as_bytes()) as usize, text.len()), (sum, number(&bytes, at + 24)));
            roxmltree::Document::parse(&text).unwrap();
            texts.push(text);
            at += 46 + name;
        }
        let text = |text: &str| format!("<c t=\"inlineStr\"><is><t xml:space=\"preserve\">{text}</t></is></c>");
        let heads = [text("time[s]"), text("head.x"), text("8 &amp; &quot;&lt;")].concat();
        let rows = format!(
            "<row>{heads}</row><row><c><v>0.5</v></c><c/>{}</row><row><c><v>1e-7</v></c><c><v>-2.0</v></c>{}</row></sheetData>",
            text("=1+1"),
            text("β\\u0001")
        );
        assert!(texts[4].contains(&rows), "{}", texts[4]);
        assert!(texts[2].contains("<sheet name=\"columns\" sheetId=\"2\" r:id=\"r2\"/>"), "{}", texts[2]);
    }

    #[test]
    fn more_than_a_sheet_holds_is_refused() {
        let wide: Vec<(String, Kind)> = (0..16_385).map(|i| (i.to_string(), Kind::Number)).collect();
        let error = bytes(Form::Xlsx, &[Sheet::new("table", &wide)]).unwrap_err().to_string();
        assert!(error.contains("1 rows of 16385 columns; a sheet holds 1048576 of 16384"), "{error}");
    }

    /// Elements of a MAT file or of an array in it: type and data.
    fn elements(mut bytes: &[u8]) -> Vec<(usize, &[u8])> {
        let mut found = Vec::new();
        while !bytes.is_empty() {
            let tag = number(bytes, 0);
            let (of, from, size) = if tag > 0xffff { (tag & 0xffff, 4, tag >> 16) } else { (tag, 8, number(bytes, 4)) };
            found.push((of, &bytes[from..from + size]));
            bytes = &bytes[(from + size).next_multiple_of(8)..];
        }
        found
    }

    #[test]
    fn a_mat_file_holds_variables_and_structures() {
        let bytes = bytes(Form::Mat, &sheets()).unwrap();
        assert_eq!(&bytes[124..128], b"\x00\x01IM");
        let all: Vec<_> = elements(&bytes[128..]).into_iter().map(|(of, array)| (of, elements(array))).collect();
        let names: Vec<_> = all.iter().map(|(of, array)| (*of, array[2].1)).collect();
        let expected: [&[u8]; 4] = [b"time_s_", b"head_x", b"x8_____", b"columns"];
        assert_eq!(names, expected.map(|name| (14, name)));
        let numbers = [f64::NAN.to_le_bytes(), (-2.0_f64).to_le_bytes()].concat();
        assert_eq!((all[1].1[0].1[0], all[1].1[1].1, all[1].1[3].1), (6, &[2, 0, 0, 0, 1, 0, 0, 0][..], &numbers[..]));
        let second = elements(all[2].1[4].1);
        assert_eq!((second[0].1[0], second[3]), (4, (16, "β\u{1}".as_bytes())));
        let field = elements(all[3].1[5].1);
        assert_eq!((all[3].1[0].1[0], &all[3].1[4].1[..5], field[0].1[0]), (2, &b"unit\0"[..], 1));
    }

    #[test]
    fn names_of_variables_are_legal_and_differ() {
        let long = "segment.".repeat(12);
        let columns = [("a.b", Kind::Number), ("a_b", Kind::Number), (&long, Kind::Number), (&long, Kind::Number)];
        let bytes = bytes(Form::Mat, &[Sheet::new("table", &columns)]).unwrap();
        let names: Vec<String> = elements(&bytes[128..])
            .iter()
            .map(|(_, array)| String::from_utf8_lossy(elements(array)[2].1).into())
            .collect();
        assert_eq!(names[..2], ["a_b", "a_b_2"]);
        assert!(names[2..].iter().all(|name| name.len() == 63) && names[2] != names[3], "{names:?}");
    }
}

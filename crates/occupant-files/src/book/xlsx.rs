//! A workbook of SpreadsheetML (ECMA-376), a sheet for each table with its headings held in view: a ZIP archive (PKWARE's
//! APPNOTE) of a few XML files, without a date so that equal tables are equal files.

use std::io::{self, Write};

use crc32fast::Hasher;
use flate2::Compression;
use flate2::write::DeflateEncoder;
use placed_text::shortened;

use super::{Sheet, Values};
use crate::base::escape;

/// Limits of spreadsheets: rows including headings, columns, characters of a cell.
const MOST_ROWS: usize = 1_048_576;
const MOST_COLUMNS: usize = 16_384;
const MOST_LETTERS: usize = 32_767;

const MAIN: &str = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
const LINKS: &str = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
const PACKAGE: &str = "http://schemas.openxmlformats.org/package/2006";
const KIND: &str = "application/vnd.openxmlformats-officedocument.spreadsheetml";

pub(super) fn bytes(sheets: &[Sheet]) -> io::Result<Vec<u8>> {
    let each = |line: &dyn Fn(usize, &Sheet) -> String| -> String {
        sheets.iter().enumerate().map(|(i, sheet)| line(i + 1, sheet)).collect()
    };
    let parts = each(&|n, _| {
        format!("<Override PartName=\"/xl/worksheets/sheet{n}.xml\" ContentType=\"{KIND}.worksheet+xml\"/>")
    });
    let named = each(&|n, sheet| format!("<sheet name=\"{}\" sheetId=\"{n}\" r:id=\"r{n}\"/>", escape(sheet.name)));
    let linked = each(&|n, _| {
        format!("<Relationship Id=\"r{n}\" Type=\"{LINKS}/worksheet\" Target=\"worksheets/sheet{n}.xml\"/>")
    });
    let mut archive = Archive::default();
    let types = format!(
        "<Types xmlns=\"{PACKAGE}/content-types\"><Default Extension=\"rels\" \
         ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/><Override PartName=\"/xl/workbook.xml\" \
         ContentType=\"{KIND}.sheet.main+xml\"/>{parts}</Types>"
    );
    let root = format!("<Relationship Id=\"r1\" Type=\"{LINKS}/officeDocument\" Target=\"xl/workbook.xml\"/>");
    let links = |all: &str| format!("<Relationships xmlns=\"{PACKAGE}/relationships\">{all}</Relationships>");
    let book = format!(
        "<workbook xmlns=\"{MAIN}\" xmlns:r=\"{LINKS}\"><bookViews><workbookView/></bookViews><sheets>{named}</sheets></workbook>"
    );
    for (name, text) in [
        ("[Content_Types].xml", types),
        ("_rels/.rels", links(&root)),
        ("xl/workbook.xml", book),
        ("xl/_rels/workbook.xml.rels", links(&linked)),
    ] {
        archive.file(name, |to| write!(to, "{text}"))?;
    }
    for (n, sheet) in (1..).zip(sheets) {
        archive.file(&format!("xl/worksheets/sheet{n}.xml"), |to| write_sheet(to, sheet))?;
    }
    archive.finish()
}

fn write_sheet(to: &mut impl Write, sheet: &Sheet) -> io::Result<()> {
    let (rows, columns) = (sheet.rows() + 1, sheet.columns.len());
    if rows > MOST_ROWS || columns > MOST_COLUMNS {
        let found = format!("{rows} rows of {columns} columns; a sheet holds {MOST_ROWS} of {MOST_COLUMNS}");
        return Err(io::Error::other(found + ", and .csv or .parquet any number"));
    }
    write!(
        to,
        "<worksheet xmlns=\"{MAIN}\"><sheetViews><sheetView workbookViewId=\"0\"><pane ySplit=\"1\" topLeftCell=\"A2\" \
         activePane=\"bottomLeft\" state=\"frozen\"/></sheetView></sheetViews><sheetData><row>"
    )?;
    sheet.columns.iter().try_for_each(|column| text(to, &column.name))?;
    for row in 0..sheet.rows() {
        write!(to, "</row><row>")?;
        for column in &sheet.columns {
            match &column.values {
                Values::Numbers(numbers) if numbers[row].is_finite() => write!(to, "<c><v>{:?}</v></c>", numbers[row])?,
                Values::Numbers(_) => write!(to, "<c/>")?,
                Values::Texts(texts) => text(to, &texts[row])?,
            }
        }
    }
    write!(to, "</row></sheetData></worksheet>")
}

/// A text cell, never a formula.
fn text(to: &mut impl Write, text: &str) -> io::Result<()> {
    let text = escape(&shortened(text, MOST_LETTERS));
    write!(to, "<c t=\"inlineStr\"><is><t xml:space=\"preserve\">{text}</t></is></c>")
}

/// A ZIP archive under construction.
#[derive(Default)]
struct Archive {
    bytes: Vec<u8>,
    /// Central directory.
    directory: Vec<u8>,
    files: u16,
}

impl Archive {
    /// Adds a file.
    fn file(&mut self, name: &str, write: impl FnOnce(&mut Counted) -> io::Result<()>) -> io::Result<()> {
        let mut content =
            Counted { to: DeflateEncoder::new(Vec::new(), Compression::fast()), sum: Hasher::new(), size: 0 };
        write(&mut content)?;
        let packed = content.to.finish()?;
        let offset = size(self.bytes.len())?;
        // version 2.0, names in UTF-8, deflated, 1980-01-01
        let mut head: Vec<u8> = [20_u16, 0x800, 8, 0, 0x21].iter().flat_map(|x| x.to_le_bytes()).collect();
        let sizes = [content.sum.finalize(), size(packed.len())?, size(content.size)?];
        head.extend(sizes.iter().flat_map(|x| x.to_le_bytes()));
        head.extend((name.len() as u16).to_le_bytes());
        head.extend([0; 2]);
        self.bytes.extend(b"PK\x03\x04".iter().chain(&head).chain(name.as_bytes()).chain(&packed));
        let ends = [&[0; 10][..], &offset.to_le_bytes(), name.as_bytes()].concat();
        self.directory.extend(b"PK\x01\x02\x14\x00".iter().chain(&head).chain(&ends));
        self.files += 1;
        Ok(())
    }

    fn finish(mut self) -> io::Result<Vec<u8>> {
        let [length, at] = [size(self.directory.len())?, size(self.bytes.len())?];
        self.bytes.append(&mut self.directory);
        self.bytes.extend(b"PK\x05\x06\x00\x00\x00\x00".iter().chain(&self.files.to_le_bytes().repeat(2)));
        self.bytes.extend([length, at].iter().flat_map(|x| x.to_le_bytes()).chain([0; 2]));
        Ok(self.bytes)
    }
}

/// A size as a field of the archive.
fn size(bytes: usize) -> io::Result<u32> {
    u32::try_from(bytes).map_err(|_| io::Error::other("a sheet of more than 4 GiB"))
}

/// Compresses, counts and checksums the data.
struct Counted {
    to: DeflateEncoder<Vec<u8>>,
    sum: Hasher,
    size: usize,
}

impl Write for Counted {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let taken = self.to.write(bytes)?;
        self.sum.update(&bytes[..taken]);
        self.size += taken;
        Ok(taken)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

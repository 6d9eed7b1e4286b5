//! Histories for other programs: the content of CSV, Parquet, XLSX and MAT files, with their metadata. It names and
//! writes no file.
//!
//! CSV has one line of headings with units, `time[s],head.acceleration.x[m/s^2]`, then numbers: nothing but that, so that
//! spreadsheets and data frames open it as it is. What the columns are stands beside it in `NAME.csv-metadata.json`, the
//! place and form that "CSV on the Web" (W3C) gives it; of a Parquet file it is JSON in the file's key `occupant`. Workbooks and MAT
//! files have tables of their own for it, and one with the figures of the run.

use std::io;

use occupant_core::results::summary::Figure;
use serde::Serialize;
use serde_json::{Value, json};

use super::history::{Column, Histories, UnitChoice, class_name, shown};
use super::results::Results;
use super::table::{Cell, Form, Kind, Table};
use crate::base::{file_name, program};

/// The run, and the processing of its histories.
#[derive(Clone, Debug, Serialize)]
pub struct About {
    /// Program and version that exported.
    pub program: String,
    /// Title of the scenario.
    pub title: String,
    /// Name of the result file.
    pub source: String,
    /// Its SHA-256.
    pub source_sha256: String,
    /// Whether the run reached its end.
    pub complete: bool,
    /// Unit system.
    pub units: &'static str,
    /// Filter asked for.
    pub filter: String,
    /// Coefficients of the filter; absent without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub filter_coefficients: Option<&'static str>,
    /// Notes for the reader.
    pub notes: Vec<String>,
    /// The columns, time first.
    pub columns: Vec<ColumnAbout>,
    /// Figures of the run, for formats with a table for them.
    #[serde(skip)]
    pub figures: Vec<Figure>,
}

/// Description of a column.
#[derive(Clone, Debug, Serialize)]
pub struct ColumnAbout {
    /// The channel.
    pub name: String,
    /// Unit of the values, in ASCII.
    pub unit: String,
    /// Axes.
    pub frame: &'static str,
    /// Filter class applied.
    pub filter: String,
    /// Meaning in words.
    pub meaning: String,
}

impl ColumnAbout {
    /// The first column of every table.
    pub fn time() -> Self {
        ColumnAbout {
            name: "time".to_owned(),
            unit: "s".to_owned(),
            frame: "none",
            filter: "none".to_owned(),
            meaning: "time of the run".to_owned(),
        }
    }
}

impl About {
    /// Description of these histories; `filter` in words.
    pub fn new(
        results: &Results,
        histories: &Histories,
        units: UnitChoice,
        filter: String,
        coefficients: Option<&'static str>,
    ) -> Self {
        let of = |c: &Column| ColumnAbout {
            name: c.channel.name.clone(),
            unit: shown(c.channel.unit, units).ascii(),
            frame: c.channel.axes.name(),
            filter: class_name(c.class),
            meaning: c.channel.meaning.clone(),
        };
        About {
            program: program(),
            title: results.loaded.scenario.title.clone(),
            source: file_name(&results.path),
            source_sha256: results.sha256.clone(),
            complete: results.is_complete(),
            units: units.name(),
            filter,
            filter_coefficients: coefficients,
            notes: histories.notes.clone(),
            columns: std::iter::once(ColumnAbout::time()).chain(histories.columns.iter().map(of)).collect(),
            figures: Vec::new(),
        }
    }

    /// Adds tables of the figures, the columns and the run to that of the histories.
    fn beside(&self, table: &mut Table<Vec<u8>>) {
        use Kind::{MaybeNumber, Text};
        let texts = |texts: &[&str]| texts.iter().map(|text| Cell::text(text)).collect();
        let figure =
            |f: &Figure| vec![Cell::text(&f.name), f.value.map_or(Cell::Absent, Cell::Number), Cell::text(f.unit)];
        let heads = [("name", Text), ("value", MaybeNumber), ("unit", Text)];
        table.beside("measures", &heads, self.figures.iter().map(figure));
        let heads = ["name", "unit", "frame", "filter", "meaning"].map(|name| (name, Text));
        let column = |c: &ColumnAbout| texts(&[&c.name, &c.unit, c.frame, &c.filter, &c.meaning]);
        table.beside("columns", &heads, self.columns.iter().map(column));
        let complete = if self.complete { "yes" } else { "no" };
        let facts = [
            ("title", &self.title[..]),
            ("program", &self.program),
            ("source", &self.source),
            ("source_sha256", &self.source_sha256),
            ("complete", complete),
            ("filter", &self.filter),
            ("filter_coefficients", self.filter_coefficients.unwrap_or_default()),
        ];
        let notes = self.notes.iter().map(|note| ("note", &note[..]));
        let facts = facts.into_iter().chain(notes).map(|(what, words)| texts(&[what, words]));
        table.beside("about", &[("what", Text), ("words", Text)], facts);
    }
}

/// The bytes of the file. In CSV, numbers have the fewest digits that give the same double again, and there is nothing for
/// a value that is no number.
///
/// # Errors
/// Histories whose lengths differ from that of their times; an error of the writer, with its text.
pub fn table(histories: &Histories, about: &About, units: UnitChoice, form: Form) -> io::Result<Vec<u8>> {
    histories.check().map_err(|found| io::Error::new(io::ErrorKind::InvalidInput, found))?;
    let is_read = matches!(form, Form::Csv | Form::Xlsx);
    let named = |c: &ColumnAbout| if is_read { heading(c) } else { c.name.clone() };
    let columns: Vec<(String, Kind)> = about.columns.iter().map(|c| (named(c), Kind::Number)).collect();
    let mut table = Table::new(Vec::new(), form, &columns, &[("occupant", serde_json::to_string(about)?)])?;
    let columns = || histories.columns.iter();
    let sizes: Vec<f64> = columns().map(|c| shown(c.channel.unit, units).si).collect();
    for (i, time_s) in histories.time_s.iter().enumerate() {
        let values = columns().zip(&sizes).map(|(column, size)| column.values[i] / size);
        table.row(if is_read {
            // 0 and not −0
            let values = values.map(|value| Cell::finite(value + 0.0));
            std::iter::once(Cell::Number(rounded(*time_s))).chain(values).collect()
        } else {
            std::iter::once(*time_s).chain(values).map(Cell::Number).collect()
        })?;
    }
    about.beside(&mut table);
    table.finish()
}

fn heading(column: &ColumnAbout) -> String {
    format!("{}[{}]", column.name, column.unit)
}

/// A time without accumulated rounding errors: 0.1 instead of 0.10000000000000002.
fn rounded(time_s: f64) -> f64 {
    (time_s * 1e9).round() / 1e9
}

/// Metadata of the table `file`.
pub fn metadata(about: &About, file: &str) -> Value {
    let columns: Vec<Value> = about
        .columns
        .iter()
        .map(|c| {
            json!({
                "titles": heading(c),
                "name": c.name,
                "datatype": "double",
                "dc:description": c.meaning,
                "unit": c.unit,
                "frame": c.frame,
                "filter": c.filter,
            })
        })
        .collect();
    json!({
        "@context": "http://www.w3.org/ns/csvw",
        "url": file,
        "dc:title": about.title,
        "dc:creator": about.program,
        "dc:source": about.source,
        "sha256 of the source": about.source_sha256,
        "complete": about.complete,
        "units": about.units,
        "filter": about.filter,
        "filter coefficients": about.filter_coefficients,
        "notes": about.notes,
        "tableSchema": { "columns": columns },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_no_traces_of_counting() {
        assert_eq!(rounded(0.1 + 0.2), 0.3);
    }
}

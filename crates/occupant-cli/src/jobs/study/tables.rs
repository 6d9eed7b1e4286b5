//! The numbers of a report as Parquet: one table of all numbers, one of the samples that they are made of.

use std::path::{Path, PathBuf};

use super::Report;
use super::numbers::{Number, numbers};
use super::samples::Samples;
use crate::base::output_file::Existing;
use crate::files::table_file::{Cell, Form, Kind, TableFile};

const COLUMNS: [(&str, Kind); 12] = [
    ("response", Kind::Text),
    ("quantity", Kind::Text),
    ("parameter", Kind::Text),
    ("run", Kind::Number),
    ("value", Kind::Number),
    ("low", Kind::Number),
    ("high", Kind::Number),
    ("unit", Kind::Text),
    ("rows", Kind::Count),
    ("mark", Kind::Text),
    ("command", Kind::Text),
    ("place", Kind::Count),
];

/// Where the tables of a report go.
#[derive(Clone, Debug)]
pub(crate) struct Tables {
    pub(crate) numbers: PathBuf,
    pub(crate) samples: PathBuf,
}

impl Tables {
    /// Beside the page: `report.html` has `report.parquet` and `report-samples.parquet`.
    pub(crate) fn beside(page: &Path) -> Self {
        let stem = page.file_stem().unwrap_or_default().to_string_lossy();
        Tables {
            numbers: page.with_file_name(format!("{stem}.parquet")),
            samples: page.with_file_name(format!("{stem}-samples.parquet")),
        }
    }
}

/// Writes the tables.
///
/// # Errors
/// A file that is there and may not be replaced; the operating system refuses.
pub(crate) fn write(report: &Report, tables: &Tables, existing: Existing) -> Result<(), String> {
    let columns: Vec<(String, Kind)> = COLUMNS.iter().map(|(n, k)| ((*n).to_owned(), *k)).collect();
    let about = [
        ("occupant.study", report.opened.manifest_sha256.clone()),
        (
            "occupant.units",
            "{\"value\": \"column unit\", \"low\": \"column unit\", \"high\": \"column unit\"}".to_owned(),
        ),
    ];
    let mut table = TableFile::create(&tables.numbers, Form::Parquet, existing, &columns, &about)?;
    let mut place = 0;
    let mut last = ("", String::new());
    for number in numbers(report) {
        // the first, second, third worst
        let now = (number.quantity, number.response.clone());
        place = if number.run.is_some() && now == last { place + 1 } else { 0 };
        last = now;
        table.row(row(&number, place))?;
    }
    table.publish()?;
    samples(&report.gathered.samples, report, &tables.samples, existing)
}

fn row(number: &Number, place: u64) -> Vec<Cell> {
    let text = |t: &str| Cell::Text(t.to_owned());
    vec![
        text(&number.response),
        text(number.quantity),
        text(&number.parameter),
        Cell::Number(number.run.map_or(f64::NAN, |run| run as f64)),
        Cell::Number(number.value),
        Cell::Number(number.interval[0]),
        Cell::Number(number.interval[1]),
        text(&number.unit),
        Cell::Count(number.rows as u64),
        text(&number.mark),
        text(&number.command),
        Cell::Count(place),
    ]
}

fn samples(samples: &Samples, report: &Report, path: &Path, existing: Existing) -> Result<(), String> {
    let mut columns = vec![("sample".to_owned(), Kind::Count)];
    let mut units = serde_json::Map::new();
    for input in &samples.inputs {
        let kind = if input.is_number() { Kind::Number } else { Kind::Text };
        let name = format!("input.{}", input.name);
        let unit = if input.unit.is_empty() && input.is_number() { "1" } else { &input.unit };
        units.insert(name.clone(), unit.into());
        columns.push((name, kind));
    }
    for response in &samples.responses {
        units.insert(response.name.clone(), response.unit.clone().into());
        columns.push((response.name.clone(), Kind::Number));
    }
    let about = [
        ("occupant.study", report.opened.manifest_sha256.clone()),
        ("occupant.units", serde_json::Value::Object(units).to_string()),
    ];
    let mut table = TableFile::create(path, Form::Parquet, existing, &columns, &about)?;
    for (i, number) in samples.numbers.iter().enumerate() {
        let mut row = vec![Cell::Count(*number)];
        for input in &samples.inputs {
            let value = input.values[i];
            let word = |words: &Vec<String>| words.get(value as usize).cloned();
            row.push(match &input.words {
                None => Cell::Number(value),
                Some(words) => Cell::Text(word(words).filter(|_| !value.is_nan()).unwrap_or_default()),
            });
        }
        let values = samples.responses.iter();
        row.extend(values.map(|response| Cell::Number(response.values[i])));
        table.row(row)?;
    }
    table.publish().map(|_| ())
}

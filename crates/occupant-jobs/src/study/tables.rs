//! The numbers of a report as Parquet: one table of all numbers, one of the samples that they are made of.

use std::path::{Path, PathBuf};

use super::gather::{Sample, each_sample};
use super::quoting::bars;
use super::{Finding, Number, Report};
use crate::base::{Existing, Failure};
use crate::quoted::Statement;
use occupant_files::table::{Cell, Form, Kind, TableFile, columns};

/// Files of a report's tables.
#[derive(Clone, Debug)]
pub struct Tables {
    /// The table of numbers.
    pub numbers: PathBuf,
    /// The table of samples.
    pub samples: PathBuf,
    /// The table of quantiles, limits, histograms and distributions.
    pub distribution: PathBuf,
}

impl Tables {
    /// Next to the page: `report.html` has `report.parquet` and `report-samples.parquet`.
    pub fn beside(page: &Path) -> Self {
        let stem = page.file_stem().unwrap_or_default().to_string_lossy();
        Tables {
            numbers: page.with_file_name(format!("{stem}.parquet")),
            samples: page.with_file_name(format!("{stem}-samples.parquet")),
            distribution: page.with_file_name(format!("{stem}-distribution.parquet")),
        }
    }
}

/// Writes the tables.
///
/// # Errors
/// A file that is there and may not be replaced; an error of the operating system.
pub fn write(report: &Report, tables: &Tables, existing: Existing) -> Result<(), Failure> {
    let about = [
        ("occupant.study", report.opened.manifest_sha256.clone()),
        (
            "occupant.units",
            "{\"value\": \"column unit\", \"low\": \"column unit\", \"high\": \"column unit\"}".to_owned(),
        ),
    ];
    let columns = columns(&[
        (Kind::Text, &["response", "quantity", "parameter"]),
        (Kind::MaybeNumber, &["run", "value", "low", "high"]),
        (Kind::Text, &["unit"]),
        (Kind::Count, &["rows"]),
        (Kind::Text, &["mark", "command"]),
        (Kind::Count, &["place"]),
    ]);
    let mut table = TableFile::create(tables.numbers.clone(), Form::Parquet, existing, &columns, &about)?;
    for finding in report.findings() {
        finding.numbers.iter().try_for_each(|number| table.row(row(&finding, number)))?;
    }
    table.publish()?;
    distribution(report, &tables.distribution, existing)?;
    samples(report, &tables.samples, existing)
}

fn row(of: &Finding<'_>, number: &Number) -> Vec<Cell> {
    let (e, run) = (&number.estimate, number.run.as_ref());
    let mut row = vec![
        Cell::text(&of.response.name),
        Cell::text(number.quantity),
        Cell::text(&of.parameters(number)),
        run.map_or(Cell::Absent, |run| Cell::count(run.number)),
    ];
    row.extend([e.value, e.low, e.high].map(Cell::finite));
    row.extend([
        Cell::text(if number.in_unit { &of.response.unit.si } else { "1" }),
        Cell::count(number.rows as u64),
        Cell::text(number.mark.as_deref().unwrap_or_default()),
        Cell::text(run.and_then(|run| run.command.as_deref()).unwrap_or_default()),
        Cell::count(run.map_or(0, |run| run.place)),
    ]);
    row
}

/// One row for each quantile, limit, bar of a histogram and value, with the interval of its share or value.
fn distribution(report: &Report, path: &Path, existing: Existing) -> Result<(), Failure> {
    let about = [
        ("occupant.study", report.opened.manifest_sha256.clone()),
        ("occupant.units", "{\"at\": \"column unit\", \"to\": \"column unit\", \"share\": \"1\"}".to_owned()),
    ];
    let columns = columns(&[
        (Kind::Text, &["response", "case", "kind"]),
        (Kind::MaybeNumber, &["at", "to", "share", "low", "high"]),
        (Kind::Count, &["count", "of"]),
        (Kind::Text, &["unit", "rules"]),
    ]);
    let mut table = TableFile::create(path.to_owned(), Form::Parquet, existing, &columns, &about)?;
    for statement in report.statements() {
        rows_of(statement).into_iter().try_for_each(|row| table.row(row))?;
    }
    table.publish().map(|_| ())
}

fn rows_of(of: &Statement) -> Vec<Vec<Cell>> {
    let none = f64::NAN;
    let row = |kind: &str, numbers: [f64; 5], count: usize, rules: &str| {
        let mut row =
            vec![Cell::text(&of.figure), Cell::text(of.case.as_deref().unwrap_or_default()), Cell::text(kind)];
        row.extend(numbers.map(Cell::finite));
        row.extend([count as u64, of.runs as u64].map(Cell::count));
        row.extend([Cell::text(&of.unit), Cell::text(rules)]);
        row
    };
    let n = of.runs as f64;
    let end = |end: Option<f64>| end.unwrap_or(none);
    let mut rows: Vec<Vec<Cell>> = Vec::new();
    rows.extend(
        of.quantiles.iter().map(|q| row("quantile", [q.value, none, q.part, end(q.low), end(q.high)], of.runs, "")),
    );
    let is_sampled = of.without_intervals.is_none();
    rows.extend(of.limits.iter().map(|limit| {
        let (found, rules) = (&limit.found, limit.rules.join(", "));
        let [low, high] = if is_sampled { [found.low, found.high] } else { [none; 2] };
        row("limit", [limit.most, none, found.probability, low, high], found.above, &rules)
    }));
    rows.extend(
        of.histogram
            .iter()
            .flat_map(bars)
            .map(|(from, to, count)| row("bar", [from, to, count as f64 / n, none, none], count, "")),
    );
    rows.extend(of.values.steps().map(|(x, upto)| row("value", [x, none, upto as f64 / n, none, none], upto, "")));
    rows
}

/// One row for each sample, also of those that are not in the table of samples.
fn samples(report: &Report, path: &Path, existing: Existing) -> Result<(), Failure> {
    let gathered = &report.gathered;
    let samples = &gathered.samples;
    let mut columns = vec![("sample".to_owned(), Kind::Count)];
    let mut units = serde_json::Map::new();
    for input in &samples.inputs {
        let kind = if input.is_number() { Kind::MaybeNumber } else { Kind::Text };
        let name = format!("input.{}", input.name);
        let unit = if input.unit.si.is_empty() && input.is_number() { "1" } else { &input.unit.si };
        units.insert(name.clone(), unit.into());
        columns.push((name, kind));
    }
    for response in &samples.responses {
        units.insert(response.name.clone(), response.unit.si.clone().into());
        columns.push((response.name.clone(), Kind::MaybeNumber));
    }
    let about = [
        ("occupant.study", report.opened.manifest_sha256.clone()),
        ("occupant.units", serde_json::Value::Object(units).to_string()),
    ];
    let mut table = TableFile::create(path.to_owned(), Form::Parquet, existing, &columns, &about)?;
    if samples.one_in > 1 {
        each_sample(&report.opened, &gathered.figures, |sample| table.row(cells(&sample, samples.inputs.len())))?;
        return table.publish().map(|_| ());
    }
    for (i, number) in samples.numbers.iter().enumerate() {
        let mut row = vec![Cell::count(*number)];
        for input in &samples.inputs {
            let value = input.values[i];
            let word = |words: &Vec<String>| words.get(value as usize).filter(|_| !value.is_nan()).cloned();
            row.push(match &input.words {
                None => Cell::finite(value),
                Some(words) => Cell::text(&word(words).unwrap_or_default()),
            });
        }
        let values = samples.responses.iter();
        row.extend(values.map(|response| Cell::finite(response.values[i])));
        table.row(row)?;
    }
    table.publish().map(|_| ())
}

/// A sample with so many inputs as a row.
fn cells(sample: &Sample, inputs: usize) -> Vec<Cell> {
    let mut row = vec![Cell::count(sample.number)];
    row.extend(sample.first.cells.iter().take(inputs).cloned());
    row.extend(sample.values.iter().map(|value| Cell::finite(*value)));
    row
}

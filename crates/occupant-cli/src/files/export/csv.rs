//! CSV: one line of headings with units, `time[s],head.acceleration.x[m/s^2]`, then numbers.
//!
//! Nothing but that, so that spreadsheets and data frames open it as it is. What the columns are stands beside it in
//! `NAME.csv-metadata.json`, the place and form that "CSV on the Web" (W3C) gives it.

use std::fmt::Write as _;

use serde_json::{Value, json};

use super::About;
use crate::files::history::{Histories, UnitChoice, shown};

/// The table; numbers with the fewest digits that give the same double again, nothing for a value that is no number.
pub(crate) fn csv(histories: &Histories, about: &About, units: UnitChoice) -> String {
    let headings: Vec<String> = about.columns.iter().map(|c| quoted(&heading(c))).collect();
    let mut text = headings.join(",");
    text.push('\n');
    let sizes: Vec<f64> = histories.columns.iter().map(|c| shown(c.channel.unit, units).si).collect();
    for (i, time_s) in histories.time_s.iter().enumerate() {
        let _ = write!(text, "{}", rounded(*time_s));
        for (column, size) in histories.columns.iter().zip(&sizes) {
            text.push(',');
            let value = column.values[i] / size;
            if value.is_finite() {
                let _ = write!(text, "{}", value + 0.0);
            }
        }
        text.push('\n');
    }
    text
}

fn heading(column: &super::ColumnAbout) -> String {
    format!("{}[{}]", column.name, column.unit)
}

/// A time without the traces of counting it: 0.1 and not 0.10000000000000002.
fn rounded(time_s: f64) -> f64 {
    (time_s * 1e9).round() / 1e9
}

fn quoted(cell: &str) -> String {
    match cell.contains(['"', ',', '\n', '\r']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell.to_owned(),
    }
}

/// Metadata of the table `file`.
pub(crate) fn metadata(about: &About, file: &str) -> Value {
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
    fn headings_with_signs_of_the_format_are_quoted() {
        assert_eq!(quoted("a[m]"), "a[m]");
        assert_eq!(quoted("a,\"b\""), "\"a,\"\"b\"\"\"");
        assert_eq!(rounded(0.1 + 0.2), 0.3);
    }
}

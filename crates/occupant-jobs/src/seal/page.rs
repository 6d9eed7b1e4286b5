//! The section of a page that lists what is sealed.

use super::inputs::Input;
use super::pack::Part;
use super::sheet::{COLUMNS, Row, Sheet, shown};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use occupant_files::base::{ending, sha256};
use occupant_files::results::Results;
use occupant_pictures::html::{Cell, Html};
use std::path::Path;

/// Axes and angles of the motion.
const AXES: &str = "Centres of gravity in vehicle-space (SAE J670): X forward, Y right, Z down. Yaw to the right, pitch nose up, roll right side down, as for vehicles; a segment that is upright and looks forward in a vehicle has its angles. Near a pitch of 90°, as of a sitter's thigh, only the sum or the difference of yaw and roll is certain.";

const SCRIPT: &str = include_str!("../../assets/seal/verify.js");

/// HTML of the section; texts of users are escaped.
pub(super) fn section(
    name: &str,
    build: &str,
    results: &Results,
    (inputs, sheet): (&[Input], &Sheet),
    parts: &[Part],
) -> String {
    let mut html = Html::default();
    html.raw("<div class=\"study\" id=\"sealed\" style=\"max-width:1500px;margin:0 auto;padding:0 16px 24px\">\n");
    html.text("h2", "Sealed case");
    html.text("p", "Choose this very file to compare its bytes with its seal, without a network. The seal finds what was altered by accident or after it; whoever rewrites a file can seal it anew, so compare the SHA-256 of the file with the one that was told.");
    html.raw("<p><input type=\"file\" id=\"seal-file\" accept=\".html\"></p>\n<pre id=\"seal-answer\"></pre>\n");
    let ran_by = results.run.get("program").cloned().unwrap_or_default();
    html.facts(&[("run", name.to_owned()), ("written by", ran_by), ("sealed by, same bits", build.to_owned())]);
    html.text("h3", "Parts");
    let rows: Vec<Vec<Cell>> = parts.iter().map(row_of_part).collect();
    html.table(&["part", "bytes", "SHA-256"], &rows);
    pictures(&mut html, parts);
    html.fold(&format!("Values that were set: {}", inputs.len()));
    let rows: Vec<Vec<Cell>> = inputs.iter().map(row_of_input).collect();
    html.table(&["key", "value", "where", "preset or earlier value"], &rows);
    html.unfold();
    let texts =
        parts.iter().filter(|part| ["toml", "csv", "json", "txt", "md"].contains(&&*ending(Path::new(&part.name))));
    for part in texts {
        html.fold(&format!("{}: whole text", part.name));
        html.text("pre", &String::from_utf8_lossy(&part.bytes));
        html.unfold();
    }
    html.fold("Motion every 1/20 s");
    html.text("p", AXES);
    let rows: Vec<Vec<Cell>> = sheet.0.iter().map(row_of_sheet).collect();
    html.table(&COLUMNS, &rows);
    html.unfold();
    html.raw(&format!("</div>\n<script>\n{SCRIPT}</script>\n"));
    html.finish()
}

fn row_of_part(part: &Part) -> Vec<Cell> {
    vec![Cell::Words(part.name.clone()), Cell::Number(part.bytes.len().to_string()), Cell::Words(sha256(&part.bytes))]
}

fn row_of_input(input: &Input) -> Vec<Cell> {
    [&input.path, &input.value, &input.place, &input.default].map(|text| Cell::Words(text.clone())).to_vec()
}

fn row_of_sheet(row: &Row) -> Vec<Cell> {
    let numbers = std::iter::once(Some(row.time_s)).chain(row.values);
    let numbers = numbers.map(|value| Cell::Number(shown(value, |x| format!("{x:.3}"))));
    std::iter::once(Cell::Words(row.part.clone())).chain(numbers).collect()
}

/// Pictures and films among the parts.
fn pictures(html: &mut Html, parts: &[Part]) {
    for part in parts {
        let kind = ending(Path::new(&part.name));
        if ["png", "gif"].contains(&&*kind) {
            let data = STANDARD.encode(&part.bytes);
            html.raw(&format!(
                "<p><img style=\"max-width:100%\" alt=\"film\" src=\"data:image/{kind};base64,{data}\"></p>\n"
            ));
        }
    }
}

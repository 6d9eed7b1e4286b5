//! The section of a page that lists what is sealed.

use super::again::STATES;
use super::inputs::Input;
use super::pack::Part;
use super::quoted::Quoted;
use super::sheet::{COLUMNS, MOTION, Row, Sheet, shown};
use crate::study::all_words;
use occupant_files::base::{ending, sha256};
use occupant_files::results::Results;
use occupant_pictures::html::{Cell, Html};
use std::path::Path;

/// Axes and angles of the motion.
const AXES: &str = "Centres of gravity in vehicle-space (SAE J670): X forward, Y right, Z down. Yaw to the right, pitch nose up, roll right side down, as for vehicles; a segment that is upright and looks forward in a vehicle has its angles. Near a pitch of 90°, as of a sitter's thigh, only the sum or the difference of yaw and roll is certain.";

pub(super) const OTHER_STUDY: &str = "The study varies another text than the scenario of this run: compare the two before its intervals are quoted for this run.";

const SCRIPT: &str = include_str!("../../assets/seal/verify.js");

/// What the page says of the file itself.
pub(super) struct Listed<'a> {
    /// Name of the result file.
    pub name: String,
    /// The program that seals.
    pub build: &'a str,
    pub parts: &'a [Part],
    /// The results, if the case would be too large with them.
    pub left: Option<&'a Part>,
}

const STATES_ALONE: &str = "states.mcap holds the state at every output and all that the run needs to go on. The commands read it as a result file and compute every other number from it anew.";
const LEFT: &str = "states.mcap is not in this case, which would be larger than 5 MB with it. states.csv has the SHA-256 of every output; `occupant seal CASE.html --verify --again` makes the run again and compares them. `occupant run resolved.toml` in the folder of `--extract` writes the results anew.";

/// HTML of the section; texts of users are escaped.
pub(super) fn section(
    results: &Results,
    (inputs, sheet, study): (&[Input], &Sheet, Option<&Quoted>),
    listed: &Listed<'_>,
) -> String {
    let mut html = Html::default();
    html.raw("<div class=\"study\" id=\"sealed\" style=\"max-width:1500px;margin:0 auto;padding:0 16px 24px\">\n");
    html.text("h2", "Sealed case");
    html.text("p", "Choose this very file to compare its bytes with its seal, without a network. The seal finds what was altered by accident or after it; whoever rewrites a file can seal it anew, so compare the SHA-256 of the file with the one that was told.");
    html.raw("<p><input type=\"file\" id=\"seal-file\" accept=\".html\"></p>\n<pre id=\"seal-answer\"></pre>\n");
    let ran_by = results.run.get("program").cloned().unwrap_or_default();
    html.facts(&[
        ("run", listed.name.clone()),
        ("written by", ran_by),
        ("sealed by, same bits", listed.build.to_owned()),
    ]);
    html.text("h3", "Parts");
    let rows: Vec<Vec<Cell>> = listed.parts.iter().chain(listed.left).map(row_of_part).collect();
    html.table(&["part", "bytes", "SHA-256"], &rows);
    html.text("p class=\"note\"", if listed.left.is_some() { LEFT } else { STATES_ALONE });
    study.iter().for_each(|study| say(&mut html, study));
    html.fold(&format!("Values that were set: {}", inputs.len()));
    let rows: Vec<Vec<Cell>> = inputs.iter().map(row_of_input).collect();
    html.table(&["key", "value", "where", "preset or earlier value", "meaning; what holds if absent"], &rows);
    html.unfold();
    let texts = listed
        .parts
        .iter()
        .filter(|part| ![STATES, MOTION].contains(&&*part.name))
        .filter(|part| ["toml", "csv", "json", "txt", "md"].contains(&&*ending(Path::new(&part.name))));
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

/// What can be quoted of a study; that it varies another text is said first.
fn say(html: &mut Html, study: &Quoted) {
    let title = &study.report.opened.manifest.title;
    html.text("h3", &format!("Intervals from the study {title}"));
    if !study.is_of_this {
        html.text("p class=\"note\"", OTHER_STUDY);
    }
    all_words(html, &study.report);
}

fn row_of_part(part: &Part) -> Vec<Cell> {
    vec![Cell::Words(part.name.clone()), Cell::Number(part.bytes.len().to_string()), Cell::Words(sha256(&part.bytes))]
}

fn row_of_input(input: &Input) -> Vec<Cell> {
    [&input.path, &input.value, &input.place, &input.default, &input.meaning]
        .map(|text| Cell::Words(text.clone()))
        .to_vec()
}

fn row_of_sheet(row: &Row) -> Vec<Cell> {
    let numbers = std::iter::once(Some(row.time_s)).chain(row.values);
    let numbers = numbers.map(|value| Cell::Number(shown(value, |x| format!("{x:.3}"))));
    std::iter::once(Cell::Words(row.part.clone())).chain(numbers).collect()
}

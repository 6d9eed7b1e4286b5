//! What a study of the scenario says, beside the one run.

use super::pack::Part;
use crate::base::{Failure, Show, Units};
use crate::study::{Report, answer};
use crate::sweep::Stored;
use occupant_files::base::sha256;
use occupant_files::results::Results;

/// A study, read.
pub(super) struct Quoted {
    pub report: Report,
    /// Whether it varies the text of this run.
    pub is_of_this: bool,
    /// Its numbers and paragraphs in JSON.
    pub part: Part,
}

/// The study's figures with their intervals, and whether it varies the scenario of the run.
pub(super) fn quoted(stored: Stored, results: &Results, units: Units) -> Result<Quoted, Failure> {
    let report = Report::of(stored, &[], &[], units, Show::NOTHING)?;
    let json = serde_json::to_vec_pretty(&answer(&report));
    let json = json.map_err(|e| Failure::plain(format!("the study's answer is not JSON: {e}")))?;
    let varied = report.opened.manifest.texts.get(1);
    let is_of_this =
        results.scenario_text.as_ref().zip(varied).is_some_and(|(own, varied)| sha256(own.as_bytes()) == varied.sha256);
    Ok(Quoted { is_of_this, part: Part::new("study/quotes.json", json), report })
}

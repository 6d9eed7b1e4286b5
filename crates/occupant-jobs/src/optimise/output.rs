//! The files of an optimisation: the best scenario, the history, the page, and optimum.json last.

use std::path::Path;

use occupant_core::results::summary::Summarizer;

use super::result::record_of;
use super::searched::Answer;
use super::{Optimising, Optimum, page, text};
use crate::base::{Failure, file_name, json};
use crate::files::study_folder::{Checksums, Folder};
use crate::fit::output::{put, write_scenario};
use crate::fit::scenario_text::{Fitted, numbers};
use crate::risk::columns;
use crate::search::{Objective, Record, history};

/// Writes the results.
///
/// # Errors
/// A best candidate that does not repeat; a file that cannot be written.
pub fn write(
    of: &Optimising,
    place: (&Folder, &Checksums),
    answer: &Answer,
    records: &[Record],
) -> Result<Optimum, Failure> {
    let (folder, sums) = place;
    let values = of.values(&answer.found.point.at);
    let written = numbers(&of.experiment, &values).map_err(Failure::broke_off)?;
    let caveats = again(of, answer, records, &written).map_err(Failure::broke_off)?;
    let result = Optimum::of(of, answer, records, written, &caveats);
    let numbers: Vec<&Fitted> = result.written.iter().collect();
    let words = |n: &&Fitted| (n.path.clone(), text::provenance(&result, &result.parameters[n.parameter]));
    let provenance: Vec<(String, String)> = numbers.iter().map(words).collect();
    let (scenario, study) = (file_name(&of.experiment.scenario), &result.study.file);
    let head = format!("# {scenario} with the numbers of the optimisation {study}: see [provenance].\n");
    write_scenario(place, &of.experiment, &numbers, &provenance, &head)?;
    let tables = history::write(folder, of, records)?;
    tables.iter().try_for_each(|table| sums.add(table))?;
    put(place, Path::new("report.html"), page::page(of, &result, records).as_bytes())?;
    put(place, Path::new("optimum.json"), json(&result)?.as_bytes())?;
    Ok(result)
}

/// Runs the scenario that is written; the texts of its caveats on the measures. It must show what the candidate showed.
fn again(of: &Optimising, answer: &Answer, records: &[Record], written: &[Fitted]) -> Result<Vec<String>, String> {
    let model = of.experiment.model_with(written.iter().map(|n| (&n.path, &n.text)));
    let model = model.map_err(|e| e.to_string())?;
    let mut summarizer = Summarizer::new();
    of.experiment.run(&model, &mut summarizer)?;
    let summary = summarizer.summary(None).ok_or("the best candidate cannot be run again")?;
    let counted = of.counted(&[summary.figures(&model), columns(model.setup())].concat())?;
    let first = record_of(answer, records).map_or(&[][..], |record| &record.parts);
    let same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits();
    if first.len() < counted.len() || !counted.iter().zip(first).all(same) {
        return Err("the best candidate shows other figures when it is run again".to_owned());
    }
    let touches = |name: &dyn Fn(&str) -> bool| of.measures.all.iter().any(|(measure, ..)| name(measure));
    let caveats = summary.caveats.iter().filter(|caveat| touches(&|measure| caveat.touches(measure)));
    Ok(caveats.map(|caveat| caveat.text.clone()).collect())
}

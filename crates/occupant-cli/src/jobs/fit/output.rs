//! The files of a fit: fitted scenarios, history, plots, and fit.json last.

use std::fs;
use std::path::Path;

use occupant_core::results::summary::Summarizer;

use super::accord::Accord;
use super::evaluator::Record;
use super::fitting::Fitting;
use super::found::{Found, found};
use super::identified::Answer;
use super::plots::{Pair, sheets};
use super::scenario_text::{Fitted, fitted, numbers};
use super::{candidates, report};
use crate::base::failure::Failure;
use crate::base::names::{file_name, file_stem};
use crate::base::output_file::{Existing, write_whole};
use crate::base::talk::{json, say};
use crate::files::study_folder::checksums::Checksums;
use crate::files::study_folder::folder::Folder;

/// Writes the results of a fit.
pub(crate) struct Output<'a> {
    pub(crate) fitting: &'a Fitting,
    pub(crate) folder: &'a Folder,
    pub(crate) sums: &'a Checksums,
}

/// What the fitted scenarios came to.
#[derive(Default)]
struct FittedRuns {
    /// The numbers as they are written.
    written: Vec<Fitted>,
    /// Misfit of each target, and how it and its run go together, experiment by experiment.
    parts: Vec<(f64, Accord)>,
    /// The runs of each experiment.
    runs: Vec<Pair>,
    /// What is to know of their figures.
    caveats: Vec<String>,
}

impl Output<'_> {
    /// Fitted scenarios, history, plots, and fit.json last.
    pub(crate) fn write(&self, answer: &Answer, records: &[Record]) -> Result<Found, Failure> {
        let values = self.fitting.values(&answer.best.at);
        let FittedRuns { written, parts, runs, caveats } = self.run_fitted(&values).map_err(broke_off)?;
        let mut found = found(self.fitting, answer, records, written, &parts);
        found.warnings.extend(caveats);
        self.write_scenarios(&found)?;
        let tables = candidates::write(self.folder, self.fitting, records)?;
        tables.iter().try_for_each(|table| self.sums.add(table))?;
        let lines = [format!("{}: {} score {:.5}", found.study.file, found.objective, found.score.after)];
        for (name, svg) in
            sheets(self.fitting, &self.fitting.corrections(Some(&values)), &runs, &lines).map_err(broke_off)?
        {
            self.put(Path::new(&format!("plots/{}.svg", file_stem(&name))), svg.as_bytes())?;
        }
        self.put(Path::new("fit.json"), json(&found)?.as_bytes())?;
        Ok(found)
    }

    /// Runs the scenarios with the numbers as they will be written, and without.
    fn run_fitted(&self, values: &[f64]) -> Result<FittedRuns, String> {
        let FittedRuns { mut written, mut parts, mut runs, mut caveats } = FittedRuns::default();
        let corrections = self.fitting.corrections(Some(values));
        for experiment in &self.fitting.experiments {
            let numbers = numbers(experiment, values)?;
            let model = experiment.model_with(numbers.iter().map(|n| (&n.path, &n.text)));
            let mut summarizer = Summarizer::new();
            let after = experiment.run(&model.map_err(|e| e.to_string())?, &mut summarizer)?;
            let summary = summarizer.summary(None);
            let of_run = summary.iter().flat_map(|summary| &summary.caveats);
            caveats.extend(of_run.map(|caveat| format!("{}: {}", experiment.fitted, caveat.text)));
            let misfits = experiment.misfits(self.fitting.fit.misfit, &after, &corrections)?;
            parts.extend(misfits.into_iter().zip(experiment.accords(&after, &corrections)?));
            written.extend(numbers);
            runs.push(Pair { before: experiment.run_with(None).ok(), after });
        }
        Ok(FittedRuns { written, parts, runs, caveats })
    }

    fn write_scenarios(&self, found: &Found) -> Result<(), Failure> {
        for experiment in &self.fitting.experiments {
            let name = &experiment.fitted;
            let numbers: Vec<&Fitted> = found.written.iter().filter(|n| n.fitted == *name).collect();
            let words = |i: usize| report::provenance(found, &found.parameters[i]);
            let provenance: Vec<(String, String)> =
                numbers.iter().map(|n| (n.path.clone(), words(n.parameter))).collect();
            let head = format!(
                "# {} with the numbers of the fit {}: see [provenance].\n",
                file_name(&experiment.scenario),
                found.study.file
            );
            let text = fitted(experiment, &numbers, &provenance, &head).map_err(broke_off)?;
            if !text.kept {
                say(&format!("note: {name} is written anew: its comments and order could not be kept"));
            }
            self.put(Path::new(name), text.text.as_bytes())?;
            let folder = Path::new(name).parent().unwrap_or(Path::new(""));
            for (table, bytes) in &experiment.tables.0 {
                // beside the scenario that names it, if that is a place below it
                let mut below = Path::new(table).components();
                if below.all(|c| matches!(c, std::path::Component::Normal(_))) {
                    self.put(&folder.join(table), bytes)?;
                }
            }
        }
        Ok(())
    }

    /// Writes a file of the folder, whole or not at all.
    fn put(&self, name: &Path, bytes: &[u8]) -> Result<(), Failure> {
        let path = self.folder.path.join(name);
        let made = path.parent().map_or(Ok(()), fs::create_dir_all);
        made.map_err(|e| broke_off(format!("cannot write {}: {e}", path.display())))?;
        let written = write_whole(&path, Existing::Replace, bytes).map_err(|e| broke_off(e.to_string()))?;
        Ok(self.sums.add(&written)?)
    }
}

fn broke_off(reason: String) -> Failure {
    Failure::BrokeOff(format!("error: {reason}"))
}

//! The files of a fit: fitted scenarios, history, plots, and fit.json last.

use std::fs;
use std::path::{Component, Path};

use occupant_core::results::summary::Summarizer;

use super::plots::{Pair, sheets};
use super::scenario_text::{fitted, numbers};
use super::{Accord, Answer, Correction, Experiment, FitResult, Fitted, Fitting, Objective, Record, report};
use crate::base::{Existing, Failure, file_name, file_stem, json, say, write_whole};
use crate::files::study_folder::{Checksums, Folder};
use crate::search::history;

/// Writes the results of a fit.
pub struct Output<'a> {
    /// The fit.
    pub fitting: &'a Fitting,
    /// The folder.
    pub folder: &'a Folder,
    /// Checksums of the inputs.
    pub sums: &'a Checksums,
}

/// Results of the fitted scenarios.
#[derive(Default)]
pub struct FittedRuns {
    /// The values as written.
    pub written: Vec<Fitted>,
    /// Misfit of each target and its agreement with the run, by experiment.
    pub parts: Vec<(f64, Accord)>,
    /// The runs of each experiment.
    runs: Vec<Pair>,
    /// Caveats on their figures.
    pub caveats: Vec<String>,
}

impl Output<'_> {
    /// Writes fitted scenarios, history, plots, and fit.json last.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self, answer: &Answer, records: &[Record]) -> Result<FitResult, Failure> {
        let values = self.fitting.values(&answer.best.at);
        let corrections = self.fitting.corrections(Some(&values));
        let mut fitted = FittedRuns::default();
        for experiment in &self.fitting.experiments {
            self.run_fitted(experiment, &values, &corrections, &mut fitted).map_err(Failure::broke_off)?;
        }
        let runs = std::mem::take(&mut fitted.runs);
        let result = FitResult::of(self.fitting, answer, records, fitted);
        for experiment in &self.fitting.experiments {
            self.write_scenario(experiment, &result)?;
        }
        let tables = history::write(self.folder, self.fitting, records)?;
        tables.iter().try_for_each(|table| self.sums.add(table))?;
        let lines = [format!("{}: {} score {:.5}", result.study.file, result.objective, result.score.after)];
        for (name, svg) in sheets(self.fitting, &corrections, &runs, &lines).map_err(Failure::broke_off)? {
            self.put(Path::new(&format!("plots/{}.svg", file_stem(&name))), svg.as_bytes())?;
        }
        self.put(Path::new("fit.json"), json(&result)?.as_bytes())?;
        Ok(result)
    }

    /// Runs a scenario with the values as written, and without.
    fn run_fitted(
        &self,
        experiment: &Experiment,
        values: &[f64],
        corrections: &[Correction],
        fitted: &mut FittedRuns,
    ) -> Result<(), String> {
        let numbers = numbers(experiment, values)?;
        let model = experiment.model_with(numbers.iter().map(|n| (&n.path, &n.text)));
        let mut summarizer = Summarizer::new();
        let after = experiment.run(&model.map_err(|e| e.to_string())?, &mut summarizer)?;
        let caveats = summarizer.summary(None).into_iter().flat_map(|summary| summary.caveats);
        fitted.caveats.extend(caveats.map(|caveat| format!("{}: {}", experiment.fitted, caveat.text)));
        let misfits = experiment.misfits(self.fitting.fit.misfit, &after, corrections)?;
        fitted.parts.extend(misfits.into_iter().zip(experiment.accords(&after, corrections)?));
        fitted.written.extend(numbers);
        fitted.runs.push(Pair { before: experiment.run_with(None).ok(), after });
        Ok(())
    }

    fn write_scenario(&self, experiment: &Experiment, result: &FitResult) -> Result<(), Failure> {
        let (name, study) = (&experiment.fitted, &result.study.file);
        let numbers: Vec<&Fitted> = result.written.iter().filter(|n| n.fitted == *name).collect();
        let words = |number: &&Fitted| report::provenance(result, &result.parameters[number.parameter]);
        let provenance: Vec<(String, String)> = numbers.iter().map(|n| (n.path.clone(), words(n))).collect();
        let head =
            format!("# {} with the numbers of the fit {study}: see [provenance].\n", file_name(&experiment.scenario));
        write_scenario((self.folder, self.sums), experiment, &numbers, &provenance, &head)
    }

    /// Writes a file of the folder, atomically.
    fn put(&self, name: &Path, bytes: &[u8]) -> Result<(), Failure> {
        put((self.folder, self.sums), name, bytes)
    }
}

/// Writes the scenario of an experiment with these numbers and their provenance, and the tables that it names.
///
/// # Errors
/// Numbers that the scenario refuses; a file that cannot be written.
pub fn write_scenario(
    place: (&Folder, &Checksums),
    experiment: &Experiment,
    numbers: &[&Fitted],
    provenance: &[(String, String)],
    head: &str,
) -> Result<(), Failure> {
    let name = &experiment.fitted;
    let (text, kept) = fitted(experiment, numbers, provenance, head).map_err(Failure::broke_off)?;
    if !kept {
        say(&format!("note: {name} is rewritten; its comments and order are lost"));
    }
    put(place, Path::new(name), text.as_bytes())?;
    let folder = Path::new(name).parent().unwrap_or(Path::new(""));
    // beside the scenario that names them, if that is a place below it
    let is_below = |table: &str| Path::new(table).components().all(|c| matches!(c, Component::Normal(_)));
    let mut tables = experiment.tables.0.iter().filter(|(table, _)| is_below(table));
    tables.try_for_each(|(table, bytes)| put(place, &folder.join(table), bytes))
}

/// Writes a file of a folder, atomically.
///
/// # Errors
/// An error of the operating system.
pub fn put((folder, sums): (&Folder, &Checksums), name: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let path = folder.path.join(name);
    let made = path.parent().map_or(Ok(()), fs::create_dir_all);
    made.map_err(|e| Failure::broke_off(format!("cannot write {}: {e}", path.display())))?;
    let written = write_whole(&path, Existing::Replace, bytes).map_err(Failure::broke_off)?;
    Ok(sums.add(&written)?)
}

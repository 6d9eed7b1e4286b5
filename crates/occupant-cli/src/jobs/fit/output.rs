//! The files of a fit: fitted scenarios, history, plots, and fit.json last.

use std::fs;
use std::io::Write;
use std::path::Path;

use occupant_core::scenario::Draft;

use super::evaluator::Record;
use super::experiment::opened;
use super::fitting::Fitting;
use super::found::{Fittings, Found, found};
use super::identified::{Answer, run, run_model};
use super::plots::{Pair, sheets};
use super::scenario_text::{fitted, numbers};
use super::{candidates, report};
use crate::base::failure::Failure;
use crate::base::names::{file_name, program};
use crate::base::output_file::{Existing, PartialFile};
use crate::base::talk::{json, say};
use crate::files::study_folder::folder::Folder;

/// Writes the results of a fit.
pub(crate) struct Output<'a> {
    pub(crate) fitting: &'a Fitting,
    pub(crate) folder: &'a Folder,
}

impl Output<'_> {
    /// Fitted scenarios, history, plots, and fit.json last.
    pub(crate) fn write(&self, answer: &Answer, records: &[Record]) -> Result<Found, Failure> {
        let values = self.fitting.values(&answer.best.at);
        let (fittings, runs) = self.run_fitted(&values).map_err(broke_off)?;
        let found = found(self.fitting, answer, records, &fittings, program());
        self.write_scenarios(&found, &fittings)?;
        candidates::write(self.folder, self.fitting, records)?;
        let lines = [format!("{}: {} score {:.5}", found.study.file, found.objective, found.score.after)];
        for (name, svg) in sheets(self.fitting, &runs, &lines).map_err(broke_off)? {
            let name = format!("plots/{}.svg", file_stem(&name));
            self.put(&name, svg.as_bytes())?;
        }
        self.put("fit.json", json(&found)?.as_bytes())?;
        Ok(found)
    }

    /// Runs the scenarios with the numbers as they will be written, and without.
    fn run_fitted(&self, values: &[f64]) -> Result<(Fittings, Vec<Pair>), String> {
        let experiments = &self.fitting.experiments;
        let mut fittings = Fittings { names: self.names(), numbers: Vec::new(), parts: Vec::new() };
        let mut runs = Vec::new();
        for experiment in experiments {
            let numbers = numbers(experiment, values)?;
            let mut draft: Draft = experiment.study.base().clone();
            for number in &numbers {
                let set = draft.set_value(&number.path, &number.text);
                set.map_err(|e| e.to_string())?;
            }
            let (_, model, _) = opened(draft, &experiment.tables).map_err(|e| e.to_string())?;
            let after = run_model(experiment, &model)?;
            fittings.parts.extend(experiment.misfits(self.fitting.fit.misfit, &after)?);
            fittings.numbers.push(numbers);
            runs.push(Pair { before: run(experiment, None).ok(), after });
        }
        Ok((fittings, runs))
    }

    /// `fitted.toml`, or a file for each experiment, named after its first test.
    fn names(&self) -> Vec<String> {
        let experiments = self.fitting.experiments.len();
        if experiments == 1 {
            return vec!["fitted.toml".to_owned()];
        }
        let name = |e: usize| {
            let test = self.fitting.tests.iter().find(|t| t.experiment == e);
            let name = test.map_or(e.to_string(), |t| file_stem(&t.name));
            format!("fitted/{name}.toml")
        };
        (0..experiments).map(name).collect()
    }

    fn write_scenarios(&self, found: &Found, fittings: &Fittings) -> Result<(), Failure> {
        let each = self.fitting.experiments.iter().zip(&fittings.numbers);
        for ((experiment, numbers), name) in each.zip(&fittings.names) {
            let words = |i: usize| report::provenance(self.fitting, found, &found.parameters[i], i);
            let provenance: Vec<(String, String)> =
                numbers.iter().map(|n| (n.path.clone(), words(n.parameter))).collect();
            let head = format!(
                "# {} with the numbers of the fit {}: see [provenance].\n",
                file_name(&experiment.scenario),
                found.study.file
            );
            let text = fitted(experiment, numbers, &provenance, &head).map_err(broke_off)?;
            if !text.kept {
                say(&format!("note: {name} is written anew: its comments and order could not be kept"));
            }
            self.put(name, text.text.as_bytes())?;
            let folder = Path::new(name).parent().unwrap_or(Path::new(""));
            for (table, bytes) in &experiment.tables {
                // beside the scenario that names it, if that is a place below it
                let below = Path::new(table).components();
                if below.clone().all(|c| matches!(c, std::path::Component::Normal(_))) {
                    let place = folder.join(table);
                    self.put(&place.display().to_string(), bytes)?;
                }
            }
        }
        Ok(())
    }

    /// Writes a file of the folder, whole or not at all.
    fn put(&self, name: &str, bytes: &[u8]) -> Result<(), Failure> {
        let path = self.folder.path().join(name);
        let failed =
            |e: &dyn std::fmt::Display| Failure::BrokeOff(format!("error: cannot write {}: {e}", path.display()));
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder).map_err(|e| failed(&e))?;
        }
        let mut file = PartialFile::create(&path, Existing::Replace).map_err(|e| failed(&e))?;
        file.write_all(bytes).map_err(|e| failed(&e))?;
        file.publish().map_err(|e| failed(&e))?;
        Ok(())
    }
}

/// A name that can be that of a file.
fn file_stem(name: &str) -> String {
    let plain = |c: char| {
        if c.is_alphanumeric() || "-_ .".contains(c) { c } else { '_' }
    };
    name.chars().map(plain).collect()
}

fn broke_off(reason: String) -> Failure {
    Failure::BrokeOff(format!("error: {reason}"))
}

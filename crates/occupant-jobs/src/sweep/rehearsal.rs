//! Preview of a sweep, without writing anything.

use std::time::Instant;

use occupant_core::results::summary::Summarizer;
use occupant_core::run::simulate::attempt;
use occupant_study::Value;
use placed_text::Severity;

use super::job::Sweep;
use super::words::indices;
use crate::base::Failure;
use crate::base::text_table::Align::{Left, Right};
use crate::base::text_table::{NONE, Table, facts, trimmed};
use crate::files::study_folder::Role;
use occupant_files::table::Cell;

/// Number of samples shown.
const SHOWN: u64 = 5;
/// Approximate size of a table value, bytes.
const CELL: f64 = 8.0;

impl Sweep {
    /// Number of samples, the first of them, and the time they take, estimated by running one.
    ///
    /// # Errors
    /// The first sample is refused or fails.
    pub fn rehearse(&self) -> Result<String, Failure> {
        let (manifest, samples) = (&self.plan.manifest, self.block.samples.clone());
        let count = samples.end - samples.start;
        let (corners, refused) = self.corners();
        let seconds = self.of_one(samples.start).map_err(|failure| match &refused[..] {
            [] => failure,
            some => failure.with_done(&format!(
                "of {corners} corners of the study, {} are invalid:\n{}",
                some.len(),
                some.concat()
            )),
        })?;
        let threads = self.engine.threads() as f64;
        let megabytes = count as f64 * manifest.columns.len() as f64 * CELL / 1e6;
        let mut lines = vec![
            ("samples", format!("{count} of {} columns each", manifest.columns.len())),
            ("time", format!("about {}, one sample took {seconds:.2} s", duration(seconds * count as f64 / threads))),
            ("threads", threads.to_string()),
            (
                "corners",
                match refused.len() {
                    0 => format!("{corners} combinations of smallest and largest values tried, all valid"),
                    n => format!("{n} of {corners} are INVALID, see below"),
                },
            ),
            ("table", format!("about {megabytes:.1} MB, plus the whole runs that are kept")),
            ("folder", format!("{}; nothing was written", self.folder.path.display())),
        ];
        lines.extend(self.plan.rating.as_ref().map(|rates| ("rating", rates.words())));
        lines.extend(indices(&self.plan.study).map(|note| ("indices", note)));
        let first = self.first(samples.start..samples.end.min(samples.start + SHOWN));
        let refused =
            if refused.is_empty() { String::new() } else { format!("\nrefused corners\n{}", refused.concat()) };
        Ok(format!("{}\n{first}{refused}", facts(&lines)))
    }

    /// Number of corners of the study, and a line for each refused one: its values, and the reason.
    fn corners(&self) -> (usize, Vec<String>) {
        let (study, all) = (&self.plan.study, self.plan.study.corners());
        let refused = all.iter().filter_map(|corner| {
            let opened = study.draft_at(corner).and_then(|draft| self.plan.tables.open(draft).map(|_| ()));
            let problems = opened.err()?;
            let values = corner.values.iter().map(|(i, value)| {
                let parameter = &study.parameters[*i];
                let (per, unit) = self.units.told_of(parameter, &study.base).shown;
                match value {
                    Value::Number(x) => {
                        format!("{} = {} {unit}", parameter.name, trimmed(x / per, 4)).trim_end().to_owned()
                    }
                    other => format!("{} = {other:?}", parameter.name),
                }
            });
            let why = problems.iter().find(|p| p.problem.severity == Severity::Error).map(|p| p.problem.to_string());
            Some(format!("  {}: {}\n", values.collect::<Vec<_>>().join(", "), why.unwrap_or_default()))
        });
        (all.len(), refused.collect())
    }

    /// Wall time of a sample, s.
    fn of_one(&self, index: u64) -> Result<f64, Failure> {
        let began = Instant::now();
        let opened = self.plan.open_sample(index);
        let opened = opened.map_err(|problems| Failure::plain(format!("sample {index} is invalid:\n{problems}")))?;
        let ended = attempt(&opened.model, Summarizer::new());
        ended.map_err(|error| Failure::broke_off(format!("sample {index} does not run: {error}")))?;
        Ok(began.elapsed().as_secs_f64())
    }

    /// Inputs of the first samples.
    fn first(&self, samples: std::ops::Range<u64>) -> String {
        let inputs: Vec<_> =
            self.plan.manifest.columns.iter().filter(|c| matches!(c.role, Role::Input | Role::InputText)).collect();
        let head = |name: &str, unit: &str| match unit {
            "" => name.to_owned(),
            unit => format!("{name}, {unit}"),
        };
        let study = &self.plan.study;
        // sample and member of an ensemble are plain numbers
        let told = |i: usize| {
            let parameter = study.parameters.get(i);
            parameter.map_or_else(|| (1.0, String::new()), |p| self.units.told_of(p, &study.base).shown)
        };
        let shown: Vec<(f64, String)> = (0..inputs.len()).map(told).collect();
        let heads: Vec<String> = inputs
            .iter()
            .zip(&shown)
            .map(|(column, (_, unit))| head(column.name.trim_start_matches("input."), unit))
            .collect();
        let heads: Vec<&str> = heads.iter().map(String::as_str).collect();
        let mut table = Table::new(&[(Left, &["sample"]), (Right, &heads)]);
        for index in samples {
            let cells = self.plan.inputs(index);
            let text = |(cell, (per, _)): (&Cell, &(f64, String))| match cell {
                Cell::Number(x) => trimmed(x / per, 4),
                Cell::Text(text) => text.to_string(),
                Cell::Absent => NONE.to_owned(),
            };
            table.row(std::iter::once(index.to_string()).chain(cells.iter().zip(&shown).map(text)));
        }
        table.text()
    }
}

/// A duration as text.
fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 100.0 => format!("{s:.1} s"),
        s if s < 6000.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}

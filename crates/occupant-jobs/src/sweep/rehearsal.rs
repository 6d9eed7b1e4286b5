//! Preview of a sweep, without writing anything.

use occupant_study::Value;
use placed_text::Severity;

use super::Staying;
use super::job::Sweep;
use super::trial::Trial;
use super::words::indices;
use crate::base::Failure;
use crate::base::text_table::Align::{Left, Right};
use crate::base::text_table::{NONE, Table, facts, trimmed};
use crate::files::study_folder::Role;
use occupant_files::table::Cell;

/// Number of samples shown.
const SHOWN: usize = 5;

impl Sweep {
    /// Number of samples, the first of them, and the time they take, estimated by running some.
    ///
    /// # Errors
    /// No sample tried can be run.
    pub fn rehearse(&self) -> Result<String, Failure> {
        let (manifest, samples) = (&self.plan.manifest, self.block.samples.clone());
        let count = samples.end - samples.start;
        let left = Staying::of(&self.plan.study, &samples, &self.engine);
        let (corners, refused) = self.corners();
        let tried =
            Trial::of(&self.plan, &samples, &self.engine, &self.interrupt).map_err(|failure| match &refused[..] {
                [] => failure,
                some => failure.with_done(&format!(
                    "of {corners} corners of the study, {} are invalid:\n{}",
                    some.len(),
                    some.concat()
                )),
            })?;
        let inputs = manifest.columns.iter().filter(|column| column.role != Role::Figure).count();
        let megabytes = tried.bytes(&left, inputs) / 1e6;
        let mut lines = vec![("samples", format!("{count} of {} columns each", manifest.columns.len()))];
        if !self.plan.study.relations.is_empty() {
            lines.push(("constraints", left.words()));
        }
        lines.extend(tried.lines(&left));
        lines.extend([
            (
                "corners",
                match refused.len() {
                    0 => format!("{corners} combinations of smallest and largest values tried, all valid"),
                    n => format!("{n} of {corners} are INVALID, see below"),
                },
            ),
            ("table", format!("about {megabytes:.1} MB on disk, plus the whole runs that are kept")),
            ("folder", format!("{}; nothing was written", self.folder.path.display())),
        ]);
        lines.extend(self.plan.rating.as_ref().map(|rates| ("rating", rates.words())));
        lines.extend(indices(&self.plan.study).map(|note| ("indices", note)));
        let is_run = |index: &u64| self.plan.study.excluded(*index).is_none();
        let first = self.first(samples.filter(is_run).take(SHOWN));
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

    /// Inputs of the first samples.
    fn first(&self, samples: impl Iterator<Item = u64>) -> String {
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

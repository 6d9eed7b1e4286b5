//! What is printed: the recorded run, and the model rebuilt from the scenario that travels with it.

use std::path::Path;

use occupant_core::body::tti12::TTI12;
use occupant_core::forces::contact::PairHistory;
use occupant_core::model::Model;
use occupant_core::results::summary::RunStatus;
use occupant_scenario::Loaded;

use cardio_legacy::{CompartmentLayout, passed_pairs};

use crate::base::{Failure, input_file};
use crate::files::mcap::StoredRun;
use crate::files::mcap::about::RUN;
use crate::files::scenario::stored;

/// A run to print.
pub(crate) struct Case {
    /// The recorded run.
    pub(crate) file: StoredRun,
    /// The scenario, overrides included.
    pub(crate) loaded: Loaded,
    pub(crate) model: Model,
    /// Warnings about it, in words.
    pub(crate) warnings: Vec<String>,
    /// Numbers of the surfaces, in the setup's order.
    pub(crate) numbers: Vec<usize>,
    /// Whether they are the report's.
    pub(crate) numbers_of_report: bool,
}

impl Case {
    /// Reads a result file and rebuilds its model.
    ///
    /// # Errors
    /// A file that `occupant run` has not written, that lacks its scenario or a table that it names, or whose scenario or
    /// checkpoints this program refuses.
    pub(crate) fn read(path: &Path) -> Result<Self, Failure> {
        let name = path.display();
        let bytes = input_file::read(path)?;
        let refused = |reason: String| {
            Failure::with_help(
                format!("{name} cannot be printed: {reason}"),
                "give a file that `occupant run` of this version has written",
            )
        };
        let file = StoredRun::read(&bytes).map_err(refused)?;
        if file.run.is_empty() {
            let why = file.because();
            let found = format!("it is an MCAP file without the record `{RUN}`: no result of `occupant run`{why}");
            return Err(refused(found));
        }
        let (loaded, model, warnings) = stored(path, &file)?;
        file.checkpoints.iter().try_for_each(|c| c.check(&model)).map_err(|e| refused(e.to_string()))?;
        let report = report_numbers(&model);
        let in_order = || (1..=model.setup().surface_names().count()).collect();
        Ok(Case {
            warnings: warnings.iter().map(|w| w.problem.to_string()).collect(),
            numbers_of_report: report.is_some(),
            numbers: report.unwrap_or_else(in_order),
            file,
            loaded,
            model,
        })
    }

    /// A fact about the run from its record; `-` where it has none.
    pub(crate) fn known(&self, key: &str) -> &str {
        self.file.run.get(key).map_or("-", String::as_str)
    }

    /// Whether its body is the report's, for whose coordinates cards have room.
    pub(crate) fn is_of_report(&self) -> bool {
        *self.model.body().tree == TTI12
    }

    /// The name of a contact sphere; empty for none.
    pub(crate) fn sphere(&self, index: usize) -> String {
        self.model.body().spheres.get(index).map(|s| s.name.clone()).unwrap_or_default()
    }

    /// The two lines on top of each page: the title cards, or the title and where the run comes from.
    pub(crate) fn titles(&self) -> [String; 2] {
        let notes = self.loaded.scenario.notes.as_deref().unwrap_or_default();
        let second = notes.lines().find_map(|line| line.trim().strip_prefix("TITLE 2 = "));
        let origin = || format!("{}, {}", self.known("scenario"), self.known("program"));
        [self.model.setup().title.clone(), second.map_or_else(origin, str::to_owned)]
    }

    /// Whether the run reached its end.
    pub(crate) fn is_complete(&self) -> bool {
        self.file.ending().0 == RunStatus::Completed
    }

    /// A surface by its number and name.
    pub(crate) fn surface(&self, index: usize) -> String {
        let name = self.model.setup().surface_name(index);
        let number = self.numbers.get(index).copied().unwrap_or_default();
        format!("{number:>2} {}", name.unwrap_or("-"))
    }

    /// The pairs (sphere, surface), by index, that have passed a surface's edge: those with NARRY = 0.
    pub(crate) fn passed(&self, pairs: &[PairHistory<f64>]) -> Vec<(usize, usize)> {
        let mut passed: Vec<_> = passed_pairs(&self.model, pairs).collect();
        let number = |surface: usize| self.numbers.get(surface).copied();
        passed.sort_by_key(|&(sphere, surface)| (sphere, number(surface)));
        passed
    }
}

/// The report's surface numbers, if every surface bears a name of the cards' compartment.
fn report_numbers(model: &Model) -> Option<Vec<usize>> {
    let layout = CompartmentLayout::reconstruction().ok()?;
    let number = |name: &str| layout.number_of(name).and_then(|n| usize::try_from(n).ok());
    model.setup().surface_names().map(number).collect()
}

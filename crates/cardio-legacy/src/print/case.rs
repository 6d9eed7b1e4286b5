//! Input of a printout: the recorded run, and the model rebuilt from its attached scenario.

use std::collections::BTreeMap;

use occupant_core::body::tti12::TTI12;
use occupant_core::forces::contact::PairHistory;
use occupant_core::model::Model;
use occupant_core::results::checkpoint::Checkpoint;
use occupant_core::results::summary::RunStatus;
use occupant_scenario::{Diagnostics, Loaded};

use crate::{CompartmentLayout, passed_pairs};

/// A run from its file.
#[derive(Clone, Debug)]
pub struct Recorded {
    /// Origin of the run: its program, scenario, changes.
    pub run: BTreeMap<String, String>,
    /// Results; none if it was interrupted.
    pub result: Option<BTreeMap<String, String>>,
    /// End of the run, and the reason for a failure.
    pub ending: (RunStatus, Option<String>),
    /// Attached texts: name and content.
    pub attachments: BTreeMap<String, Vec<u8>>,
    /// Its outputs.
    pub checkpoints: Vec<Checkpoint>,
}

/// A run to print.
pub struct Case {
    /// The recorded run.
    pub(crate) file: Recorded,
    /// The scenario, overrides included.
    pub loaded: Loaded,
    /// Its model.
    pub model: Model,
    /// Warnings about it, as text.
    pub(crate) warnings: Vec<String>,
    /// Numbers of the surfaces, in the setup's order.
    pub(crate) numbers: Vec<usize>,
    /// Whether they are the report's.
    pub(crate) numbers_of_report: bool,
}

impl Case {
    /// A recorded run, and the model of its scenario with the warnings about it.
    pub fn new(file: Recorded, (loaded, model, warnings): (Loaded, Model, Diagnostics)) -> Self {
        let report = report_numbers(&model);
        let in_order = || (1..=model.setup().surface_names().count()).collect();
        Case {
            warnings: warnings.iter().map(|w| w.problem.to_string()).collect(),
            numbers_of_report: report.is_some(),
            numbers: report.unwrap_or_else(in_order),
            file,
            loaded,
            model,
        }
    }

    /// Entry of the run's record; `-` without one.
    pub(crate) fn known(&self, key: &str) -> &str {
        self.file.run.get(key).map_or("-", String::as_str)
    }

    /// Whether its body is the report's, whose coordinates fit on cards.
    pub(crate) fn is_of_report(&self) -> bool {
        *self.model.body().tree == TTI12
    }

    /// The name of a contact sphere; empty for none.
    pub(crate) fn sphere(&self, index: usize) -> String {
        self.model.body().spheres.get(index).map(|s| s.name.clone()).unwrap_or_default()
    }

    /// The two lines at the top of each page: the title cards, or the title and the origin of the run.
    pub(crate) fn titles(&self) -> [String; 2] {
        let notes = self.loaded.scenario.notes.as_deref().unwrap_or_default();
        let second = notes.lines().find_map(|line| line.trim().strip_prefix("TITLE 2 = "));
        let origin = || format!("{}, {}", self.known("scenario"), self.known("program"));
        [self.model.setup().title.clone(), second.map_or_else(origin, str::to_owned)]
    }

    /// Whether the run reached its end.
    pub fn is_complete(&self) -> bool {
        self.file.ending.0 == RunStatus::Completed
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

/// The report's surface numbers, if every surface has a name of the cards' compartment.
fn report_numbers(model: &Model) -> Option<Vec<usize>> {
    let layout = CompartmentLayout::reconstruction().ok()?;
    let number = |name: &str| layout.number_of(name).and_then(|n| usize::try_from(n).ok());
    model.setup().surface_names().map(number).collect()
}

//! Endings of the runs of a study, and the runs whose results count.

use std::collections::BTreeMap;

use occupant_core::results::summary::Caveat;
use serde::{Deserialize, Serialize};

use super::manifest::Manifest;
use super::row::{Row, Status};

/// Largest number of different reasons kept.
const REASONS: usize = 12;
/// Largest number of runs kept with their reasons.
const FIRST: usize = 3;

/// Outcomes of runs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Census {
    /// All runs of the study.
    pub planned: u64,
    /// Runs that reached their end time.
    pub completed: u64,
    /// Runs whose integration failed.
    pub failed: u64,
    /// Runs whose scenario was refused.
    pub refused: u64,
    /// Runs that the study's constraints leave out.
    pub excluded: u64,
    /// Runs on which the program broke off.
    pub broken: u64,
    /// Completed runs with a lost energy balance, whose figures are invalid.
    pub doubtful: u64,
    /// The first incomplete runs, with reasons.
    pub first: Vec<(u64, String)>,
    /// Reasons of incomplete runs: text, number, first run.
    pub reasons: Vec<(String, u64, u64)>,
    /// Caveats of completed runs: number of runs, and the first.
    pub caveats: BTreeMap<String, (u64, u64)>,
    /// Number of runs with further reasons.
    pub other_reasons: u64,
}

impl Census {
    /// Nothing counted yet.
    pub fn new(manifest: &Manifest) -> Self {
        Census { planned: manifest.samples, ..Census::default() }
    }

    /// Number of runs that have ended or are left out.
    pub fn finished(&self) -> u64 {
        self.begun() + self.excluded
    }

    /// Number of ended runs, without those that are left out.
    pub fn begun(&self) -> u64 {
        self.completed + self.failed + self.refused + self.broken
    }

    /// Number of ended runs without valid figures.
    pub fn without_figures(&self) -> u64 {
        self.begun() - self.completed + self.doubtful
    }

    /// Counts a run; whether its figures are valid.
    pub fn see(&mut self, row: &Row) -> bool {
        *match row.status {
            Status::Completed => &mut self.completed,
            Status::Failed => &mut self.failed,
            Status::Refused => &mut self.refused,
            Status::Excluded => &mut self.excluded,
            Status::Broken => &mut self.broken,
        } += 1;
        if row.status != Status::Completed {
            if row.status != Status::Excluded {
                self.remember(row);
            }
            return false;
        }
        let mut counts = true;
        for caveat in row.caveats().filter(|caveat| !caveat.is_note()) {
            counts &= caveat.name != Caveat::BALANCE_LOST;
            let (count, first) = self.caveats.entry(caveat.name).or_insert((0, row.index));
            (*count, *first) = (*count + 1, row.index.min(*first));
        }
        self.doubtful += u64::from(!counts);
        counts
    }

    /// A line for each caveat.
    pub fn caveats(&self) -> impl Iterator<Item = String> {
        let line = |(name, (count, first)): (&String, &(u64, u64))| {
            format!("{name}: {count} of {} runs, first in sample {first}", self.completed)
        };
        self.caveats.iter().map(line)
    }

    fn remember(&mut self, row: &Row) {
        if self.first.len() < FIRST {
            self.first.push((row.index, row.reason.clone()));
        }
        self.count_reason(&row.reason, 1, row.index);
    }

    fn count_reason(&mut self, reason: &str, count: u64, first: u64) {
        let known = self.reasons.iter().position(|r| r.0 == reason);
        match known {
            Some(at) => self.reasons[at].1 += count,
            None if self.reasons.len() < REASONS => self.reasons.push((reason.to_owned(), count, first)),
            None => self.other_reasons += count,
        }
    }

    /// Adds the outcomes of later runs.
    pub fn add(&mut self, later: &Census) {
        self.completed += later.completed;
        self.failed += later.failed;
        self.refused += later.refused;
        self.excluded += later.excluded;
        self.broken += later.broken;
        self.doubtful += later.doubtful;
        self.other_reasons += later.other_reasons;
        let room = FIRST.saturating_sub(self.first.len());
        self.first.extend(later.first.iter().take(room).cloned());
        for (reason, count, first) in &later.reasons {
            self.count_reason(reason, *count, *first);
        }
        for (name, (count, first)) in &later.caveats {
            let known = self.caveats.entry(name.clone()).or_insert((0, *first));
            *known = (known.0 + count, known.1.min(*first));
        }
    }
}

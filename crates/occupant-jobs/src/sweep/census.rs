//! How the runs of a study ended, and of which the figures count.

use std::collections::BTreeMap;

use occupant_core::results::summary::Caveat;

use crate::files::study_folder::{Manifest, Row, Status};

/// So many different reasons are remembered.
const REASONS: usize = 12;
/// So many runs are remembered with their reasons.
const FIRST: usize = 3;

/// How runs ended.
#[derive(Clone, Debug, Default)]
pub struct Census {
    /// All runs of the study.
    pub planned: u64,
    /// Runs at their end time.
    pub completed: u64,
    /// Runs whose integration failed.
    pub failed: u64,
    /// Runs whose scenario is refused.
    pub refused: u64,
    /// Runs on which the program broke off.
    pub broken: u64,
    /// Completed runs whose energy balance is lost: their figures count for nothing.
    pub doubtful: u64,
    /// The first runs that did not complete, and why.
    pub first: Vec<(u64, String)>,
    /// Reasons of runs that did not complete: words, how many, the first run.
    pub reasons: Vec<(String, u64, u64)>,
    /// Caveats on figures of completed runs: how many runs have each, and the first.
    pub caveats: BTreeMap<String, (u64, u64)>,
    /// Runs with other reasons still.
    pub other_reasons: u64,
}

impl Census {
    /// Nothing counted yet.
    pub fn new(manifest: &Manifest) -> Self {
        Census { planned: manifest.samples, ..Census::default() }
    }

    /// Runs that have ended, however.
    pub fn finished(&self) -> u64 {
        self.completed + self.failed + self.refused + self.broken
    }

    /// Finished runs without figures that count.
    pub fn without_figures(&self) -> u64 {
        self.finished() - self.completed + self.doubtful
    }

    /// Counts a run; whether its figures count.
    pub fn see(&mut self, row: &Row) -> bool {
        *match row.status {
            Status::Completed => &mut self.completed,
            Status::Failed => &mut self.failed,
            Status::Refused => &mut self.refused,
            Status::Broken => &mut self.broken,
        } += 1;
        if row.status != Status::Completed {
            self.remember(row);
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
            format!("{name}: {count} of {} runs, the first is {first}", self.completed)
        };
        self.caveats.iter().map(line)
    }

    fn remember(&mut self, row: &Row) {
        if self.first.len() < FIRST {
            self.first.push((row.index, row.reason.clone()));
        }
        let known = self.reasons.iter().position(|r| r.0 == row.reason);
        match known {
            Some(at) => self.reasons[at].1 += 1,
            None if self.reasons.len() < REASONS => self.reasons.push((row.reason.clone(), 1, row.index)),
            None => self.other_reasons += 1,
        }
    }
}

//! What a sweep came to: how its samples ended, and which of them are the worst.

use occupant_study::ending::Balance;

use super::worst::Worst;
use crate::files::study_folder::manifest::{Column, Manifest, Role};
use crate::files::study_folder::row::{Row, Status};

/// So many reasons are told.
const TOLD: usize = 3;

/// Counts how samples ended.
#[derive(Clone, Debug, Default)]
pub(crate) struct Census {
    /// Samples at their end time.
    pub(crate) completed: u64,
    /// Samples whose integration failed.
    pub(crate) failed: u64,
    /// Samples whose scenario is refused.
    pub(crate) refused: u64,
    /// Samples on which the program broke off.
    pub(crate) broken: u64,
    /// Completed samples whose energy balance is off by more than a tenth.
    pub(crate) unbalanced: u64,
    /// The first samples that did not complete, and why.
    pub(crate) reasons: Vec<(u64, String)>,
    balance: Option<usize>,
    worst: Option<(usize, Worst)>,
}

impl Census {
    pub(crate) fn new(manifest: &Manifest) -> Self {
        Census { balance: column(manifest, "energy.balance_error"), ..Census::default() }
    }

    /// Looks for the `count` worst by a figure too; false if there is no such figure.
    pub(crate) fn look_for(&mut self, manifest: &Manifest, count: usize, figure: &str) -> bool {
        let column = column(manifest, figure);
        self.worst = column.map(|c| (c, Worst::new(count)));
        column.is_some()
    }

    /// The worst, if they were looked for.
    pub(crate) fn worst(&self) -> Vec<u64> {
        let worst = self.worst.as_ref();
        worst.map(|(_, worst)| worst.indices()).unwrap_or_default()
    }

    pub(crate) fn see(&mut self, row: &Row) {
        *match row.status {
            Status::Completed => &mut self.completed,
            Status::Failed => &mut self.failed,
            Status::Refused => &mut self.refused,
            Status::Broken => &mut self.broken,
        } += 1;
        if row.status != Status::Completed {
            if self.reasons.len() < TOLD {
                self.reasons.push((row.index, row.reason.clone()));
            }
            return;
        }
        let value = |column: usize| row.cells.get(column).and_then(|cell| cell.number());
        if self.balance.and_then(value).is_some_and(|e| Balance::of(e) == Balance::Lost) {
            self.unbalanced += 1;
        }
        if let Some((column, worst)) = &mut self.worst
            && let Some(value) = value(*column)
        {
            worst.see(value, row.index);
        }
    }
}

/// Where a figure stands.
fn column(manifest: &Manifest, figure: &str) -> Option<usize> {
    let ours = |c: &Column| c.role == Role::Figure && c.name == figure;
    manifest.columns.iter().position(ours)
}

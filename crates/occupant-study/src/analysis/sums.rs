//! Sums over the rows of a stream, from which an analysis follows without the rows.
//!
//! Rows are divided into groups. The bootstrap draws groups instead of rows: its intervals are those of the rows, with an
//! uncertainty of their own of 1/√(2·63), 9 %, for [`GROUPS`] groups.

use super::{Estimate, bootstrap};
use crate::random::{Purpose, bits};

/// Number of groups of a long stream.
const GROUPS: usize = 64;

/// Groups of sums.
#[derive(Clone, Debug)]
pub(super) struct Sums {
    /// Number of sums.
    len: usize,
    /// By group; with one row a group, as many as rows.
    pub(super) groups: Vec<Vec<f64>>,
    by: Grouping,
}

/// How the rows of a stream are divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grouping {
    /// Each is a group of its own: a bootstrap of rows, in memory that grows with them.
    Rows,
    /// At random into a fixed number of groups, by this seed.
    Groups(u64),
}

impl Sums {
    /// No rows yet.
    pub(super) fn new(len: usize, by: Grouping) -> Self {
        let groups = match by {
            Grouping::Rows => Vec::new(),
            Grouping::Groups(_) => vec![vec![0.0; len]; GROUPS],
        };
        Sums { len, groups, by }
    }

    /// The sums that a row with this index is added to.
    pub(super) fn of_row(&mut self, index: u64) -> &mut [f64] {
        let at = match self.by {
            Grouping::Rows => {
                self.groups.push(vec![0.0; self.len]);
                self.groups.len() - 1
            }
            Grouping::Groups(seed) => (bits(seed, Purpose::Bootstrap, index, u32::MAX, 0) % GROUPS as u64) as usize,
        };
        &mut self.groups[at]
    }

    /// Sums of these groups.
    fn of(&self, groups: &[usize]) -> Vec<f64> {
        let mut all = vec![0.0; self.len];
        for group in groups {
            all.iter_mut().zip(&self.groups[*group]).for_each(|(all, one)| *all += one);
        }
        all
    }

    /// Sums of all rows.
    pub(super) fn total(&self) -> Vec<f64> {
        self.of(&(0..self.groups.len()).collect::<Vec<_>>())
    }

    /// The 95 % intervals of `count` statistics, computed from sums.
    pub(super) fn intervals(&self, seed: u64, count: usize, of: impl Fn(&[f64]) -> Vec<f64>) -> Vec<Estimate> {
        bootstrap::intervals(seed, self.groups.len(), count, |groups| of(&self.of(groups)))
    }
}

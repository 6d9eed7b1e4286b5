//! Trajectories for Morris's screening.
//!
//! M. D. Morris, "Factorial sampling plans for preliminary computational experiments", Technometrics 33 (1991), 161–174:
//! each range is cut into p levels, p even; a step is Δ = p/(2(p − 1)). A trajectory starts at random levels and changes
//! one parameter at a time, each once, in a random order, up or down by Δ.

use super::permutation::permute;
use super::random::{Purpose, bits};

/// One trajectory.
pub(super) struct Trajectory {
    pub number: u64,
    parameters: usize,
    levels: u64,
    seed: u64,
}

impl Trajectory {
    /// The trajectory of a sample, and the number of its steps made so far.
    pub(super) fn of_sample(index: u64, parameters: usize, levels: u64, seed: u64) -> (Self, usize) {
        let len = parameters as u64 + 1;
        (Trajectory { number: index / len, parameters, levels, seed }, (index % len) as usize)
    }

    /// The step that changes a parameter, from 0.
    fn turn(&self, parameter: usize) -> usize {
        // one seed for each trajectory, as the permutation has no index of its own
        let seed = bits(self.seed, Purpose::Morris, self.number, u32::MAX, 1);
        permute(parameter as u64, self.parameters as u64, seed, 0) as usize
    }

    /// The parameter changed by the last of this many steps, and the change.
    pub(super) fn change(&self, steps: usize) -> Option<(usize, f64)> {
        let before = steps.checked_sub(1)?;
        let changed = (0..self.parameters).find(|d| self.turn(*d) == before)?;
        Some((changed, self.coordinate(changed, steps) - self.coordinate(changed, before)))
    }

    /// Coordinate of a parameter in [0, 1] after this many steps.
    pub(super) fn coordinate(&self, parameter: usize, steps: usize) -> f64 {
        let draw = bits(self.seed, Purpose::Morris, self.number, parameter as u32, 0);
        let half = self.levels / 2;
        // the lower end of the change lies in the lower half of the levels; the bias of % is below levels/2⁶²
        let low = (draw >> 1) % half;
        let starts_high = draw & 1 == 1;
        let changed = self.turn(parameter) < steps;
        let level = if starts_high != changed { low + half } else { low };
        level as f64 / (self.levels - 1) as f64
    }
}

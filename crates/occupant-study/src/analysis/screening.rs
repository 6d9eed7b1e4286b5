//! Morris's screening: elementary effects along trajectories.
//!
//! The effect of a parameter at one place is the change of the figure over the change of the parameter in units of its
//! range. With r trajectories: μ the mean effect, μ* the mean of its magnitude (F. Campolongo et al., Environ. Model.
//! Softw. 22 (2007)), σ the standard deviation. A large μ* means that the parameter matters; a large σ as well means
//! interaction or nonlinearity.

use super::sums::{Grouping, Sums};
use super::{AnalysisError, Estimate};

/// Smallest number of trajectories for an effect.
const LEAST_TRAJECTORIES: usize = 4;

/// The effects of one parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effect {
    /// μ, in the figure's unit for the whole range of the parameter.
    pub mean: Estimate,
    /// μ*.
    pub mean_magnitude: Estimate,
    /// σ.
    pub deviation: f64,
    /// Number of effects used.
    pub effects: usize,
    /// Effects left out because a run has no such figure.
    pub dropped: usize,
}

/// The effects of every parameter. `effects[i]` holds those of parameter i, one for each trajectory: change of the figure
/// over change of the parameter as a part of its range; NaN where a run failed.
///
/// # Errors
/// Fewer than 4 effects of a parameter.
pub fn screening(effects: &[Vec<f64>], seed: u64) -> Result<Vec<Effect>, AnalysisError> {
    let sums_of = |all: &Vec<f64>| {
        let mut sums = EffectSums::new(Grouping::Rows);
        all.iter().for_each(|effect| sums.see(0, *effect));
        sums
    };
    effects.iter().map(|all| sums_of(all).effect(seed)).collect()
}

/// Sums over the effects of one parameter: memory does not grow with them if they are grouped.
#[derive(Clone, Debug)]
pub struct EffectSums {
    /// Count, Σe, Σ|e|, Σ(e − e₁)², Σ(e − e₁), with e₁ the first effect, so that no digits are lost.
    sums: Sums,
    first: Option<f64>,
    effects: usize,
    dropped: usize,
}

impl EffectSums {
    /// No effects yet.
    pub fn new(by: Grouping) -> Self {
        EffectSums { sums: Sums::new(5, by), first: None, effects: 0, dropped: 0 }
    }

    /// Adds the effect along a trajectory; one that is not finite is left out and counted.
    pub fn see(&mut self, trajectory: u64, effect: f64) {
        if !effect.is_finite() {
            self.dropped += 1;
            return;
        }
        self.effects += 1;
        let from_first = effect - *self.first.get_or_insert(effect);
        let terms = [1.0, effect, effect.abs(), from_first * from_first, from_first];
        self.sums.of_row(trajectory).iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
    }

    /// The effect of the parameter.
    ///
    /// # Errors
    /// Fewer than 4 effects.
    pub fn effect(&self, seed: u64) -> Result<Effect, AnalysisError> {
        let found = self.effects;
        if found < LEAST_TRAJECTORIES {
            return Err(AnalysisError::TooFew { found, needed: LEAST_TRAJECTORIES });
        }
        let both = self.sums.intervals(seed, 2, |sums| vec![sums[1] / sums[0], sums[2] / sums[0]]);
        let total = self.sums.total();
        let squares = total[3] - total[4] * total[4] / total[0];
        Ok(Effect {
            mean: both[0],
            mean_magnitude: both[1],
            deviation: (squares.max(0.0) / (total[0] - 1.0)).sqrt(),
            effects: found,
            dropped: self.dropped,
        })
    }
}

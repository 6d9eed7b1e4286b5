//! Morris's screening: elementary effects along trajectories.
//!
//! The effect of a parameter at one place is the change of the figure over the change of the parameter in units of its
//! range. With r trajectories: μ the mean effect, μ* the mean of its magnitude (F. Campolongo et al., Environ. Model.
//! Softw. 22 (2007)), σ the standard deviation. A large μ* means that the parameter matters; a large σ as well means
//! interaction or nonlinearity.

use super::{AnalysisError, Estimate, bootstrap, deviation};

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
    effects.iter().map(|all| effect(all, seed)).collect()
}

fn effect(all: &[f64], seed: u64) -> Result<Effect, AnalysisError> {
    let effects: Vec<f64> = all.iter().copied().filter(|e| e.is_finite()).collect();
    let found = effects.len();
    if found < LEAST_TRAJECTORIES {
        return Err(AnalysisError::TooFew { found, needed: LEAST_TRAJECTORIES });
    }
    let of = |rows: &[usize]| {
        let count = rows.len() as f64;
        let sum: f64 = rows.iter().map(|&r| effects[r]).sum();
        let magnitudes: f64 = rows.iter().map(|&r| effects[r].abs()).sum();
        vec![sum / count, magnitudes / count]
    };
    let both = bootstrap::intervals(seed, found, 2, of);
    Ok(Effect {
        mean: both[0],
        mean_magnitude: both[1],
        deviation: deviation(&effects),
        effects: found,
        dropped: all.len() - found,
    })
}

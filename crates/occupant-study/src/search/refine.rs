//! Local refinement to the minimum: quadratic models through ever closer points, and a step to the minimum of each.
//!
//! Only evaluated values count, never the model's prediction: a point is accepted only if it is lower.

use super::quadratic::{explore, lowest_step};
use super::{Evaluate, Point, Stage, evaluated};

const ROUNDS: usize = 12;
/// Factor by which points move closer after a round of little gain.
const CLOSER: f64 = 4.0;
const CLOSEST: f64 = 1.0 / 300.0;
/// Gain, as a fraction of the rise, that counts as little.
const LITTLE: f64 = 1e-3;
/// Fractions of the step to the minimum that are tried.
const PARTS: [f64; 4] = [0.3, 1.0, 1.7, 3.0];

/// Moves from `centre` to the local minimum. `lengths` are the distances at which each coordinate alone raises the
/// value by `rise`; a missing length is that of the cube.
///
/// # Errors
/// An error of `evaluate`.
pub fn refine<E>(centre: Point, lengths: &[f64], rise: f64, evaluate: &mut Evaluate<'_, E>) -> Result<Point, E> {
    let all: Vec<usize> = (0..centre.at.len()).collect();
    let lengths: Vec<f64> = all.iter().map(|i| lengths.get(*i).copied().unwrap_or(1.0)).collect();
    let mut best = centre.in_cube();
    let mut scale = 1.0;
    for _ in 0..ROUNDS {
        let near: Vec<f64> = lengths.iter().map(|l| (l * scale).max(1e-9)).collect();
        let before = best.value;
        let (bowl, met) = explore(Stage::Refinement, &best, &near, &all, evaluate)?;
        // in units of `near` a rise of scale² · rise is that of a bowl
        let curvature = bowl.rising(&near, 1e-3 * scale * scale * rise);
        let slope: Vec<f64> = (0..all.len()).map(|i| bowl.slope[i] * near[i]).collect();
        let walls: Vec<[f64; 2]> = (0..all.len())
            .map(|i| {
                let wall = |side: f64| (side - best.at[i]) / near[i];
                [wall(0.0).max(-3.0), wall(1.0).min(3.0)]
            })
            .collect();
        let step = lowest_step(&slope, &curvature, &walls);
        let along = |part: f64| -> Vec<f64> {
            let moved = |i: usize| (best.at[i] + part * step[i] * near[i]).clamp(0.0, 1.0);
            (0..all.len()).map(moved).collect()
        };
        let tried = PARTS.map(along).to_vec();
        let tried = evaluated(Stage::Refinement, tried, evaluate)?;
        best = met.into_iter().chain(tried).fold(best, Point::lower);
        if before - best.value < LITTLE * rise {
            scale /= CLOSER;
            if scale < CLOSEST {
                break;
            }
        }
    }
    Ok(best)
}

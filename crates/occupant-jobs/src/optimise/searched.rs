//! The search from its first candidate to the neighbours of the best.

use occupant_study::Optimise;
use occupant_study::search::{Descents, Found, Rank, Stage, Trial, lower, search_within};

use super::Optimising;
use crate::base::Failure;
use crate::search::{Evaluator, Objective, Record};

/// Distance of a neighbour that is reported, as a fraction of the range.
pub const STEP: f64 = 0.02;
/// The same while the search still moves to better ones.
const STEPS: [f64; 3] = [0.02, 0.005, 0.00125];
/// Number of times that all neighbours are looked at, if each time one is better.
const LOOKS: u64 = 8;
/// One of this many candidates is kept for them at most.
const KEPT: u64 = 4;

/// Largest number of candidates of a search, with the base scenario.
pub fn most_candidates(optimise: &Optimise) -> u64 {
    // at least one generation is computed
    1 + optimise.budget.max(optimise.population as u64)
}

/// Candidates kept for the neighbours in `n` parameters.
fn kept(budget: u64, n: usize) -> u64 {
    (LOOKS * 2 * n as u64).min(budget / KEPT)
}

/// The best candidate and its neighbours.
pub struct Answer {
    /// The base scenario.
    pub before: Record,
    /// The best candidate, what it shows, and all others of the search.
    pub found: Found,
    /// What the neighbours below and above in each parameter show, none beyond a bound; nothing if the budget ended while a
    /// neighbour was still better.
    pub neighbours: Option<Vec<[Option<Trial>; 2]>>,
}

/// Searches, and looks at both neighbours in each parameter until none is better.
///
/// # Errors
/// A signal, a full disk, an optimisation in which no candidate could be run.
pub fn search(of: &Optimising, evaluator: &mut Evaluator<'_, Optimising>) -> Result<Answer, Failure> {
    let before = evaluator.base()?;
    let how = Descents {
        start: of.start(),
        next: Vec::new(),
        seed: of.optimise.seed,
        evaluations: of.optimise.budget - kept(of.optimise.budget, of.bounds.len()),
        population: of.optimise.population,
        tolerance: of.optimise.tolerance,
    };
    let mut evaluate = |stage: Stage, points: &[Vec<f64>]| -> Result<Vec<Trial>, Failure> {
        let from = evaluator.records.len();
        evaluator.scores(stage, points)?;
        Ok(evaluator.records[from..].iter().map(|record| of.trial(record)).collect())
    };
    let mut found = search_within(&how, of.optimise.front, &mut evaluate)?;
    let mut best = (found.point, found.trial);
    let mut left = of.optimise.budget.saturating_sub(found.tried.points.len() as u64);
    let mut looks = STEPS.iter().copied().chain([STEP]).peekable();
    let neighbours = loop {
        let (centre, step) = (best.0.clone(), looks.peek().copied().unwrap_or(STEP));
        let places = around(&centre.at, step);
        let points: Vec<Vec<f64>> = places.iter().flatten().flatten().cloned().collect();
        let Some(rest) = left.checked_sub(points.len() as u64) else { break None };
        left = rest;
        let trials = evaluate(Stage::Scan, &points)?;
        lower(&mut best, &points, &trials);
        // the last look shows the neighbours of what is reported
        if best.0 == centre {
            _ = looks.next();
            if looks.peek().is_none() {
                let mut trials = trials.into_iter();
                let mut shown = |place: &Option<Vec<f64>>| place.as_ref().and_then(|_| trials.next());
                break Some(places.iter().map(|[below, above]| [shown(below), shown(above)]).collect());
            }
        }
    };
    (found.point, found.trial) = best;
    if let Rank::Failed = found.trial.rank() {
        return Err(evaluator.none_could_be_run());
    }
    Ok(Answer { before, found, neighbours })
}

/// The neighbours of a point below and above in each coordinate, this far away; none beyond a bound.
fn around(at: &[f64], step: f64) -> Vec<[Option<Vec<f64>>; 2]> {
    let neighbour = |i: usize, step: f64| {
        let u = (at[i] + step).clamp(0.0, 1.0);
        (u != at[i]).then(|| at.iter().enumerate().map(|(j, x)| if i == j { u } else { *x }).collect())
    };
    (0..at.len()).map(|i| [neighbour(i, -step), neighbour(i, step)]).collect()
}

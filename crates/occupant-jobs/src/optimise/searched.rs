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
/// Gain of the goal, as a fraction, below which a neighbour is as good.
const TINY: f64 = 1e-6;
/// Part of the distance below which a neighbour is the same candidate.
const NEAR: f64 = 0.01;
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
    /// What the neighbours below and above in each parameter show, none beyond a bound; nothing if the budget ended before all
    /// were seen.
    pub neighbours: Option<Neighbours>,
    /// Whether one of the last neighbours seen was still better.
    pub is_moving: bool,
}

/// By parameter: what the neighbours below and above show; none beyond a bound.
pub type Neighbours = Vec<[Option<Trial>; 2]>;

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
    let (mut steps, mut is_moving) = (STEPS.iter().copied(), false);
    let mut step = steps.next();
    // the last look at the reported distance, and what its centre shows
    let mut seen: Option<(Trial, Neighbours)> = None;
    let is_of = |seen: &Option<(Trial, Neighbours)>, best: &Trial| {
        seen.as_ref().is_some_and(|(centre, _)| !is_better(best, centre))
    };
    while let Some(now) = step.or_else(|| (!is_of(&seen, &best.1)).then_some(STEP)) {
        let centre = best.clone();
        let places = around(&centre.0.at, now);
        let points: Vec<Vec<f64>> = places.iter().flatten().flatten().cloned().collect();
        let Some(rest) = left.checked_sub(points.len() as u64) else { break };
        left = rest;
        let trials = evaluate(Stage::Scan, &points)?;
        lower(&mut best, &points, &trials);
        is_moving = is_better(&best.1, &centre.1);
        if now == STEP {
            let mut trials = trials.into_iter();
            let mut shown = |place: &Option<Vec<f64>>| place.as_ref().and_then(|_| trials.next());
            let all = places.iter().map(|[below, above]| [shown(below), shown(above)]).collect();
            seen = Some((centre.1, all));
        }
        if !is_moving {
            step = steps.next();
        }
    }
    let neighbours = if is_of(&seen, &best.1) { seen.map(|(_, all)| all) } else { None };
    (found.point, found.trial) = best;
    if let Rank::Failed = found.trial.rank() {
        return Err(evaluator.none_could_be_run());
    }
    Ok(Answer { before, found, neighbours, is_moving })
}

/// Whether a trial is better than another by more than nothing.
fn is_better(one: &Trial, other: &Trial) -> bool {
    match (one.rank(), other.rank()) {
        (Rank::Allowed(one), Rank::Allowed(other)) => other - one > TINY * other.abs().max(one.abs()),
        (one, other) => one < other,
    }
}

/// The neighbours of a point below and above in each coordinate, this far away; none beyond a bound.
fn around(at: &[f64], step: f64) -> Vec<[Option<Vec<f64>>; 2]> {
    let neighbour = |i: usize, step: f64| {
        let u = (at[i] + step).clamp(0.0, 1.0);
        // a bound that is reached but for rounding has nothing beyond
        ((u - at[i]).abs() > NEAR * step.abs())
            .then(|| at.iter().enumerate().map(|(j, x)| if i == j { u } else { *x }).collect())
    };
    (0..at.len()).map(|i| [neighbour(i, -step), neighbour(i, step)]).collect()
}

//! The search from its first candidate to the intervals of the parameters.

use occupant_study::Misfit;
use occupant_study::misfit::{likelihood_rise, unrelated_samples};
use occupant_study::search::{Descents, Global, Point, Profiles, Reach, Shape, Stage, descend, profile, refine, scan};
use serde::Serialize;

use super::{Evaluator, Fitting, Record, WORST};
use crate::base::Failure;

/// Scores that differ by less are the same where a study says nothing, the likelihood of "rms" apart.
const SAME: f64 = 0.01;
/// Root mean square differences below this part of the peak are none.
const NONE: f64 = 5e-4;
/// How often a lower point that was met on the way to an interval begins everything after the descents anew.
const ANEW: usize = 3;
/// A lower point counts as such by this part of the rise.
const LOWER: f64 = 0.05;

/// The best parameters and how well they are determined. Costs are [`Misfit::cost`] of scores.
pub struct Answer {
    /// The base scenario.
    pub before: Record,
    /// The descents.
    pub global: Global,
    /// The best point; its value is a cost.
    pub best: Point,
    /// By how much the cost rises to where sets count as worse.
    pub rise: f64,
    /// How near it lies to its bounds.
    pub near: Near,
    /// How far each parameter can go alone.
    pub reaches: Vec<[Reach; 2]>,
    /// Curvature and correlations.
    pub shape: Shape,
    /// The ends of the intervals.
    pub profiles: Profiles,
}

/// What says which sets are as good as the best.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Near {
    /// Of what.
    pub by: &'static str,
    /// Residuals that are unrelated, where the likelihood says so.
    pub unrelated_residuals: Option<f64>,
}

/// Searches, refines, and looks how well the answer is determined.
///
/// # Errors
/// A signal, a full disk, a fit in which no candidate could be run.
pub fn search(fitting: &Fitting, evaluator: &mut Evaluator<'_>) -> Result<Answer, Failure> {
    let before = evaluator.base()?;
    let global = descents(fitting, evaluator)?;
    let misfit = fitting.fit.misfit;
    let mut costs = |stage: Stage, points: &[Vec<f64>]| -> Result<Vec<f64>, Failure> {
        Ok(evaluator.scores(stage, points)?.into_iter().map(|score| misfit.cost(score)).collect())
    };
    let mut best = Point { at: global.best.at.clone(), value: misfit.cost(global.best.value) };
    let mut anew = 0;
    loop {
        let (rise, _) = rise(fitting, &best)?;
        let (reaches, lowest) = scan(&best, rise, &mut costs)?;
        let lengths: Vec<f64> = reaches.iter().map(|[a, b]| a.length.max(b.length)).collect();
        best = refine(lowest, &lengths, rise, &mut costs)?;
        let (rise, near) = self::rise(fitting, &best)?;
        let (reaches, scanned) = scan(&best, rise, &mut costs)?;
        let (shape, looked) = Shape::look(&best, &reaches, rise, &mut costs)?;
        let profiles = profile(&best, &reaches, &shape, rise, &mut costs)?;
        let lowest = [scanned, looked, profiles.lowest.clone()];
        let lowest = lowest.into_iter().min_by(|a, b| a.value.total_cmp(&b.value));
        anew += 1;
        match lowest {
            Some(lower) if anew < ANEW && best.value - lower.value > LOWER * rise => best = lower,
            _ => {
                return Ok(Answer { before, global, best, rise, near, reaches, shape, profiles });
            }
        }
    }
}

/// The global search.
fn descents(fitting: &Fitting, evaluator: &mut Evaluator<'_>) -> Result<Global, Failure> {
    let fit = &fitting.fit;
    let how = Descents {
        start: fitting.start(),
        seed: fit.seed,
        evaluations: fit.budget,
        population: fit.population,
        tolerance: fit.tolerance,
    };
    let global = descend(&how, &mut |stage: Stage, points: &[Vec<f64>]| evaluator.scores(stage, points))?;
    if global.best.value < WORST {
        return Ok(global);
    }
    let reason = evaluator.records.iter().rev().find_map(|r| r.reason.clone()).unwrap_or_default();
    Err(Failure::broke_off(format!(
        "none of {} candidates could be run; the last one: {reason}\n = help: narrow the parameter ranges, and try the base scenario with `occupant run`",
        evaluator.records.len()
    )))
}

/// By how much the cost of the best point may rise until a set counts as worse.
fn rise(fitting: &Fitting, best: &Point) -> Result<(f64, Near), Failure> {
    let misfit = fitting.fit.misfit;
    let score = misfit.of_cost(best.value);
    // never nothing, however small `near` is beside the score
    let above = |near: f64| (misfit.cost(score + near) - misfit.cost(score)).max(1e-12 * (1.0 + best.value));
    let near = |rise: f64, by, unrelated_residuals| Ok((rise, Near { by, unrelated_residuals }));
    if let Some(given) = fitting.fit.near {
        return near(above(given), "the study", None);
    }
    if misfit != Misfit::Rms {
        return near(above(SAME), "scores that differ by less than 0.01", None);
    }
    let values = fitting.values(&best.at);
    let mut unrelated = 0.0;
    for experiment in &fitting.experiments {
        let run = experiment.run_with(Some(&values));
        let residuals = run.and_then(|series| experiment.residuals(&series, &fitting.corrections(Some(&values))));
        let again = |reason| Failure::broke_off(format!("the best candidate cannot be run again: {reason}"));
        let residuals = residuals.map_err(again)?;
        unrelated += residuals.iter().map(|r| unrelated_samples(r)).sum::<f64>();
    }
    let likely = likelihood_rise(best.value, unrelated);
    let least = NONE * NONE;
    if likely > least {
        return near(likely, "95 % likelihood of the residuals", Some(unrelated));
    }
    near(least, "0.05 % of the measured peaks, because the residuals are smaller", None)
}

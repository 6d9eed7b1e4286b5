//! The search from its first candidate to the intervals of the parameters.

use occupant_study::Misfit;
use occupant_study::misfit::{likelihood_rise, unrelated_samples};
use occupant_study::search::{Descents, Global, Point, Profiles, Reach, Shape, Stage, descend, profile, refine, scan};
use serde::Serialize;

use super::{Evaluator, Fitting, Objective, Record, WORST};
use crate::base::Failure;

/// Difference of scores that counts as equal by default, except for the likelihood of "rms".
const SAME: f64 = 0.01;
/// RMS difference, relative to the peak, that counts as zero.
const NONE: f64 = 5e-4;
/// Largest number of restarts after the descents because a lower point was found.
const ANEW: usize = 3;
/// Least improvement of a lower point, relative to the rise.
const LOWER: f64 = 0.05;

/// The best parameters and how well they are determined. Costs are [`Misfit::cost`] of scores.
pub struct Answer {
    /// The base scenario.
    pub before: Record,
    /// The descents.
    pub global: Global,
    /// The best point; its value is a cost.
    pub best: Point,
    /// Rise of the cost up to which sets count as equally good.
    pub rise: f64,
    /// Definition of equally good sets.
    pub near: Near,
    /// Reach of each parameter alone.
    pub reaches: Vec<[Reach; 2]>,
    /// Curvature and correlations.
    pub shape: Shape,
    /// The ends of the intervals.
    pub profiles: Profiles,
}

/// Criterion for equally good sets.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Near {
    /// Name of the criterion.
    pub by: &'static str,
    /// Number of independent residuals, for the likelihood criterion.
    pub unrelated_residuals: Option<f64>,
}

/// Searches, refines, and determines the uncertainty of the result.
///
/// # Errors
/// A signal, a full disk, a fit in which no candidate could be run.
pub fn search(fitting: &Fitting, evaluator: &mut Evaluator<'_, Fitting>) -> Result<Answer, Failure> {
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
fn descents(fitting: &Fitting, evaluator: &mut Evaluator<'_, Fitting>) -> Result<Global, Failure> {
    let fit = &fitting.fit;
    let how = Descents {
        start: fitting.start(),
        next: Vec::new(),
        seed: fit.seed,
        evaluations: fit.budget,
        population: fit.population,
        tolerance: fit.tolerance,
    };
    let global = descend(&how, &mut |stage: Stage, points: &[Vec<f64>]| evaluator.scores(stage, points))?;
    if global.best.value < WORST { Ok(global) } else { Err(evaluator.none_could_be_run()) }
}

/// Rise of the cost above the best point up to which sets count as equally good.
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

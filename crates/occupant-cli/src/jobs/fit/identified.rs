//! The search from its first candidate to the intervals of the parameters.

use occupant_core::model::Model;
use occupant_core::results::channel::Series;
use occupant_core::run::simulate::simulate;
use occupant_study::Misfit;
use occupant_study::ending::Ending;
use occupant_study::misfit::{likelihood_rise, unrelated_samples};
use occupant_study::search::{Descents, Global, Point, Profiles, Reach, Shape, Stage, descend, profile, refine, scan};

use super::evaluator::{Evaluator, Record, WORST};
use super::experiment::Experiment;
use super::fitting::Fitting;
use crate::base::failure::Failure;

/// Scores that differ by less are the same where a study says nothing, the likelihood of "rms" apart.
const SAME: f64 = 0.01;
/// Root mean square differences below this part of the peak are none.
const NONE: f64 = 5e-4;
/// How often a lower point that was met on the way to an interval begins everything after the descents anew.
const ANEW: usize = 3;
/// A lower point counts as such by this part of the rise.
const LOWER: f64 = 0.05;

/// The best parameters and how well they are determined. Costs are [`Misfit::cost`] of scores.
pub(crate) struct Answer {
    /// The base scenario.
    pub(crate) before: Record,
    /// The descents.
    pub(crate) global: Global,
    /// The best point; its value is a cost.
    pub(crate) best: Point,
    /// By how much the cost rises to where sets count as worse.
    pub(crate) rise: f64,
    pub(crate) near: Near,
    /// How far each parameter can go alone.
    pub(crate) reaches: Vec<[Reach; 2]>,
    /// Curvature and correlations.
    pub(crate) shape: Shape,
    /// The ends of the intervals.
    pub(crate) profiles: Profiles,
}

/// What says which sets are as good as the best.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Near {
    Study,
    /// The likelihood of the residuals, so many of which are unrelated.
    Likelihood {
        unrelated: f64,
    },
    /// Differences below 0.05 % of the peak, because the residuals are smaller still.
    Peak,
    /// Scores that differ by 0.01.
    Score,
}

/// Searches, refines, and looks how well the answer is determined.
///
/// # Errors
/// A signal, a full disk, a fit in which no candidate could be run.
pub(crate) fn search(fitting: &Fitting, evaluator: &mut Evaluator<'_>) -> Result<Answer, Failure> {
    evaluator.scores(None, vec![None])?;
    let before = evaluator.records[0].clone();
    let fit = &fitting.fit;
    let how = Descents {
        start: fitting.start(),
        seed: fit.seed,
        evaluations: fit.budget,
        population: fit.population,
        tolerance: fit.tolerance,
    };
    let mut scores =
        |stage: Stage, points: &[Vec<f64>]| evaluator.scores(Some(stage), points.iter().cloned().map(Some).collect());
    let global = descend(&how, &mut scores)?;
    if global.best.value >= WORST {
        let mut latest = evaluator.records.iter().rev();
        let reason = latest.find_map(|r| r.reason.clone()).unwrap_or_default();
        return Err(Failure::BrokeOff(format!(
            "error: none of {} candidates could be run; the last: {reason}\n = help: narrow the ranges of the parameters, or try the base scenario with `occupant run`",
            evaluator.records.len()
        )));
    }
    let misfit = fit.misfit;
    let mut costs = |stage: Stage, points: &[Vec<f64>]| -> Result<Vec<f64>, Failure> {
        let scores = evaluator.scores(Some(stage), points.iter().cloned().map(Some).collect())?;
        Ok(scores.into_iter().map(|s| misfit.cost(s)).collect())
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

/// By how much the cost of the best point may rise until a set counts as worse.
fn rise(fitting: &Fitting, best: &Point) -> Result<(f64, Near), Failure> {
    let misfit = fitting.fit.misfit;
    let score = misfit.of_cost(best.value);
    let above = |near: f64| misfit.cost(score + near) - misfit.cost(score);
    if let Some(near) = fitting.fit.near {
        return Ok((above(near), Near::Study));
    }
    if misfit != Misfit::Rms {
        return Ok((above(SAME), Near::Score));
    }
    let values = fitting.values(&best.at);
    let mut unrelated = 0.0;
    for experiment in &fitting.experiments {
        let residuals = run(experiment, Some(&values)).and_then(|s| experiment.residuals(&s));
        let residuals = residuals
            .map_err(|reason| Failure::BrokeOff(format!("error: the best candidate cannot be run again: {reason}")))?;
        unrelated += residuals.iter().map(|r| unrelated_samples(r)).sum::<f64>();
    }
    let likely = likelihood_rise(best.value, unrelated);
    let least = NONE * NONE;
    Ok(if likely > least { (likely, Near::Likelihood { unrelated }) } else { (least, Near::Peak) })
}

/// The recorded channels of an experiment with these parameters.
///
/// # Errors
/// A scenario that is refused, an integration that fails.
pub(crate) fn run(experiment: &Experiment, values: Option<&[f64]>) -> Result<Series, String> {
    let model = experiment.model_of(values).map_err(|e| e.to_string())?;
    run_model(experiment, &model)
}

/// The recorded channels of an experiment for a model of it.
///
/// # Errors
/// An integration that fails.
pub(crate) fn run_model(experiment: &Experiment, model: &Model) -> Result<Series, String> {
    let mut series = Series::new(experiment.recorded.clone());
    let outcome = simulate(model, &mut series).map_err(|e| e.to_string())?;
    match Ending::of(&outcome).and_then(|ending| ending.reason()) {
        None => Ok(series),
        Some(reason) => Err(reason),
    }
}

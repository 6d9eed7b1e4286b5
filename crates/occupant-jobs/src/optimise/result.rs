//! The result of an optimisation, in the form of optimum.json. Nothing in it depends on the day, the machine or the number
//! of threads.

use occupant_study::ApplyChoice;
use occupant_study::search::{Rank, Stage, Trial, front};
use serde::Serialize;

use super::optimising::base_name;
use super::searched::{Answer, STEP};
use super::{Measures, Optimising};
use crate::compare::Source;
use crate::fit::scenario_text::Fitted;
use crate::fit::verdict::shown_unit;
use crate::search::{Objective, Record};

/// Largest distance to a limit, as a fraction of it, that counts as active.
const ACTIVE: f64 = 0.01;
/// Number of best candidates listed.
const LISTED: usize = 10;

/// Content of optimum.json.
#[derive(Serialize)]
pub struct Optimum {
    /// The program that computed it.
    pub program: String,
    /// Title of the study.
    pub title: String,
    /// The study.
    pub study: Source,
    /// The scenario.
    pub scenario: String,
    /// Changes from the command line.
    pub overrides: Vec<String>,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Budget of the search, candidates.
    pub budget: u64,
    /// Runs per candidate, and the quantile that counts of several.
    pub members: u64,
    /// That quantile; none of a single run.
    pub quantile: Option<f64>,
    /// Whether the best candidate is within all limits and without caveats that matter.
    pub is_allowed: bool,
    /// Goal of the base scenario and of the best candidate.
    pub goal: Pair,
    /// The measures of the goal.
    pub goals: Vec<GoalPart>,
    /// The limits.
    pub constraints: Vec<LimitKept>,
    /// The parameters.
    pub parameters: Vec<Tuned>,
    /// The best candidates, the best first.
    pub best: Vec<Candidate>,
    /// The front between several goals, if the study asks for it: the allowed candidates than which no other is better in one goal
    /// and as good in all others, in the order of their first goals.
    pub front: Vec<Candidate>,
    /// Values in the scenario that is written.
    pub written: Vec<Fitted>,
    /// Numbers of candidates.
    pub candidates: Counts,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

/// A number before and after.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Pair {
    /// Of the base scenario; none if it could not be run.
    pub before: Option<f64>,
    /// Of the best candidate.
    pub after: f64,
}

/// A measure of the goal.
#[derive(Serialize)]
pub struct GoalPart {
    /// The measure, with the quantile of several members.
    pub measure: String,
    /// Its unit; numbers are in it.
    pub unit: &'static str,
    /// Whether it is maximised.
    pub is_maximised: bool,
    /// Weight.
    pub weight: f64,
    /// Divisor.
    pub per: f64,
    /// Its values.
    #[serde(flatten)]
    pub values: Pair,
}

/// A limit at the optimum.
#[derive(Serialize)]
pub struct LimitKept {
    /// The measure, with the quantile of several members.
    pub measure: String,
    /// Its unit; numbers are in it.
    pub unit: &'static str,
    /// Whether the limit is the least value allowed.
    pub is_floor: bool,
    /// The limit.
    pub limit: f64,
    /// Its values.
    #[serde(flatten)]
    pub values: Pair,
    /// Distance to the limit as a fraction of it; negative beyond.
    pub margin: f64,
    /// Whether the optimum is within 1 % of it.
    pub is_active: bool,
}

/// A parameter. Numbers are SI, angles in rad.
#[derive(Serialize)]
pub struct Tuned {
    /// Its name.
    pub name: String,
    /// SI unit; empty for factors and plain numbers.
    pub unit: &'static str,
    /// Display unit, and its SI value.
    #[serde(skip)]
    pub shown: (String, f64),
    /// How the number changes the scenario's value.
    pub apply: ApplyChoice,
    /// Paths that it changes.
    pub places: Vec<String>,
    /// Bounds of the search.
    pub bounds: [f64; 2],
    /// Whether the search was logarithmic.
    pub log: bool,
    /// The base scenario's value, if it is a single number.
    pub base: Option<f64>,
    /// The best value.
    pub value: f64,
    /// "lower" or "upper" at a bound.
    pub at_bound: Option<&'static str>,
    /// The neighbours 2 % of the range below and above; none beyond a bound.
    pub neighbours: [Option<Neighbour>; 2],
}

/// A neighbour of the optimum.
#[derive(Serialize)]
pub struct Neighbour {
    /// The parameter there.
    pub value: f64,
    /// The goal there; none if it could not be run.
    pub goal: Option<f64>,
    /// Measures whose limits it exceeds.
    pub beyond: Vec<String>,
    /// Whether it is refused for caveats.
    pub has_caveats: bool,
}

/// One of the best candidates.
#[derive(Clone, Serialize)]
pub struct Candidate {
    /// Its number in the history.
    pub index: usize,
    /// Goal.
    pub goal: f64,
    /// Parameters, SI, in their order.
    pub values: Vec<f64>,
    /// Values that count, in their units: those of `measures`.
    pub measures: Vec<f64>,
    /// Caveats that matter, and whether it is within all limits.
    pub caveats: String,
    /// Whether it is within all limits.
    pub is_within: bool,
}

/// Numbers of candidates.
#[derive(Default, Serialize)]
pub struct Counts {
    /// All, with the base scenario.
    pub all: usize,
    /// Of the search.
    pub search: usize,
    /// Neighbours of the best.
    pub neighbours: usize,
    /// That could not be run.
    pub failed: usize,
    /// With caveats that matter.
    pub with_caveats: usize,
    /// Beyond a limit.
    pub beyond: usize,
    /// Reason of the first that could not be run.
    pub reason: Option<String>,
    /// Caveats of the first that has some.
    pub caveats: Option<String>,
}

impl Optimum {
    /// Assembles the result; `written` are the values of the best candidate, `caveats` what its run says.
    pub fn of(of: &Optimising, answer: &Answer, records: &[Record], written: Vec<Fitted>, caveats: &[String]) -> Self {
        let (study, candidates) = (&of.manifest.texts[0], counts(of, records));
        let (best, front) = (best(of, records), front_of(of, records));
        let after = record_of(answer, records).map_or_else(Vec::new, |record| of.measures.values(&record.parts));
        let before = answer.before.reason.is_none().then(|| of.measures.values(&answer.before.parts));
        let members = of.runs();
        let is_allowed = matches!(answer.found.trial.rank(), Rank::Allowed(_));
        let mut result = Optimum {
            program: of.manifest.program.clone(),
            title: of.manifest.title.clone(),
            study: Source { file: study.name.clone(), sha256: study.sha256.clone() },
            scenario: base_name(of),
            overrides: of.overrides.clone(),
            seed: of.optimise.seed,
            budget: of.optimise.budget,
            members,
            quantile: (members > 1).then_some(of.optimise.quantile),
            is_allowed,
            goal: Pair { before: before.as_ref().map(|v| of.measures.goal(v)), after: answer.found.trial.goal },
            goals: goals(of, before.as_deref(), &after),
            constraints: limits(&of.measures, before.as_deref(), &after),
            parameters: (0..of.bounds.len()).map(|i| parameter(of, answer, i)).collect(),
            best,
            front,
            written,
            candidates,
            warnings: of.warnings.clone(),
        };
        result.warnings.extend(remarks(of, answer, &result));
        result.warnings.extend(caveats.iter().map(|text| format!("caveat of the best run: {text}")));
        result
    }
}

/// The record of the best candidate.
pub fn record_of<'r>(answer: &Answer, records: &'r [Record]) -> Option<&'r Record> {
    records.iter().find(|record| record.at.as_ref() == Some(&answer.found.point.at))
}

fn goals(of: &Optimising, before: Option<&[f64]>, after: &[f64]) -> Vec<GoalPart> {
    let part = |(i, (value, _)): (usize, &(usize, f64))| GoalPart {
        measure: of.measures.name(*value),
        unit: of.measures.unit(*value),
        is_maximised: of.optimise.goals[i].is_maximised,
        weight: of.optimise.goals[i].weight,
        per: of.measures.per[i],
        values: Pair { before: before.map(|v| v[*value]), after: after.get(*value).copied().unwrap_or(f64::NAN) },
    };
    of.measures.goals.iter().enumerate().map(part).collect()
}

fn limits(measures: &Measures, before: Option<&[f64]>, after: &[f64]) -> Vec<LimitKept> {
    let kept = |limit: &super::measures::Limit| {
        let now = after.get(limit.value).copied().unwrap_or(f64::NAN);
        let margin = -limit.beyond(now);
        LimitKept {
            measure: measures.name(limit.value),
            unit: measures.unit(limit.value),
            is_floor: limit.is_floor,
            limit: limit.limit,
            values: Pair { before: before.map(|v| v[limit.value]), after: now },
            margin,
            is_active: margin.abs() < ACTIVE,
        }
    };
    measures.limits.iter().map(kept).collect()
}

fn parameter(of: &Optimising, answer: &Answer, i: usize) -> Tuned {
    let (parameter, bounds) = (&of.parameters()[i], of.bounds[i]);
    let (best, value) = (&answer.found.point.at, |at: &[f64]| of.values(at)[i]);
    let u = bounds.part(value(best));
    let neighbour = |side: usize| {
        let trial = answer.neighbours.as_ref()?.get(i)?[side].as_ref()?;
        let mut at = best.clone();
        at[i] = (at[i] + if side == 0 { -STEP } else { STEP }).clamp(0.0, 1.0);
        let beyond = trial.beyond.iter().zip(&of.measures.limits).filter(|(g, _)| **g > 0.0);
        Some(Neighbour {
            value: value(&at),
            goal: trial.goal.is_finite().then_some(trial.goal),
            beyond: beyond.map(|(_, limit)| of.measures.name(limit.value)).collect(),
            has_caveats: trial.is_refused,
        })
    };
    Tuned {
        name: parameter.name.clone(),
        unit: parameter.unit,
        shown: shown_unit(parameter, &of.experiment.study.base),
        apply: parameter.apply,
        places: parameter.targets.iter().map(|t| t.path.clone()).collect(),
        bounds: [bounds.from, bounds.to],
        log: bounds.log,
        base: match parameter.nominal() {
            occupant_study::Value::Number(x) => Some(x),
            _ => None,
        },
        value: value(best),
        at_bound: match u {
            u if u < STEP / 2.0 => Some("lower"),
            u if u > 1.0 - STEP / 2.0 => Some("upper"),
            _ => None,
        },
        neighbours: [neighbour(0), neighbour(1)],
    }
}

fn best(of: &Optimising, records: &[Record]) -> Vec<Candidate> {
    let tried = records.iter().enumerate().filter(|(_, r)| r.at.is_some() && r.reason.is_none());
    let mut order: Vec<(usize, &Record)> = tried.collect();
    // scores are clamped, ranks are not
    let by_rank = |a: &Record, b: &Record| of.trial(a).rank().partial_cmp(&of.trial(b).rank());
    order.sort_by(|a, b| by_rank(a.1, b.1).unwrap_or(std::cmp::Ordering::Equal).then(a.0.cmp(&b.0)));
    order.dedup_by(|a, b| a.1.at == b.1.at);
    order.into_iter().take(LISTED).map(|(index, record)| candidate(of, index, record)).collect()
}

fn candidate(of: &Optimising, index: usize, record: &Record) -> Candidate {
    let Trial { goal, beyond, .. } = of.trial(record);
    Candidate {
        index,
        goal,
        values: record.at.as_ref().map_or_else(Vec::new, |at| of.values(at)),
        measures: of.measures.values(&record.parts),
        caveats: record.caveats.clone(),
        is_within: beyond.iter().all(|g| *g <= 0.0),
    }
}

/// The front; empty if the study asks for none.
fn front_of(of: &Optimising, records: &[Record]) -> Vec<Candidate> {
    if of.optimise.front == 0 {
        return Vec::new();
    }
    // the base scenario is none of the candidates
    let tried: Vec<(usize, &Record)> = records.iter().enumerate().filter(|(_, r)| r.at.is_some()).collect();
    let trials: Vec<Trial> = tried.iter().map(|(_, record)| of.trial(record)).collect();
    front(&trials).into_iter().map(|i| candidate(of, tried[i].0, tried[i].1)).collect()
}

fn counts(of: &Optimising, records: &[Record]) -> Counts {
    let mut count = Counts { all: records.len(), ..Counts::default() };
    for record in records {
        match record.stage {
            None => {}
            Some(Stage::Sample | Stage::Model { .. } | Stage::Descent { .. }) => count.search += 1,
            Some(_) => count.neighbours += 1,
        }
        if let Some(reason) = &record.reason {
            count.failed += 1;
            count.reason.get_or_insert_with(|| reason.clone());
            continue;
        }
        if !record.caveats.is_empty() {
            count.with_caveats += 1;
            count.caveats.get_or_insert_with(|| record.caveats.clone());
        }
        count.beyond += usize::from(of.trial(record).beyond.iter().any(|g| *g > 0.0));
    }
    count
}

/// Remarks on the result.
fn remarks(of: &Optimising, answer: &Answer, result: &Optimum) -> Vec<String> {
    let mut all = Vec::new();
    let count = &result.candidates;
    match answer.found.trial.rank() {
        Rank::Beyond(_) => {
            all.push("no candidate is within all limits: the best is the one that exceeds them least".to_owned())
        }
        Rank::Refused(sum) => all.push(format!(
            "all candidates{} have caveats, such as {}: `allow_caveats` says which do not matter",
            if sum > 0.0 { "" } else { " within the limits" },
            count.caveats.as_deref().unwrap_or("none")
        )),
        Rank::Allowed(_) | Rank::Failed => {}
    }
    for parameter in &result.parameters {
        let inner = &parameter.neighbours[usize::from(parameter.at_bound == Some("lower"))];
        let has_influence = inner.as_ref().is_none_or(|n| n.goal != Some(result.goal.after));
        if let Some(bound) = parameter.at_bound.filter(|_| has_influence) {
            all.push(format!("{} is at its {bound} bound: a wider range may have a better optimum", parameter.name));
        }
    }
    if count.failed > 0 {
        let reason = count.reason.as_deref().unwrap_or("no reason");
        all.push(format!("{} of {} candidates could not be run; the first one: {reason}", count.failed, count.all));
    }
    if of.trial(&answer.before).rank() < answer.found.trial.rank() {
        all.push("no candidate is better than the base scenario: give a larger budget".to_owned());
    }
    if answer.is_moving {
        all.push("the budget ended while neighbours were still better: a larger one finds a better optimum".to_owned());
    } else if answer.neighbours.is_none() {
        all.push(
            "the budget ended before all neighbours were seen: a larger one shows what the optimum hangs on".to_owned(),
        );
    }
    let is_settled = answer.found.descents.iter().any(|d| d.ending != occupant_study::search::Ending::Budget);
    if answer.found.regions == 0 && !is_settled {
        all.push("the search had not settled when its budget ended: a larger one may find a better optimum".to_owned());
    }
    if of.runs() > 1 {
        all.push(format!(
            "figures are quantiles of {} members; `occupant run best.toml` gives those of the first",
            of.runs()
        ));
    }
    all
}

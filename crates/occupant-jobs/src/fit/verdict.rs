//! Identifiability of each parameter, from the ends of its interval.

use occupant_scenario::Draft;
use occupant_study::search::End;
use occupant_study::{ApplyChoice, Bounds, Parameter, Value};
use serde::Serialize;

use super::{Answer, COMPENSATING, Fitting, IntervalEnd, Objective, ParameterEstimate, Record};

/// Largest interval, as a fraction of the range, between two bounds that still identifies a parameter.
const WIDE: f64 = 0.25;
/// Interval, as a fraction of the range, above which a parameter is weakly identified.
const VAGUE: f64 = 0.4;
/// Interval, as a fraction of the range, above which a parameter is not identified.
const EVERYTHING: f64 = 0.8;
/// Distance to a bound that counts as being at it.
const AT: f64 = 1e-3;

/// Identifiability of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The score rises on both sides.
    Identified,
    /// The score rises on both sides, but far away.
    Weak,
    /// The score rises on one side only.
    OneSided,
    /// The score would fall further below the lower bound.
    AtLowerBound,
    /// The score would fall further above the upper bound.
    AtUpperBound,
    /// The score would fall further beyond a constraint of the study.
    AtConstraint,
    /// The test does not determine it.
    NotIdentified,
}

/// All parameters with their verdicts; `sets` are the evaluated equally good sets.
pub fn verdicts(fitting: &Fitting, answer: &Answer, sets: &[&Record]) -> Vec<ParameterEstimate> {
    let parameters = 0..fitting.parameters.len();
    parameters.map(|i| parameter(fitting, answer, sets, i)).collect()
}

fn parameter(fitting: &Fitting, answer: &Answer, sets: &[&Record], i: usize) -> ParameterEstimate {
    let (of, bounds) = (&fitting.parameters[i], fitting.bounds[i]);
    let u = answer.best.at[i];
    let ends = &answer.profiles.ends[i];
    let near = &answer.best.at;
    // where the constraint is the reason, not the test
    let stopped = [0, 1].map(|s| ends[s].open || is_stopped(fitting, answer, &ends[s]));
    let open = [0, 1].map(|s| stopped[s] || is_open(&ends[s], near) || meets_more(fitting, &ends[s].point.at, near));
    let constraints: Vec<&str> =
        names_met(fitting, near).filter(|(of, _)| of.contains(&i)).map(|(_, name)| name).collect();
    let verdict = verdict(u, ends, (stopped, open), !constraints.is_empty());
    let compensated_by = partners(fitting, answer, i);
    let misfit = fitting.fit.misfit;
    let end = |end: &End| IntervalEnd { values: fitting.values(&end.point.at), score: misfit.of_cost(end.point.value) };
    let [down, up] = answer.reaches[i];
    let among = sets.iter().filter_map(|r| r.at.as_ref()).map(|at| at[i]);
    let [least, most] = among.fold([u, u], |[l, m], v| [l.min(v), m.max(v)]);
    ParameterEstimate {
        name: of.name.clone(),
        unit: of.unit,
        shown: shown_unit(of, &fitting.experiments[0].study.base),
        apply: of.apply,
        places: of.targets.iter().map(|t| t.path.clone()).collect(),
        bounds: [bounds.from, bounds.to],
        log: bounds.log,
        base: match of.nominal() {
            Value::Number(x) => Some(x),
            _ => None,
        },
        value: fitting.values(&answer.best.at)[i],
        interval: [bounds.value(ends[0].at), bounds.value(ends[1].at)],
        open,
        alone: alone(bounds, u, [down.length, up.length]),
        near_optimal: [bounds.value(least), bounds.value(most)],
        words: words(verdict, &compensated_by, &constraints),
        verdict,
        compensated_by,
        ends: [end(&ends[0]), end(&ends[1])],
    }
}

/// Display unit of a parameter, and its SI value: the unit used in the base scenario.
pub fn shown_unit(parameter: &Parameter, base: &Draft) -> (String, f64) {
    let place = parameter.targets.first();
    match parameter.apply {
        ApplyChoice::Factor => (String::new(), 1.0),
        ApplyChoice::Value | ApplyChoice::Offset => {
            place.and_then(|t| base.unit_at(&t.path)).unwrap_or((parameter.unit.to_owned(), 1.0))
        }
    }
}

fn alone(bounds: Bounds, u: f64, [down, up]: [f64; 2]) -> [f64; 2] {
    [bounds.value((u - down).max(0.0)), bounds.value((u + up).min(1.0))]
}

/// Whether the interval ends at a bound, of this or another parameter.
fn is_open(end: &End, best: &[f64]) -> bool {
    let at_bound = |u: f64| !(AT..=1.0 - AT).contains(&u);
    let others = end.point.at.iter().zip(best);
    others.into_iter().any(|(there, here)| at_bound(*there) && !at_bound(*here))
}

/// Whether an interval ends because candidates beyond are moved back to a constraint: most of the rise is for the move.
fn is_stopped(fitting: &Fitting, answer: &Answer, end: &End) -> bool {
    let score = |cost: f64| fitting.fit.misfit.of_cost(cost);
    let rise = score(end.point.value) - score(answer.best.value);
    fitting.of_move(&end.point.at) > 0.5 * rise
}

/// Constraints that a point meets: their parameters and names.
fn names_met<'f>(fitting: &'f Fitting, at: &[f64]) -> impl Iterator<Item = (Vec<usize>, &'f str)> {
    let values = fitting.values(at);
    let met = fitting.within.iter().flat_map(move |within| within.met(&values, AT).collect::<Vec<_>>());
    met.map(|relation| (relation.terms.iter().map(|(i, _)| *i).collect(), relation.name.as_str()))
}

/// Whether a point meets a constraint that the best point does not.
fn meets_more(fitting: &Fitting, at: &[f64], best: &[f64]) -> bool {
    names_met(fitting, at).any(|(_, name)| names_met(fitting, best).all(|(_, other)| other != name))
}

fn verdict(u: f64, ends: &[End; 2], (stopped, open): ([bool; 2], [bool; 2]), at_constraint: bool) -> Verdict {
    let width = ends[1].at - ends[0].at;
    match () {
        () if width > EVERYTHING || (open == [true; 2] && width > WIDE) => Verdict::NotIdentified,
        () if u < AT && ends[0].open => Verdict::AtLowerBound,
        () if u > 1.0 - AT && ends[1].open => Verdict::AtUpperBound,
        () if at_constraint && stopped != [false; 2] => Verdict::AtConstraint,
        () if stopped != [false; 2] => Verdict::OneSided,
        () if width > VAGUE => Verdict::Weak,
        () => Verdict::Identified,
    }
}

/// Parameters that compensate for this one.
fn partners(fitting: &Fitting, answer: &Answer, i: usize) -> Vec<String> {
    let parameters = fitting.parameters.iter().enumerate();
    let makes_up = |j: usize| {
        let correlation = answer.shape.correlation(i, j);
        j != i && correlation.is_some_and(|c| c.abs() > COMPENSATING)
    };
    let partners = parameters.filter(|(j, _)| makes_up(*j));
    partners.map(|(_, p)| p.name.clone()).collect()
}

fn words(verdict: Verdict, partners: &[String], constraints: &[&str]) -> String {
    let with = match partners {
        [] => String::new(),
        names => format!(": {} compensates it", names.join(" or ")),
    };
    match verdict {
        Verdict::Identified if partners.is_empty() => "identified".to_owned(),
        Verdict::Identified => format!("identified only together with others{with}"),
        Verdict::Weak => format!("weakly identified{with}"),
        Verdict::OneSided => format!("bounded on one side only{with}"),
        Verdict::AtLowerBound => "at its lower bound".to_owned(),
        Verdict::AtUpperBound => "at its upper bound".to_owned(),
        Verdict::AtConstraint => format!("at constraint {}", constraints.join(" and ")),
        Verdict::NotIdentified => format!("not identified{with}"),
    }
}

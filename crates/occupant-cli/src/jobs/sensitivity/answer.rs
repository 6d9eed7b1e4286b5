//! The answer of `occupant sensitivity --json`.

use occupant_core::model::Model;
use occupant_core::model::setup::Integrator;
use occupant_study::sensitivity::events::{Change, Event};
use occupant_study::sensitivity::finite::{HOLDS, Verdict};
use serde::Serialize;

use super::analysis::{Analysis, Asked, relative};
use super::units::per;
use crate::base::names::program;

/// All that was found. Every number is SI, angles in radians; null where there is none.
#[derive(Debug, Serialize)]
pub(crate) struct Answer {
    program: String,
    scenario: String,
    title: String,
    integrator: &'static str,
    steps: u64,
    parameters: Vec<ParameterAnswer>,
    measures: Vec<MeasureAnswer>,
    sensitivities: Vec<Sensitivity>,
    events: Vec<EventAnswer>,
    events_not_kept: u64,
    holds_while_off_by_at_most: f64,
    cost: Cost,
}

#[derive(Debug, Serialize)]
struct ParameterAnswer {
    path: String,
    unit: String,
    value: f64,
    /// Changes are parts of this.
    size: f64,
    /// Greatest relative distance of two extrapolations of what the model is built of.
    constants_doubt: f64,
    /// The same of the vehicle's motion, and when; absent if the parameter leaves it alone.
    path_doubt: Option<f64>,
    path_doubt_time_s: Option<f64>,
    notes: Vec<String>,
}

#[derive(Debug, Serialize)]
struct MeasureAnswer {
    name: String,
    unit: &'static str,
    value: f64,
}

#[derive(Debug, Serialize)]
struct Sensitivity {
    measure: String,
    parameter: String,
    derivative: f64,
    unit: String,
    /// Parts of the measure per part of the parameter.
    relative: Option<f64>,
    /// Distance of two extrapolations of the derivative, and rounding.
    doubt: f64,
    changes: Vec<ChangeAnswer>,
    verdict: &'static str,
    /// Greatest distance of a secant from the derivative, as a part of it, up to `up_to_part`.
    off_by: Option<f64>,
    up_to_part: Option<f64>,
}

#[derive(Debug, Serialize)]
struct ChangeAnswer {
    part: f64,
    secant_below: f64,
    secant_above: f64,
    off_by: f64,
}

#[derive(Debug, Serialize)]
struct EventAnswer {
    time_s: f64,
    what: String,
    change: &'static str,
    jump_n: f64,
    /// By parameter, s per unit; absent where it is not known.
    shift_s_per_unit: Option<Vec<f64>>,
}

#[derive(Debug, Serialize)]
struct Cost {
    plain_run_s: f64,
    run_in_duals_s: f64,
    ratio: f64,
    parameters: usize,
}

impl Answer {
    /// Of this analysis of a scenario file.
    pub(crate) fn new(file: &str, model: &Model, asked: &Asked<'_>, found: &Analysis) -> Self {
        let setup = model.setup();
        let [plain, dual] = found.cost_s;
        Answer {
            program: program(),
            scenario: file.to_owned(),
            title: setup.title.clone(),
            integrator: match setup.integrator {
                Integrator::Rk4 { .. } => "rk4",
                Integrator::Adaptive { .. } => "adaptive",
            },
            steps: found.trajectory.outcome.effort.steps,
            parameters: parameters(asked, found),
            measures: measures(asked, found),
            sensitivities: sensitivities(asked, found),
            events: found.trajectory.events.iter().map(|e| event(e, model)).collect(),
            events_not_kept: found.trajectory.dropped_events,
            holds_while_off_by_at_most: HOLDS,
            cost: Cost {
                plain_run_s: plain,
                run_in_duals_s: dual,
                ratio: dual / plain,
                parameters: asked.parameters.len(),
            },
        }
    }
}

fn parameters(asked: &Asked<'_>, found: &Analysis) -> Vec<ParameterAnswer> {
    let one = |k: usize| {
        let (parameter, built) = (&asked.parameters[k], &found.built[k]);
        let (path_doubt, path_doubt_time_s) = built.path_doubt().unzip();
        ParameterAnswer {
            path: parameter.name.clone(),
            unit: parameter.unit.clone(),
            value: parameter.nominal,
            size: parameter.size,
            constants_doubt: built.doubt,
            path_doubt,
            path_doubt_time_s,
            notes: built.notes.clone(),
        }
    };
    (0..asked.parameters.len()).map(one).collect()
}

fn measures(asked: &Asked<'_>, found: &Analysis) -> Vec<MeasureAnswer> {
    let named = asked.wish.figures.iter().zip(&asked.units);
    named
        .zip(&found.values.figures)
        .map(|((name, unit), value)| MeasureAnswer { name: name.clone(), unit, value: *value })
        .collect()
}

fn sensitivities(asked: &Asked<'_>, found: &Analysis) -> Vec<Sensitivity> {
    let mut all = Vec::new();
    for (i, measure) in asked.wish.figures.iter().enumerate() {
        for (k, parameter) in asked.parameters.iter().enumerate() {
            let slope = found.derivatives[k].figures[i];
            let comparison = &found.comparisons[k][i];
            let (verdict, off_by, up_to_part) = match comparison.verdict {
                Verdict::Holds { off, up_to } => ("holds", Some(off), Some(up_to)),
                Verdict::NoInfluence => ("no influence", None, None),
                Verdict::NotReliable { off, at } => ("not to be relied upon", Some(off), Some(at)),
                Verdict::Unchecked => ("unchecked", None, None),
            };
            let changes = found.finite[k].iter().enumerate();
            let change = |(c, finite): (usize, &occupant_study::sensitivity::finite::Finite)| {
                let [secant_below, secant_above] = comparison.secants[c];
                ChangeAnswer { part: finite.part, secant_below, secant_above, off_by: comparison.off[c] }
            };
            all.push(Sensitivity {
                measure: measure.clone(),
                parameter: parameter.name.clone(),
                derivative: slope.value,
                unit: per(asked.units[i], &parameter.unit),
                relative: relative(slope.value, found.values.figures[i], parameter.nominal),
                doubt: slope.doubt,
                changes: changes.map(change).collect(),
                verdict,
                off_by,
                up_to_part,
            });
        }
    }
    all
}

fn event(event: &Event, model: &Model) -> EventAnswer {
    EventAnswer {
        time_s: event.time_s,
        what: event.happening.words(model),
        change: match event.change {
            Change::Kink => "kink",
            Change::Jump => "jump",
        },
        jump_n: event.jump_n,
        shift_s_per_unit: event.shift.iter().any(|s| *s != 0.0).then(|| event.shift.clone()),
    }
}

//! The answer of `occupant sensitivity --json`. Every number is SI, angles in radians; null where there is none.

use occupant_core::model::Model;
use occupant_core::model::setup::Integrator;
use occupant_study::sensitivity::events::{Change, Event};
use occupant_study::sensitivity::finite::Finite;
use occupant_study::sensitivity::verdict::{HOLDS, Verdict};
use occupant_study::sensitivity::{Built, Parameter};
use serde_json::{Value, json};

use super::analysis::{Analysis, Asked, relative};
use super::units::per;
use crate::base::program;

/// All results of this analysis of a scenario file.
pub fn answer(file: &str, model: &Model, asked: &Asked<'_>, analysis: &Analysis) -> Value {
    let setup = model.setup();
    let [plain_s, dual_s] = analysis.cost_s;
    let trajectory = &analysis.trajectory;
    let measures = asked.request.figures.iter().zip(&asked.units).zip(&analysis.values.figures);
    json!({
        "program": program(),
        "scenario": file,
        "title": setup.title,
        "integrator": match setup.integrator {
            Integrator::Rk4 { .. } => "rk4",
            Integrator::Adaptive { .. } => "adaptive",
        },
        "steps": trajectory.outcome.effort.steps,
        "parameters": parameters(asked, analysis),
        "measures": measures
            .map(|((name, unit), value)| json!({ "name": name, "unit": unit, "value": value }))
            .collect::<Vec<Value>>(),
        "sensitivities": sensitivities(asked, analysis),
        "events": trajectory.events.iter().map(|e| event(e, model)).collect::<Vec<Value>>(),
        "events_not_kept": trajectory.dropped_events,
        "holds_while_off_by_at_most": HOLDS,
        "cost": {
            "plain_run_s": plain_s,
            "run_in_duals_s": dual_s,
            "ratio": dual_s / plain_s,
            "parameters": asked.parameters.len(),
        },
    })
}

/// Changes are fractions of `size`; a doubt is the largest relative difference of two extrapolations, of the model's
/// constants and of the vehicle's motion, null if the parameter does not affect it.
fn parameters(asked: &Asked<'_>, analysis: &Analysis) -> Vec<Value> {
    let one = |(parameter, built): (&Parameter<'_>, &Built)| {
        let (path_doubt, path_doubt_time_s) = built.path_doubt().unzip();
        json!({
            "path": parameter.name,
            "unit": parameter.unit,
            "value": parameter.nominal,
            "size": parameter.size,
            "constants_doubt": built.doubt,
            "path_doubt": path_doubt,
            "path_doubt_time_s": path_doubt_time_s,
            "notes": built.notes,
        })
    };
    asked.parameters.iter().zip(&analysis.built).map(one).collect()
}

/// `doubt` is the difference of two extrapolations of the derivative, plus rounding; `off_by` the largest relative
/// difference of a secant from the derivative, for changes up to `up_to_part`, or at that change if it does not hold
/// for a `reason`.
fn sensitivities(asked: &Asked<'_>, analysis: &Analysis) -> Vec<Value> {
    let mut all = Vec::new();
    for (i, measure) in asked.request.figures.iter().enumerate() {
        for (k, parameter) in asked.parameters.iter().enumerate() {
            let slope = analysis.derivatives[k].figures[i];
            let comparison = &analysis.comparisons[k][i];
            let (verdict, off_by, up_to_part, reason) = match comparison.verdict {
                Verdict::Holds { off, up_to } => ("holds", Some(off), Some(up_to), None),
                Verdict::NoInfluence => ("no influence", None, None, None),
                Verdict::DoesNotHold { off, at, why } => ("does not hold", Some(off), Some(at), Some(why.words())),
                Verdict::Unchecked => ("unchecked", None, None, None),
            };
            let change = |(c, finite): (usize, &Finite)| {
                let [below, above] = comparison.secants[c];
                json!({ "part": finite.part, "secant_below": below, "secant_above": above, "off_by": comparison.off[c] })
            };
            all.push(json!({
                "measure": measure,
                "parameter": parameter.name,
                "derivative": slope.value,
                "unit": per(asked.units[i], &parameter.unit),
                "relative": relative(slope.value, analysis.values.figures[i], parameter.nominal),
                "doubt": slope.doubt,
                "changes": analysis.neighbours.finite[k].iter().enumerate().map(change).collect::<Vec<Value>>(),
                "verdict": verdict,
                "off_by": off_by,
                "up_to_part": up_to_part,
                "reason": reason,
            }));
        }
    }
    all
}

/// `shift_s_per_unit` is by parameter, null where unknown.
fn event(event: &Event, model: &Model) -> Value {
    json!({
        "time_s": event.time_s,
        "what": event.happening.words(model),
        "change": match event.change {
            Change::Kink => "kink",
            Change::Jump => "jump",
        },
        "jump_n": event.jump_n,
        "shift_s_per_unit": event.shift.iter().any(|s| *s != 0.0).then_some(&event.shift),
    })
}

//! The report as JSON: SI, units in the names.

use serde_json::{Map, Value, json as value};

use super::Report;
use super::figures::Figures;
use super::table::{basis_name, grade_name, source_name, verdict_name};
use crate::files::history::family_name;
use occupant_study::risk::VerticalGravity;

pub(crate) fn json(report: &Report) -> Value {
    let figures = Figures::of(report);
    let (signals, preparation) = (&report.signals, &report.preparation);
    let measures: Map<String, Value> = figures
        .figures
        .iter()
        .map(|figure| {
            let mut entry = value!({ "value": figure.value, "when_s": figure.when_s });
            if !figure.remark.is_empty() {
                entry["remark"] = figure.remark.into();
            }
            (figure.key.clone(), entry)
        })
        .collect();
    let left_out = figures.left_out.iter();
    let limits = report.judgements.iter();
    value!({
        "vehicle": report.subject.name,
        "source": source_name(report),
        "signs": "x forward, y right, z down",
        "record": {
            "samples": signals.samples(),
            "interval_s": signals.dt_s,
            "start_s": signals.start_s,
            "end_s": signals.end_s(),
        },
        "filter": preparation.filter.map(|(class, family)| {
            format!("CFC {:.0}, {}", class.hertz(), family_name(family))
        }),
        "offset_m": preparation.offset_m,
        "gravity_included": preparation.gravity == VerticalGravity::Included,
        "occupant": {
            "longitudinal_m": report.flight.distances.longitudinal_m,
            "lateral_m": report.flight.distances.lateral_m,
            "head_start_x_m": report.flight.head.start_x_m,
        },
        "measures": measures,
        "left_out": left_out
            .map(|l| value!({ "measure": l.name, "reason": l.reason }))
            .collect::<Vec<Value>>(),
        "limits": limits
            .map(|j| value!({
                "rule": j.limit.rule.name(),
                "measure": j.measure,
                "grade": grade_name(j.limit.grade),
                "most": j.limit.most,
                "value": j.value,
                "margin": j.verdict.map(|v| v.margin),
                "relative_margin": j.verdict.map(|v| v.relative_margin),
                "verdict": verdict_name(j),
                "read_in": basis_name(j.limit.basis),
            }))
            .collect::<Vec<Value>>(),
    })
}

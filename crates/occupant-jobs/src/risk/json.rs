//! The report as JSON: SI, units in the names.

use occupant_scenario::kind::UnitSystem;
use serde_json::{Map, Value, json as value};

use super::Report;
use super::figures::{Figure, Figures};
use super::table::{basis_name, filter_name, source_name, verdict_name};
use occupant_study::risk::VerticalGravity;

/// The report as JSON.
pub fn json(report: &Report) -> Value {
    let figures = Figures::of(report);
    let (signals, preparation) = (&report.signals, &report.preparation);
    let measure = |f: &Figure| {
        let mut measure = value!(f);
        if let Some(ends) = report.intervals.as_ref().and_then(|intervals| intervals.of_key(&f.key)) {
            measure["interval_95"] = value!(ends);
        }
        (f.key.clone(), measure)
    };
    let measures: Map<String, Value> = figures.figures.iter().map(measure).collect();
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
        "filter": filter_name(preparation),
        "offset_m": preparation.offset_m,
        "baseline_s": preparation.baseline_s,
        "notes": report.notes,
        "intervals": report.intervals.as_ref().map(|intervals| intervals.words()),
        "gravity_included": preparation.gravity == VerticalGravity::Included,
        "occupant": {
            "longitudinal_m": report.flight.distances.longitudinal_m,
            "lateral_m": report.flight.distances.lateral_m,
            "head_start_x_m": report.flight.head.start_x_m,
        },
        "measures": measures,
        "left_out": figures.left_out,
        "classes": report
            .classes(Some(UnitSystem::Si))
            .into_iter()
            .map(|(rule, class, by)| value!({ "rule": rule, "class": class, "by": by }))
            .collect::<Vec<Value>>(),
        "limits": limits
            .map(|j| value!({
                "rule": j.limit.rule.name(),
                "measure": j.measure,
                "grade": j.limit.grade.name(),
                "most": j.limit.most,
                "value": j.value,
                "margin": j.verdict.map(|v| v.margin),
                "relative_margin": j.verdict.map(|v| v.relative_margin),
                "verdict": verdict_name(j),
                "read_in": basis_name(j.limit.basis),
                "document": j.limit.rule.document(),
            }))
            .collect::<Vec<Value>>(),
    })
}

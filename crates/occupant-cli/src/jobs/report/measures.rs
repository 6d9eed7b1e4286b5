//! The table of measures: injury measures against limits, then what the run's summary tells.

use crash_measures::injury;
use crash_measures::unit::{Shown, Unit};
use occupant_core::results::summary::Summary;
use serde::Serialize;

/// A row of the table.
#[derive(Debug, Serialize)]
pub(crate) struct Measure {
    group: &'static str,
    name: String,
    value: Option<f64>,
    unit: String,
    /// When; the start of an interval.
    time_s: Option<f64>,
    /// Largest value allowed, in the same unit.
    limit: Option<f64>,
    /// The rule that sets the limit.
    rule: Option<String>,
    /// `passed` or `failed`.
    verdict: Option<&'static str>,
    /// Why there is no value, or what to know of it.
    remark: Option<String>,
}

impl Measure {
    fn new(group: &'static str, name: impl Into<String>, value: Option<f64>, unit: Shown, time_s: Option<f64>) -> Self {
        Measure {
            group,
            name: name.into(),
            value,
            unit: unit.symbol(),
            time_s,
            limit: None,
            rule: None,
            verdict: None,
            remark: None,
        }
    }
}

/// All rows, group by group.
pub(crate) fn measures(summary: &Summary) -> Vec<Measure> {
    let mut rows: Vec<_> = summary.measures.iter().flat_map(injury_rows).collect();
    add_loads(&mut rows, summary);
    add_excursion(&mut rows, summary);
    let energy = &summary.energy;
    let group = "Energy balance and work of the integrator";
    let mut add = |name: &str, value: f64, unit| {
        rows.push(Measure::new(group, name, Some(value), unit, None));
    };
    let percent = Unit::One.shown_in("%");
    add("Greatest imbalance, of the greatest kinetic energy", 100.0 * energy.balance_error, percent);
    add("Greatest kinetic energy, in the vehicle", energy.greatest_kinetic_j, Unit::Joule.shown());
    add("Steps", summary.solver.steps as f64, Unit::One.shown());
    add("Steps rejected", summary.solver.rejected as f64, Unit::One.shown());
    rows
}

/// A row for each limit of an injury measure, or one without.
fn injury_rows(m: &injury::Measure) -> Vec<Measure> {
    let unit = engineering(m.unit);
    let group = "Injury measures, unfiltered";
    let mut first = Measure::new(group, m.label, m.value.map(|v| v * unit.per_si()), unit, m.from_s);
    first.remark.clone_from(&m.remark);
    if m.limits.is_empty() {
        return vec![first];
    }
    let row = |judgement: &injury::Judgement| Measure {
        group,
        name: m.label.to_owned(),
        value: first.value,
        unit: first.unit.clone(),
        time_s: first.time_s,
        limit: Some(judgement.most * unit.per_si()),
        rule: Some(if judgement.quoted {
            judgement.rule.to_owned()
        } else {
            format!("{}, as generally known", judgement.rule)
        }),
        verdict: Some(if judgement.passed { "passed" } else { "failed" }),
        remark: m.remark.clone(),
    };
    m.limits.iter().map(row).collect()
}

/// The unit that engineers read.
fn engineering(unit: Unit) -> Shown {
    match unit {
        Unit::MetrePerSecondSquared => unit.shown_in("g"),
        Unit::Newton => unit.shown_in("kN"),
        other => other.shown(),
    }
}

fn add_loads(rows: &mut Vec<Measure>, summary: &Summary) {
    let force = engineering(Unit::Newton);
    let mut add = |name, force_n: f64, time_s| {
        rows.push(Measure::new("Loads", name, Some(force_n / force.si), force, time_s));
    };
    for belt in &summary.belts {
        add(format!("Belt {}, loop force", belt.belt), belt.loop_force_n, belt.time_s);
    }
    for sphere in &summary.sphere_forces {
        add(format!("{} against {}", sphere.sphere, sphere.surface), sphere.force_n, Some(sphere.time_s));
    }
}

fn add_excursion(rows: &mut Vec<Measure>, summary: &Summary) {
    let Some(e) = &summary.head_excursion else {
        return;
    };
    for (way, by_m, time_s) in [
        ("forward", e.forward_m, e.forward_time_s),
        ("rearward", e.rearward_m, e.rearward_time_s),
        ("left", e.left_m, e.left_time_s),
        ("right", e.right_m, e.right_time_s),
        ("up", e.up_m, e.up_time_s),
        ("down", e.down_m, e.down_time_s),
    ] {
        let (group, unit) = ("Head excursion in the vehicle", Unit::Metre.shown_in("mm"));
        rows.push(Measure::new(group, way, Some(by_m * unit.per_si()), unit, Some(time_s)));
    }
}

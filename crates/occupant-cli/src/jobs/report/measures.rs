//! The table of measures: injury measures against limits, then the run's summary.

use crash_measures::injury;
use crash_measures::unit::Unit;
use occupant_core::model::setup::STANDARD_GRAVITY_M_S2;
use occupant_core::results::summary::Summary;
use serde::Serialize;

/// A row of the table.
#[derive(Debug, Serialize)]
pub(crate) struct Measure {
    group: &'static str,
    name: String,
    value: Option<f64>,
    unit: &'static str,
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
    fn new(
        group: &'static str,
        name: impl Into<String>,
        value: Option<f64>,
        unit: &'static str,
        time_s: Option<f64>,
    ) -> Self {
        Measure { group, name: name.into(), value, unit, time_s, limit: None, rule: None, verdict: None, remark: None }
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
    add("Greatest imbalance, of the greatest kinetic energy", 100.0 * energy.balance_error, "%");
    add("Greatest kinetic energy, in the vehicle", energy.greatest_kinetic_j, "J");
    add("Steps", summary.solver.steps as f64, "");
    add("Steps rejected", summary.solver.rejected as f64, "");
    rows
}

/// A row for each limit of an injury measure, or one without.
fn injury_rows(m: &injury::Measure) -> Vec<Measure> {
    let (unit, per_si) = scale(m.unit);
    let group = "Injury measures, unfiltered";
    let mut first = Measure::new(group, m.label, m.value.map(|v| v * per_si), unit, m.from_s);
    first.remark.clone_from(&m.remark);
    if m.limits.is_empty() {
        return vec![first];
    }
    let row = |judgement: &injury::Judgement| Measure {
        group,
        name: m.label.to_owned(),
        value: first.value,
        unit,
        time_s: first.time_s,
        limit: Some(judgement.most * per_si),
        rule: Some(match judgement.quoted {
            true => judgement.rule.to_owned(),
            false => format!("{}, as generally known", judgement.rule),
        }),
        verdict: Some(if judgement.passed { "passed" } else { "failed" }),
        remark: m.remark.clone(),
    };
    m.limits.iter().map(row).collect()
}

/// The unit that engineers read, and how many of it make one of SI.
fn scale(unit: Unit) -> (&'static str, f64) {
    match unit {
        Unit::MetrePerSecondSquared => ("g", 1.0 / STANDARD_GRAVITY_M_S2),
        Unit::Newton => ("kN", 1e-3),
        Unit::One => ("", 1.0),
        other => (other.symbol(), 1.0),
    }
}

fn add_loads(rows: &mut Vec<Measure>, summary: &Summary) {
    for belt in &summary.belts {
        let name = format!("Belt {}, loop force", belt.belt);
        let force_kn = Some(belt.loop_force_n / 1e3);
        rows.push(Measure::new("Loads", name, force_kn, "kN", belt.time_s));
    }
    for sphere in &summary.sphere_forces {
        let name = format!("{} against {}", sphere.sphere, sphere.surface);
        let force_kn = Some(sphere.force_n / 1e3);
        let time = Some(sphere.time_s);
        rows.push(Measure::new("Loads", name, force_kn, "kN", time));
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
        let group = "Head excursion in the vehicle";
        rows.push(Measure::new(group, way, Some(by_m * 1e3), "mm", Some(time_s)));
    }
}

//! The table of measures: injury measures against limits, then the run's summary.

use crash_measures::injury;
use crash_measures::unit::Unit;
use occupant_core::forces::table::{Holds, Table};
use occupant_core::model::setup::STANDARD_GRAVITY_M_S2;
use occupant_core::results::summary::{Peak, Summary};
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
    rows.extend(summary.elements.values().flat_map(element_rows));
    for sphere in &summary.sphere_forces {
        let name = format!("{} against {}", sphere.sphere, sphere.surface);
        let force_kn = Some(sphere.force_n / 1e3);
        let time = Some(sphere.time_s);
        rows.push(Measure::new("Loads", name, force_kn, "kN", time));
    }
}

/// Peak forces of force elements whose times are known: `Belt lap, loop force`.
fn element_rows(table: &Table) -> impl Iterator<Item = Measure> {
    let of = table.columns[0].heading;
    let of = of[..1].to_uppercase() + &of[1..];
    let peaks = table.columns.windows(2).filter(|both| both[1].holds == Holds::Time);
    let all = peaks.flat_map(|peak| table.rows.iter().map(move |row| (peak, row)));
    all.map(move |(peak, row)| {
        let what = peak[0].heading.split(',').next().unwrap_or_default();
        let name = format!("{of} {}, {what}", row[0].text().unwrap_or_default());
        let force_kn = row[peak[0].key].number().map(|force_n| force_n / 1e3);
        Measure::new("Loads", name, force_kn, "kN", row[peak[1].key].number())
    })
}

fn add_excursion(rows: &mut Vec<Measure>, summary: &Summary) {
    let Some(e) = &summary.head_excursion else {
        return;
    };
    for (way, Peak { value, time_s }) in e.ways() {
        let group = "Head excursion in the vehicle";
        rows.push(Measure::new(group, way, Some(value * 1e3), "mm", Some(time_s)));
    }
}

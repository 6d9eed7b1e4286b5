//! The table of measures: injury measures against limits, then the run's summary.

use crash_measures::injury;
use crash_measures::unit::{Shown, Unit};
use occupant_core::forces::table::{Holds, Table};
use occupant_core::results::summary::{Caveat, Peak, Summary};
use serde::Serialize;

/// A row of the table.
#[derive(Clone, Debug, Default, Serialize)]
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
        Measure { group, name: name.into(), value, unit: unit.symbol(), time_s, ..Measure::default() }
    }
}

/// All rows, group by group.
pub(crate) fn measures(summary: &Summary) -> Vec<Measure> {
    let mut rows: Vec<_> = summary.measures.iter().flat_map(|m| injury_rows(m, &summary.caveats)).collect();
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
fn injury_rows(m: &injury::Measure, caveats: &[Caveat]) -> Vec<Measure> {
    let unit = engineering(m.unit);
    let mut first =
        Measure::new("Injury measures, unfiltered", m.label, m.value.map(|v| v * unit.per_si()), unit, m.from_s);
    let touching = caveats.iter().filter(|caveat| caveat.touches(m.name)).map(|caveat| &caveat.text);
    let remarks: Vec<_> = touching.chain(&m.remark).map(String::as_str).collect();
    first.remark = (!remarks.is_empty()).then(|| remarks.join("; "));
    if m.limits.is_empty() {
        return vec![first];
    }
    let row = |judgement: &injury::Judgement| Measure {
        limit: Some(judgement.most * unit.per_si()),
        rule: Some(if judgement.quoted {
            judgement.rule.to_owned()
        } else {
            format!("{}, as generally known", judgement.rule)
        }),
        verdict: Some(if judgement.passed { "passed" } else { "failed" }),
        ..first.clone()
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
    rows.extend(summary.elements.values().flat_map(element_rows));
    let spheres = summary.sphere_forces.iter();
    rows.extend(spheres.map(|s| load(format!("{} against {}", s.sphere, s.surface), Some(s.force_n), Some(s.time_s))));
}

/// The row of a force.
fn load(name: String, force_n: Option<f64>, time_s: Option<f64>) -> Measure {
    let unit = engineering(Unit::Newton);
    Measure::new("Loads", name, force_n.map(|force_n| force_n / unit.si), unit, time_s)
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
        load(name, row[peak[0].key].number(), row[peak[1].key].number())
    })
}

fn add_excursion(rows: &mut Vec<Measure>, summary: &Summary) {
    let Some(e) = &summary.head_excursion else {
        return;
    };
    for (way, Peak { value, time_s }) in e.ways() {
        let (group, unit) = ("Head excursion in the vehicle", Unit::Metre.shown_in("mm"));
        rows.push(Measure::new(group, way, Some(value * unit.per_si()), unit, Some(time_s)));
    }
}

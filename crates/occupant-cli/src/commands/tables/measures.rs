//! Injury measures as tables.

use crash_measures::injury::{Judgement, Measure};
use occupant_core::model::setup::STANDARD_GRAVITY_M_S2;
use occupant_units::unit::Unit;

use super::summary::Marks;
use crate::base::Units;
use crate::base::text_table::Align::{Left, Right};
use crate::base::text_table::{self, NONE, Table};

/// Remarks on measures, one line for all measures with the same remark.
pub(crate) fn remarks(measures: &[Measure]) -> String {
    let mut remarks: Vec<(&str, Vec<&str>)> = Vec::new();
    for (label, remark) in measures.iter().filter_map(|m| Some((m.label, m.remark.as_ref()?))) {
        match remarks.iter_mut().find(|known| known.0 == remark) {
            Some((_, labels)) => labels.push(label),
            None => remarks.push((remark, vec![label])),
        }
    }
    remarks.iter().map(|(remark, labels)| format!("{}: {remark}\n", labels.join(", "))).collect()
}

/// Injury risks, one line per curve; marked if the measure is marked or the curve contradicts another.
pub(crate) fn risks(measures: &[Measure], marks: &Marks) -> String {
    let rows = measures.iter().flat_map(|m| m.risks.iter().map(move |risk| (m, risk))).map(|(m, risk)| {
        let mark = if risk.agrees && !marks.spoils(m.figure.unwrap_or(m.name)) { " " } else { "!" };
        [risk.injury.to_owned(), m.label.to_owned(), text_table::number(100.0 * risk.probability, 1) + mark]
    });
    text_table::table(&[(Left, &["injury", "from"]), (Right, &["risk, %"])], rows)
}

/// Measures with one line per limit. Without `verdicts`, as for a person, limits are yardsticks.
pub(crate) fn table<'m>(
    measures: impl IntoIterator<Item = &'m Measure>,
    marks: &Marks,
    units: Units,
    verdicts: bool,
) -> String {
    let mut table = Table::new(&[
        (Left, &["injury measure"]),
        (Right, &["value"]),
        (Left, &["unit"]),
        (Right, &["at, ms", "limit"]),
        (Left, &["of"]),
        (Right, &["margin"]),
        (Left, &[""]),
    ]);
    for m in measures.into_iter().filter(|m| m.has_part()) {
        let value = m.value.map_or(NONE.to_owned(), |v| shown(m, v, units));
        let mut left = [m.label.to_owned(), marks.put(m.figure.unwrap_or(m.name), value), unit(m, units), at(m)];
        for i in 0..m.limits.len().max(1) {
            let right = m.limits.get(i).map(|limit| verdict(m, limit, units, verdicts)).unwrap_or_default();
            table.row(left.into_iter().chain(right));
            left = Default::default();
        }
    }
    table.text()
}

/// Measures of several runs, one column each; a value beyond a limit has a `>`; the lowest limit is shown.
pub(crate) fn side_by_side(runs: &[(&[Measure], &Marks)], units: Units) -> String {
    let numbers: Vec<String> = (1..=runs.len()).map(|number| number.to_string()).collect();
    let heads: Vec<&str> = numbers.iter().map(String::as_str).collect();
    let mut table = Table::new(&[(Left, &["injury measure", "unit"]), (Right, &["limit"]), (Right, &heads)]);
    let mut known: Vec<&Measure> = Vec::new();
    for m in runs.iter().flat_map(|(measures, _)| *measures).filter(|m| m.has_part()) {
        if !known.iter().any(|other| other.name == m.name) {
            known.push(m);
        }
    }
    for m in known {
        let least = m.limits.iter().map(|limit| limit.most).min_by(f64::total_cmp);
        let left = [m.label.to_owned(), unit(m, units), least.map(|most| shown(m, most, units)).unwrap_or_default()];
        let values = runs.iter().map(|(measures, marks)| {
            let Some(own) = measures.iter().find(|own| own.name == m.name) else { return NONE.to_owned() };
            let value = own.value.map_or(NONE.to_owned(), |v| shown(own, v, units));
            let beyond = if own.is_exceeded() { '>' } else { ' ' };
            marks.put(own.figure.unwrap_or(own.name), value) + &beyond.to_string()
        });
        table.row(left.into_iter().chain(values));
    }
    table.text()
}

fn verdict(m: &Measure, limit: &Judgement, units: Units, verdicts: bool) -> [String; 4] {
    [
        shown(m, limit.most, units),
        if verdicts { limit.rule.to_owned() } else { format!("a dummy, {}", limit.rule) },
        format!("{:+.0} %", 100.0 * limit.relative_margin),
        if !verdicts {
            ""
        } else if limit.passed {
            "passed"
        } else {
            "EXCEEDED"
        }
        .to_owned(),
    ]
}

fn at(m: &Measure) -> String {
    let ms = |t: f64| format!("{:.1}", t * 1e3);
    match (m.from_s, m.to_s) {
        (Some(from), Some(to)) => format!("{}–{}", ms(from), ms(to)),
        (Some(from), None) => ms(from),
        _ => String::new(),
    }
}

fn unit(m: &Measure, units: Units) -> String {
    match m.unit {
        Unit::MetrePerSecondSquared => "g".to_owned(),
        Unit::One => String::new(),
        unit => units.symbol(unit.symbol()),
    }
}

/// Value in the measure's unit; accelerations in g.
fn shown(m: &Measure, value: f64, units: Units) -> String {
    let number = |value, decimals| units.number(value, m.unit.symbol(), decimals);
    match m.unit {
        Unit::MetrePerSecondSquared => text_table::number(value / STANDARD_GRAVITY_M_S2, 1),
        Unit::Newton => number(value, 0),
        Unit::NewtonMetre => number(value, 1),
        _ if value.abs() < 10.0 => number(value, 3),
        _ => number(value, 1),
    }
}

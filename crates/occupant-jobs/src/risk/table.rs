//! The report as text, in the style of a test report: measures in SI and US units, limits, omissions.

use crash_measures::measure::limits::{Basis, Quantity};
use occupant_scenario::kind::UnitSystem;
use occupant_study::risk::{Judgement, Preparation, VerticalGravity};

use super::Report;
use super::figures::{Figure, Figures, Unit, deg, ft_s, g, km_h, m_s, mph, plain};
use super::subject::Source;
use crate::base::text_table::{Align, NONE, Table, facts, number};
use crate::files::history::family_name;

/// The report, in one system of units, or in SI with US units beside.
pub fn text(report: &Report, units: Option<UnitSystem>) -> String {
    let figures = Figures::of(report);
    let head = facts(&head(report));
    let mut parts = vec![head, measures(&figures, report, units)];
    if !report.judgements.is_empty() {
        parts.push(limits(&report.judgements, units));
        parts.extend(classes(report, units));
    }
    if !figures.left_out.is_empty() {
        let lines = figures.left_out.iter();
        let lines: String = lines.map(|l| format!("  {}: {}\n", l.measure, l.reason)).collect();
        parts.push(format!("left out\n{lines}"));
    }
    parts.join("\n")
}

/// Source and preparation of the motion.
pub(super) fn head(report: &Report) -> Vec<(&'static str, String)> {
    let (signals, preparation) = (&report.signals, &report.preparation);
    let [x, y, z] = preparation.offset_m;
    let place = match preparation.offset_m {
        [0.0, 0.0, 0.0] => "at the centre of gravity".to_owned(),
        _ => format!("({x}, {y}, {z}) m from the centre of gravity; transferred to it"),
    };
    let gravity = match (report.subject.source, preparation.gravity) {
        (Source::Recorded, VerticalGravity::Included) => "in az: 1 g is added",
        (Source::Recorded, VerticalGravity::Removed) => "assumed not in the accelerations",
        _ => "not in the accelerations",
    };
    let flight = &report.flight;
    let zero = match preparation.baseline_s {
        [None, _] => "unchanged".to_owned(),
        [Some(start_s), None] => format!("minus the mean of the first {} ms", 1e3 * start_s),
        [Some(start_s), Some(end_s)] => {
            format!(
                "minus a straight line from the mean of the first {} ms to that of the last {} ms",
                1e3 * start_s,
                1e3 * end_s
            )
        }
    };
    let mut facts = vec![
        ("vehicle", format!("{} ({})", report.subject.name, source_name(report))),
        (
            "record",
            format!(
                "{} samples, {:.0} a second, {:.4} s to {:.4} s; first contact at {:.4} s",
                signals.samples(),
                1.0 / signals.dt_s,
                signals.start_s,
                signals.end_s(),
                signals.start_s
            ),
        ),
        ("filter", filter_name(preparation).unwrap_or_else(|| "none: assumed to be filtered already".to_owned())),
        ("sensors", place),
        ("zero", zero),
        ("gravity", gravity.to_owned()),
        (
            "occupant",
            format!(
                "flail distance {} m forward and back, {} m to each side; THIV head {} m ahead of the centre of gravity",
                flight.distances.longitudinal_m, flight.distances.lateral_m, flight.head.start_x_m
            ),
        ),
        (
            "signs",
            "x forward, y right, z down (SAE J211, J670); OIV, THIV, PHD as magnitudes; roll right side down, pitch nose up, yaw right"
                .to_owned(),
        ),
    ];
    if report.subject.source != Source::Recorded {
        facts.retain(|(name, _)| *name != "zero");
    }
    facts.extend(report.intervals.as_ref().map(|intervals| ("intervals", intervals.words())));
    facts
}

/// Class and coefficients of the filter.
pub fn filter_name(preparation: &Preparation) -> Option<String> {
    let (class, family) = preparation.filter?;
    Some(format!("CFC {:.0}, {}", class.hertz(), family_name(family)))
}

/// Source of the motion, as text.
pub fn source_name(report: &Report) -> &'static str {
    match report.subject.source {
        Source::Recorded => "recorded",
        Source::Path => "path of a scenario, sampled",
        Source::PathOfStraightLines => {
            "path of a scenario with straight lines between stations: the velocity jumps at each, so the results depend on the filter"
        }
    }
}

/// Display units of a figure.
pub(super) fn told(figure: &Figure, units: Option<UnitSystem>) -> Vec<Unit> {
    let [si, us] = figure.units;
    match units {
        _ if si == us => vec![si],
        None => vec![si, us],
        Some(UnitSystem::Si) => vec![si],
        Some(UnitSystem::InchPound) if si == g() => vec![si],
        Some(UnitSystem::InchPound) if si == km_h() => vec![mph()],
        Some(UnitSystem::InchPound) => vec![us],
    }
}

/// Time and remark.
pub(super) fn about(figure: &Figure) -> [String; 2] {
    let times: Vec<String> = figure.when_s.iter().map(|t| format!("{t:.4}")).collect();
    [times.join(" – "), figure.remark.to_owned()]
}

fn measures(figures: &Figures, report: &Report, units: Option<UnitSystem>) -> String {
    let mut heads = vec![(Align::Left, &["measure"][..]), (Align::Right, &["value"]), (Align::Left, &["unit"])];
    if report.intervals.is_some() {
        heads.push((Align::Right, &["95 % from", "to"]));
    }
    if units.is_none() {
        heads.extend([(Align::Right, &["or"][..]), (Align::Left, &["unit"])]);
    }
    heads.push((Align::Left, &["time, s", ""]));
    let mut table = Table::new(&heads);
    for figure in &figures.figures {
        let told = told(figure, units);
        let mut cells = vec![figure.name.clone(), shown(figure.value, told[0]), told[0].0.symbol()];
        if let Some(intervals) = &report.intervals {
            let ends = intervals.of_key(&figure.key).map(|ends| ends.map(|si| shown(si, told[0])));
            cells.extend(ends.unwrap_or_else(|| [NONE.to_owned(), NONE.to_owned()]));
        }
        if units.is_none() {
            let other = told.get(1).map(|unit| [shown(figure.value, *unit), unit.0.symbol()]);
            cells.extend(other.unwrap_or_default());
        }
        table.row(cells.into_iter().chain(about(figure)));
    }
    table.text()
}

pub(super) fn shown(si: f64, (unit, decimals): Unit) -> String {
    // minus zero is zero
    let text = number(si / unit.si, decimals);
    match text.trim_start_matches(['-', '0', '.']) {
        "" => text.trim_start_matches('-').to_owned(),
        _ => text,
    }
}

fn limits(judgements: &[Judgement], units: Option<UnitSystem>) -> String {
    let mut table = Table::new(&[
        (Align::Left, &["rule", "measure", "limit"]),
        (Align::Right, &["at most", "value", "margin"]),
        (Align::Left, &["unit", "verdict"]),
    ]);
    // where limits were read, a mark for each such place
    let mut read_in: Vec<&str> = Vec::new();
    for judgement in judgements {
        let unit = unit_of(judgement.limit.quantity, units);
        let perhaps = |si: Option<f64>| si.map_or(NONE.to_owned(), |si| shown(si, unit));
        table.row([
            judgement.limit.rule.name().to_owned(),
            judgement.measure.to_owned(),
            judgement.limit.grade.name().to_owned(),
            shown(judgement.limit.most, unit) + mark(basis_name(judgement.limit.basis), &mut read_in),
            perhaps(judgement.value),
            perhaps(judgement.verdict.map(|v| v.margin)),
            unit.0.symbol(),
            verdict_name(judgement).to_owned(),
        ]);
    }
    let notes = read_in.iter().zip(MARKS).map(|(words, mark)| format!("{mark} limit from {words}\n"));
    let sources = documents(judgements).into_iter().map(|(rules, document)| format!("{rules}: {document}\n"));
    table.text() + &notes.chain(sources).collect::<String>()
}

/// Document of each rule, grouped.
pub(super) fn documents(judgements: &[Judgement]) -> Vec<(String, &'static str)> {
    let mut all: Vec<(Vec<&str>, &str)> = Vec::new();
    for rule in judgements.iter().map(|judgement| judgement.limit.rule) {
        match all.iter_mut().find(|(_, document)| *document == rule.document()) {
            None => all.push((vec![rule.name()], rule.document())),
            Some((names, _)) if !names.contains(&rule.name()) => names.push(rule.name()),
            Some(_) => {}
        }
    }
    all.into_iter().map(|(names, document)| (names.join(", "), document)).collect()
}

/// Class or level for each rule that has any.
fn classes(report: &Report, units: Option<UnitSystem>) -> Option<String> {
    let mut table = Table::new(&[(Align::Left, &["rule", "class or level", "by"])]);
    let classes = report.classes(units);
    classes.iter().for_each(|(rule, class, why)| table.row([*rule, class.unwrap_or("none"), why].map(str::to_owned)));
    (!classes.is_empty()).then(|| table.text())
}

/// Marks of footnotes.
const MARKS: [&str; 2] = ["¹", "²"];

/// Footnote mark for a text, which is added to the list.
fn mark<'a>(words: &'a str, known: &mut Vec<&'a str>) -> &'static str {
    let at = known.iter().position(|own| *own == words).unwrap_or_else(|| {
        known.push(words);
        known.len() - 1
    });
    MARKS.get(at).copied().unwrap_or_default()
}

/// The unit of a limit.
pub(super) fn unit_of(quantity: Quantity, units: Option<UnitSystem>) -> Unit {
    let is_us = units == Some(UnitSystem::InchPound);
    match quantity {
        Quantity::OccupantImpactVelocity | Quantity::LongitudinalImpactVelocity if is_us => ft_s(),
        Quantity::OccupantImpactVelocity | Quantity::LongitudinalImpactVelocity => m_s(),
        Quantity::Thiv if is_us => mph(),
        Quantity::Thiv => km_h(),
        Quantity::RidedownAcceleration | Quantity::Phd => g(),
        Quantity::Roll | Quantity::Pitch => deg(),
        _ => plain(),
    }
}

/// Source of a limit, as text.
pub fn basis_name(basis: Basis) -> &'static str {
    match basis {
        Basis::SecondarySource => "a source that quotes the rule",
        Basis::CommonKnowledge => "memory, not from the rule",
    }
}

/// The verdict in a word.
pub fn verdict_name(judgement: &Judgement) -> &'static str {
    match judgement.verdict {
        None => "not measured",
        Some(verdict) if verdict.passed => "pass",
        Some(_) if judgement.breaks_the_rule() => "FAIL",
        Some(_) => "exceeded",
    }
}

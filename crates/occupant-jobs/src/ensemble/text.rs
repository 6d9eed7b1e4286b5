//! An ensemble as text: changes, stable figures, times at which the members diverge.

use occupant_study::Tolerances;
use occupant_study::spread::Verdict;

use super::{Failed, Judged, Report};
use crate::base::Units;
use crate::base::text_table::Align::{Left, Right};
use crate::base::text_table::{NONE, Table, facts, number, trimmed};

/// Figures always shown in the table, besides belts.
const ALWAYS: [&str; 17] = [
    "head.peak",
    "head.three_ms_contiguous",
    "head.three_ms_cumulative",
    "chest.peak",
    "chest.three_ms_cumulative",
    "pelvis.peak",
    "contacts.head.peak",
    "contacts.chest.peak",
    "contacts.right_knee.peak",
    "contacts.left_knee.peak",
    "head_excursion.forward",
    "hic15",
    "hic36",
    "nij",
    "neck_tension",
    "right_femur",
    "left_femur",
];
/// Number of failed members named.
const NAMED: usize = 3;
/// Number of figures named that are not in the table.
const LISTED: usize = 12;
/// Least number of members for a verdict.
const ENOUGH: u64 = 10;

/// Report of an ensemble for the terminal.
pub fn text(report: &Report, units: Units) -> String {
    let mut parts = vec![what(report, units), figure_table(&report.figures, units)];
    if !report.bands.channels.is_empty() {
        parts.push(channels(report, units));
    }
    parts.push(conclusion(report));
    let quoted = report.quotes.iter().filter(|quote| report.quote.contains(&quote.figure));
    parts.extend(quoted.map(|quote| format!("{}\n", quote.paragraph)));
    parts.join("\n")
}

fn what(report: &Report, units: Units) -> String {
    let failed = report.failed.len();
    let mut ended = format!("{} runs, the unchanged one included", report.members);
    if failed > 0 {
        ended += &format!("; {failed} FAILED, so no result of this ensemble counts as stable");
    }
    let mut lines = vec![("ensemble", ended)];
    for Failed { member, reason } in report.failed.iter().take(NAMED) {
        lines.push(("", format!("member {member}: {reason}")));
    }
    lines.push(("changed by up to", changes(&report.changes, Some(report.seed), units)));
    lines.extend(report.inputs.iter().map(|input| ("drawn", input.clone())));
    lines.push((
        "stable",
        format!(
            "the middle 90 % of the runs span at most {} % of the median, or less than matters in practice",
            percent(report.within)
        ),
    ));
    facts(&lines)
}

/// The changes in words, with the seed.
pub fn changes(most: &Tolerances, seed: Option<u64>, units: Units) -> String {
    let segments = (most.segments > 0.0).then(|| format!(", {} % of each segment", percent(most.segments)));
    let (per, unit) = units.told("m").shown;
    let place = format!("{} {unit}", trimmed(most.place_m / per, 3));
    format!(
        "{}° in each angle, {} in position, {} % of the pulse, {} % of each stiffness{}{}",
        trimmed(most.posture_rad.to_degrees(), 3),
        place,
        percent(most.path),
        percent(most.stiffness),
        segments.unwrap_or_default(),
        seed.map(|seed| format!(" (seed {seed})")).unwrap_or_default()
    )
}

fn percent(part: f64) -> String {
    trimmed(100.0 * part, 3)
}

/// Table of the shown figures.
pub fn figure_table(figures: &[Judged], units: Units) -> String {
    let mut table =
        Table::new(&[(Left, &["figure"]), (Right, &["unchanged", "median", "5 %", "95 %"]), (Left, &["", ""])]);
    for figure in figures.iter().filter(|f| is_shown(&f.name)) {
        let (s, (per, unit)) = (&figure.spread, units.told(&figure.unit).shown);
        let shown = |x: f64| number(x / per, decimals(s.median / per));
        let verdict = match (figure.verdict, s.missing) {
            (Verdict::Stable, _) => "stable".to_owned(),
            (Verdict::NotStable, 0) => "NOT STABLE".to_owned(),
            (Verdict::NotStable, n) => format!("NOT STABLE ({n} members have none)"),
            (Verdict::TooFew, _) => "too few members".to_owned(),
        };
        let unchanged = figure.nominal.map_or(NONE.to_owned(), shown);
        let [median, q05, q95] = [s.median, s.q05, s.q95].map(shown);
        table.row([figure.name.clone(), unchanged, median, q05, q95, unit, verdict]);
    }
    table.text()
}

/// Two values of a figure in display units, and the unit.
pub fn ranged(values: [f64; 2], unit: &str, units: Units) -> ([String; 2], String) {
    let (per, unit) = units.told(unit).shown;
    let greatest = values.iter().fold(0.0_f64, |m, x| m.max((x / per).abs()));
    (values.map(|x| number(x / per, decimals(greatest))), unit)
}

fn decimals(size: f64) -> usize {
    match size.abs() {
        x if x >= 1000.0 => 0,
        x if x >= 10.0 => 1,
        _ => 3,
    }
}

fn channels(report: &Report, units: Units) -> String {
    let mut table = Table::new(&[
        (Left, &["channel"]),
        (Right, &["runs diverge at, ms", "by more than", "widest", "at, ms"]),
        (Left, &[""]),
    ]);
    let ms = |t: f64| format!("{:.1}", t * 1e3);
    for band in &report.bands.channels {
        let (per, unit) = units.told(band.unit).shown;
        let size = |x: f64| number(x / per, decimals(x / per));
        table.row([
            band.name.clone(),
            band.lost_at_s.map_or("never".to_owned(), ms),
            size(band.tolerance),
            band.widest.map_or(NONE.to_owned(), size),
            band.widest_at_s.map_or(NONE.to_owned(), ms),
            unit,
        ]);
    }
    table.text()
}

fn conclusion(report: &Report) -> String {
    let (unstable, all) = (report.unstable(), report.figures.len());
    if report.members < ENOUGH {
        return format!("{} runs are too few for a verdict: use {ENOUGH} or more\n", report.members);
    }
    if unstable.is_empty() {
        return format!("all {all} results are stable\n");
    }
    let mut more: Vec<&str> = unstable.iter().copied().filter(|name| !is_shown(name)).collect();
    if more.len() > LISTED {
        more.truncate(LISTED);
        more.push("… (--json has all)");
    }
    let besides = if more.is_empty() { String::new() } else { format!("; others: {}", more.join(", ")) };
    format!("NOT STABLE: {} of {all} results{besides}\n", unstable.len())
}

/// Whether the tables show a figure, of a single occupant or of one of several.
pub fn is_shown(name: &str) -> bool {
    let is_belt = ["belts.", "straps."].iter().any(|kind| name.starts_with(kind));
    let of_one = name.split_once('.').filter(|(kind, _)| *kind != "contacts").map_or(name, |(_, figure)| figure);
    (is_belt && name.ends_with(".peak")) || ALWAYS.contains(&name) || ALWAYS.contains(&of_one)
}

#[cfg(test)]
mod tests {
    use super::is_shown;

    #[test]
    fn figures_of_several_occupants_are_shown_as_those_of_one() {
        assert!(["hic15", "driver.hic15", "rear.head.peak", "straps.driver_belt_sill.peak"].into_iter().all(is_shown));
        assert!(!["contacts.pelvis.peak", "driver.hic15_time", "rear.csi"].into_iter().any(is_shown));
    }
}

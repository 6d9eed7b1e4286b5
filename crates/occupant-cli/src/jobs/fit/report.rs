//! What a fit says at its end.

use occupant_study::ApplyChoice;

use super::fitting::Fitting;
use super::found::{COMPENSATING, Found, ParameterFound};
use super::verdict::Verdict;
use crate::base::text_table::Align::{Left, Right};
use crate::base::text_table::{NONE, Table, facts};

/// Tables of parameters and channels.
pub(crate) fn text(fitting: &Fitting, found: &Found) -> String {
    let mut parts = vec![overview(found), parameters(fitting, found)];
    let pairs = compensating(fitting, found);
    if !pairs.is_empty() {
        parts.push(pairs);
    }
    parts.push(channels(found));
    parts.join("\n")
}

fn overview(found: &Found) -> String {
    let e = &found.evaluations;
    let before = found.score.before.map_or(NONE.to_owned(), |b| format!("{b:.5}"));
    let tests: Vec<&str> = found.tests.iter().map(|t| t.file.as_str()).collect();
    let mut lines = vec![
        ("fit", format!("{} to {}", found.study.file, tests.join(", "))),
        (
            "score",
            format!("{:.5} ({}), before {before}; 0 is a run that is the test", found.score.after, found.objective),
        ),
        (
            "evaluations",
            format!(
                "{} of the search in {} descents, {} of the refinement, {} for the intervals",
                e.search,
                found.descents.len(),
                e.refinement,
                e.intervals
            ),
        ),
        ("as good", format!("scores up to {:.5} ({})", found.near.score, found.near.near.by)),
    ];
    for warning in &found.warnings {
        lines.push(("warning", warning.clone()));
    }
    facts(&lines)
}

/// In which unit the values of a parameter are shown, and how many SI units it is: that of its place.
pub(crate) fn unit_of(fitting: &Fitting, i: usize) -> (String, f64) {
    let parameter = &fitting.parameters()[i];
    let base = fitting.experiments[0].study.base();
    let place = parameter.targets.first();
    match parameter.apply {
        ApplyChoice::Factor => (String::new(), 1.0),
        ApplyChoice::Value | ApplyChoice::Offset => {
            place.and_then(|t| base.unit_at(&t.path)).unwrap_or((parameter.unit.to_owned(), 1.0))
        }
    }
}

/// A number with five significant digits.
pub(crate) fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.4e}").parse().unwrap_or(value);
    rounded.to_string()
}

fn parameters(fitting: &Fitting, found: &Found) -> String {
    let mut table = Table::new(&[
        ("parameter", Left),
        ("unit", Left),
        ("base", Right),
        ("fitted", Right),
        ("interval", Right),
        ("looked for", Right),
        ("", Left),
    ]);
    for (i, p) in found.parameters.iter().enumerate() {
        let (unit, si) = unit_of(fitting, i);
        let unit = match (p.apply, unit.as_str()) {
            (ApplyChoice::Factor, _) => "×".to_owned(),
            (_, "") => NONE.to_owned(),
            (_, unit) => unit.to_owned(),
        };
        let from_to = |[a, b]: [f64; 2]| format!("{} to {}", short(a / si), short(b / si));
        table.row([
            p.name.clone(),
            unit,
            p.base.map_or(NONE.to_owned(), |b| short(b / si)),
            short(p.value / si),
            from_to(p.interval),
            from_to(p.bounds),
            p.words.clone(),
        ]);
    }
    table.text()
}

/// Pairs that make up for each other, and how far.
fn compensating(fitting: &Fitting, found: &Found) -> String {
    let mut lines = Vec::new();
    for pair in found.correlations.iter().filter(|c| c.correlation.abs() > COMPENSATING) {
        let [a, b] = &pair.between;
        let place = |name: &String| found.parameters.iter().position(|p| p.name == *name);
        let (Some(i), Some(j)) = (place(a), place(b)) else {
            continue;
        };
        let [low, high] = &found.parameters[i].ends;
        let value = |end: &super::found::EndFound, at: usize| {
            let (unit, si) = unit_of(fitting, at);
            format!("{} {unit}", short(end.values[at] / si)).trim().to_owned()
        };
        lines.push(format!(
            "{a} and {b} compensate each other (correlation {:.3}): {} with {} scores {:.5}, {} with {} scores {:.5}\n",
            pair.correlation,
            value(low, i),
            value(low, j),
            low.score,
            value(high, i),
            value(high, j),
            high.score,
        ));
    }
    lines.concat()
}

fn channels(found: &Found) -> String {
    let mut table = Table::new(&[
        ("test", Left),
        ("channel", Left),
        ("filter", Left),
        ("ms", Right),
        ("weight", Right),
        ("before", Right),
        ("fitted", Right),
    ]);
    for c in &found.score.channels {
        let [from, to] = c.window_s.map(|t| short(t * 1e3));
        table.row([
            c.test.clone(),
            c.channel.clone(),
            c.filter.clone(),
            format!("{from} to {to}"),
            short(c.weight),
            c.before.map_or(NONE.to_owned(), |b| format!("{b:.4}")),
            format!("{:.4}", c.after),
        ]);
    }
    table.text()
}

/// What is said of a fitted number in the scenario.
pub(crate) fn provenance(fitting: &Fitting, found: &Found, p: &ParameterFound, i: usize) -> String {
    let (unit, si) = unit_of(fitting, i);
    let with_unit = |text: String| format!("{text} {unit}").trim().to_owned();
    let [low, high] = p.interval.map(|x| short(x / si));
    let factor = match p.apply {
        ApplyChoice::Value => String::new(),
        ApplyChoice::Factor => format!(" (times {} what the base scenario says)", short(p.value)),
        ApplyChoice::Offset => format!(" ({} added to what the base scenario says)", with_unit(short(p.value / si))),
    };
    let interval = match p.verdict {
        Verdict::NotIdentified => {
            format!("{}; any value of {} is as good", p.words, with_unit(format!("{low} to {high}")))
        }
        _ => format!("{}, interval {}", p.words, with_unit(format!("{low} to {high}"))),
    };
    let tests = found.tests.iter();
    let tests: Vec<String> = tests.map(|t| format!("{} (SHA-256 {})", t.file, t.sha256)).collect();
    format!(
        "fitted by {}{factor}: parameter {} of {} (SHA-256 {}…) to {}; {} score {:.5}; {interval}",
        found.program,
        p.name,
        found.study.file,
        start(&found.study.sha256),
        tests.join(", "),
        found.objective,
        found.score.after,
    )
}

/// So much of a checksum as tells files apart; fit.json has the whole.
fn start(sha256: &str) -> &str {
    sha256.get(..16).unwrap_or(sha256)
}

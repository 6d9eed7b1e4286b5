//! Report of a finished fit.

use occupant_study::ApplyChoice;

use super::{COMPENSATING, FitResult, IntervalEnd, ParameterEstimate, Verdict};
use crate::base::text_table::Align::{Left, Right};
use crate::base::text_table::{NONE, Table, facts};

/// Tables of parameters and channels.
pub fn text(result: &FitResult) -> String {
    let mut parts = vec![overview(result), parameters(result)];
    let pairs = compensating(result);
    if !pairs.is_empty() {
        parts.push(pairs);
    }
    parts.push(channels(result));
    parts.join("\n")
}

fn overview(result: &FitResult) -> String {
    let e = &result.evaluations;
    let before = result.score.before.map_or(NONE.to_owned(), |b| format!("{b:.5}"));
    let tests: Vec<&str> = result.tests.iter().map(|t| t.file.as_str()).collect();
    let mut lines = vec![
        ("fit", format!("{} to {}", result.study.file, tests.join(", "))),
        ("score", format!("{:.5} ({}), before {before}; 0 is a perfect match", result.score.after, result.objective)),
        (
            "evaluations",
            format!(
                "{} in the search ({} descents), {} in the refinement, {} for the intervals",
                e.search,
                result.descents.len(),
                e.refinement,
                e.intervals
            ),
        ),
        ("as good", format!("scores up to {:.5} ({})", result.near.score, result.near.near.by)),
    ];
    for warning in &result.warnings {
        let note = warning.strip_prefix("note: ");
        lines.push((note.map_or("warning", |_| "note"), note.unwrap_or(warning).to_owned()));
    }
    facts(&lines)
}

impl ParameterEstimate {
    /// A value in its display unit.
    fn number(&self, si: f64) -> String {
        short(si / self.shown.1)
    }

    /// The same with the unit.
    fn with_unit(&self, text: &str) -> String {
        format!("{text} {}", self.shown.0).trim().to_owned()
    }

    fn range(&self, ends: [f64; 2]) -> String {
        let [low, high] = ends.map(|si| self.number(si));
        format!("{low} to {high}")
    }
}

/// A number with five significant digits.
pub fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.4e}").parse().unwrap_or(value);
    rounded.to_string()
}

fn parameters(result: &FitResult) -> String {
    let mut table = Table::new(&[
        (Left, &["parameter", "unit"]),
        (Right, &["base", "fitted", "interval", "bounds"]),
        (Left, &[""]),
    ]);
    for p in &result.parameters {
        let unit = match (p.apply, p.shown.0.as_str()) {
            (ApplyChoice::Factor, _) => "×",
            (_, "") => NONE,
            (_, unit) => unit,
        };
        table.row([
            p.name.clone(),
            unit.to_owned(),
            p.base.map_or(NONE.to_owned(), |b| p.number(b)),
            p.number(p.value),
            p.range(p.interval),
            p.range(p.bounds),
            p.words.clone(),
        ]);
    }
    table.text()
}

/// Pairs of parameters that compensate each other, with their correlation.
fn compensating(result: &FitResult) -> String {
    let mut lines = Vec::new();
    for pair in result.correlations.iter().filter(|c| c.correlation.abs() > COMPENSATING) {
        let [a, b] = &pair.between;
        let place = |name: &String| result.parameters.iter().position(|p| p.name == *name);
        let (Some(i), Some(j)) = (place(a), place(b)) else {
            continue;
        };
        let end = |end: &IntervalEnd| {
            let [one, other] = [i, j].map(|at| {
                let p = &result.parameters[at];
                p.with_unit(&p.number(end.values[at]))
            });
            format!("{one} with {other} scores {:.5}", end.score)
        };
        let [low, high] = result.parameters[i].ends.each_ref().map(end);
        let correlation = pair.correlation;
        lines.push(format!("{a} and {b} compensate each other (correlation {correlation:.3}): {low}, {high}\n"));
    }
    lines.concat()
}

fn channels(result: &FitResult) -> String {
    let mut table =
        Table::new(&[(Left, &["test", "channel", "filter"]), (Right, &["ms", "weight", "before", "fitted"])]);
    for c in &result.score.channels {
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

/// Provenance text of a fitted value in the scenario.
pub fn provenance(result: &FitResult, p: &ParameterEstimate) -> String {
    let factor = match p.apply {
        ApplyChoice::Value => String::new(),
        ApplyChoice::Factor => format!(" (times {} the base scenario)", short(p.value)),
        ApplyChoice::Offset => {
            format!(" ({} added to the base scenario)", p.with_unit(&p.number(p.value)))
        }
    };
    let range = p.with_unit(&p.range(p.interval));
    let interval = match p.verdict {
        Verdict::NotIdentified => format!("{}; any value in {range} is as good", p.words),
        _ => format!("{}, interval {range}", p.words),
    };
    let tests = result.tests.iter();
    let tests: Vec<String> = tests.map(|t| format!("{} (SHA-256 {})", t.file, t.sha256)).collect();
    format!(
        "fitted by {}{factor}: parameter {} of {} (SHA-256 {}…) to {}; {} score {:.5}; {interval}",
        result.program,
        p.name,
        result.study.file,
        start(&result.study.sha256),
        tests.join(", "),
        result.objective,
        result.score.after,
    )
}

/// Start of a checksum, enough to distinguish files; fit.json has it all.
fn start(sha256: &str) -> &str {
    sha256.get(..16).unwrap_or(sha256)
}

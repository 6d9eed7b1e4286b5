//! The report of a finished optimisation on a terminal, and words that the page shares.

use occupant_study::ApplyChoice;

use super::Optimum;
use super::result::{LimitKept, Neighbour, Pair, Tuned};
use crate::base::Units;
use crate::base::text_table::Align::{Left, Right};
use crate::base::text_table::{NONE, facts, table};
use crate::fit::report::short;

/// Tables of measures and parameters.
pub fn text(result: &Optimum) -> String {
    let mut lines = head(result);
    for warning in &result.warnings {
        let note = warning.strip_prefix("note: ");
        lines.push((note.map_or("warning", |_| "note"), note.unwrap_or(warning).to_owned()));
    }
    let heads = [(Left, &["measure"][..]), (Right, &["base", "optimum"]), (Left, &["unit", "wanted"])];
    let measures = table(&heads, measures(result));
    let heads = [
        (Left, &["parameter", "unit"][..]),
        (Right, &["base", "optimum", "bounds"]),
        (Left, &["2 % of the range below", "above"]),
    ];
    format!("{}\n{measures}\n{}", facts(&lines), table(&heads, parameters(result)))
}

/// What was optimised, and how.
pub fn head(result: &Optimum) -> Vec<(&'static str, String)> {
    let before = result.goal.before.map_or(NONE.to_owned(), short);
    let c = &result.candidates;
    let runs = if result.members > 1 { format!(" of {} runs each", result.members) } else { String::new() };
    let mut parts = vec![format!("{} in the search, {} neighbours{runs}", c.search, c.neighbours)];
    for (n, what) in [(c.beyond, "beyond a limit"), (c.with_caveats, "with caveats"), (c.failed, "not run")] {
        if n > 0 {
            parts.push(format!("{n} {what}"));
        }
    }
    let mut lines = vec![
        ("optimum", format!("{} of {}", result.study.file, result.scenario)),
        ("goal", format!("{}, before {before}", short(result.goal.after))),
        ("candidates", parts.join("; ")),
    ];
    if !result.front.is_empty() {
        lines.push(("front", format!("{} candidates: report.html, optimum.json", result.front.len())));
    }
    lines
}

/// A row for each measure of the goal and for each limit: name, base, optimum, unit, what is wanted of it.
pub fn measures(result: &Optimum) -> Vec<[String; 5]> {
    let row = |name: &String, unit: &str, values: Pair, wanted: &dyn Fn(f64, &str) -> String| {
        let (per, symbol) = Units::default().told(unit).shown;
        let before = values.before.map_or(NONE.to_owned(), |x| short(x / per));
        let symbol = if symbol.is_empty() { NONE.to_owned() } else { symbol };
        [name.clone(), before, short(values.after / per), symbol.clone(), wanted(per, &symbol)]
    };
    let goals = result.goals.iter().map(|g| {
        let word = if g.is_maximised { "maximised" } else { "minimised" };
        row(&g.measure, g.unit, g.values, &|per, _| match result.goals.len() {
            1 => word.to_owned(),
            _ => format!("{word}, weight {}, per {}", short(g.weight), short(g.per / per)),
        })
    });
    let limits = result.constraints.iter().map(|l| row(&l.measure, l.unit, l.values, &|per, _| wanted(l, per)));
    goals.chain(limits).collect()
}

fn wanted(limit: &LimitKept, per: f64) -> String {
    let side = if limit.is_floor { "at least" } else { "at most" };
    let remark = match limit.margin {
        m if m < 0.0 => ", exceeded",
        _ if limit.is_active => ", active",
        _ => "",
    };
    format!("{side} {}{remark}", short(limit.limit / per))
}

/// A row for each parameter: name, unit, base, optimum, bounds, and what its neighbours show.
pub fn parameters(result: &Optimum) -> Vec<[String; 7]> {
    let row = |p: &Tuned| {
        let number = |si: f64| short(si / p.shown.1);
        let unit = match (p.apply, p.shown.0.as_str()) {
            (ApplyChoice::Factor, _) => "×",
            (_, "") => NONE,
            (_, unit) => unit,
        };
        let [below, above] = p.neighbours.each_ref().map(|n| n.as_ref().map(|n| neighbour(result, n)));
        let end = |side| if p.at_bound == Some(side) { "at its bound" } else { NONE }.to_owned();
        [
            p.name.clone(),
            unit.to_owned(),
            p.base.map_or(NONE.to_owned(), number),
            number(p.value),
            format!("{} to {}", number(p.bounds[0]), number(p.bounds[1])),
            below.unwrap_or_else(|| end("lower")),
            above.unwrap_or_else(|| end("upper")),
        ]
    };
    result.parameters.iter().map(row).collect()
}

/// Change of the goal at a neighbour, and why it does not win.
fn neighbour(result: &Optimum, of: &Neighbour) -> String {
    let Some(goal) = of.goal else { return "not run".to_owned() };
    let change = 100.0 * (goal - result.goal.after) / result.goal.after.abs().max(1e-12);
    let mut words = format!("{change:+.2} %");
    if !of.beyond.is_empty() {
        words += &format!(", beyond {}", of.beyond.join(" and "));
    }
    if of.has_caveats {
        words += ", caveats";
    }
    words
}

/// Provenance text of a value in the scenario that is written.
pub fn provenance(result: &Optimum, p: &Tuned) -> String {
    let number = |si: f64| format!("{} {}", short(si / p.shown.1), p.shown.0).trim().to_owned();
    let how = match p.apply {
        ApplyChoice::Value => String::new(),
        ApplyChoice::Factor => format!(" (times {} the base scenario)", short(p.value)),
        ApplyChoice::Offset => format!(" ({} added to the base scenario)", number(p.value)),
    };
    let goals: Vec<String> = result.goals.iter().map(|g| g.measure.clone()).collect();
    format!(
        "optimised by {}{how}: parameter {} of {} (SHA-256 {}…) for {}; between {} and {}",
        result.program,
        p.name,
        result.study.file,
        result.study.sha256.get(..16).unwrap_or_default(),
        goals.join(" and "),
        number(p.bounds[0]),
        number(p.bounds[1]),
    )
}

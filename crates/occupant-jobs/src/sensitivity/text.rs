//! The answer as text: a table of derivatives, how far they hold, and where the run is not smooth.

use occupant_core::model::Model;
use occupant_study::sensitivity::events::{Change, Event, Happening, Touching};
use occupant_study::sensitivity::verdict::{HOLDS, Verdict, Why};

use super::analysis::{Analysis, Asked, relative};
use super::units::per;
use crate::base::Units;
use crate::base::text_table::{Align, NONE, Table, facts, trimmed};

/// Difference of two extrapolations of the vehicle's motion that counts as a kink.
const KINK: f64 = 1e-2;
/// Largest number of events listed.
const LISTED: usize = 30;

/// The whole answer.
pub fn text(model: &Model, asked: &Asked<'_>, analysis: &Analysis, units: Units) -> String {
    let mut text = heading(model, asked, analysis);
    if !asked.request.figures.is_empty() {
        text.push('\n');
        text.push_str(&table(asked, analysis, units));
        text.push_str(&format!(
            "\nrelative: % of the measure per % of the parameter. holds: the largest difference between the derivative and the\n\
             slopes of full runs with changes to both sides, at a hundredth of the tolerances; above {} % the derivative does\n\
             not hold. straight: the range over which a straight line holds as well.\n",
            100.0 * HOLDS
        ));
        text.push_str(&reasons(analysis));
    }
    text.push('\n');
    text.push_str(&events(model, &analysis.trajectory.events, units));
    if analysis.trajectory.dropped_events > 0 {
        text.push_str(&format!("and {} more\n", analysis.trajectory.dropped_events));
    }
    for note in analysis.built.iter().flat_map(|b| &b.notes) {
        text.push_str(&format!("note: {note}\n"));
    }
    for (parameter, built) in asked.parameters.iter().zip(&analysis.built) {
        if let Some((doubt, time_s)) = built.path_doubt().filter(|(doubt, _)| *doubt > KINK) {
            text.push_str(&format!(
                "note: {}: the vehicle's motion has a kink at this value (at {:.1} ms, by {:.0} %), so the two sides differ\n",
                parameter.name,
                time_s * 1e3,
                doubt * 100.0
            ));
        }
    }
    text
}

fn heading(model: &Model, asked: &Asked<'_>, analysis: &Analysis) -> String {
    let outcome = &analysis.trajectory.outcome;
    let worst = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0_f64, f64::max);
    let constants = worst(&mut analysis.built.iter().map(|b| b.doubt));
    let figures = analysis.derivatives.iter().flat_map(|d| &d.figures);
    let figures = worst(&mut figures.filter(|s| s.value != 0.0).map(|s| s.doubt / s.value.abs()));
    let mut accuracy = format!("initial state and constants to {constants:.0e}");
    if let Some((doubt, time_s)) =
        analysis.built.iter().filter_map(|b| b.path_doubt()).max_by(|a, b| a.0.total_cmp(&b.0))
    {
        accuracy.push_str(&format!(", the vehicle's motion to {doubt:.0e} (worst at {:.1} ms)", time_s * 1e3));
    }
    if !asked.request.figures.is_empty() {
        accuracy.push_str(&format!(", measures to {figures:.0e}"));
    }
    let [plain, dual] = analysis.cost_s;
    let tightly = if asked.request.channels.is_empty() { " at a hundredth of the tolerances" } else { "" };
    let count = match asked.parameters.len() {
        1 => "1 parameter".to_owned(),
        n => format!("{n} parameters"),
    };
    facts(&[
        ("scenario", model.setup().title.clone()),
        (
            "run",
            format!(
                "{} steps to {:.1} ms{tightly}; the run in dual numbers equals the plain run to the last bit",
                outcome.effort.steps,
                outcome.time_s * 1e3
            ),
        ),
        ("extrapolated", accuracy),
        ("cost", format!("{:.1} times the plain run, for {count}", dual / plain)),
    ])
}

fn table(asked: &Asked<'_>, analysis: &Analysis, units: Units) -> String {
    let mut table = Table::new(&[
        (Align::Left, &["measure"]),
        (Align::Right, &["value"]),
        (Align::Left, &["parameter"]),
        (Align::Right, &["value", "derivative"]),
        (Align::Left, &["unit"]),
        (Align::Right, &["relative"]),
        (Align::Left, &["holds"]),
    ]);
    for (i, measure) in asked.request.figures.iter().enumerate() {
        let (value, (per_value, unit)) = (analysis.values.figures[i], units.over(asked.units[i]));
        for (k, parameter) in asked.parameters.iter().enumerate() {
            let slope = analysis.derivatives[k].figures[i];
            let (per_parameter, by) = units.over(&parameter.unit);
            let relative = relative(slope.value, value, parameter.nominal);
            table.row([
                measure.clone(),
                with_unit(value / per_value, &unit),
                parameter.name.clone(),
                with_unit(parameter.nominal / per_parameter, &by),
                number(slope.value * per_parameter / per_value),
                per(&unit, &by),
                relative.map_or_else(|| NONE.to_owned(), |r| format!("{r:+.3}")),
                words(&analysis.comparisons[k][i].verdict, parameter.nominal == 0.0),
            ]);
        }
    }
    table.text()
}

/// Reasons why derivatives do not hold, each once.
fn reasons(analysis: &Analysis) -> String {
    let mut given: Vec<Why> = Vec::new();
    for comparison in analysis.comparisons.iter().flatten() {
        match comparison.verdict {
            Verdict::DoesNotHold { why, .. } if !given.contains(&why) => given.push(why),
            _ => {}
        }
    }
    given.iter().map(|why| format!("{}: {}\n", why.name(), why.words())).collect()
}

fn with_unit(value: f64, unit: &str) -> String {
    match unit {
        "1" | "" => number(value),
        _ => format!("{} {unit}", number(value)),
    }
}

/// A number with five digits.
fn number(value: f64) -> String {
    /// Least magnitudes for 0, 1, 2, … decimals.
    const LEAST: [f64; 7] = [1e4, 1e3, 1e2, 1e1, 1.0, 0.1, 0.01];
    match value.abs() {
        0.0 => format!("{value:.4}"),
        size if (1e-3..1e6).contains(&size) => {
            let decimals = LEAST.iter().position(|least| size >= *least).unwrap_or(LEAST.len());
            format!("{value:.decimals$}")
        }
        _ => format!("{value:.4e}"),
    }
}

fn words(verdict: &Verdict, of_zero: bool) -> String {
    // a parameter of 0 has no parts: its size stands for it
    let part = |part: f64| if of_zero { format!("{} of its size", percent(part)) } else { percent(part) };
    match *verdict {
        Verdict::Holds { off, up_to: 0.0 } => format!("within {}, but curved", percent(off)),
        Verdict::Holds { off, up_to } => format!("within {}, straight up to ±{}", percent(off), part(up_to)),
        Verdict::NoInfluence => "no influence".to_owned(),
        Verdict::DoesNotHold { at, why: why @ Why::NoRun, .. } => {
            format!("does not hold ({}): ±{}", why.name(), part(at))
        }
        Verdict::DoesNotHold { off, at, why } => {
            format!("does not hold ({}): {} off at ±{}", why.name(), percent(off), part(at))
        }
        Verdict::Unchecked => "not checked: no comparison run".to_owned(),
    }
}

/// A percentage with at least two digits.
fn percent(part: f64) -> String {
    let value = part * 100.0;
    match value {
        x if x >= 1000.0 => "> 1000 %".to_owned(),
        x if x >= 10.0 => format!("{x:.0} %"),
        x if x >= 0.995 => format!("{x:.1} %").replace(".0 %", " %"),
        x if x >= 0.0095 => format!("{} %", trimmed(x, 2)),
        _ => format!("{value:.0e} %"),
    }
}

/// Kinks of a force, which are counted, not listed, with their descriptions.
const MINOR: [(Touching, &str); 4] = [
    (Touching::Unloads, "springs of contacts unload"),
    (Touching::Reloads, "load again"),
    (Touching::Stiffens, "reach their second slope"),
    (Touching::SlipsBack, "friction reverses"),
];

/// Jumps, beginnings and ends one by one; kinks by number.
fn events(model: &Model, events: &[Event], units: Units) -> String {
    let is =
        |event: &Event, minor: Touching| matches!(event.happening, Happening::Contact { what, .. } if what == minor);
    let is_listed = |e: &&Event| e.change == Change::Jump || MINOR.iter().all(|(minor, _)| !is(e, *minor));
    let jumps = events.iter().filter(|e| e.change == Change::Jump).count();
    let mut text = format!(
        "the motion is not smooth at {} times: a force jumps at {jumps}, a slope changes at {}\n",
        events.len(),
        events.len() - jumps
    );
    let listed: Vec<&Event> = events.iter().filter(is_listed).collect();
    for event in listed.iter().take(LISTED) {
        let jump = match event.change {
            Change::Jump => format!(": a force jumps by {}", units.say(event.jump_n, "N", 0)),
            Change::Kink => String::new(),
        };
        text.push_str(&format!("{:9.2} ms  {}{jump}\n", event.time_s * 1e3, event.happening.words(model)));
    }
    if listed.len() > LISTED {
        text.push_str(&format!("and {} more of these\n", listed.len() - LISTED));
    }
    let [unload, reload, stiffen, reverse] =
        MINOR.map(|(minor, words)| format!("{words} {} times", events.iter().filter(|e| is(e, minor)).count()));
    text.push_str(&format!("also: {unload}, {reload}, {stiffen}; {reverse}\n"));
    if jumps > 0 {
        text.push_str(
            "Where a contact force jumps, the derivative lacks the jump times the shift of its time; the finite changes include it.\n",
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_shown_as_per_cent() {
        let shown: Vec<String> = [1e-4, 1e-3, 0.01, 0.0123, 0.2, 30.0].map(percent).into();
        assert_eq!(shown, ["0.01 %", "0.1 %", "1 %", "1.2 %", "20 %", "> 1000 %"]);
        assert_eq!(number(-0.001234567), "-0.0012346");
        assert_eq!(number(1234567.0), "1.2346e6");
    }
}

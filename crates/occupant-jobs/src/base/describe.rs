//! Designs, parameters and caveats in words.

use occupant_core::results::summary::Caveat;
use occupant_study::{ApplyChoice, Change, Design, Distribution, Ensemble, Law, Parameter, Perturbation, Study, Value};

use super::shown::{given, given_with_unit};
use super::text_table::trimmed;
use super::{Told, Units};

/// Largest number of list values or paths named.
const NAMED: usize = 6;

/// Description of a design.
pub fn design(study: &Study) -> String {
    let crossed: Vec<&str> = study.parameters.iter().filter(|p| p.crossed).map(|p| p.name.as_str()).collect();
    let design = alone(study);
    match crossed.is_empty() {
        true => design,
        false => format!("{design}, each with all {} values of {}", study.crossing(), crossed.join(" × ")),
    }
}

/// The design without crossed parameters.
fn alone(study: &Study) -> String {
    match &study.design {
        Design::Single => "the scenario itself".to_owned(),
        Design::FullFactorial => "full factorial: all combinations of values".to_owned(),
        Design::LatinHypercube { samples } => format!("Latin hypercube of {samples} samples"),
        Design::Sobol { samples, scramble } => {
            format!("Sobol’s sequence, {samples} points, {}", if *scramble { "scrambled" } else { "plain" })
        }
        Design::MonteCarlo { samples } => format!("Monte Carlo, {samples} independent samples"),
        Design::OneAtATime { .. } => "one parameter at a time, all others as in the base".to_owned(),
        Design::Table { rows, .. } => format!("a table of {} samples", rows.len()),
        Design::Saltelli { samples, second_order } => format!(
            "Saltelli’s design for Sobol indices, {samples} points{}",
            if *second_order { ", second order included" } else { "" }
        ),
        Design::Morris { trajectories, levels, .. } => {
            format!("Morris’s screening, {trajectories} trajectories on {levels} levels")
        }
    }
}

/// Description of a parameter's law.
pub fn law(parameter: &Parameter, unit: &Told) -> String {
    of_law(&parameter.law, parameter.apply, unit)
}

/// The random changes of an ensemble: each size once, with the paths that are changed so.
pub fn ensemble(of: &Ensemble, units: Units) -> Vec<String> {
    let mut groups: Vec<(String, Vec<&str>)> = Vec::new();
    for Perturbation { change, targets } in &of.perturbations {
        let unit = units.told(targets.first().map_or("", |target| target.unit));
        let words = match change {
            Change::Offset(most) => format!("uniform within ± {}", given_with_unit(*most, &unit)),
            Change::Factor(most) => format!("uniform within ± {} %", trimmed(100.0 * most, 3)),
            Change::Drawn(law, ApplyChoice::Factor) => of_law(law, ApplyChoice::Factor, &units.told("")),
            Change::Drawn(law, apply) => of_law(law, *apply, &unit),
        };
        let paths = targets.iter().map(|target| target.path.as_str());
        match groups.iter_mut().find(|(known, _)| *known == words) {
            Some((_, all)) => all.extend(paths),
            None => groups.push((words, paths.collect())),
        }
    }
    groups.into_iter().map(|(words, paths)| format!("{} {words}", some(&paths))).collect()
}

/// Some of these paths, and the number of the others.
fn some(paths: &[&str]) -> String {
    let named = paths.iter().take(NAMED).copied().collect::<Vec<_>>().join(", ");
    match paths.len().saturating_sub(NAMED) {
        0 => named,
        more => format!("{named} and {more} more"),
    }
}

fn of_law(law: &Law, apply: ApplyChoice, unit: &Told) -> String {
    let range = |from: f64, to: f64| format!("{} to {}", given(from, unit), given_with_unit(to, unit));
    let text = match law {
        Law::List(values) => {
            let some: Vec<String> = values.iter().take(NAMED).map(|v| value(v, unit)).collect();
            let more = values.len().saturating_sub(NAMED);
            let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
            format!("list: {}{rest}", some.join(", "))
        }
        Law::Grid { from, to, steps, log } => {
            format!("grid: {}, {steps} values{}", range(*from, *to), if *log { ", equal ratios" } else { "" })
        }
        Law::Distribution(Distribution::Uniform { from, to }) => format!("uniform: {}", range(*from, *to)),
        Law::Distribution(Distribution::LogUniform { from, to }) => format!("log-uniform: {}", range(*from, *to)),
        Law::Distribution(Distribution::Normal { mean, sd }) => {
            format!("normal: {} ± {}", given(*mean, unit), given_with_unit(*sd, unit))
        }
        Law::Distribution(Distribution::TruncatedNormal { mean, sd, from, to }) => {
            format!("normal: {} ± {}, cut to {}", given(*mean, unit), given_with_unit(*sd, unit), range(*from, *to))
        }
        Law::Distribution(Distribution::Triangular { from, mode, to }) => {
            format!("triangular: {}, likeliest {}", range(*from, *to), given_with_unit(*mode, unit))
        }
        Law::Table => "from the table".to_owned(),
    };
    match apply {
        ApplyChoice::Value => text,
        ApplyChoice::Factor => format!("{text}, a factor"),
        ApplyChoice::Offset => format!("{text}, an offset"),
    }
}

fn value(value: &Value, unit: &Told) -> String {
    match value {
        Value::Number(x) => given_with_unit(*x, unit),
        Value::Text(text) => text.clone(),
        Value::Truth(b) => b.to_string(),
        Value::Base => "as in the base".to_owned(),
    }
}

/// A parameter with its places, its law and the source of a built-in one.
pub fn input(parameter: &Parameter, unit: &Told) -> String {
    let places = places(parameter);
    let places = if places == parameter.name { String::new() } else { format!(" ({places})") };
    let source = match parameter.source {
        "" => String::new(),
        source => format!(" [ready distribution; {source}]"),
    };
    format!("{}{places}, {}{source}", parameter.name, law(parameter, unit))
}

/// Paths that a parameter changes.
pub fn places(parameter: &Parameter) -> String {
    some(&parameter.targets.iter().map(|target| target.path.as_str()).collect::<Vec<_>>())
}

/// The base scenario's value of a parameter.
pub fn nominal(parameter: &Parameter, unit: &Told) -> String {
    value(&parameter.nominal(), unit)
}

/// A caveat of a run or a note on it, as a line.
pub fn caveat(of: &Caveat) -> String {
    format!("{} {}\n", if of.is_note() { "note:" } else { "!" }, of.text)
}

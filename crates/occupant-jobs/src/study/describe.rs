//! Designs and parameters in words.

use occupant_study::{ApplyChoice, Design, Distribution, Law, Parameter, Study, Value};

use super::shown::{given, given_with_unit};
use crate::base::Told;

/// So many values of a list, or places of a parameter, are named.
const NAMED: usize = 6;

/// A design in words.
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

/// How the values of a parameter are spread, as text.
pub fn law(parameter: &Parameter, unit: &Told) -> String {
    let range = |from: f64, to: f64| format!("{} to {}", given(from, unit), given_with_unit(to, unit));
    let text = match &parameter.law {
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
    match parameter.apply {
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

/// Where a parameter acts.
pub fn places(parameter: &Parameter) -> String {
    let paths: Vec<&str> = parameter.targets.iter().take(NAMED).map(|t| t.path.as_str()).collect();
    match parameter.targets.len().saturating_sub(NAMED) {
        0 => paths.join(", "),
        more => format!("{} and {more} more", paths.join(", ")),
    }
}

/// What the base scenario says of a parameter.
pub fn nominal(parameter: &Parameter, unit: &Told) -> String {
    value(&parameter.nominal(), unit)
}

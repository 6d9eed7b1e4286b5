//! Sets every parameter of the base scenario to its bounds and checks the result, so that a negative stiffness or two
//! exclusive keys are reported once, before the first run.

use super::Binder;
use crate::law::{Distribution, Law, Value};
use crate::parameter::{Assignment, Parameter, put};
use crate::section::ApplyChoice;
use occupant_scenario::{Diagnostics, Draft, Place};
use placed_text::{Problem, Severity};

/// Tail probability of a normal distribution beyond which values are not range-checked.
const RARE: f64 = 1e-6;

/// Checks the extreme values of every parameter, and that no value is both overridden and varied.
pub(super) fn check(binder: &mut Binder, base: &Draft, parameters: &[Parameter], overrides: &[String]) {
    let written = binder.text.section.parameters.len();
    for (i, parameter) in parameters.iter().enumerate() {
        // a broken parameter shifts the others; then point at the name only
        let at = if parameters.len() == written { format!("parameters[{i}]") } else { "parameters".to_owned() };
        by_hand(binder, base, parameter, overrides, &at);
        for value in extremes(&parameter.law) {
            let mut list = Vec::new();
            parameter.assign(&value, &mut list);
            if let Err(wrong) = put_in(base, &list) {
                let rare = matches!(parameter.law, Law::Distribution(Distribution::Normal { .. }));
                tell(binder, &at, parameter, wrong, rare);
                break;
            }
        }
    }
}

fn tell(binder: &mut Binder, at: &str, parameter: &Parameter, wrong: Diagnostics, rare: bool) {
    let Some(first) = wrong.iter().next() else { return };
    let (name, words) = (&parameter.name, &first.problem);
    let found = format!("`{name}` makes the scenario invalid: {}", words.found);
    let problem = Problem::error(at, found, words.expected.clone());
    binder.report(if rare {
        let hint = "a \"truncated_normal\" distribution stays within the possible range";
        Problem { severity: Severity::Warning, ..problem }.with_hint(Some(hint))
    } else {
        problem.with_hint(words.hint.clone())
    });
}

/// The least and largest values of a law, or all values of a list.
fn extremes(law: &Law) -> Vec<Value> {
    match law {
        Law::List(values) => values.clone(),
        Law::Table => Vec::new(),
        _ => vec![law.bounded_quantile(0.0, RARE), law.bounded_quantile(1.0, RARE)],
    }
}

/// Problems of the base scenario with these values.
fn put_in(base: &Draft, list: &[Assignment]) -> Result<(), Diagnostics> {
    let mut draft = base.clone();
    put(list, &mut draft)?;
    let wrong = draft.check();
    if wrong.has_errors() { Err(wrong) } else { Ok(()) }
}

/// Reports an override that this parameter would undo.
fn by_hand(binder: &mut Binder, base: &Draft, parameter: &Parameter, overrides: &[String], at: &str) {
    if parameter.apply != ApplyChoice::Value {
        return;
    }
    for path in overrides.iter().filter_map(|o| o.split_once('=')) {
        let places = base.places(path.0.trim()).unwrap_or_default();
        let shared = |place: &Place| parameter.targets.iter().any(|t| t.path == place.path);
        if let Some(place) = places.iter().find(|p| shared(p)) {
            let found = format!("`{}` is overridden and also varied by `{}`", place.path, parameter.name);
            binder.error(at, found, "one of the two", Some("leave the override out".into()));
        }
    }
}

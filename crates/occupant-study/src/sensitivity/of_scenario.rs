//! Numbers of a scenario as parameters, by the paths that `--set` and studies know.

use super::parameter::{Parameter, size_of};
use crate::parameter::put;
use crate::{ApplyChoice, Law, Target, Value};
use occupant_scenario::{Draft, Resolver, Wanted};
use placed_text::Problem;

/// The parameter at a path: the number there, or a common factor if the path means several numbers, as in
/// `joints.*.damping`.
///
/// # Errors
/// A path that does not exist, to no number, or to numbers that a factor does not change.
pub fn parameter<'a>(draft: &'a Draft, path: &str, resolver: Resolver<'a>) -> Result<Parameter<'a>, Problem> {
    let places = draft.places(path)?;
    let refuse =
        |found: String, hint: Option<&str>| Problem::error("", found, "a number of the scenario").with_hint(hint);
    for place in &places {
        let at = &place.path;
        match (place.si, &place.wanted, &place.value) {
            (Some(_), ..) => {}
            (None, Wanted::Quantity(_) | Wanted::Number, None) => {
                return Err(refuse(
                    format!("`{at}` has no value in this scenario"),
                    Some("give it one with --set, or choose another key"),
                ));
            }
            (None, Wanted::Truth, _) => {
                return Err(refuse(format!("`{at}` is true or false"), None));
            }
            (None, ..) => return Err(refuse(format!("`{at}` is a text"), None)),
        }
    }
    let targets: Vec<Target> = places.iter().map(Target::of).collect();
    let (apply, unit) = match targets.as_slice() {
        [Target { unit: "", .. }] => (ApplyChoice::Value, "1"),
        [only] => (ApplyChoice::Value, only.unit),
        several if several.iter().all(|t| t.base == Value::Number(0.0)) => {
            return Err(refuse(
                format!("`{path}` matches {} numbers, all 0, which a factor cannot change", several.len()),
                Some("name one of them"),
            ));
        }
        _ => (ApplyChoice::Factor, "1"),
    };
    let varied =
        crate::Parameter { name: path.to_owned(), unit, apply, law: Law::Table, crossed: false, targets, source: "" };
    let nominal = match varied.nominal() {
        Value::Number(x) => x,
        _ => f64::NAN,
    };
    let model_at = move |value: f64| {
        let (mut draft, mut list) = (draft.clone(), Vec::new());
        varied.assign(&Value::Number(value), &mut list);
        put(&list, &mut draft).map_err(|e| e.to_string())?;
        let loaded = draft.load(resolver).map_err(|e| e.to_string())?;
        let (model, _) = loaded.model().map_err(|e| e.to_string())?;
        Ok(model)
    };
    let size = size_of(nominal, unit);
    Ok(Parameter { name: path.to_owned(), size, unit: unit.to_owned(), nominal, model_at: Box::new(model_at) })
}

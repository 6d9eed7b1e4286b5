//! Numbers of a scenario as parameters, by the paths that `--set` and studies know.

use super::parameter::{Parameter, size_of};
use crate::{Assignment, Target, Value};
use occupant_core::scenario::{Draft, Resolver, Wanted};
use placed_text::Problem;

/// The parameter at a path: the number that stands there, or for a path to several numbers, such as `joints.*.damping`, a
/// factor on all of them.
///
/// # Errors
/// A path that leads nowhere, to no number, or to numbers that a factor does not change.
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
                    Some("give it one with --set, or choose what the scenario says instead"),
                ));
            }
            (None, Wanted::Truth, _) => {
                return Err(refuse(format!("`{at}` is true or false"), None));
            }
            (None, ..) => return Err(refuse(format!("`{at}` is a text"), None)),
        }
    }
    let targets: Vec<Target> = places.iter().map(Target::of).collect();
    let base = |target: &Target| match target.base {
        Value::Number(x) => x,
        _ => f64::NAN,
    };
    let (nominal, unit) = match targets.as_slice() {
        [only] => (base(only), unit_of(only)),
        several if several.iter().all(|t| base(t) == 0.0) => {
            return Err(refuse(
                format!("`{path}` leads to {} numbers, all 0, which no factor changes", several.len()),
                Some("name one of them"),
            ));
        }
        _ => (1.0, "1".to_owned()),
    };
    let is_factor = targets.len() > 1;
    let model_at = move |value: f64| {
        let mut draft = draft.clone();
        for target in &targets {
            let value = if is_factor { base(target) * value } else { value };
            let put = Assignment { path: target.path.clone(), value: Value::Number(value), unit: target.unit };
            draft.set_value(&put.path, &put.text()).map_err(|e| e.to_string())?;
        }
        let loaded = draft.load(resolver).map_err(|e| e.to_string())?;
        let (model, _) = loaded.model().map_err(|e| e.to_string())?;
        Ok(model)
    };
    Ok(Parameter { name: path.to_owned(), size: size_of(nominal, &unit), unit, nominal, model_at: Box::new(model_at) })
}

fn unit_of(target: &Target) -> String {
    match target.unit {
        "" => "1".to_owned(),
        unit => unit.to_owned(),
    }
}

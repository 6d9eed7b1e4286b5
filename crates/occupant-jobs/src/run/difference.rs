//! Differences between two scenarios, key by key.

use occupant_scenario::Scenario;
use serde_json::Value;

/// Keys that do not affect the states of a run: end time and descriptions.
const FREE: [&str; 4] = ["time.end", "title", "notes", "provenance"];

/// A line for each value that differs, `key: there → here`; end time and descriptions are ignored.
///
/// # Errors
/// A scenario that JSON cannot hold.
pub fn differences(there: &Scenario, here: &Scenario) -> serde_json::Result<Vec<String>> {
    let (there, here) = (serde_json::to_value(there)?, serde_json::to_value(here)?);
    let mut found = Vec::new();
    compare("", Some(&there), Some(&here), &mut found);
    Ok(found)
}

fn compare(path: &str, there: Option<&Value>, here: Option<&Value>, found: &mut Vec<String>) {
    if there == here || FREE.contains(&path) {
        return;
    }
    match (there, here) {
        (Some(Value::Object(a)), Some(Value::Object(b))) => {
            let only_here = b.keys().filter(|key| !a.contains_key(*key));
            for key in a.keys().chain(only_here) {
                let below = match path {
                    "" => key.clone(),
                    _ => format!("{path}.{key}"),
                };
                compare(&below, a.get(key), b.get(key), found);
            }
        }
        (Some(Value::Array(a)), Some(Value::Array(b))) if a.len() == b.len() => {
            for (i, (a, b)) in a.iter().zip(b).enumerate() {
                compare(&format!("{path}[{i}]"), Some(a), Some(b), found);
            }
        }
        _ => found.push(format!("{path}: {} → {}", show(there), show(here))),
    }
}

/// A value in one short line.
fn show(value: Option<&Value>) -> String {
    let text = match value {
        None | Some(Value::Null) => return "absent".to_owned(),
        Some(value) => value.to_string(),
    };
    match text.char_indices().nth(60) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text,
    }
}

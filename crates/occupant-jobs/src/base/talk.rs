//! Messages of jobs while they work. They go to the log: a command writes it to standard error, a notebook shows it.

use super::Failure;

/// Log target of all messages here.
pub const TARGET: &str = "occupant";

/// Reports a message.
pub fn say(text: &str) {
    log::info!(target: TARGET, "{text}");
}

/// Reports a note on a result.
pub fn note(text: &String) {
    say(&format!("note: {text}"));
}

/// A value as JSON text for people and programs, with a line end.
///
/// # Errors
/// A value that JSON cannot hold.
pub fn json(value: &impl serde::Serialize) -> Result<String, Failure> {
    let mut text = serde_json::to_string_pretty(value)
        .map_err(|e| Failure::BrokeOff(format!("error: the result is not JSON: {e}")))?;
    text.push('\n');
    Ok(text)
}

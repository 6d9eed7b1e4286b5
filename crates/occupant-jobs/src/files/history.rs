//! Time histories that the library of files takes from a run, and messages about unknown names.

use occupant_core::model::Model;
use occupant_core::results::channel::Channel;
use occupant_scenario::kind::{KINDS, TIME};

pub use occupant_files::history::*;

use crate::base::{Failure, note};

/// Channels selected by names and patterns; patterns without a match are reported.
///
/// # Errors
/// A name or pattern that fits no channel.
pub fn choose(model: &Model, names: &[String]) -> Result<Vec<Channel>, Failure> {
    let (channels, missing) = occupant_files::history::choose(model, names)?;
    missing.iter().for_each(|name| note(&format!("no channel matches `{name}`")));
    Ok(channels)
}

/// A time as text, s; a bare number is in seconds.
///
/// # Errors
/// An invalid time.
pub fn seconds(text: &str) -> Result<f64, String> {
    let wrong = |expected: &str| format!("not a time; expected {expected}, such as '80 ms'");
    match KINDS[TIME].read(text) {
        Ok(seconds) if seconds.is_finite() => Ok(seconds),
        Ok(_) => Err(wrong("a finite time")),
        Err(error) => Err(wrong(&error.expected)),
    }
}

/// An interval between samples or prints as text, s.
///
/// # Errors
/// An invalid time, or one that is not above zero.
pub fn interval(text: &str) -> Result<f64, String> {
    match seconds(text)? {
        seconds if seconds > 0.0 => Ok(seconds),
        _ => Err("not an interval; expected a time above zero, such as '1 ms'".to_owned()),
    }
}

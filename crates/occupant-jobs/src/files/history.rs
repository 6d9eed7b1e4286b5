//! Time histories that the library of files takes from a run, and messages about unknown names.

use occupant_core::model::Model;
use occupant_core::results::channel::Channel;

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

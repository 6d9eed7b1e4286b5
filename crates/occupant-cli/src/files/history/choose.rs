//! Channels by the names that a person gives.

use occupant_core::model::Model;
use occupant_core::results::channel::{Channel, channels, find, matching};

use crate::base::Failure;

/// The channels that names and patterns (`head.*`) ask for, each once, in the order asked; all for no names.
///
/// # Errors
/// A name or pattern that fits no channel.
pub(crate) fn choose(model: &Model, names: &[String]) -> Result<Vec<Channel>, Failure> {
    if names.is_empty() {
        return Ok(channels(model));
    }
    let mut chosen: Vec<Channel> = Vec::new();
    for name in names.iter().flat_map(|n| n.split(',')).map(str::trim) {
        for channel in fitting(model, name)? {
            if chosen.iter().all(|c| c.name != channel.name) {
                chosen.push(channel);
            }
        }
    }
    Ok(chosen)
}

fn fitting(model: &Model, name: &str) -> Result<Vec<Channel>, Failure> {
    if name.contains('*') {
        let found = matching(model, name);
        return if found.is_empty() { Err(unknown(model, name, None)) } else { Ok(found) };
    }
    let found = find(model, name);
    found.map(|c| vec![c]).map_err(|nearest| unknown(model, name, nearest))
}

fn unknown(model: &Model, name: &str, nearest: Option<String>) -> Failure {
    let inside = matching(model, &format!("*{name}*"));
    let help = match (nearest, inside.first()) {
        (Some(nearest), _) => format!("did you mean `{nearest}`?"),
        (None, Some(one)) => format!("a name is complete, such as `{}`; `*` stands for anything", one.name),
        (None, None) => {
            "names are such as head.acceleration.x, belt.lap.force, energy.balance; `occupant export -o all.csv` lists all"
                .to_owned()
        }
    };
    Failure::with_help(format!("no channel is called `{name}`"), &help)
}

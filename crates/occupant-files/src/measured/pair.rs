//! Pairs of measured signals and channels.
//!
//! By `--map column=channel`, otherwise by the same name, otherwise by the ISO-MME code. A channel with a map uses
//! nothing else.

use std::fmt;
use std::str::FromStr;

use crash_measures::signal::{CfcFamily, ChannelClass, uniform_interval};
use occupant_core::model::Model;
use occupant_core::results::channel::Channel;
use occupant_units::unit::Dimension;
use placed_text::name_and_unit;

use crate::base::Failure;
use crate::channel_code::{Place, place_of};
use crate::history::filtered;
use crate::signals::{Recording, Signal, scale_of};

/// A channel to be matched with a signal.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// The channel of a run.
    pub name: String,
    /// Its dimension and unit; none if it is itself measured and has no unit.
    pub unit: Option<(Dimension, String)>,
    /// Its position in the dictionary of ISO-MME codes, where only the model tells it.
    pub place: Option<Place>,
}

impl Wanted {
    /// A channel of a model.
    pub fn of(model: &Model, channel: &Channel) -> Self {
        Wanted { place: place_of(model, channel), ..Wanted::from(channel) }
    }
}

impl From<&Channel> for Wanted {
    fn from(channel: &Channel) -> Self {
        let unit = Some((channel.unit.dimension(), channel.unit.symbol().to_owned()));
        Wanted { name: channel.name.clone(), unit, place: None }
    }
}

impl From<&Signal> for Wanted {
    fn from(signal: &Signal) -> Self {
        let unit = signal.scale.map(|s| s.dimension).zip(signal.unit.clone());
        Wanted { name: signal.name.clone(), unit, place: None }
    }
}

/// `column[unit]=channel`, with `-channel` for opposite signs.
#[derive(Clone, Debug, PartialEq)]
pub struct MapArgument {
    column: String,
    unit: Option<String>,
    channel: String,
    sign: f64,
}

impl MapArgument {
    /// Name of the channel.
    pub fn channel(&self) -> &str {
        &self.channel
    }
}

impl FromStr for MapArgument {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (column, channel) =
            text.rsplit_once('=').ok_or("expected column=channel, such as 'head_x[g]=head.acceleration.x'")?;
        let (column, unit) = name_and_unit(column);
        let channel = channel.trim();
        let (channel, sign) = match channel.strip_prefix('-') {
            Some(channel) => (channel, -1.0),
            None => (channel, 1.0),
        };
        if column.is_empty() || channel.is_empty() {
            return Err("expected a column before `=` and a channel after it".to_owned());
        }
        Ok(MapArgument { column: column.to_owned(), unit: unit.map(str::to_owned), channel: channel.to_owned(), sign })
    }
}

impl fmt::Display for MapArgument {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let unit = self.unit.as_ref().map(|u| format!("[{u}]"));
        let sign = if self.sign < 0.0 { "-" } else { "" };
        let unit = unit.unwrap_or_default();
        write!(f, "{}{unit}={sign}{}", self.column, self.channel)
    }
}

/// A measured signal converted to a channel's unit and axes.
#[derive(Clone, Debug)]
pub struct Pair {
    /// Index among the channels to be matched.
    pub channel: usize,
    /// Name of the signal.
    pub signal: String,
    /// Times, s.
    pub time_s: Vec<f64>,
    /// Values, SI, in the channel's axes; NaN where missing.
    pub values: Vec<f64>,
}

impl Pair {
    /// Filters the values like the channel.
    ///
    /// # Errors
    /// Missing values, samples that are not equally spaced or too far apart.
    pub fn filter(&mut self, class: ChannelClass, family: CfcFamily) -> Result<(), Failure> {
        let refused = |reason: String| {
            Failure::with_help(
                format!("the measured signal {} cannot be filtered: {reason}", self.signal),
                "use --filter none to leave signals as they are",
            )
        };
        let dt_s = uniform_interval(&self.time_s).map_err(|e| refused(e.to_string()))?;
        self.values = filtered(&self.values, dt_s, class, family).map_err(refused)?;
        Ok(())
    }
}

/// Pairs for these channels, in their order, and the assumptions made.
///
/// `seat` is the ISO-MME position of the occupant.
///
/// # Errors
/// A map to an unknown column or channel, a unit that is not the channel's, several signals for a channel.
pub fn pairs(
    recording: &Recording,
    wanted: &[Wanted],
    maps: &[MapArgument],
    seat: char,
    notes: &mut Vec<String>,
) -> Result<Vec<Pair>, Failure> {
    for map in maps {
        if wanted.iter().all(|w| w.name != map.channel) {
            return Err(Failure::with_help(
                format!("--map: the channel `{}` is not selected", map.channel),
                "select it with --channel, or correct the name",
            ));
        }
    }
    let mut found = Vec::new();
    for (channel, wanted) in wanted.iter().enumerate() {
        let Some((signal, map, sign)) = signal_for(recording, wanted, maps, seat)? else {
            continue;
        };
        let unit = map.and_then(|m| m.unit.as_deref());
        let factor = factor(recording, signal, unit, wanted, notes)?;
        found.push(Pair {
            channel,
            signal: signal.name.clone(),
            time_s: signal.time_s.clone(),
            values: signal.values.iter().map(|v| v * factor * sign).collect(),
        });
    }
    Ok(found)
}

type Match<'a> = (&'a Signal, Option<&'a MapArgument>, f64);

fn signal_for<'a>(
    recording: &'a Recording,
    wanted: &Wanted,
    maps: &'a [MapArgument],
    seat: char,
) -> Result<Option<Match<'a>>, Failure> {
    let file = recording.path.display();
    if let Some(map) = maps.iter().find(|m| m.channel == wanted.name) {
        let mut named = recording.signals.iter().filter(|s| s.name == map.column);
        return match (named.next(), named.next()) {
            (Some(signal), None) => Ok(Some((signal, Some(map), map.sign))),
            (None, _) => Err(Failure::with_help(
                format!("--map: {file} has no column `{}`", map.column),
                &format!("it has {}", names(&recording.signals)),
            )),
            _ => Err(Failure::plain(format!("--map: {file} has more than one column `{}`", map.column))),
        };
    }
    let sign = |s: &Signal| {
        if s.name == wanted.name {
            return Some(1.0);
        }
        let code = s.code.as_ref()?;
        code.sign_for(&wanted.name, seat).or_else(|| code.sign_at(wanted.place.as_ref()?, seat))
    };
    let fitting: Vec<Match<'a>> = recording.signals.iter().filter_map(|s| Some((s, None, sign(s)?))).collect();
    match fitting.as_slice() {
        [] => Ok(None),
        [one] => Ok(Some(*one)),
        [(first, ..), (second, ..), ..] => {
            let names: Vec<&str> = fitting.iter().map(|(s, ..)| s.name.as_str()).collect();
            let help = if first.name == second.name {
                "rename one of them, or remove it".to_owned()
            } else {
                format!("choose one with --map {}={}", first.name, wanted.name)
            };
            Err(Failure::with_help(
                format!("{file} has more than one signal for {}: {}", wanted.name, names.join(", ")),
                &help,
            ))
        }
    }
}

/// SI value of one unit of the signal.
fn factor(
    recording: &Recording,
    signal: &Signal,
    unit: Option<&str>,
    wanted: &Wanted,
    notes: &mut Vec<String>,
) -> Result<f64, Failure> {
    let (scale, written) = match unit {
        Some(unit) => {
            if let Some(heading) = signal.unit.as_deref().filter(|heading| *heading != unit) {
                notes.push(format!("{}: its heading says {heading}, --map says {unit}, which is used", signal.name));
            }
            (scale_of(unit), Some(unit))
        }
        None => (signal.scale, signal.unit.as_deref()),
    };
    let Some(written) = written else {
        let file = recording.path.display();
        notes.push(match &wanted.unit {
            Some((_, symbol)) => format!(
                "{file} gives no unit for `{}`: the SI unit of {} is assumed; otherwise give it with --map '{}[unit]={}'",
                signal.name, symbol, signal.name, wanted.name
            ),
            None => format!("{file} gives no unit for `{}`: used as it is", signal.name),
        });
        return Ok(1.0);
    };
    let Some(scale) = scale else {
        return Err(Failure::with_help(
            format!("{}: unknown unit `{written}` of {}", signal.place, signal.name),
            &format!("give it with --map '{}[unit]={}'", signal.name, wanted.name),
        ));
    };
    match &wanted.unit {
        Some((dimension, symbol)) if scale.dimension != *dimension => Err(Failure::with_help(
            format!("{}: {} is in {written}, but {} in {symbol}", signal.place, signal.name, wanted.name),
            "map a column with the same quantity",
        )),
        _ => Ok(scale.factor),
    }
}

/// Names of signals, for a message.
fn names(signals: &[Signal]) -> String {
    let mut names: Vec<&str> = signals.iter().take(12).map(|s| s.name.as_str()).collect();
    if signals.len() > names.len() {
        names.push("…");
    }
    names.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_map_names_a_column_its_unit_and_a_channel() {
        let map: MapArgument = "head x [g]=-head.acceleration.x".parse().unwrap();
        assert_eq!(map.column, "head x");
        assert_eq!(map.unit.as_deref(), Some("g"));
        assert_eq!((map.channel.as_str(), map.sign), ("head.acceleration.x", -1.0));
        assert!("head".parse::<MapArgument>().is_err() && "=x".parse::<MapArgument>().is_err());
    }
}

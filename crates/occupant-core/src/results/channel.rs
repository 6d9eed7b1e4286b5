//! The result channels: every scalar time history of a run, by name, with its unit and axes.
//!
//! Plots, exports, comparisons and studies take their numbers from here. A name is a place and a quantity,
//! `head.acceleration.x`, `belt.lap.force`, `joint.neck.moment.resultant`; names of spheres and belts are those of the
//! scenario. The list depends on the model alone, so every run of a scenario has the same channels.

pub(crate) use occupant_units::unit::Unit;

use crate::model::Model;
use crate::quantity::Axes;
use crate::quantity::Value;
use crate::results::catalogue::{Catalogue, Source};
use crate::results::recorder::{Flow, Recorder, RecorderError};
use crate::results::sample::Sample;
use crate::results::unknown::Unknown;

/// A scalar time history of a run.
#[derive(Clone, Debug)]
pub struct Channel {
    /// Unique name, lower-case words with dots between.
    pub name: String,
    /// SI unit.
    pub unit: Unit,
    /// Axes.
    pub axes: Axes,
    /// Meaning, in a sentence without a full stop.
    pub meaning: String,
    pub(super) source: Source,
    pub(super) component: Component,
    /// [`Model::names_hash`] of its model.
    pub(super) of: u64,
}

impl Channel {
    /// Value at an output, in its SI unit; NaN for a sample of a model with other channels.
    pub fn value(&self, sample: &Sample<'_>) -> f64 {
        if sample.model.names_hash() == self.of { self.component.of(&self.source.value(sample)) } else { f64::NAN }
    }
}

/// A component of a vector; a number counts as X.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Component {
    X,
    Y,
    Z,
    Resultant,
}

impl Component {
    pub(crate) const ALL: [Component; 4] = [Component::X, Component::Y, Component::Z, Component::Resultant];

    pub(crate) const fn name(self) -> &'static str {
        ["x", "y", "z", "resultant"][self as usize]
    }

    /// Axes; a resultant has none.
    pub(crate) fn axes(self, of_vector: Axes) -> Axes {
        if self == Component::Resultant { Axes::None } else { of_vector }
    }

    pub(crate) fn of(self, value: &Value) -> f64 {
        match (value, self) {
            (Value::Number(x), _) => *x,
            (Value::Vector(Some(v)), Component::Resultant) => v.norm(),
            (Value::Vector(Some(v)), component) => v[component as usize],
            _ => f64::NAN,
        }
    }
}

/// All channels of a model, in a fixed order: vehicle, segments, neck and femurs, spheres, belts, joints, markers, energies.
pub fn channels(model: &Model) -> Vec<Channel> {
    Catalogue::of(model).channels
}

/// The channel with this name.
///
/// # Errors
/// A name that no channel has, with the nearest that one has.
pub fn find(model: &Model, name: &str) -> Result<Channel, Unknown> {
    let mut all = channels(model);
    match all.iter().position(|c| c.name == name) {
        Some(at) => Ok(all.swap_remove(at)),
        None => Err(Unknown::new("channel", name, all.iter().map(|c| c.name.as_str()))),
    }
}

/// Channels whose name matches a pattern in which `*` stands for any characters, in the list's order.
pub fn matching(model: &Model, pattern: &str) -> Vec<Channel> {
    let pieces: Vec<&str> = pattern.split('*').collect();
    let mut all = channels(model);
    all.retain(|c| matches(&c.name, &pieces));
    all
}

/// Whether `name` consists of the pieces in order with anything between.
pub fn matches(name: &str, pieces: &[&str]) -> bool {
    let [first, rest @ ..] = pieces else {
        return false;
    };
    let Some(mut left) = name.strip_prefix(first) else {
        return false;
    };
    let Some((last, middle)) = rest.split_last() else {
        return left.is_empty();
    };
    for piece in middle {
        match left.find(piece) {
            Some(at) => left = &left[at + piece.len()..],
            None => return false,
        }
    }
    left.ends_with(last)
}

/// The part of a name that the only star of a pattern stands for, at least one character; empty for a pattern without a
/// star that equals the name.
pub fn star<'n>(pattern: &str, name: &'n str) -> Option<&'n str> {
    match pattern.split_once('*') {
        None => (pattern == name).then_some(""),
        Some((before, after)) => name.strip_prefix(before)?.strip_suffix(after).filter(|middle| !middle.is_empty()),
    }
}

/// Number of outputs with space reserved at the start.
const MOST_ROOM: usize = 1 << 16;

/// Recorder of the values of chosen channels at every output.
#[derive(Clone, Debug, Default)]
pub struct Series {
    /// The channels.
    pub channels: Vec<Channel>,
    /// Output times, s.
    pub time_s: Vec<f64>,
    /// By channel: a value for each output time, in the channel's SI unit.
    pub values: Vec<Vec<f64>>,
}

impl Series {
    /// Empty series.
    pub fn new(channels: Vec<Channel>) -> Self {
        let values = vec![Vec::new(); channels.len()];
        Series { channels, time_s: Vec::new(), values }
    }

    /// Values of the channel of this name, if it was chosen.
    pub fn of(&self, name: &str) -> Option<&[f64]> {
        let at = self.channels.iter().position(|c| c.name == name)?;
        Some(&self.values[at])
    }
}

impl Recorder for Series {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        if let Some(channel) = self.channels.iter().find(|channel| channel.of != model.names_hash()) {
            return Err(
                format!("the channel {} was listed for another model; list those of this one", channel.name).into()
            );
        }
        // a run that may go on for hours gets room as it needs it
        let outputs = model.output_count().min(MOST_ROOM);
        self.time_s.clear();
        self.time_s.reserve(outputs);
        for values in &mut self.values {
            values.clear();
            values.reserve(outputs);
        }
        Ok(())
    }

    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        self.time_s.push(sample.time_s);
        for (values, channel) in self.values.iter_mut().zip(&self.channels) {
            values.push(channel.value(sample));
        }
        Ok(Flow::Continue)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_star_is_one_name() {
        assert_eq!(star("sphere.*.force.resultant", "sphere.left_knee.force.resultant"), Some("left_knee"));
        assert_eq!(star("belt.*.force", "belt.lap.elongation"), None);
        assert_eq!(star("belts.*.peak", "belts..peak"), None);
        assert_eq!((star("hic15", "hic15"), star("hic15", "hic1")), (Some(""), None));
    }

    #[test]
    fn a_star_stands_for_anything() {
        let found = |pattern: &str, name| matches(name, &pattern.split('*').collect::<Vec<_>>());
        assert!(found("head.acceleration.x", "head.acceleration.x"));
        assert!(!found("head.acceleration", "head.acceleration.x"));
        assert!(found("head.*.x", "head.acceleration.x"));
        assert!(!found("head.*.y", "head.acceleration.x"));
        assert!(found("*", "anything") && found("*lap*", "belt.lap.force"));
        // the pieces must not overlap
        assert!(!found("aba*ba", "aba"));
    }
}

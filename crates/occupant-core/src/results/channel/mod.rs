//! The result channels: every scalar time history of a run, by name, with its unit and axes.
//!
//! Plots, exports, comparisons and studies take their numbers from here. A name is a place and a quantity,
//! `head.acceleration.x`, `belt.lap.force`, `joint.neck.moment.resultant`; names of spheres and belts are those of the
//! scenario. The list depends on the model alone, so every run of a scenario has the same channels.

mod catalogue;
mod quantity;
mod series;

use crate::model::Model;
use crate::problem::nearest;
use crate::results::sample::Sample;

pub use catalogue::channels;
pub use crash_measures::unit::Unit;
use quantity::{Component, Source};
pub use series::Series;

/// The axes that a component is along.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axes {
    /// No axes: a scalar or a resultant.
    None,
    /// Vehicle axes: X forward, Y right, Z down.
    Vehicle,
    /// Axes of the segment: X ahead, Y to the occupant's left, Z up when standing upright.
    Segment,
    /// SAE J211 axes of the segment: X ahead, Y to the occupant's right, Z down when standing upright.
    J211,
    /// Vehicle-space: X′_v forward, Y′_v right, Z′_v down, fixed.
    VehicleSpace,
}

impl Axes {
    /// Its name in metadata.
    pub const fn name(self) -> &'static str {
        match self {
            Axes::None => "none",
            Axes::Vehicle => "vehicle",
            Axes::Segment => "segment",
            Axes::J211 => "segment (SAE J211)",
            Axes::VehicleSpace => "vehicle-space",
        }
    }
}

/// A scalar time history of a run.
#[derive(Clone, Debug)]
pub struct Channel {
    /// Unique name, lower-case words with dots between.
    pub name: String,
    /// SI unit.
    pub unit: Unit,
    /// What it is along.
    pub axes: Axes,
    /// What it is, in a sentence without a full stop.
    pub meaning: String,
    source: Source,
    component: Component,
}

impl Channel {
    /// Its value at an output, in its SI unit; the sample must be of the model that the channel was listed for.
    pub fn value(&self, sample: &Sample<'_>) -> f64 {
        self.component.of(&self.source.value(sample))
    }
}

/// The channel of this name.
///
/// # Errors
/// The nearest name there is, if one is near.
pub fn find(model: &Model, name: &str) -> Result<Channel, Option<String>> {
    let mut all = channels(model);
    match all.iter().position(|c| c.name == name) {
        Some(at) => Ok(all.swap_remove(at)),
        None => Err(nearest(name, all.iter().map(|c| c.name.as_str())).map(str::to_owned)),
    }
}

/// Channels whose name matches a pattern in which `*` stands for any characters, in the list's order.
pub fn matching(model: &Model, pattern: &str) -> Vec<Channel> {
    let pieces: Vec<&str> = pattern.split('*').collect();
    let mut all = channels(model);
    all.retain(|c| matches(&c.name, &pieces));
    all
}

/// Whether `name` is the pieces in order with anything between.
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

#[cfg(test)]
mod tests {
    use super::*;

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

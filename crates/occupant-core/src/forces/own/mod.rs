//! A program's own forces: anything that acts on segments, spheres and frames, written in plain numbers. Ours.
//!
//! A [`Force`] receives a [`Scene`] and returns its action as [`Pushes`]. It is a part of the derivative like every
//! force element: error control includes it, the energy balance counts the energy that it takes from the bodies, stored
//! or lost, and its channels are among all others. Its memory changes only at accepted steps.
//!
//! It supports neither dual numbers nor lanes: a model with one has no derivatives and always runs alone.

mod element;
mod scene;

use std::fmt::Debug;
use std::sync::Arc;

use occupant_units::unit::Unit;
use placed_text::{Problems, with_key};

pub use element::{OwnAction, OwnData, OwnForces, OwnLaw};
pub use scene::{Place, PointMotion, Pushes, Scene};

/// Largest count of numbers in a force's memory.
pub const MOST_MEMORY: usize = 16;
/// Most channels of a force.
pub const MOST_CHANNELS: usize = 8;
/// Most forces of a setup.
pub const MOST_FORCES: usize = 8;

/// Your own force.
///
/// Each step evaluates it several times, in any order, from any thread: its result must follow from the scene and its
/// memory alone, **to the bit**. Forces must be continuous in position, velocity and time; otherwise error control
/// takes short steps around each jump.
///
/// A spring of 1000 N/m between a hand and a knob of the vehicle:
///
/// ```
/// use occupant_core::forces::own::{Force, Place, Pushes, Scene};
///
/// #[derive(Debug)]
/// struct Knob {
///     hand: Place,
///     knob: Place,
/// }
///
/// impl Force for Knob {
///     fn apply(&self, scene: &Scene<'_>, _memory: &[f64], pushes: &mut Pushes<'_, '_>) {
///         let way_m = scene.motion(&self.knob).place_m - scene.motion(&self.hand).place_m;
///         pushes.between(&self.hand, &self.knob, 1000.0 * way_m);
///         pushes.stored_j(500.0 * way_m.norm_squared());
///     }
/// }
/// ```
pub trait Force: Debug + Send + Sync {
    /// Adds its forces at one instant to `pushes`.
    fn apply(&self, scene: &Scene<'_>, memory: &[f64], pushes: &mut Pushes<'_, '_>);

    /// Its initial memory: at most [`MOST_MEMORY`] numbers.
    fn start(&self, _scene: &Scene<'_>) -> Vec<f64> {
        Vec::new()
    }

    /// Updates the memory at an accepted step; it must not change anywhere else. The same position may be committed
    /// more than once, also at an output, and the second time must change nothing. So the memory may keep a maximum,
    /// but not a count.
    fn accept(&self, _scene: &Scene<'_>, _memory: &mut [f64]) {}

    /// Values that it shows with [`Pushes::show`]: at most [`MOST_CHANNELS`].
    fn channels(&self) -> Vec<ForceChannel> {
        Vec::new()
    }
}

/// A value shown by a force: the channel `own_force.NAME.CHANNEL`.
#[derive(Clone, Debug, PartialEq)]
pub struct ForceChannel {
    /// Its name: small letters, digits and `_`.
    pub name: String,
    /// Its SI unit.
    pub unit: Unit,
}

impl ForceChannel {
    /// Channel with this name and unit.
    pub fn new(name: impl Into<String>, unit: Unit) -> Self {
        ForceChannel { name: name.into(), unit }
    }
}

/// Force with its name, as in a setup. Two are equal if they share one object.
#[derive(Clone, Debug)]
pub struct OwnForce {
    /// Its name: small letters, digits and `_`.
    pub name: String,
    /// The force.
    pub force: Arc<dyn Force>,
}

impl OwnForce {
    /// Force with a name.
    pub fn new(name: impl Into<String>, force: impl Force + 'static) -> Self {
        OwnForce { name: name.into(), force: Arc::new(force) }
    }
}

impl PartialEq for OwnForce {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name && Arc::ptr_eq(&self.force, &other.force)
    }
}

fn is_plain(name: &str) -> bool {
    let is_letter = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    !name.is_empty() && name.chars().all(is_letter)
}

/// Reports problems of names and counts.
fn check(forces: &[OwnForce], problems: &mut Problems) {
    let expected = "small letters, digits and `_`";
    problems.check_unique("own_forces", "force", forces.iter().map(|own| own.name.as_str()));
    if forces.len() > MOST_FORCES {
        problems.error("own_forces", format!("{} own forces", forces.len()), format!("at most {MOST_FORCES}"));
    }
    for own in forces {
        let (path, channels) = (with_key("own_forces", &own.name), own.force.channels());
        if !is_plain(&own.name) {
            problems.error(&path, format!("a force named {:?}", own.name), expected);
        }
        problems.check_unique(&path, "channel", channels.iter().map(|channel| channel.name.as_str()));
        if channels.len() > MOST_CHANNELS {
            problems.error(&path, format!("{} channels", channels.len()), format!("at most {MOST_CHANNELS}"));
        }
        let known = ["force", "taken", "stored"];
        for channel in channels.iter().filter(|one| !is_plain(&one.name) || known.contains(&one.name.as_str())) {
            problems.error(
                &path,
                format!("a channel named {:?}", channel.name),
                format!("{expected}; a name of its own"),
            );
        }
    }
}

//! The subject: a file of recorded data, or the path of a scenario's vehicle.

use occupant_core::model::setup::{OtherFrame, Setup};
use occupant_core::vehicle::{AccelerationRecord, Attitude, Interpolation, PathCursor, VehiclePath};
use occupant_study::risk::sampled;

/// Default sample interval of paths, s.
pub const PATH_INTERVAL_S: f64 = 1e-4;

/// Source of the motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Sensors.
    Recorded,
    /// The path of a scenario, or of a table of positions or velocity changes, sampled.
    Path,
    /// The path of a scenario, linear between stations, sampled.
    PathOfStraightLines,
}

/// A vehicle whose motion is assessed.
#[derive(Debug)]
pub struct Subject {
    /// Its name: the file name.
    pub name: String,
    /// Source of its motion.
    pub source: Source,
    /// Accelerations and rates.
    pub record: AccelerationRecord,
    /// Attitude of the vehicle at the first sample; level if it was not recorded.
    pub initial: Attitude,
}

impl Subject {
    /// Recorded data.
    pub fn recorded(name: &str, record: AccelerationRecord) -> Self {
        Subject { name: name.to_owned(), source: Source::Recorded, record, initial: Attitude::default() }
    }

    /// The path of a scenario's first vehicle over its run, or of another by name; none if it cannot be sampled at this
    /// interval.
    ///
    /// # Errors
    /// The names that there are, for a name that is none of them.
    pub fn of_run(
        name: &str,
        setup: &Setup,
        vehicle: Option<&str>,
        interval_s: f64,
    ) -> Result<Option<Self>, Vec<String>> {
        let others = others(setup);
        let path = match vehicle {
            None | Some(FIRST) => &setup.path,
            Some(asked) => match others.clone().find(|frame| frame.name == asked) {
                Some(frame) => &frame.path,
                None => return Err([FIRST.to_owned()].into_iter().chain(others.map(|f| f.name.clone())).collect()),
            },
        };
        let name = vehicle.map_or_else(|| name.to_owned(), |vehicle| format!("{vehicle} of {name}"));
        Ok(Subject::path(&name, path, [setup.time.start_s, setup.time.end_s], interval_s))
    }

    /// A path between two times; none if it cannot be sampled at this interval.
    pub fn path(name: &str, path: &VehiclePath, [from_s, to_s]: [f64; 2], interval_s: f64) -> Option<Self> {
        let straight = matches!(path, VehiclePath::Table(table) if table.interpolation() == Interpolation::Linear);
        let pose = path.attitude(from_s, &mut PathCursor::default());
        Some(Subject {
            name: name.to_owned(),
            source: if straight { Source::PathOfStraightLines } else { Source::Path },
            record: sampled(path, from_s, to_s, interval_s)?,
            initial: pose.attitude,
        })
    }
}

/// Vehicles of a setup, starting with the first.
pub fn vehicles(setup: &Setup) -> Vec<&str> {
    [FIRST].into_iter().chain(others(setup).map(|frame| frame.name.as_str())).collect()
}

fn others(setup: &Setup) -> impl Iterator<Item = &OtherFrame> + Clone {
    setup.frames.iter().filter(|frame| frame.parent.is_none() && frame.name != GROUND)
}

/// Name of the ground frame.
const GROUND: &str = "ground";
const FIRST: &str = "vehicle";

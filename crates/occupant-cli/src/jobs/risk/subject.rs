//! What is measured: a file of recorded data, or the path of a scenario's vehicle.

use occupant_core::model::setup::Setup;
use occupant_core::vehicle::{AccelerationRecord, Attitude, Interpolation, PathCursor, VehiclePath};
use occupant_scenario::RecordFile;
use occupant_study::risk::sampled;

/// Where the motion comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Source {
    /// Sensors.
    Recorded,
    /// The path of a scenario, sampled.
    Path,
    /// The path of a scenario that has straight lines between stations, sampled.
    PathOfStraightLines,
}

#[derive(Debug)]
pub(crate) struct Subject {
    /// Its name: the file's.
    pub(crate) name: String,
    /// Where it comes from.
    pub(crate) source: Source,
    pub(crate) record: AccelerationRecord,
    /// Attitude of the vehicle at the first sample; level if it was not recorded.
    pub(crate) initial: Attitude,
}

impl Subject {
    /// Recorded data.
    pub(crate) fn recorded(name: &str, file: &RecordFile) -> Self {
        Subject {
            name: name.to_owned(),
            source: Source::Recorded,
            record: file.record.clone(),
            initial: Attitude::default(),
        }
    }

    /// The path of a scenario's vehicle over its run; none if it cannot be sampled at this interval.
    pub(crate) fn path(name: &str, setup: &Setup, interval_s: f64) -> Option<Self> {
        let (path, time) = (&setup.path, setup.time);
        let straight = matches!(path, VehiclePath::Table(table) if table.interpolation() == Interpolation::Linear);
        let pose = path.attitude(time.start_s, &mut PathCursor::default());
        Some(Subject {
            name: name.to_owned(),
            source: if straight { Source::PathOfStraightLines } else { Source::Path },
            record: sampled(path, time.start_s, time.end_s, interval_s)?,
            initial: pose.attitude,
        })
    }
}

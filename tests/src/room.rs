//! A body among solids.

use occupant_core::model::setup::Setup;
use occupant_core::results::checkpoint::Checkpoint;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_core::scenario::{Draft, Format};

const ROOM: &str = include_str!("../data/room.toml");

/// The text of a scenario with these assignments as plain data.
pub fn setup(text: &str, set: &[&str]) -> Setup {
    let mut draft = Draft::read(text, Format::Toml, "test").unwrap();
    set.iter().for_each(|assignment| draft.set(assignment).unwrap());
    let no_files = |name: &str| Err(format!("no file {name}"));
    draft.load(&no_files).and_then(|loaded| loaded.build()).unwrap().0
}

/// A body that falls tumbling through a room of twenty solids, with these assignments.
pub fn room(set: &[&str]) -> Setup {
    setup(ROOM, set)
}

/// Keeps the last checkpoint.
#[derive(Default)]
pub struct Last(pub Option<Checkpoint>);

impl Recorder for Last {
    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        self.0 = Some(sample.checkpoint());
        Ok(Flow::Continue)
    }
}

//! Runs as MCAP files that Foxglove-compatible viewers show and Python reads.
//!
//! [`McapRecorder`] is a recorder of `occupant_core`; [`PartialFile`] is the file under its provisional name. What a file
//! holds — topics, units, frames, schemas — stands in `docs/mcap.md`.
//!
//! Field numbers, topic names and frame names are never used again for something else; additions get new ones.

pub mod about;
mod channel;
mod clock;
pub mod column;
pub mod descriptor;
mod file;
pub mod foxglove;
pub mod groups;
mod layout;
mod log;
mod recorder;
pub mod scene;
pub mod topics;
mod transforms;
pub mod wire;

pub use about::{About, Document};
pub use file::{Existing, FileProblem, PartialFile};
pub use recorder::{McapOptions, McapRecorder};

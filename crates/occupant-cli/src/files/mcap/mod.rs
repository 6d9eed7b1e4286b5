//! Runs as MCAP files that Foxglove-compatible viewers show and Python reads.
//!
//! [`McapRecorder`] is a recorder of `occupant_core`. What a file holds — topics, units, frames, schemas — stands in
//! `docs/mcap.md`.
//!
//! Field numbers, topic names and frame names are never used again for something else; additions get new ones.

pub(crate) mod about;
mod channel;
mod clock;
pub mod column;
mod descriptor;
mod foxglove;
pub mod groups;
mod layout;
mod log;
mod press;
mod recorder;
pub mod scene;
mod stored;
pub(crate) mod topics;
mod transforms;
pub(crate) mod wire;

pub use about::{About, Document};
pub use recorder::{McapOptions, McapRecorder};
pub use stored::StoredRun;

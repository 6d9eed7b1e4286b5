//! Runs as MCAP files that Foxglove-compatible viewers show and Python reads.
//!
//! [`McapRecorder`] is a recorder of `occupant_core`. `crates/occupant-cli/docs/mcap.md` describes its topics, units,
//! frames and schemas.
//!
//! Field numbers, topic names and frame names are never reused; additions get new ones.

pub mod about;
mod channel;
pub mod checkpoint;
mod clock;
mod descriptor;
pub mod drive;
mod foxglove;
mod layout;
mod log;
mod press;
mod recorder;
pub mod records;
pub mod scene;
mod states;
mod stored;
pub mod topics;
mod transforms;
pub mod wire;

use occupant_core::model::Model;
use occupant_core::results::catalogue::{self, Message};

pub use about::{About, Document};
pub use recorder::{McapOptions, McapRecorder};
pub use states::states;
pub use stored::StoredRun;

/// Compression of the chunks: none in a browser.
const COMPRESSION: Option<mcap::Compression> = {
    #[cfg(not(target_family = "wasm"))]
    let of_chunks = Some(mcap::Compression::Lz4);
    #[cfg(target_family = "wasm")]
    let of_chunks = None;
    of_chunks
};

/// The messages of every output, in writing order: those of the model's catalogue, and the checkpoint.
pub fn messages(model: &Model) -> Vec<Message> {
    let mut messages = catalogue::messages(model);
    messages.push(checkpoint::checkpoint());
    messages
}

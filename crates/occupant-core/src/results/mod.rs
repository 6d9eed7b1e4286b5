//! Results of a run: samples, energies, reactions, channels, summaries, checkpoints.

pub mod catalogue;
pub mod channel;
pub mod checkpoint;
pub(crate) mod elements;
pub mod energy;
pub mod fine;
pub mod outcome;
pub mod peaks;
pub mod reaction;
pub(crate) mod rear;
pub mod recorder;
pub mod sample;
pub mod summary;
mod told;
mod unknown;

pub use unknown::Unknown;

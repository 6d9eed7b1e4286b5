//! What a run gives: samples, energies, reactions, channels, summaries, checkpoints.

pub mod catalogue;
pub mod channel;
pub mod checkpoint;
pub(crate) mod elements;
pub mod energy;
pub(crate) mod instruments;
pub mod outcome;
pub mod reaction;
pub mod recorder;
pub mod sample;
pub mod summary;

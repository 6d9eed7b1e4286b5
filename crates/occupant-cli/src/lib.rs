//! The command `occupant`, as a library: the command line itself.
//!
//! Two rooms: `base` is how a command talks, and `commands` are flags, words and text tables. The work is done by
//! `occupant-jobs`.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod base;
mod commands;

pub use commands::{answer, main};
pub use occupant_files::{mcap, results};
pub use occupant_jobs::study;

//! The command `occupant`, as a library: its recorders for other programs, and the command line itself.
//!
//! Four rooms, one above the other: `commands` may use all that follow, `jobs`, `files`, `base` only what stands
//! behind them in this list. Nothing points back.

mod base;
mod commands;
mod files;
mod jobs;

use occupant_pictures as pictures;

pub use commands::{answer, main};
pub use jobs::study;
pub use occupant_files::{mcap, results};

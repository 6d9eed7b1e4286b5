//! The command `occupant`, as a library: its recorders for other programs, and the command line itself.
//!
//! Five rooms, one above the other: `commands` may use all that follow, `jobs`, `pictures`, `files`, `base` only what stands
//! behind them in this list. Nothing points back.

mod base;
mod commands;
mod files;
mod jobs;
mod pictures;

pub use commands::{answer, main};
pub use files::{mcap, results};
pub use jobs::study;

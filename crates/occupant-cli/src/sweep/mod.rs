//! Sweeps: every sample of a study run, one row each, on all cores, to be gone on with after any interruption.
//!
//! ```text
//! study ─ Plan ─ engine (threads: sample → model → run → figures → row) ─ journal ─ table
//! ```
//!
//! A finished sample is a row in the journal at once; the table is made from the journal when all are there. What a folder
//! holds stands in [`folder`], what a piece of the journal is in [`piece`].

pub mod census;
pub mod csv_table;
pub mod engine;
pub mod finished;
pub mod folder;
pub mod journal;
pub mod kept;
pub mod manifest;
pub mod parquet_table;
pub mod piece;
pub mod plan;
pub mod problem;
pub mod progress;
pub mod results;
pub mod row;
pub mod shard;
pub mod simulation;
pub mod table;
pub mod texts;
pub mod worst;

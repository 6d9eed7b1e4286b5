//! Sweeps: every sample of a study run, one row each, on all cores, to be resumed after any interruption.
//!
//! ```text
//! study ─ Plan ─ engine (sample → model → run → figures → row) ─ journal ─ table, census, worst, stable
//! ```
//!
//! A finished sample is a row in the journal at once; the table is made from the journal when all are there.

pub(crate) mod census;
pub(crate) mod extremes;
pub(crate) mod job;
pub(crate) mod kept;
pub(crate) mod plan;
mod progress;
mod rehearsal;
pub(crate) mod results;
pub(crate) mod simulation;
mod stable;
pub(crate) mod stored;
pub(crate) mod words;

pub(crate) use census::Census;
pub(crate) use extremes::Extremes;
pub(crate) use plan::Plan;
pub(crate) use results::Results;
pub(crate) use simulation::Simulation;
pub(crate) use stable::{Ensembles, Stable};
pub(crate) use stored::Stored;

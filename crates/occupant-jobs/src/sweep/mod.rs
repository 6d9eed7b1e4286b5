//! Sweeps: every sample of a study run, one row each, on all cores, to be resumed after any interruption.
//!
//! ```text
//! study ─ Plan ─ engine (sample → model → run → figures → row) ─ journal ─ table, census, worst, stable
//! ```
//!
//! A finished sample is a row in the journal at once; the table is made from the journal when all are there.

pub mod census;
pub mod extremes;
pub mod job;
pub mod kept;
pub mod plan;
mod progress;
mod rehearsal;
pub mod results;
pub mod simulation;
mod stable;
pub mod stored;
pub mod words;

pub use census::Census;
pub use extremes::Extremes;
pub use plan::Plan;
pub use results::Results;
pub use simulation::Simulation;
pub use stable::{Ensembles, Stable};
pub use stored::Stored;

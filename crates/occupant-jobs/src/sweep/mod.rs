//! Sweeps: every sample of a study run, one row each, on all cores, to be resumed after any interruption.
//!
//! ```text
//! study ─ Plan ─ engine (sample → model → run → figures → row) ─ journal ─ parts ─ table, census, worst, stable, rating
//! ```
//!
//! A finished sample is a row in the journal at once. When all of a range are there, the journal becomes a part of the table; the
//! table is made from parts and journals when all samples are there.

pub mod extremes;
mod identity;
pub mod job;
pub mod kept;
mod parts;
pub mod plan;
mod progress;
pub mod rating;
mod rehearsal;
pub mod results;
pub mod simulation;
mod stable;
mod staying;
pub mod stored;
mod trial;
pub mod words;

pub use crate::files::study_folder::Census;
pub use extremes::Extremes;
pub use plan::Plan;
pub use results::Results;
pub use simulation::Simulation;
pub use stable::{Ensembles, Stable};
use staying::Staying;
pub use stored::Stored;

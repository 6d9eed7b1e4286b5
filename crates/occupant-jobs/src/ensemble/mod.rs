//! Ensembles: one run many times with small changes, and which figures can be quoted as one number.
//!
//! ```text
//! study ─ members (threads: member → model → run → figures, histories) ─ judged figures, bands ─ tables, plot
//! ```
//!
//! The changes and the quantiles are the core's (`occupant_study`); here are the runs, the tolerances and the words.

pub mod bands;
pub mod beside_run;
pub mod judge;
pub mod members;
mod plot;
mod quotes;
pub mod report;
pub mod text;

pub use bands::{Bands, ChannelBand};
pub use judge::Judged;
pub use members::{Left, Member, Members};
pub use report::{Failed, Report};

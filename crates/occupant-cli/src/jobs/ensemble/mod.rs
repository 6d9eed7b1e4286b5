//! Ensembles: one run many times with small changes, and what may be said of it in one number.
//!
//! ```text
//! study ─ members (threads: member → model → run → figures, histories) ─ judged figures, bands ─ tables, plot
//! ```
//!
//! The changes and the quantiles are the core's (`occupant_study`); here are the runs, the tolerances and the words.

pub(crate) mod bands;
pub(crate) mod beside_run;
pub(crate) mod judge;
pub(crate) mod members;
mod plot;
pub(crate) mod report;
pub(crate) mod text;

pub(crate) use bands::{Bands, ChannelBand};
pub(crate) use judge::Judged;
pub(crate) use members::{Left, Member, Members};
pub(crate) use report::{Failed, Report};

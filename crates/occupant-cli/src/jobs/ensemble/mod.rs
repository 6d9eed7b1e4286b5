//! Ensembles: one run many times with small changes, and what may be said of it in one number.
//!
//! ```text
//! study ─ members (threads: member → model → run → figures, histories) ─ judged figures, bands ─ tables, plot
//! ```
//!
//! The changes and the quantiles are the core's (`occupant_core::study`); here are the runs, the tolerances and the words.

pub mod band_table;
pub mod bands;
pub mod beside_run;
pub mod judge;
pub mod members;
pub mod of_table;
pub mod plot;
pub mod report;
pub mod study_bands;
pub mod text;

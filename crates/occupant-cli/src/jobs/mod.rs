//! The work of the program: runs, sweeps, ensembles, fits, and what is made of their results.
//!
//! A job takes what it needs as values and gives results and their words; it reads no command line.

pub(crate) mod compare;
pub(crate) mod drive;
pub(crate) mod ensemble;
pub(crate) mod export;
pub(crate) mod extend;
pub(crate) mod fit;
pub(crate) mod import;
pub(crate) mod plot;
pub(crate) mod print;
pub(crate) mod report;
pub(crate) mod risk;
pub(crate) mod run;
pub(crate) mod sensitivity;
pub mod study;
pub(crate) mod sweep;

//! The work of the program: runs, sweeps, ensembles, fits, and what is made of their results.
//!
//! A job takes what it needs as values and gives results and their words. It reads no command line and knows no terminal: the
//! command, a notebook and a page use it alike. What it says while it works goes to the `log`; how far it is goes to the bar
//! that the caller gives it ([`base::Show`]).

#![allow(missing_docs, reason = "fields and variants say by their names and units what they hold")]

pub mod base;
pub mod compare;
pub mod drive;
pub mod ensemble;
pub mod export;
pub mod extend;
pub mod files;
pub mod fit;
pub mod import;
pub mod instruments;
pub mod plot;
pub mod print;
pub mod report;
pub mod risk;
pub mod run;
pub mod sensitivity;
pub mod study;
pub mod sweep;

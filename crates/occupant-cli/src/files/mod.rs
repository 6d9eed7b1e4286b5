//! Files that are read and written: results (MCAP), tables, workbooks, measured tests, ISO-MME, folders of studies.
//!
//! Draws no picture, starts no run of its own and knows no command.

mod book;
pub(crate) mod deck;
pub(crate) mod export;
pub(crate) mod history;
pub mod mcap;
pub(crate) mod measured;
pub(crate) mod mme;
mod part;
pub mod results;
pub(crate) mod scenario;
pub(crate) mod signals;
pub(crate) mod steps;
pub(crate) mod study_folder;
pub(crate) mod table;
mod trouble;

//! Files that are read and written: results (MCAP), tables, workbooks, measured tests, ISO-MME.
//!
//! Draws no picture, starts no run of its own and knows no command.

#![allow(missing_docs, reason = "fields and variants say by their names and units what they hold")]

pub mod base;
mod book;
mod channel_code;
pub mod deck;
pub mod export;
pub mod history;
pub mod mcap;
pub mod measured;
pub mod mme;
mod part;
pub mod results;
pub mod scenario;
pub mod signals;
pub mod steps;
pub mod table;
mod trouble;

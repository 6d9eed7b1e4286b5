//! The command `occupant`, as a library: its recorders for other programs, and the command line itself.

pub mod cli;
pub mod figure;
pub mod mcap;
pub mod picture;
mod print;
pub mod report;
pub mod results;
mod sweep;
pub mod view;

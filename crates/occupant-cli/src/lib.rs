//! The command `occupant`, as a library: its recorders for other programs, and the command line itself.

pub mod cli;
mod ensemble;
pub mod mcap;
mod print;
pub mod results;
mod risk;
mod sweep;

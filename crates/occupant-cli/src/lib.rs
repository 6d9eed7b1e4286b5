//! The command `occupant`, as a library: its recorders for other programs, and the command line itself.

pub mod cli;
mod compare;
mod ensemble;
mod export;
pub mod figure;
mod fit;
mod history;
pub mod mcap;
mod measured;
mod mme;
pub mod picture;
mod plot;
mod print;
pub mod report;
pub mod results;
mod risk;
mod sensitivity;
pub mod study;
mod sweep;
pub mod view;

//! Parts of the command `occupant` that other programs and tests may use: its recorders.

pub mod mcap;
